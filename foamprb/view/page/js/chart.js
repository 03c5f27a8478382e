// Curve over time, with a mark at the current time.

import { axis, number, readable } from "./colours.js";

const WIDTH = 262, HEIGHT = 118, LEFT = 48, RIGHT = 8, TOP = 22, BOTTOM = 20;
const make = (name, attributes, text) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
};

export function drawChart(figure, { label, unit, times, values, now }) {
  const known = values.filter(Number.isFinite);
  figure.replaceChildren();
  if (known.length === 0) return;
  let low = known.reduce((a, b) => Math.min(a, b)), high = known.reduce((a, b) => Math.max(a, b));
  if (high - low <= 2e-4 * Math.max(Math.abs(low), Math.abs(high))) {
    const room = Math.abs(high) * 0.05 || 1;
    low -= room;
    high += room;
  } else if (low > 0 && low < 0.5 * high) low = 0;
  const scale = axis(unit, low, high);
  // From the release of the body to its end.
  const own = times.filter((_, k) => Number.isFinite(values[k])), from = own[0], to = own[own.length - 1];
  const clock = readable("s", to);
  const x = (t) => LEFT + ((t - from) / (to - from || 1)) * (WIDTH - LEFT - RIGHT);
  const y = (v) => TOP + (1 - (v - low) / (high - low)) * (HEIGHT - TOP - BOTTOM);
  const svg = make("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" });
  const name = scale.unit ? `${label} (${scale.unit})` : label;
  svg.append(make("title", {}, `${name} over time, from ${scale.text(known[0])} to ${scale.text(known[known.length - 1])}`));
  svg.append(make("text", { class: "name", x: 0, y: 12 }, name));
  svg.append(make("path", { class: "frame", fill: "none", d: `M${LEFT} ${TOP}V${HEIGHT - BOTTOM}H${WIDTH - RIGHT}` }));
  for (const [v, dy] of [[low, 0], [high, 8]]) svg.append(make("text", { x: LEFT - 5, y: y(v) + dy, "text-anchor": "end" }, scale.text(v)));
  svg.append(make("text", { x: LEFT, y: HEIGHT - 5 }, number(from / clock.factor, 3)));
  svg.append(make("text", { x: WIDTH - RIGHT, y: HEIGHT - 5, "text-anchor": "end" }, `${number(to / clock.factor, 3)} ${clock.unit}`));
  let path = "", pen = false;
  values.forEach((v, k) => {
    if (!Number.isFinite(v)) { pen = false; return; }
    path += `${pen ? "L" : "M"}${x(times[k]).toFixed(1)} ${y(v).toFixed(1)}`;
    pen = true;
  });
  svg.append(make("path", { class: "curve", fill: "none", d: path }));
  if (times[now] >= from && times[now] <= to) svg.append(make("path", { class: "now", d: `M${x(times[now]).toFixed(1)} ${TOP}V${HEIGHT - BOTTOM}` }));
  if (Number.isFinite(values[now])) svg.append(make("circle", { class: "dot", r: 3.5, cx: x(times[now]), cy: y(values[now]) }));
  figure.append(svg);
}
