// Data of the page: decodes the columns of encode.py.

async function inflated(text) {
  let bytes;
  if (Uint8Array.fromBase64) {
    bytes = Uint8Array.fromBase64(text);
  } else {
    const characters = atob(text);
    bytes = new Uint8Array(characters.length);
    for (let i = 0; i < characters.length; i++) bytes[i] = characters.charCodeAt(i);
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function section(number) {
  const element = document.getElementById(`section-${number}`);
  const text = element.textContent.trim();
  element.remove();
  return text;
}

const BLOCK = 64;
// As in encode.py: the code of the value 0, and the steps from a power of two to the next.
const MANTISSA_BITS = 14, MANTISSAS = 2 ** MANTISSA_BITS, ZERO = 2 + 24 * MANTISSAS;

// Integers of a column, the time first, as an array of type `Kind`.
async function column(spec, Kind = Int32Array) {
  const planes = await inflated(section(spec.section));
  const m = spec.shape[0], { order, bytes } = spec;
  const n = spec.shape.reduce((a, b) => a * b, 1);
  const width = m ? n / m : 0;
  const whole = new Kind(n);
  const [one, two, three, four] = [0, 1, 2, 3].map((k) => planes.subarray(k * n, (k + 1) * n));
  // Bodies are decoded in blocks, so that writes to different times stay in the cache.
  const block = new Int32Array(m * BLOCK);
  for (let from = 0, i = 0; from < width; from += BLOCK) {
    const to = Math.min(width, from + BLOCK), size = to - from;
    for (let j = 0; j < size; j++) {
      let value = 0, change = 0;
      for (let t = 0; t < m; t++, i++) {
        let coded = one[i];
        if (bytes > 1) coded |= two[i] << 8;
        if (bytes > 2) coded |= three[i] << 16;
        if (bytes > 3) coded |= four[i] << 24;
        const difference = (coded >>> 1) ^ -(coded & 1);
        if (order === 0) value = difference;
        else if (order === 1) value += difference;
        else { change += difference; value += change; }
        block[t * size + j] = value;
      }
    }
    for (let t = 0; t < m; t++) whole.set(block.subarray(t * size, (t + 1) * size), t * width + from);
  }
  return whole;
}

// Positions in the coordinates of the page.
async function places(packed, frame) {
  const whole = await column(packed);
  const result = new Float32Array(whole.length);
  for (let i = 0; i < whole.length; i++) {
    const c = i % 3;
    result[i] = (packed.low[c] + packed.step[0] * whole[i] - frame.middle[c]) / frame.size;
  }
  return result;
}

// Array of the bodies: `at(frame, body, component)`, NaN where unknown.
class Field {
  constructor(spec, whole, n) {
    Object.assign(this, spec);
    this.whole = whole;
    this.n = n;
    this.components = spec.shape[2];
    this.constant = spec.shape[0] === 1;
    this.own = spec.parts.filter((part) => part !== "magnitude");
  }

  at(frame, body, component) {
    const row = this.constant ? 0 : frame;
    const code = this.whole[(row * this.n + body) * this.components + component];
    if (code === 0) return NaN;
    const k = code - ZERO, steps = Math.abs(k) - 1;
    if (k === 0) return 0;
    return Math.sign(k) * this.low[component] * 2 ** (steps >> MANTISSA_BITS) * (1 + (steps % MANTISSAS) / MANTISSAS);
  }

  value(frame, body, part) {
    if (part !== "magnitude") return this.at(frame, body, Math.max(0, this.own.indexOf(part)));
    let sum = 0;
    for (let c = 0; c < this.components; c++) sum += this.at(frame, body, c) ** 2;
    return Math.sqrt(sum);
  }
}

// Property with names.
class Codes {
  constructor(spec, whole, n) {
    Object.assign(this, spec);
    this.whole = whole;
    this.n = n;
    this.constant = spec.shape[0] === 1;
  }

  code(frame, body) {
    return this.whole[(this.constant ? 0 : frame) * this.n + body];
  }

  meaning(frame, body) {
    return this.meanings[this.code(frame, body)] ?? "";
  }
}

export async function load() {
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const n = scene.bodies.ids.shape[0], m = scene.times.length;
  const frame = scene.frame;
  const codes = {}, fields = {};
  for (const [name, spec] of Object.entries(scene.codes)) codes[name] = new Codes(spec, await column(spec, Uint8Array), n);
  for (const [name, spec] of Object.entries(scene.fields)) fields[name] = new Field(spec, await column(spec), n);
  const surfaces = [];
  for (const spec of scene.surfaces) {
    const density = spec.density ? await column(spec.density, Uint8Array) : null;
    surfaces.push({ ...spec, density, points: await places(spec.points, frame), triangles: await column(spec.triangles, Uint32Array) });
  }
  let flow = null;
  if (scene.flow) {
    const { lines } = scene.flow, values = [];
    for (const spec of scene.flow.values) values.push({ ...spec, whole: await column(spec, Uint8Array) });
    flow = { ...scene.flow, values, lines: { ...lines, points: await places(lines.points, frame), start: await column(lines.start) } };
  }
  const linear = async (spec) => Float64Array.from(await column(spec), (whole) => spec.low[0] + spec.step[0] * whole);
  let paths = null;
  if (scene.paths) {
    paths = {
      bodies: await column(scene.paths.bodies), start: await column(scene.paths.start),
      points: await places(scene.paths.points, frame), times: await linear(scene.paths.times),
    };
  }
  const radius = Float32Array.from(await linear(scene.bodies.radius), (r) => r / frame.size);
  return {
    scene, n, m, times: scene.times, codes, fields, surfaces, flow, paths, radius,
    edges: await places(scene.edges, frame),
    ids: await column(scene.bodies.ids, Float64Array),
    x: await places(scene.bodies.places, frame),
    F: await column(scene.bodies.shapes, Int16Array),
    shapeStep: scene.bodies.shapes.step[0],
    // Quadratic modes, if bodies have them.
    B: scene.bodies.modes ? await column(scene.bodies.modes, Int16Array) : null,
    modeStep: scene.bodies.modes ? scene.bodies.modes.step[0] : 0,
    bits: await column(scene.bodies.present, Uint8Array),
    bytesOfBits: scene.bodies.present.shape[1],
    // Whether a body passed through a coupled patch before a time: it moved much farther than its velocities carry it.
    jumps(t, i) {
      const a = 3 * (n * (t - 1) + i), b = 3 * (n * t + i), { x } = this;
      const far = Math.hypot(x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]);
      if (far < 0.1 || !fields.U) return false;
      const fastest = Math.max(...[t - 1, t].map((k) => fields.U.value(k, i, "magnitude")));
      return far * frame.size > 10 * fastest * (scene.times[t] - scene.times[t - 1]);
    },
    present(t, i) { return (this.bits[t * this.bytesOfBits + (i >> 3)] >> (i & 7)) & 1; },
  };
}
