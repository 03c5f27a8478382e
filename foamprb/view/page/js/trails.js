// Trails: ribbons of constant width on the screen behind the bodies, in the colours that the bodies had, fading
// towards their tails; or whole paths, which do not fade.

import { BufferAttribute, GLSL3, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh, RawShaderMaterial, Sphere, Vector2, Vector3 } from "three";
import { HAZE } from "./shade.js";

const VERTEX = `
precision highp float;
in vec2 position;          // 0 to 1 along the segment, −1 to 1 across
in vec4 older, newer;      // place, and time
in vec2 values;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 size;
uniform float width, tail, now;
out float across, colourAt, share, distance;
void main() {
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  across = position.y;
  vec4 from = older, to = newer;
  vec2 value = values;
  if (to.w <= tail || from.w >= now) return;
  if (from.w < tail) { float s = (tail - from.w) / (to.w - from.w); from = mix(from, to, s); value.x = mix(value.x, value.y, s); }
  if (to.w > now) to = mix(from, to, (now - from.w) / (to.w - from.w));
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from.xyz, 1.0), b = projectionMatrix * modelViewMatrix * vec4(to.xyz, 1.0);
  // Cut at the plane near the eye.
  float da = a.z + a.w, db = b.z + b.w;
  if (da <= 0.0 && db <= 0.0) return;
  if (da <= 0.0) a = mix(a, b, da / (da - db)); else if (db <= 0.0) b = mix(b, a, db / (db - da));
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  along = length(along) > 1e-3 ? normalize(along) : vec2(1.0, 0.0);
  vec4 here = position.x < 0.5 ? a : b;
  distance = here.w;
  float time = position.x < 0.5 ? from.w : to.w;
  share = now > tail ? clamp((time - tail) / (now - tail), 0.0, 1.0) : 1.0;
  colourAt = position.x < 0.5 ? value.x : value.y;
  float wide = width * (0.35 + 0.65 * share);
  gl_Position = here + vec4(vec2(-along.y, along.x) * position.y * wide / size * here.w, 0.0, 0.0);
}`;

const FRAGMENT = `
precision highp float;
in float across, colourAt, share, distance;
uniform sampler2D colours;
uniform vec3 unknown;
uniform float opacity, fading;
out vec4 colour;
${HAZE}
void main() {
  vec3 base = colourAt != colourAt || colourAt < -0.5 ? unknown : texture(colours, vec2((clamp(colourAt, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  float edge = 1.0 - smoothstep(0.55, 1.0, abs(across));
  colour = vec4(hazed(base, distance, 0.3), opacity * edge * mix(1.0, pow(share, 1.5), fading));
}`;

const NUMBERS = 10;

export class Trails {
  constructor(data, width, haze) {
    this.data = data;
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false,
      uniforms: {
        size: { value: new Vector2(1, 1) }, width: { value: width }, tail: { value: -Infinity }, now: { value: 0 },
        opacity: { value: 0.8 }, fading: { value: 1 }, colours: { value: null }, unknown: { value: new Vector3(0.6, 0.63, 0.66) }, haze,
      },
    });
    this.mesh = new Mesh(new InstancedBufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 3;
    this.mesh.visible = false;
    this.numbers = new Float32Array(0);
    // Paths that the run recorded are finer than the written times. One through a coupled patch has several parts.
    this.recorded = new Map();
    data.paths?.bodies.forEach((body, k) => this.recorded.set(body, [...(this.recorded.get(body) ?? []), k]));
  }

  // Draw bodies from one time to another; `colour(t, i)` is the place in the colours at the written time t.
  draw(bodies, tail, now, colour, fading) {
    const { data } = this, { n, x, times, paths } = data;
    const first = Math.max(0, frameBefore(times, tail)), last = frameBefore(times, now * (1 + 1e-9));
    let used = 0;
    const add = (from, i, t0, v0, to, j, t1, v1) => {
      if (from[3 * i] === to[3 * j] && from[3 * i + 1] === to[3 * j + 1] && from[3 * i + 2] === to[3 * j + 2]) return;
      if (NUMBERS * (used + 1) > this.numbers.length) {
        const larger = new Float32Array(Math.max(4096, 2 * this.numbers.length));
        larger.set(this.numbers);
        this.numbers = larger;
      }
      const k = NUMBERS * used++, { numbers } = this;
      for (let c = 0; c < 3; c++) { numbers[k + c] = from[3 * i + c]; numbers[k + 4 + c] = to[3 * j + c]; }
      numbers[k + 3] = t0; numbers[k + 7] = t1; numbers[k + 8] = v0; numbers[k + 9] = v1;
    };
    for (const body of bodies) {
      const parts = this.recorded.get(body);
      for (const part of parts ?? []) {
        for (let k = paths.start[part] + 1; k < paths.start[part + 1]; k++) {
          if (paths.times[k] <= tail || paths.times[k - 1] >= now) continue;
          const [v0, v1] = [k - 1, k].map((j) => colour(nearest(times, paths.times[j]), body));
          add(paths.points, k - 1, paths.times[k - 1], v0, paths.points, k, paths.times[k], v1);
        }
      }
      for (let t = parts ? last + 1 : first + 1; t <= last; t++) {
        if (!data.present(t - 1, body) || data.jumps(t, body)) continue;
        add(x, n * (t - 1) + body, times[t - 1], colour(t - 1, body), x, n * t + body, times[t], colour(t, body));
      }
    }
    this.replace(used);
    Object.assign(this.material.uniforms.tail, { value: tail });
    Object.assign(this.material.uniforms.now, { value: now });
    Object.assign(this.material.uniforms.fading, { value: fading ? 1 : 0 });
  }

  replace(used) {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([0, -1, 1, -1, 1, 1, 0, 1]), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const buffer = new InstancedInterleavedBuffer(this.numbers.slice(0, NUMBERS * used), NUMBERS);
    geometry.setAttribute("older", new InterleavedBufferAttribute(buffer, 4, 0));
    geometry.setAttribute("newer", new InterleavedBufferAttribute(buffer, 4, 4));
    geometry.setAttribute("values", new InterleavedBufferAttribute(buffer, 2, 8));
    geometry.instanceCount = used;
    // The corners of the rectangle give no bound of the scene.
    geometry.boundingSphere = new Sphere(new Vector3(), 1);
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
    this.mesh.visible = used > 0;
  }
}

// Index of the last time that is not after `time`, or −1.
export function frameBefore(times, time) {
  let low = 0, high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle + 1; else high = middle;
  }
  return low - 1;
}

function nearest(times, time) {
  const k = Math.max(0, frameBefore(times, time));
  return k + 1 < times.length && times[k + 1] - time < time - times[k] ? k + 1 : k;
}
