// Density of deposits on the walls: the kernels of all places up to a time, summed on a grid that the walls sample.

import { Data3DTexture, LinearFilter, RedFormat, Vector3 } from "three";

export class Painting {
  constructor(data) {
    const { places, times, width, cell, reach, most, peak } = data.painting;
    Object.assign(this, { places, times, width, cell, reach, most, peak, count: 0 });
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const { points } of data.surfaces) {
      for (let i = 0; i < points.length; i++) { low[i % 3] = Math.min(low[i % 3], points[i]); high[i % 3] = Math.max(high[i % 3], points[i]); }
    }
    this.low = low;
    this.number = [0, 1, 2].map((c) => Math.ceil((high[c] - low[c]) / cell) + 1);
    const size = this.number.reduce((a, b) => a * b, 1);
    this.sums = new Float32Array(size);
    this.bytes = new Uint8Array(size);
    this.texture = new Data3DTexture(this.bytes, ...this.number);
    Object.assign(this.texture, { format: RedFormat, minFilter: LinearFilter, magFilter: LinearFilter, unpackAlignment: 1, needsUpdate: true });
    this.uniforms = {
      paint: { value: this.texture }, paintLow: { value: new Vector3(...low) }, paintCell: { value: cell },
      paintNumber: { value: new Vector3(...this.number) },
    };
  }

  // Sum the kernels of the places up to a time.
  show(time) {
    const before = this.count;
    while (this.count < this.times.length && this.times[this.count] <= time) this.add(this.count++, 1);
    while (this.count > 0 && this.times[this.count - 1] > time) this.add(--this.count, -1);
    if (this.count === before) return;
    if (this.count === 0) this.sums.fill(0);
    for (let i = 0; i < this.sums.length; i++) this.bytes[i] = Math.max(0, Math.min(255, (255 * this.sums[i]) / this.most));
    this.texture.needsUpdate = true;
  }

  add(place, sign) {
    const { low, number, cell, width, sums } = this, far = this.reach * width;
    const at = [0, 1, 2].map((c) => this.places[3 * place + c] - low[c]);
    const from = at.map((x) => Math.max(0, Math.ceil((x - far) / cell))), to = at.map((x, c) => Math.min(number[c] - 1, Math.floor((x + far) / cell)));
    for (let k = from[2]; k <= to[2]; k++) {
      for (let j = from[1]; j <= to[1]; j++) {
        const off = (k * cell - at[2]) ** 2 + (j * cell - at[1]) ** 2, row = number[0] * (j + number[1] * k);
        for (let i = from[0]; i <= to[0]; i++) {
          const square = off + (i * cell - at[0]) ** 2;
          if (square < far * far) sums[row + i] += sign * this.peak * Math.exp((-0.5 * square) / (width * width));
        }
      }
    }
  }

  // Density in the unit of the legend at a point of the page.
  at(x, y, z) {
    const [i, j, k] = [x, y, z].map((v, c) => Math.round((v - this.low[c]) / this.cell));
    return this.sums[i + this.number[0] * (j + this.number[1] * k)];
  }
}
