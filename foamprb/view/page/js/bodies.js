// Bodies: one rectangle of two triangles each. The ray of every pixel in it is intersected with the ellipsoid, or with
// the surface of the quadratic mode, so outlines are exact at any size.

import {
  BufferAttribute, DynamicDrawUsage, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, RawShaderMaterial,
  Sphere, Vector3,
} from "three";
import { HAZE, SHADE } from "./shade.js";

// The quadratic mode: a point Y of the unit sphere goes to V Y + B YY, where F = V Q and Y = Q X with the rotation Q.
const MODE = `
// B·y, symmetric, from the components 111, 112, 113, 122 and 123, 222, 223.
mat3 along_mode(vec4 b, vec3 c, vec3 y) {
  float xzz = -b.x - b.w, yzz = -b.y - c.y, zzz = -b.z - c.z;
  float xy = b.y * y.x + b.w * y.y + c.x * y.z, xz = b.z * y.x + c.x * y.y + xzz * y.z, yz = c.x * y.x + c.z * y.y + yzz * y.z;
  return mat3(
    b.x * y.x + b.y * y.y + b.z * y.z, xy, xz,
    xy, b.w * y.x + c.y * y.y + c.z * y.z, yz,
    xz, yz, xzz * y.x + yzz * y.y + zzz * y.z);
}`;

