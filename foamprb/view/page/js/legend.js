// Legends: a bar with ticks for numbers, a list for names; on the page and on a saved picture.

import { colourOfName, number, pretty, readable, ticks } from "./colours.js";

// Label of a legend, its unit, and as note the unit with the least and the largest value if they lie beyond the colours.
const title = (spec) => {
  if (spec.names) return { text: spec.label, unit: "", note: "", factor: 1 };
  const { unit: name, factor } = readable(spec.unit, Math.max(Math.abs(spec.low), Math.abs(spec.high)));
  const [below, above] = beyond(spec), text = (value) => number(value / factor, 2);
  const range = [below ? `min ${text(spec.least)}` : "", above ? `max ${text(spec.most)}` : ""].filter(Boolean).join(", ");
  const unit = pretty(name ?? "");
  return { text: spec.label, unit, note: [unit ? `(${unit})` : "", range].filter(Boolean).join(" "), factor };
};

function beyond(spec) {
  const slack = 1e-5 * (spec.high - spec.low);
  return [spec.least < spec.low - slack, spec.most > spec.high + slack];
}

// Text of a tick, with ≤ or ≥ at an end if values lie beyond it.
export function tickText(spec, value, factor) {
  const [under, over] = beyond(spec), below = value === spec.low && under, above = value === spec.high && over;
  return `${below ? "≤ " : above ? "≥ " : ""}${number(value / factor, 3)}`;
}

export function showLegend(parent, spec) {
  const box = document.createElement("div");
  box.className = "legend";
  const heading = document.createElement("h2");
  const { text, unit, note, factor } = title(spec);
  heading.textContent = text;
  if (note) {
    const small = document.createElement("small");
    small.textContent = note;
    heading.append(small);
  }
  box.append(heading);
  if (spec.names) {
    const list = document.createElement("ul");
    for (const [k, name] of spec.names) {
      const item = document.createElement("li"), swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.background = colourOfName(k);
      item.append(swatch, name);
      list.append(item);
    }
    box.append(list);
  } else {
    const bar = document.createElement("canvas");
    bar.width = 256;
    bar.height = 1;
    bar.setAttribute("role", "img");
    bar.setAttribute("aria-label", `Colours from ${number(spec.low / factor)} to ${number(spec.high / factor)} ${unit}`);
    bar.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(spec.table), 256, 1), 0, 0);
    const scale = document.createElement("div");
    scale.className = "ticks";
    for (const value of ticks(spec.low, spec.high)) {
      const tick = document.createElement("span");
      tick.textContent = tickText(spec, value, factor);
      tick.style.left = `${(100 * (value - spec.low)) / (spec.high - spec.low || 1)}%`;
      scale.append(tick);
    }
    box.append(bar, scale);
  }
  parent.append(box);
}

// Legends on a picture, from the lower left corner upwards; `s` pixels of the picture per pixel of the page.
export function paintLegends(context, specs, style, s, height) {
  let bottom = height - 22 * s;
  for (const spec of [...specs].reverse()) {
    const { text, note, factor } = title(spec);
    const left = 22 * s;
    if (spec.names) {
      context.font = `${13 * s}px ${style.font}`;
      let x = left;
      for (const [k, name] of spec.names) {
        context.fillStyle = colourOfName(k);
        context.beginPath();
        context.arc(x + 6 * s, bottom - 5 * s, 6 * s, 0, 7);
        context.fill();
        context.fillStyle = style.ink;
        context.fillText(name, x + 18 * s, bottom);
        x += context.measureText(name).width + 34 * s;
      }
      bottom -= 22 * s;
    } else {
      context.font = `${12 * s}px ${style.font}`;
      context.fillStyle = style.ink;
      for (const value of ticks(spec.low, spec.high)) {
        const share = (value - spec.low) / (spec.high - spec.low || 1);
        context.textAlign = share === 0 ? "left" : share === 1 ? "right" : "center";
        context.fillText(tickText(spec, value, factor), left + 280 * s * share, bottom);
      }
      context.textAlign = "left";
      const bar = new OffscreenCanvas(256, 1);
      bar.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(spec.table), 256, 1), 0, 0);
      context.drawImage(bar, left, bottom - 29 * s, 280 * s, 12 * s);
      bottom -= 37 * s;
    }
    context.font = `600 ${13 * s}px ${style.font}`;
    context.fillStyle = style.ink;
    context.fillText(text, left, bottom);
    const width = context.measureText(`${text}  `).width;
    context.font = `${13 * s}px ${style.font}`;
    context.fillStyle = style.soft;
    if (note) context.fillText(note, left + width, bottom);
    bottom -= 28 * s;
  }
}
