// The flow: streamlines, and a plane that can be dragged through a grid of values. The surfaces of the mesh, drawn into
// the stencil on the far side of the plane, bound the plane exactly.

import {
  AlwaysStencilFunc, BackSide, BufferAttribute, BufferGeometry, Data3DTexture, DecrementWrapStencilOp, DoubleSide, FrontSide,
  GLSL3, Group, IncrementWrapStencilOp, LinearFilter, LineSegments, Mesh, NotEqualStencilFunc, RawShaderMaterial, RedFormat, Vector3,
  Vector4,
} from "three";
import { lineMaterial } from "./surroundings.js";

const HALF_VERTEX = `
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec4 half_space;
out float beyond;
void main() {
  beyond = dot(half_space.xyz, position) - half_space.w;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const HALF_FRAGMENT = `
precision highp float;
in float beyond;
out vec4 colour;
void main() { if (beyond < 0.0) discard; colour = vec4(0.0); }`;

const PLANE_VERTEX = `
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 place;
void main() {
  place = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  // Behind the edges of walls.
  gl_Position.z += 4e-5 * gl_Position.w;
}`;

const PLANE_FRAGMENT = `
precision highp float;
precision highp sampler3D;
in vec3 place;
uniform sampler3D grid;
uniform sampler2D colours;
uniform vec3 low, size, number;
out vec4 colour;
void main() {
  vec3 at = (0.5 + clamp((place - low) / size, 0.0, 1.0) * (number - 1.0)) / number;
  colour = vec4(texture(colours, vec2((texture(grid, at).r * 255.0 + 0.5) / 256.0, 0.5)).rgb, 1.0);
}`;

export function streamlines(flow, haze) {
  const { points, start } = flow.lines, places = [];
  for (let k = 0; k + 1 < start.length; k++) {
    for (let i = start[k] + 1; i < start[k + 1]; i++) for (const j of [i - 1, i]) places.push(points[3 * j], points[3 * j + 1], points[3 * j + 2]);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
  const lines = new LineSegments(geometry, lineMaterial(flow.lines.opacity, haze));
  lines.renderOrder = 2;
  return lines;
}

export class FlowPlane {
  constructor(data, walls) {
    const { low, high, values } = data.flow;
    this.low = new Vector3(...low);
    this.high = new Vector3(...high);
    this.group = new Group();
    this.half = new Vector4();
    for (const { far } of walls.patches) {
      for (const [side, stencilZPass] of [[FrontSide, DecrementWrapStencilOp], [BackSide, IncrementWrapStencilOp]]) {
        const mesh = new Mesh(far.geometry, new RawShaderMaterial({
          glslVersion: GLSL3, vertexShader: HALF_VERTEX, fragmentShader: HALF_FRAGMENT, uniforms: { half_space: { value: this.half } },
          side, colorWrite: false, depthWrite: false, depthTest: false, stencilWrite: true, stencilFunc: AlwaysStencilFunc, stencilZPass,
        }));
        mesh.renderOrder = -2;
        this.group.add(mesh);
      }
    }
    this.textures = values.map(({ whole, shape }) => {
      const texture = new Data3DTexture(whole, shape[2], shape[1], shape[0]);
      Object.assign(texture, { format: RedFormat, minFilter: LinearFilter, magFilter: LinearFilter, unpackAlignment: 1, needsUpdate: true });
      return texture;
    });
    const [nz, ny, nx] = values[0].shape, size = this.high.clone().sub(this.low).max(new Vector3(1e-9, 1e-9, 1e-9));
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: PLANE_VERTEX, fragmentShader: PLANE_FRAGMENT, side: DoubleSide,
      stencilWrite: true, stencilFunc: NotEqualStencilFunc, stencilRef: 0,
      uniforms: { grid: { value: null }, colours: { value: null }, low: { value: this.low }, size: { value: size }, number: { value: new Vector3(nx, ny, nz) } },
    });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.mesh.geometry.setAttribute("position", new BufferAttribute(new Float32Array(12), 3));
    this.mesh.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
    this.group.add(this.mesh);
    this.group.visible = false;
  }

  // Extent of the box along a direction.
  range(normal) {
    const middle = this.low.clone().add(this.high).multiplyScalar(0.5), halves = this.high.clone().sub(middle);
    const reach = Math.abs(normal.x) * halves.x + Math.abs(normal.y) * halves.y + Math.abs(normal.z) * halves.z;
    return [middle.dot(normal) - reach, middle.dot(normal) + reach];
  }

  place(normal, offset) {
    Object.assign(this, { normal, offset });
    const middle = this.low.clone().add(this.high).multiplyScalar(0.5), reach = this.high.distanceTo(this.low);
    this.centre = middle.addScaledVector(normal, offset - middle.dot(normal));
    const across = new Vector3(...(Math.abs(normal.x) < 0.7 ? [1, 0, 0] : [0, 1, 0])).cross(normal).normalize(), upright = normal.clone().cross(across);
    [[-1, -1], [1, -1], [1, 1], [-1, 1]].forEach(([a, b], k) => {
      this.centre.clone().addScaledVector(across, a * reach).addScaledVector(upright, b * reach).toArray(this.mesh.geometry.attributes.position.array, 3 * k);
    });
    this.mesh.geometry.attributes.position.needsUpdate = true;
  }

  // Show one of the quantities, or none if `k` is not a number.
  show(k, colours) {
    this.group.visible = k in this.textures;
    if (!this.group.visible) return;
    this.material.uniforms.grid.value = this.textures[k];
    this.material.uniforms.colours.value = colours;
  }

  // The surfaces count on the side of the plane that is away from the eye.
  face(eye) {
    if (!this.normal) return;
    const s = eye.dot(this.normal) > this.offset ? -1 : 1;
    this.half.set(s * this.normal.x, s * this.normal.y, s * this.normal.z, s * this.offset);
  }
}
