// Values of the bodies over time: median and 5–95 % band, curves of chosen bodies, or numbers of bodies by name.
// A click sets the time; a drag draws a box through which the shown bodies must pass.

import uPlot from "uplot";
import { axis, colourOfName, number, readable } from "./colours.js";

// Bodies whose values are sorted at each time.
const MOST = 4000;
const SHARES = [0.95, 0.5, 0.05];
export const CURVES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8c6d1f", "#56b4e9"];
const DASHES = [[], [8, 3], [3, 3], [8, 3, 2, 3], [14, 4], [2, 5]];

// Name of a curve beside a piece of it.
export function curveKey(text, colour, k) {
  const key = document.createElement("span"), svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  for (const [name, value] of Object.entries({ d: "M0 5H26", stroke: colour, "stroke-dasharray": DASHES[k % DASHES.length].join(" ") })) line.setAttribute(name, value);
  svg.setAttribute("viewBox", "0 0 26 10");
  svg.setAttribute("aria-hidden", "true");
  svg.append(line);
  key.append(svg, text);
  return key;
}

// Quantiles over the times of the values of bodies; `valueAt(t, i)` is NaN where a body does not count.
export function quantiles(m, bodies, valueAt) {
  const few = bodies.length <= MOST ? bodies : Array.from({ length: MOST }, (_, k) => bodies[Math.floor((k * bodies.length) / MOST)]);
  const found = SHARES.map(() => new Array(m).fill(null)), values = new Float64Array(few.length);
  for (let t = 0; t < m; t++) {
    let n = 0;
    for (const i of few) {
      const value = valueAt(t, i);
      if (Number.isFinite(value)) values[n++] = value;
    }
    const sorted = values.subarray(0, n).sort();
    SHARES.forEach((share, k) => {
      const at = share * (n - 1), low = Math.floor(at);
      if (n) found[k][t] = sorted[low] + (at - low) * (sorted[Math.min(low + 1, n - 1)] - sorted[low]);
    });
  }
  return found;
}

// Bodies that have a value in a box of times and values.
export function through(times, n, box, valueAt) {
  const inside = new Uint8Array(n);
  times.forEach((time, t) => {
    if (time < box.from || time > box.to) return;
    for (let i = 0; i < n; i++) if (!inside[i]) { const value = valueAt(t, i); inside[i] = value >= box.low && value <= box.high ? 1 : 0; }
  });
  return inside;
}

export class TimePlot {
  constructor(element, onTime, onBox) {
    Object.assign(this, { element, onTime, onBox, now: 0, box: null });
    new ResizeObserver(() => this.fit()).observe(element);
  }

  // `curves`: name and values over the times; `counts`: the same for numbers of bodies by name.
  draw({ times, unit, band, curves, counts, style, table, limits }) {
    this.plot?.destroy();
    const nulls = (values) => values.map((value) => (Number.isFinite(value) ? value : null));
    const series = [{}], data = [times], line = (more) => series.push({ points: { show: false }, spanGaps: false, ...more });
    if (band) {
      data.push(...band);
      line({ width: 0 });
      line({ stroke: style.ink, width: 2 });
      line({ width: 0 });
    }
    curves.forEach(({ values, colour }, k) => { data.push(nulls(values)); line({ stroke: colour, width: 2, dash: DASHES[k % DASHES.length] }); });
    counts.forEach(({ values, code }) => { data.push(values); line({ stroke: colourOfName(code), width: 2 }); });
    const all = data.slice(1).flat().filter(Number.isFinite);
    let low = all.reduce((a, b) => Math.min(a, b), Infinity), high = all.reduce((a, b) => Math.max(a, b), -Infinity);
    if (!(high > low)) { const middle = Number.isFinite(low) ? low : 0; low = middle - (Math.abs(middle) * 0.05 || 1); high = middle + (Math.abs(middle) * 0.05 || 1); }
    if (counts.length || (low > 0 && low < 0.5 * high)) low = 0;
    const room = 0.04 * (high - low), scale = axis(unit, low, high), clock = readable("s", times[times.length - 1]);
    const font = `12px ${style.font}`;
    const common = { stroke: style.soft, font, grid: { stroke: style.line, width: 1 }, ticks: { show: false } };
    this.plot = new uPlot({
      ...this.size(), series, legend: { show: false }, padding: [8, 12, 0, 0],
      bands: band ? [{ series: [1, 3], fill: style.band }] : [],
      scales: { x: { time: false }, y: { range: [low === 0 ? 0 : low - room, high + room] } },
      axes: [
        { ...common, size: 26, values: (_, ticks) => ticks.map((t) => number(t / clock.factor, 3)) },
        { ...common, size: 52, values: (_, ticks) => ticks.map(scale.text), space: 26 },
      ],
      cursor: { x: true, y: true, points: { show: false }, drag: { x: true, y: true, setScale: false, dist: 6 } },
      hooks: { draw: [(plot) => { this.drawNow(plot, style, table, limits); }], setSelect: [(plot) => this.select(plot)] },
    }, data, this.element);
    this.scale = { unit: scale.unit, clock: clock.unit };
    const over = this.plot.over;
    let start = 0;
    over.addEventListener("mousedown", (event) => { start = event.clientX; });
    over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - start) > 5) return;
      this.onTime(this.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x"));
    });
    if (this.box) this.showBox();
  }

  size() {
    return { width: Math.max(100, this.element.clientWidth), height: Math.max(60, this.element.clientHeight) };
  }

  fit() {
    if (this.plot && this.element.clientWidth) { this.plot.setSize(this.size()); if (this.box) this.showBox(); }
  }

  at(time) {
    this.now = time;
    this.plot?.redraw(false);
  }

  // A line at the current time, and beside the axis of values their colours.
  drawNow(plot, style, table, limits) {
    const { ctx: context, bbox } = plot, x = plot.valToPos(this.now, "x", true), s = devicePixelRatio || 1;
    context.save();
    context.fillStyle = style.mark;
    context.fillRect(x - s, bbox.top, 2 * s, bbox.height);
    if (table) {
      for (let y = 0; y < bbox.height; y++) {
        const value = plot.posToVal(bbox.top + y, "y", true), share = (value - limits[0]) / (limits[1] - limits[0] || 1);
        const k = 4 * Math.round(255 * Math.max(0, Math.min(1, share)));
        context.fillStyle = `rgb(${table[k]} ${table[k + 1]} ${table[k + 2]})`;
        context.fillRect(bbox.left - 5 * s, bbox.top + y, 4 * s, 1);
      }
    }
    context.restore();
  }

  select(plot) {
    const { left, top, width, height } = plot.select;
    if (width < 2 || height < 2) return;
    this.box = {
      from: plot.posToVal(left, "x"), to: plot.posToVal(left + width, "x"),
      low: plot.posToVal(top + height, "y"), high: plot.posToVal(top, "y"),
    };
    this.onBox(this.box);
  }

  showBox() {
    const { from, to, low, high } = this.box, at = (value, key) => this.plot.valToPos(value, key);
    this.plot.setSelect({ left: at(from, "x"), width: at(to, "x") - at(from, "x"), top: at(high, "y"), height: at(low, "y") - at(high, "y") }, false);
  }
}