const VERTEX = `
precision highp float;
in vec2 position;
in vec3 place;
in vec4 row0, row1, row2;   // rows of F, in steps; the last of row0 is 1 if the body is shown
in float radius, value;
#ifdef QUADRATIC
in vec4 mode0, mode1;   // the components of B, in steps
uniform float modeStep;
flat out mat3 stretch, material;
flat out vec4 modeA;
flat out vec3 modeB;
#endif
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
  mat3 bounding = G;
#ifdef QUADRATIC
  mat3 turn = mat3(1.0), inverseV;
  modeA = vec4(0.0); modeB = vec3(0.0);
  if (longest >= least) {
    turn = F;
    // The rotation of F, by Newton's iteration.
    for (int k = 0; k < 12; k++) turn = 0.5 * (turn + transpose(inverse(turn)));
    modeA = mode0 * modeStep; modeB = mode1.xyz * modeStep;
    // The ellipsoid, so much larger, contains the surface: |B YY| is at most the amplitude.
    float xzz = modeA.x + modeA.w, yzz = modeA.y + modeB.y, zzz = modeA.z + modeB.z;
    float squares = modeA.x * modeA.x + modeB.y * modeB.y + zzz * zzz
      + 3.0 * (dot(modeA.yzw, modeA.yzw) + modeB.z * modeB.z + xzz * xzz + yzz * yzz) + 6.0 * modeB.x * modeB.x;
    inverseV = inverse(F);
    bounding = G * (1.0 + sqrt(0.4 * squares * (dot(inverseV[0], inverseV[0]) + dot(inverseV[1], inverseV[1]) + dot(inverseV[2], inverseV[2]))));
    G = mat3(viewMatrix) * size;
    stretch = F * transpose(turn);
  } else stretch = mat3(1.0);
  material = transpose(turn);
#endif
  vec3 depth = vec3(bounding[0].z, bounding[1].z, bounding[2].z);
  float reach = length(depth);
  if (centre.z - reach > 0.0) return;
  vec2 xs, ys;
  if (-centre.z <= reach * 1.001) {
    xs = (projectionMatrix[2][0] + vec2(-1.0, 1.0)) / projectionMatrix[0][0];
    ys = (projectionMatrix[2][1] + vec2(-1.0, 1.0)) / projectionMatrix[1][1];
  } else {
    xs = bounds(vec3(bounding[0].x, bounding[1].x, bounding[2].x), depth, centre.x, centre.z) + vec2(-1.5, 1.5) * pixel;
    ys = bounds(vec3(bounding[0].y, bounding[1].y, bounding[2].y), depth, centre.y, centre.z) + vec2(-1.5, 1.5) * pixel;
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
#ifdef QUADRATIC
flat in mat3 stretch, material;
flat in vec4 modeA;
flat in vec3 modeB;
${MODE}
#endif
${SHADE}${HAZE}

void main() {
  mat3 inverted = mat3(inverse0, inverse1, inverse2);
  vec3 along = inverted * ray;
  float square = dot(along, along), nearest = -dot(eye, along) / square;
  vec3 point = eye + nearest * along;
#ifdef QUADRATIC
  // Newton's iterations for the point of the ray whose image in the sphere is nearest to its centre, then for the
  // point where the image enters the sphere.
  mat3 inverseV = inverse(stretch), tangent = inverseV;
  vec3 speed = tangent * along;
  nearest = -dot(inverseV * eye, speed) / dot(speed, speed);
  point = inverseV * (eye + nearest * along);
  for (int k = 0; k < 6; k++) {
    mat3 half_slope = along_mode(modeA, modeB, point);
    tangent = inverse(stretch + 2.0 * half_slope);
    point += tangent * (eye + nearest * along - (stretch + half_slope) * point);
    speed = tangent * along;
    float bend = dot(speed, speed) - 2.0 * dot(point, tangent * (along_mode(modeA, modeB, speed) * speed));
    float change = -dot(point, speed) / max(bend, 0.3 * dot(speed, speed));
    nearest += change;
    point += change * speed;
    // Farther out the map folds.
    point *= min(1.0, 1.2 / length(point));
  }
  square = dot(speed, speed);
#endif
  float away = length(point);
#ifdef QUADRATIC
  vec3 residual = eye + nearest * along - (stretch + along_mode(modeA, modeB, point)) * point;
  if (dot(residual, residual) > 1e-3) away = 2.0;
#endif
  float blur = max(fwidth(away), 1e-6);
  float cover = clamp((1.0 - away) / blur + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  float half_chord = sqrt(max(1.0 - away * away, 0.0) / square);
  float t = nearest - half_chord;
  if (nearest <= 0.0) discard;
#ifdef QUADRATIC
  point -= half_chord * speed;
  for (int k = 0; k < 5; k++) {
    mat3 half_slope = along_mode(modeA, modeB, point);
    tangent = inverse(stretch + 2.0 * half_slope);
    point += tangent * (eye + t * along - (stretch + half_slope) * point);
    speed = tangent * along;
    float change = 0.5 * (1.0 - dot(point, point)) / min(dot(point, speed), -1e-3 * sqrt(square));
    change = clamp(change, -0.5 * half_chord, 0.5 * half_chord);
    t += change;
    point += change * speed;
  }
  vec3 normal = normalize(transpose(tangent * inverted) * point);
  residual = eye + t * along - (stretch + along_mode(modeA, modeB, point)) * point;
  if (dot(residual, residual) > 1e-3) discard;
  point = normalize(material * point);
#else
  point = normalize(point - half_chord * along);
  vec3 normal = normalize(transpose(inverted) * point);
#endif
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

// ε of the bullet r = 1 + ε P₃ with as large a mode.
export function amplitude([xxx, xxy, xxz, xyy, xyz, yyy, yyz]) {
  const once = xxx ** 2 + yyy ** 2 + (xxz + yyz) ** 2;
  const thrice = xxy ** 2 + xxz ** 2 + xyy ** 2 + yyz ** 2 + (xxx + xyy) ** 2 + (xxy + yyy) ** 2;
  return Math.sqrt(0.4 * (once + 3 * thrice + 6 * xyz ** 2));
}

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
    this.modes = data.B ? [0, 1].map((k) => instanced(`mode${k}`, new Int16Array(4 * n), 4)) : [];
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      defines: data.B ? { QUADRATIC: 1 } : {},
      alphaToCoverage: true,
      uniforms: {
        shapeStep: { value: data.shapeStep }, modeStep: { value: data.modeStep }, enlargement: { value: 1 }, pixel: { value: 1e-3 }, smallest: { value: 1.4 },
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
    const { n, x, F, B } = this.data;
    const [mode0, mode1] = this.modes.map((mode) => mode.array);
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
      if (B) {
        const b = 7 * (n * t + i);
        mode0.set(B.subarray(b, b + 4), r);
        mode1.set(B.subarray(b + 4, b + 7), r);
      }
      value[i] = colour(i);
    }
    for (const attribute of [this.place, ...this.rows, ...this.modes, this.value]) attribute.needsUpdate = true;
    return count;
  }

  // The first body on a ray, or -1, by the ellipsoids.
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
