// Bodies: one rectangle of two triangles each. The ray of every pixel in it is intersected with the ellipsoid, so
// outlines are exact at any size.

import {
  BufferAttribute, DynamicDrawUsage, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, RawShaderMaterial,
  Sphere, Vector3,
} from "three";
import { HAZE, SHADE } from "./shade.js";

const VERTEX = `
precision highp float;
in vec2 position;
in vec3 place;
in vec4 row0, row1, row2;   // rows of F, in steps; the last of row0 is 1 if the body is shown
in float radius, value;
uniform mat4 viewMatrix, projectionMatrix;
uniform float shapeStep, enlargement, pixel, smallest, chosen;
flat out vec3 eye, inverse0, inverse1, inverse2;
flat out float colourAt, isChosen;
out vec3 ray;

// Bounds of the cone of tangents, as x or y over -z: roots of a s² + 2 b s + c = 0.
vec2 bounds(vec3 across, vec3 depth, float at, float z) {
  float a = z * z - dot(depth, depth), b = at * z - dot(across, depth), c = at * at - dot(across, across);
  float root = sqrt(max(b * b - a * c, 0.0));
  return vec2(-b - root, -b + root) / a;
}

void main() {
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  if (row0.w < 0.5) return;
  mat3 F = transpose(mat3(row0.xyz, row1.xyz, row2.xyz)) * shapeStep;
  vec3 centre = (viewMatrix * vec4(place, 1.0)).xyz;
  float size = radius * enlargement;
  // Bodies below a size of one or two pixels are drawn as dots.
  float least = smallest * pixel * max(-centre.z, 0.0);
  float longest = size * sqrt(max(dot(F[0], F[0]), max(dot(F[1], F[1]), dot(F[2], F[2]))));
  mat3 G = longest < least ? mat3(least) : mat3(viewMatrix) * F * size;
  vec3 depth = vec3(G[0].z, G[1].z, G[2].z);
  float reach = length(depth);
  if (centre.z - reach > 0.0) return;
  vec2 xs, ys;
  if (-centre.z <= reach * 1.001) {
    xs = (projectionMatrix[2][0] + vec2(-1.0, 1.0)) / projectionMatrix[0][0];
    ys = (projectionMatrix[2][1] + vec2(-1.0, 1.0)) / projectionMatrix[1][1];
  } else {
    xs = bounds(vec3(G[0].x, G[1].x, G[2].x), depth, centre.x, centre.z) + vec2(-1.5, 1.5) * pixel;
    ys = bounds(vec3(G[0].y, G[1].y, G[2].y), depth, centre.y, centre.z) + vec2(-1.5, 1.5) * pixel;
  }
  ray = vec3(position.x < 0.0 ? xs.x : xs.y, position.y < 0.0 ? ys.x : ys.y, -1.0);
  mat3 inverted = inverse(G);
  eye = -(inverted * centre);
  inverse0 = inverted[0]; inverse1 = inverted[1]; inverse2 = inverted[2];
  colourAt = value;
  isChosen = float(gl_InstanceID) == chosen ? 1.0 : 0.0;
  gl_Position = vec4((projectionMatrix * vec4(ray, 1.0)).xy, 0.0, 1.0);
}`;

const FRAGMENT = `
precision highp float;
flat in vec3 eye, inverse0, inverse1, inverse2;
flat in float colourAt, isChosen;
in vec3 ray;
uniform mat4 projectionMatrix;
uniform sampler2D colours;
uniform float mark;
uniform vec3 accent, unknown;
out vec4 colour;
${SHADE}${HAZE}

void main() {
  mat3 inverted = mat3(inverse0, inverse1, inverse2);
  vec3 along = inverted * ray;
  float square = dot(along, along), nearest = -dot(eye, along) / square;
  vec3 point = eye + nearest * along;
  float away = length(point), blur = max(fwidth(away), 1e-6);
  float cover = clamp((1.0 - away) / blur + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  float half_chord = sqrt(max(1.0 - away * away, 0.0) / square);
  float t = nearest - half_chord;
  if (nearest <= 0.0) discard;
  point = normalize(point - half_chord * along);
  vec3 normal = normalize(transpose(inverted) * point);
  float z = -t;
  float depth = (projectionMatrix[2][2] * z + projectionMatrix[3][2]) / -z;
  gl_FragDepth = clamp(0.5 * depth + 0.5, 0.0, 1.0);

  vec3 base = colourAt != colourAt || colourAt < -0.5 ? unknown : texture(colours, vec2((colourAt * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  if (mark > 0.5) {
    // Three great circles and a spot on the material.
    vec3 off = abs(point);
    float line = min(off.x, min(off.y, off.z)), soft = max(fwidth(line), 1e-5);
    float on = (1.0 - smoothstep(0.04 - soft, 0.04 + soft, line)) * min(1.0, 0.09 / soft);
    float spot = length(point - vec3(1.0, 0.0, 0.0)), softer = max(fwidth(spot), 1e-5);
    on = max(on, (1.0 - smoothstep(0.3 - softer, 0.3 + softer, spot)) * min(1.0, 0.6 / softer));
    float light = dot(base, vec3(0.3, 0.59, 0.11));
    base = mix(base, light > 0.45 ? base * 0.42 : mix(base, vec3(1.0), 0.62), 0.8 * on);
  }
  vec3 lit = shade(base, normal, normalize(-ray));
  lit = hazed(lit, -z, 0.3);
  // Outline of the selected body.
  if (isChosen > 0.5) lit = mix(lit, accent, smoothstep(1.0 - 4.5 * blur, 1.0 - 3.5 * blur, away));
  colour = vec4(lit, cover);
}`;

