// Colours of values and names, and the format of numbers.

export const names = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#8c8c8c"];

// Beyond the names, hues at the golden angle.
export function colourOfName(k) {
  if (k < names.length) return names[k];
  const h = (k * 137.508) % 360;
  const channel = (shift) => {
    const t = (((h / 60 + shift) % 6) + 6) % 6;
    const c = Math.max(0, Math.min(1, Math.min(t, 4 - t)));
    return Math.round(255 * (0.25 + 0.5 * c)).toString(16).padStart(2, "0");
  };
  return `#${channel(2)}${channel(0)}${channel(4)}`;
}

export function bytesOf(hex) {
  return [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
}

// 256 colours as RGBA from a string of 256 × 6 hexadecimal digits.
export function table(digits) {
  const colours = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; i++) {
    for (let c = 0; c < 3; c++) colours[4 * i + c] = parseInt(digits.slice(6 * i + 2 * c, 6 * i + 2 * c + 2), 16);
    colours[4 * i + 3] = 255;
  }
  return colours;
}

export function tableOfNames(count) {
  const colours = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; i++) colours.set([...bytesOf(i < count ? colourOfName(i) : "#9aa3ab"), 255], 4 * i);
  return colours;
}

const prefixes = [[1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];

// Unit in which numbers up to `most` need no power of ten, and its size.
export function readable(unit, most) {
  const size = Math.abs(most);
  if (!/^(m|s|m\/s|Pa|N)$/.test(unit) || !(size > 0) || size >= 1e5) return { factor: 1, unit };
  for (const [factor, prefix] of prefixes) {
    if (size >= 0.5 * factor) return { factor, unit: prefix + unit };
  }
  return { factor: 1, unit };
}

// The unit of an axis from `low` to `high`, a power of ten with it if the numbers need one, and short texts of the numbers.
export function axis(unit, low, high) {
  const most = Math.max(Math.abs(low), Math.abs(high)), scale = readable(unit, most);
  const exponent = Math.floor(Math.log10(most / scale.factor || 1));
  const power = exponent < -2 || exponent > 3 ? exponent : 0, factor = scale.factor * 10 ** power;
  const decimals = Math.min(Math.max(Math.ceil(1.5 - Math.log10((high - low) / factor)), 0), 4);
  const text = (value) => String(Number((value / factor).toFixed(decimals))).replace("-", "−");
  return { unit: [power ? powerOfTen(power) : "", pretty(scale.unit)].filter(Boolean).join(" "), factor, text };
}

const superscripts = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

const powerOfTen = (exponent) => `10${[...String(exponent)].map((c) => superscripts[c]).join("")}`;

export function number(value, digits = 4) {
  if (!Number.isFinite(value)) return "unknown";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) {
    return String(Number(value.toPrecision(digits))).replace("-", "−");
  }
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${String(Number(mantissa)).replace("-", "−")} × ${powerOfTen(Number(exponent))}`;
}

// A value in the readable unit of `most`.
export function written(value, unit, most = value) {
  const scale = readable(unit, most);
  return `${number(value / scale.factor)}${scale.unit ? ` ${pretty(scale.unit)}` : ""}`;
}

// m/s2 → m/s², N m → N m.
export function pretty(unit) {
  return unit.replace(/(?<=[a-zA-Z])(-?\d)/g, (power) => [...power].map((c) => superscripts[c]).join(""));
}

// Two limits and round numbers between them.
export function ticks(low, high, wanted = 5) {
  const span = high - low;
  if (!(span > 0)) return [low];
  const raw = span / (wanted - 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((d) => d * power).find((d) => d >= raw * (1 - 1e-9));
  const list = [low];
  for (let k = Math.ceil(low / step + 1e-6); k * step < high - 1e-6 * span; k++) {
    if (k * step - low > 0.6 * step && high - k * step > 0.6 * step) list.push(k * step);
  }
  list.push(high);
  return list;
}
