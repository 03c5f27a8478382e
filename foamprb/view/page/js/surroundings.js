// Surroundings of the bodies: walls, edges, and marks of deposits.

import {
  BackSide, BufferAttribute, BufferGeometry, FrontSide, GLSL3, Group, LineSegments, Mesh, Points,
  RawShaderMaterial, Vector3,
} from "three";
import { HAZE, SHADE } from "./shade.js";

const SURFACE_VERTEX = `
precision highp float;
in vec3 position, normal;
in float density;
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 across, place;
out float amount;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  amount = density;
  across = mat3(modelViewMatrix) * normal;
  place = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`;

const SURFACE_FRAGMENT = `
precision highp float;
in vec3 across, place;
in float amount;
uniform vec3 base, deep;
uniform float opacity, painted;
uniform sampler2D colours;
out vec4 colour;
${SHADE}${HAZE}
void main() {
  // Towards the viewer: gl_FrontFacing is true for the visible side of any material.
  vec3 normal = normalize(dot(across, place) < 0.0 ? across : -across);
  vec3 towards = normalize(-place);
  float facing = abs(dot(normal, towards));
  float lit = 0.5 + 0.5 * dot(normal, normalize(vec3(-0.35, 0.75, 0.55)));
  vec3 seen = mix(deep, base, smoothstep(0.1, 0.95, lit));
  if (painted > 0.5) seen = (0.75 + 0.25 * lit) * texture(colours, vec2(amount, 0.5)).rgb;
  seen = hazed(seen, -place.z, 0.35);
  // Glass is denser at grazing angles.
  colour = vec4(seen, opacity >= 1.0 ? 1.0 : opacity * (1.0 + 2.5 * pow(1.0 - facing, 3.0)));
}`;

const LINE_VERTEX = `
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
out float distance;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  distance = -seen.z;
  gl_Position = projectionMatrix * seen;
  // Edges lie in front of their walls.
  gl_Position.z -= 2e-5 * gl_Position.w;
}`;

const LINE_FRAGMENT = `
precision highp float;
in float distance;
uniform vec3 base;
uniform float opacity;
out vec4 colour;
${HAZE}
void main() {
  colour = vec4(hazed(base, distance, 0.6), opacity);
}`;

const POINT_VERTEX = `
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float ratio;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_Position.z = 0.0;
  gl_PointSize = 8.0 * ratio;
}`;

const POINT_FRAGMENT = `
precision highp float;
uniform vec3 base, paper;
uniform float ratio;
out vec4 colour;
void main() {
  float away = 8.0 * ratio * length(gl_PointCoord - 0.5);
  float cover = 1.0 - smoothstep(4.0 * ratio - 1.0, 4.0 * ratio, away);
  if (cover <= 0.0) discard;
  colour = vec4(mix(base, paper, smoothstep(2.6 * ratio - 0.5, 2.6 * ratio + 0.5, away)), cover);
}`;

function material(vertexShader, fragmentShader, uniforms, more = {}) {
  const values = Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, { value }]));
  return new RawShaderMaterial({ glslVersion: GLSL3, vertexShader, fragmentShader, uniforms: values, ...more });
}

export function lineMaterial(opacity, haze) {
  const made = material(LINE_VERTEX, LINE_FRAGMENT, { base: new Vector3(), opacity }, { transparent: true, depthWrite: false });
  made.uniforms.haze = haze;
  return made;
}

export const isWall = (patch) => patch.type === "wall" || patch.type === "mappedWall";
export const isFlat = (patch) => patch.type === "empty" || patch.type === "wedge";

export class Walls {
  constructor(data, haze) {
    this.group = new Group();
    this.patches = data.surfaces.map((surface) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(surface.points, 3));
      const density = surface.density ?? new Uint8Array(surface.points.length / 3);
      geometry.setAttribute("density", new BufferAttribute(density, 1, true));
      geometry.setIndex(new BufferAttribute(surface.triangles, 1));
      geometry.computeVertexNormals();
      const side = (more, order) => {
        const mesh = new Mesh(geometry, material(SURFACE_VERTEX, SURFACE_FRAGMENT,
          { base: new Vector3(), deep: new Vector3(), opacity: 1, darkness: 0, painted: 0, colours: null }, more));
        Object.assign(mesh.material.uniforms, { haze });
        mesh.renderOrder = order;
        this.group.add(mesh);
        return mesh;
      };
      const clear = { transparent: true, depthWrite: false };
      return {
        name: surface.name, type: surface.type, dense: Boolean(surface.density), visible: !isFlat(surface),
        far: side({ side: BackSide }, 0), veil: side({ side: BackSide, ...clear }, 1), near: side({ side: FrontSide, ...clear }, 5),
      };
    });
    const edges = new BufferGeometry();
    edges.setAttribute("position", new BufferAttribute(data.edges, 3));
    this.edges = new LineSegments(edges, lineMaterial(0.75, haze));
    this.edges.renderOrder = 4;
    this.group.add(this.edges);
  }

  // `colours`: the texture of the deposits per area, or null.
  paint(palette, style, dark, colours) {
    for (const patch of this.patches) {
      const wall = isWall(patch), painted = colours !== null && patch.dense;
      patch.far.visible = patch.visible && style === "glass" && wall;
      patch.veil.visible = patch.visible && style !== "none" && !patch.far.visible;
      patch.near.visible = patch.visible && style !== "none";
      for (const mesh of [patch.far, patch.veil, patch.near]) {
        const { base, deep, opacity } = mesh.material.uniforms;
        base.value.set(...(wall ? palette.glass : palette.accent));
        deep.value.set(...(wall ? palette.glassDeep : palette.accent));
        opacity.value = mesh === patch.far ? 1 : painted ? 0.35 : wall ? (style === "glass" ? 0.1 : 0.06) : 0.05;
        mesh.material.uniforms.darkness.value = dark ? 1 : 0;
        mesh.material.uniforms.painted.value = painted ? 1 : 0;
        mesh.material.uniforms.colours.value = colours;
      }
    }
    this.edges.material.uniforms.base.value.set(...palette.edge);
  }
}

// Marks of constant screen size at stuck bodies.
export class Deposits {
  constructor() {
    this.points = new Points(new BufferGeometry(), material(POINT_VERTEX, POINT_FRAGMENT,
      { base: new Vector3(), paper: new Vector3(), ratio: 1 }, { transparent: true, depthTest: false, depthWrite: false }));
    this.points.frustumCulled = false;
    this.points.renderOrder = 6;
  }

  draw(places) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
    this.points.geometry.dispose();
    this.points.geometry = geometry;
    this.points.visible = places.length > 0;
  }
}