export class Bodies {
  constructor(data, haze) {
    this.data = data;
    const n = data.n;
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.instanceCount = n;
    // A bound of the whole scene; the corners of the rectangle do not give one.
    geometry.boundingSphere = new Sphere(new Vector3(), 1);
    const instanced = (name, array, size) => {
      const attribute = new InstancedBufferAttribute(array, size);
      attribute.setUsage(DynamicDrawUsage);
      geometry.setAttribute(name, attribute);
      return attribute;
    };
    this.place = instanced("place", new Float32Array(3 * n), 3);
    this.rows = [0, 1, 2].map((k) => instanced(`row${k}`, new Int16Array(4 * n), 4));
    this.value = instanced("value", new Float32Array(n), 1);
    instanced("radius", data.radius, 1);
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      alphaToCoverage: true,
      uniforms: {
        shapeStep: { value: data.shapeStep }, enlargement: { value: 1 }, pixel: { value: 1e-3 }, smallest: { value: 1.4 },
        chosen: { value: -1 }, mark: { value: 1 }, colours: { value: null }, accent: { value: new Vector3() },
        unknown: { value: new Vector3(0.6, 0.63, 0.66) }, darkness: { value: 0 }, haze,
      },
    });
    this.mesh = new Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    this.shown = new Uint8Array(n);
  }

  // Set positions, shapes and colours of a time; `colour(body)` is 0 to 1, NaN if unknown.
  show(t, isShown, colour) {
    const { n, x, F } = this.data;
    const place = this.place.array, value = this.value.array;
    const [row0, row1, row2] = this.rows.map((row) => row.array);
    let count = 0;
    place.set(x.subarray(3 * n * t, 3 * n * (t + 1)));
    for (let i = 0; i < n; i++) {
      const visible = isShown(i);
      this.shown[i] = visible ? 1 : 0;
      row0[4 * i + 3] = this.shown[i];
      if (!visible) continue;
      count++;
      const f = 9 * (n * t + i), r = 4 * i;
      row0[r] = F[f]; row0[r + 1] = F[f + 1]; row0[r + 2] = F[f + 2];
      row1[r] = F[f + 3]; row1[r + 1] = F[f + 4]; row1[r + 2] = F[f + 5];
      row2[r] = F[f + 6]; row2[r + 1] = F[f + 7]; row2[r + 2] = F[f + 8];
      value[i] = colour(i);
    }
    for (const attribute of [this.place, ...this.rows, this.value]) attribute.needsUpdate = true;
    return count;
  }

  // The first body on a ray, or -1, by the same geometry as in the shader.
  pick(t, origin, direction, pixel) {
    const { n, x, F, radius, shapeStep } = this.data;
    const { enlargement, smallest } = this.material.uniforms;
    let first = Infinity, found = -1;
    for (let i = 0; i < n; i++) {
      if (!this.shown[i]) continue;
      const p = 3 * (n * t + i), f = 9 * (n * t + i);
      const cx = x[p] - origin.x, cy = x[p + 1] - origin.y, cz = x[p + 2] - origin.z;
      const along = cx * direction.x + cy * direction.y + cz * direction.z;
      if (along <= 0) continue;
      const size = radius[i] * enlargement.value * shapeStep;
      let longest = 0;
      for (let k = 0; k < 3; k++) longest = Math.max(longest, F[f + k] ** 2 + F[f + k + 3] ** 2 + F[f + k + 6] ** 2);
      longest = Math.sqrt(longest) * size;
      // Pointers are inexact: small bodies have a tolerance of some pixels.
      const least = Math.max(smallest.value, 5) * pixel * along;
      const off = cx * cx + cy * cy + cz * cz - along * along;
      const reach = Math.max(1.8 * longest, least);
      if (off > reach * reach) continue;
      let t0;
      if (longest < least) {
        if (off > least * least) continue;
        t0 = along;
      } else {
        const meet = intersect(F, f, size, cx, cy, cz, direction);
        if (meet === null) continue;
        t0 = meet;
      }
      if (t0 < first) { first = t0; found = i; }
    }
    return found;
  }
}

// Distance at which a ray from 0 meets the unit sphere under s·F at a centre; null if it misses.
function intersect(F, f, s, cx, cy, cz, d) {
  const [a, b, c, e, g, h, k, l, o] = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((q) => s * F[f + q]);
  const determinant = a * (g * o - h * l) - b * (e * o - h * k) + c * (e * l - g * k);
  if (determinant === 0) return null;
  const inverse = (x, y, z) => [
    ((g * o - h * l) * x + (c * l - b * o) * y + (b * h - c * g) * z) / determinant,
    ((h * k - e * o) * x + (a * o - c * k) * y + (c * e - a * h) * z) / determinant,
    ((e * l - g * k) * x + (b * k - a * l) * y + (a * g - b * e) * z) / determinant,
  ];
  const [ux, uy, uz] = inverse(d.x, d.y, d.z), [vx, vy, vz] = inverse(cx, cy, cz);
  const uu = ux * ux + uy * uy + uz * uz, uv = ux * vx + uy * vy + uz * vz, vv = vx * vx + vy * vy + vz * vz;
  const root = uv * uv - uu * (vv - 1);
  return root < 0 ? null : (uv - Math.sqrt(root)) / uu;
}
