// Axes, the directions of the flow and of gravity, and a scale bar; on the page and on a saved picture.

import { written } from "./colours.js";

const HEIGHT = 84, GLYPH = 56, REACH = 14, ARROW = 34, LETTER = 11;

export const compassWidth = (spec) => Math.max(spec.scaleBar + 16, GLYPH * (1 + Object.keys(spec.directions).length));
export const compassHeight = HEIGHT;

// The largest of 1, 2, 5 times a power of ten that is not above a positive value.
export function roundLength(most) {
  const power = 10 ** Math.floor(Math.log10(most) + 1e-12);
  return Number((power * [5, 2, 1].find((digit) => digit * power <= most * (1 + 1e-12))).toPrecision(12));
}

// `axes`: right, up and towards the viewer, as vectors of three.js; `pixel`: length of a pixel of the page, m.
// Returns the text of the scale bar.
export function paintCompass(context, left, top, axes, pixel, spec, style, s) {
  const seen = (v) => ["right", "up", "towards"].map((name) => axes[name].x * v[0] + axes[name].y * v[1] + axes[name].z * v[2]);
  const glyphs = Object.entries(spec.directions), right = left + compassWidth(spec) * s;
  const line = (points, colour, width) => {
    context.strokeStyle = colour;
    context.lineWidth = width * s;
    context.beginPath();
    points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.stroke();
  };
  const disc = (x, y, radius, colour) => {
    context.fillStyle = colour;
    context.beginPath();
    context.arc(x, y, radius * s, 0, 7);
    context.fill();
  };
  const write = (text, x, y, align = "center") => {
    context.font = `${12 * s}px ${style.font}`;
    context.fillStyle = style.ink;
    context.textAlign = align;
    context.textBaseline = "middle";
    context.fillText(text, x, y);
  };
  const middle = (k) => right - (glyphs.length - k + 0.5) * GLYPH * s;

  const x0 = middle(0), y0 = top + 30 * s, names = [];
  const three = ["x", "y", "z"].map((name, k) => [name, seen([0, 1, 2].map((c) => (c === k ? 1 : 0)))]);
  for (const [name, [x, y]] of three.sort((a, b) => a[1][2] - b[1][2])) {
    line([[x0, y0], [x0 + REACH * s * x, y0 - REACH * s * y]], style.soft, 1.5);
    // The name of an axis along the line of sight stands below its origin.
    const size = Math.hypot(x, y), at = size < 0.3 ? [-0.7, -0.7] : [x / size, y / size];
    const reach = size < 0.3 ? LETTER : REACH * size + 8;
    const place = [x0 + reach * s * at[0], y0 - reach * s * at[1]];
    if (names.some((other) => Math.hypot(place[0] - other[0], place[1] - other[1]) < LETTER * s)) place[1] += LETTER * s;
    names.push(place);
    write(name, ...place);
  }
  disc(x0, y0, 2, style.soft);

  glyphs.forEach(([name, vector], k) => {
    const x = middle(k + 1), y = top + 20 * s, [across, upwards, nearer] = seen(vector);
    const size = Math.hypot(across, upwards), colour = name === "flow" ? style.accent : style.soft;
    write(name, x, top + 48 * s);
    if (size < 0.35) {
      // Like the point or the feathers of an arrow.
      context.strokeStyle = colour;
      context.lineWidth = 2 * s;
      context.beginPath();
      context.arc(x, y, 8 * s, 0, 7);
      context.stroke();
      if (nearer > 0) disc(x, y, 2.5, colour);
      else for (const d of [-1, 1]) line([[x - 5 * s, y - 5 * d * s], [x + 5 * s, y + 5 * d * s]], colour, 2);
      return;
    }
    const along = [across / size, -upwards / size], half = 0.5 * ARROW * s * size;
    const point = (a, b) => [x + a * along[0] - b * along[1], y + a * along[1] + b * along[0]];
    line([point(-half, 0), point(half - 6 * s, 0)], colour, 2);
    context.fillStyle = colour;
    context.beginPath();
    for (const [a, b] of [[half, 0], [half - 9 * s, 4.5 * s], [half - 9 * s, -4.5 * s]]) context.lineTo(...point(a, b));
    context.fill();
  });

  const length = roundLength(spec.scaleBar * pixel), text = written(length, "m");
  const [from, to, y] = [right - 6 * s - (length / pixel) * s, right - 6 * s, top + 66 * s];
  line([[from, y - 4 * s], [from, y], [to, y], [to, y - 4 * s]], style.ink, 1.5);
  write(text, (from + to) / 2, y + 10 * s);
  context.textBaseline = "alphabetic";
  context.textAlign = "left";
  return text;
}
