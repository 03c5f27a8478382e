// The page: its state, the drawing, and the controls.

import { Color, ColorManagement, DataTexture, LinearFilter, LinearSRGBColorSpace, NearestFilter, Raycaster, RGBAFormat, Scene, Vector2, Vector3, Vector4, WebGLRenderer } from "three";
import { Bodies } from "./bodies.js";
import { Eye } from "./camera.js";
import { drawChart } from "./chart.js";
import { compassHeight, compassWidth, paintCompass, roundLength } from "./compass.js";
import { bytesOf, colourOfName, number, pretty, readable, table, tableOfNames, written } from "./colours.js";
import { load } from "./data.js";
import { FlowPlane, streamlines } from "./flow.js";
import { GALLERY, Gallery } from "./gallery.js";
import { paintLegends, showLegend } from "./legend.js";
import { Link } from "./link.js";
import { CURVES, TimePlot, curveKey, quantiles, through } from "./plot.js";
import { Deposits, Walls } from "./surroundings.js";
import { Trails, frameBefore } from "./trails.js";

const $ = (id) => document.getElementById(id);
// A page inside another one has a name instead of an address.
const words = new URLSearchParams(window.name.startsWith("foamprb ") ? window.name.slice(8) : location.hash.slice(1));
// Digits of the values of a page.
const DIGITS = 4;
const MOST_SEGMENTS = 400_000;
// Seconds in which a run is played by default, and speeds as multiples of that.
const DURATION = 8, SPEEDS = [0.1, 0.2, 0.5, 1, 2, 5, 10];

const keys = [
  ["Space", "play, stop", () => play(!state.playing)],
  [", and .", "previous, next time", null],
  ["Home, End", "first, last time", null],
  ["Arrows", "turn; with shift move", null],
  ["+ and −", "zoom", null],
  ["N and P", "select the next, the previous body", null],
  ["F", "follow the selected body", () => follow(!state.follow)],
  ["Escape", "deselect the body", () => choose(-1)],
  ["0", "first view", () => eye.goHome()],
  ["W", "whole geometry", () => eye.showAll(halves())],
  ["M", "mark on the surface", () => toggle("mark")],
  ["S", "save the picture", () => savePicture()],
  ["D", "light or dark", () => setTheme(dark() ? "light" : "dark")],
  ["T", "values over time", () => openPlot($("plot").hidden)],
  ["O", "options", () => openPanel(!$("panel").classList.contains("open"))],
  ["H", "this list", () => $("about").showModal()],
];

let data, renderer, eye, bodies, walls, plane, streams, trails, ownTrail, deposits, plot, gallery, link;
const scene = new Scene(), haze = { value: new Vector4(1, 1, 1, 1) };
const state = {
  t: 0, chosen: -1, follow: false, playing: false, speed: 10, name: "", part: "", low: 0, high: 1, map: "",
  enlargement: 1, fates: new Set(), injectors: new Set(), gone: false, curve: null, count: 0, kept: [], boxed: null,
};
let legends = {}, dirty = false, stale = false, textures = {};

async function start() {
  if (!document.createElement("canvas").getContext("webgl2")) throw new Error("it needs WebGL 2, which this browser or computer does not provide");
  if (typeof DecompressionStream === "undefined") throw new Error("it needs a browser of 2023 or newer");
  for (const word of ["bare", "naked"]) document.documentElement.classList.toggle(word, words.has(word));
  if (words.has("naked")) document.documentElement.classList.add("bare");
  data = await load();
  const { scene: spec } = data;
  const canvas = $("canvas");
  ColorManagement.enabled = false;
  renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false, stencil: true, preserveDrawingBuffer: false });
  renderer.outputColorSpace = LinearSRGBColorSpace;
  bodies = new Bodies(data, haze);
  walls = new Walls(data, haze);
  deposits = new Deposits();
  trails = new Trails(data, 3, haze);
  ownTrail = new Trails(data, 4, haze);
  scene.add(bodies.mesh, walls.group, trails.mesh, ownTrail.mesh, deposits.points);
  if (data.flow) scene.add((plane = new FlowPlane(data, walls)).group, (streams = streamlines(data.flow, haze)));
  eye = new Eye(canvas, spec.home, insets(), () => { dirty = true; }, tap);
  for (const [name, digits] of Object.entries({ ...spec.maps, ...spec.planeMaps })) textures[name] = { bytes: table(digits), texture: null };

  gallery = new Gallery(data);
  plot = new TimePlot($("curves"), (time) => { play(false); show(nearestFrame(time)); }, setBox);
  describe(spec);
  fill(spec);
  listen();
  state.enlargement = spec.enlargement;
  state.t = Math.min(data.m - 1, spec.first);
  setTheme(words.get("theme") ?? "auto");
  setEnlargement(spec.enlargement);
  setColour(...spec.colour, spec.range);
  setSlice();
  $("app").classList.remove("loading");
  $("notice").textContent = "";
  if (innerWidth >= 1100 && innerHeight >= 820 && data.m > 2) openPlot(true);
  resize();
  eye.goHome();
  new ResizeObserver(resize).observe($("stage"));
  link = new Link(words, view, restore);
  restore(words);
  show(state.t);
  requestAnimationFrame(loop);
}

// What a link restores: time, s, body, array, and the eye by angles, distance and the middle of the picture.
function view() {
  const { yaw, pitch, distance, fit, target } = eye, found = { t: [data.times[state.t]], colour: `${state.name}:${state.part}`, eye: [yaw, pitch, distance / fit, target.x, target.y, target.z] };
  return state.chosen < 0 ? found : { ...found, body: [data.ids[state.chosen]] };
}

function restore(from) {
  const numbers = (key) => (from.get(key) ?? "").split(",").filter(Boolean).map(Number);
  const [name, part] = (from.get("colour") ?? "").split(":"), [time] = numbers("t"), [body] = numbers("body"), seen = numbers("eye");
  if (part !== undefined && [...$("colour").options].some(({ value }) => value === `${name}:${part}`)) setColour(name, part);
  if (Number.isFinite(time)) show(nearestFrame(time));
  if (data.ids.includes(body)) choose(data.ids.indexOf(body));
  if (seen.length === 6 && seen.every(Number.isFinite)) eye.look(...seen);
}

// ---------------------------------------------------------------------------------------------------------
// Drawing

function loop(now) {
  if (state.playing) {
    const { times, m } = data, step = (times[m - 1] - times[0]) / (m - 1);
    loop.clock += ((now - (loop.last ?? now)) / 1000) * state.speed;
    loop.last = now;
    // The last time stays as long as another.
    if (loop.clock > times[m - 1] + step) loop.clock = times[0];
    const t = Math.max(0, frameBefore(times, loop.clock));
    if (t !== state.t) show(t);
  }
  if (dirty) draw();
  requestAnimationFrame(loop);
}

function draw() {
  dirty = false;
  for (const { material } of [trails, ownTrail]) material.uniforms.size.value.set(eye.width, eye.height);
  const tangent = 2 * Math.tan((data.scene.home.angle * Math.PI) / 360);
  bodies.material.uniforms.pixel.value = tangent / eye.height;
  if (stale) drawPlot();
  if (!$("card").hidden) drawGallery();
  haze.value.w = eye.distance;
  plane?.face(eye.camera.position);
  renderer.render(scene, eye.camera);
  placeLabels();
  placeHandle();
  drawCompass();
  link?.changed();
}

function drawGallery() {
  const i = state.chosen, life = [...data.times.keys()].filter((t) => counts(t, i));
  const number = Math.min(GALLERY, life.length), frames = Array.from({ length: number }, (_, k) => life[Math.round((k * (life.length - 1)) / Math.max(1, number - 1))]);
  $("gallery").hidden = number === 0;
  if (number === 0) return;
  const style = { ...textStyle(), raised: new Color().setRGB(...bytesOf(variable("--raised")).map((byte) => byte / 255)) };
  $("gallery").setAttribute("aria-label", gallery.paint($("gallery"), renderer, i, frames, state.t, colouring(), eye.axes(), bodies.material, style));
}

function drawCompass() {
  const canvas = $("compass"), ratio = renderer.getPixelRatio(), { scene: spec } = data;
  const [width, height] = [compassWidth(spec), compassHeight].map((size) => Math.round(size * ratio));
  if (canvas.width !== width) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, width, height);
  const text = paintCompass(context, 0, 0, eye.axes(), metresOfPixel(), spec, textStyle(), ratio);
  canvas.setAttribute("aria-label", `Axes, ${Object.keys(spec.directions).map((name) => `direction of ${name}, `).join("")}scale bar of ${text}`);
}

// Length of a pixel of the page at the middle of the picture, m.
const metresOfPixel = () => bodies.material.uniforms.pixel.value * eye.distance * data.scene.frame.size;

const textStyle = () => ({ font: getComputedStyle(document.body).fontFamily, ink: variable("--ink"), soft: variable("--soft"), accent: variable("--accent") });

function resize() {
  const { clientWidth: width, clientHeight: height } = $("stage");
  if (!width || !height) return;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2.5));
  renderer.setSize(width, height, false);
  deposits.points.material.uniforms.ratio.value = renderer.getPixelRatio();
  eye.insets = insets();
  eye.resize(width, height);
  dirty = true;
}

// Pixels that texts, or the card of the selected body on a narrow screen, take above and below the scene.
function insets() {
  if (words.has("naked")) return [0, 0];
  const [above, below] = data.scene.home.insets, card = $("card");
  const covers = !card.hidden && getComputedStyle(card).position === "fixed";
  return [above, covers ? card.offsetHeight - $("transport").offsetHeight : Math.max(below, $("bottom").offsetHeight + 12)];
}

// In the flow or on a wall.
const inside = (word) => word === "active" || word === "stuck";

// Whether a body passes the filters, whether or not it is in the flow.
function passes(i, t = state.t) {
  const { fate, injector } = data.codes, { filter, boxed } = state;
  if (state.fates.has(fate.code(0, i)) || (boxed && !boxed[i])) return false;
  if (injector && state.injectors.has(injector.code(t, i))) return false;
  if (filter && filter.field) {
    const value = filter.field.value(t, i, filter.part);
    if (!(value >= filter.low && value <= filter.high)) return false;
  }
  return true;
}

function isShown(i) {
  if (!data.present(state.t, i)) return false;
  return (state.gone || inside(data.codes.status.meaning(state.t, i))) && passes(i);
}

// Function of a time and a body: its place in the colours, 0 to 1; −1 if unknown.
function colouring() {
  const codes = data.codes[state.name], field = data.fields[state.name], { part, low } = state, span = state.high - low || 1;
  if (codes) return (t, i) => codes.code(t, i) / 255;
  return (t, i) => {
    const value = field.value(t, i, part);
    return Number.isFinite(value) ? Math.max(0, Math.min(1, (value - low) / span)) : -1;
  };
}

function show(t) {
  const before = state.t;
  state.t = t;
  const colour = colouring();
  state.count = bodies.show(t, isShown, (i) => colour(t, i));
  bodies.material.uniforms.chosen.value = state.chosen;
  showTrails();
  if (state.follow && state.chosen >= 0) {
    const a = 3 * (data.n * before + state.chosen), b = 3 * (data.n * t + state.chosen), { x } = data;
    eye.target.add(new Vector3(x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]));
    eye.place();
  }
  showDeposits();
  plot.at(data.times[t]);
  $("time").value = t;
  const text = written(data.times[t], "s", data.times[data.m - 1]);
  $("time").setAttribute("aria-valuetext", text);
  $("time-text").textContent = text;
  $("clock").textContent = `t = ${text}`;
  $("caption").textContent = caption();
  if (state.chosen >= 0) showCard();
  dirty = true;
}

function caption() {
  const drawn = state.enlargement === 1 ? "drawn to scale" : `drawn ${number(state.enlargement, 3)}× larger`;
  return `${state.count} ${state.count === 1 ? "body" : "bodies"}, ${drawn}`;
}

function showDeposits() {
  const list = [], { n, x } = data, { status } = data.codes, { t } = state;
  if ($("deposits").value === "marked") {
    for (let i = 0; i < n; i++) {
      const p = 3 * (n * t + i);
      if (bodies.shown[i] && status.meaning(t, i) === "stuck") list.push(x[p], x[p + 1], x[p + 2]);
    }
  }
  deposits.draw(list);
}

// Fading trails of the shown bodies and of those that have just left, or whole paths up to now. The selected body
// has its whole path.
function showTrails() {
  const colour = colouring(), wanted = $("trails").value, { t, chosen } = state, now = data.times[t];
  let list = [];
  if (wanted === "fading" || wanted === "whole") for (let i = 0; i < data.n; i++) if (data.present(t, i) && passes(i)) list.push(i);
  const most = wanted === "fading" ? data.scene.mostTrails : Math.max(1, Math.floor(MOST_SEGMENTS / data.m));
  if (list.length > most) {
    say(`${most} of ${list.length} bodies have trails.`);
    list = Array.from({ length: most }, (_, k) => list[Math.floor((k * list.length) / most)]);
  }
  const fading = wanted === "fading", start = data.times[0] - 1;
  trails.draw(list, fading ? now - data.scene.trail : start, now, colour, fading);
  trails.material.uniforms.opacity.value = fading ? 0.85 : Math.max(0.18, Math.min(0.6, 60 / list.length));
  ownTrail.draw(wanted !== "none" && chosen >= 0 ? [chosen] : [], start, now, colour, false);
  dirty = true;
}

// ---------------------------------------------------------------------------------------------------------
// Values over time

const nearestFrame = (time) => data.times.reduce((best, t, k) => (Math.abs(t - time) < Math.abs(data.times[best] - time) ? k : best), 0);

function restale() {
  stale = dirty = true;
}

function openPlot(on) {
  $("plot").hidden = !on;
  $("open-plot").setAttribute("aria-expanded", String(on));
  document.documentElement.classList.toggle("plotted", on);
  restale();
}

// Whether a body counts at a time, and its value.
const counts = (t, i) => data.present(t, i) && inside(data.codes.status.meaning(t, i));
const valueAt = (t, i) => (counts(t, i) ? data.fields[state.name].value(t, i, state.part) : NaN);

function drawPlot() {
  stale = false;
  if ($("plot").hidden) return;
  const field = data.fields[state.name], codes = data.codes[state.name], every = Array.from({ length: data.n }, (_, i) => i);
  const list = state.chosen >= 0 && !state.kept.includes(state.chosen) ? [...state.kept, state.chosen] : state.kept;
  const curves = field ? list.map((i, k) => ({ values: series(field, state.part, i), colour: CURVES[k], text: `${data.ids[i]}` })) : [];
  const numbers = field ? [] : legends.colour.names.map(([code, text]) => ({ code, text, values: data.times.map(() => 0) }));
  for (const { code, values } of numbers) {
    values.forEach((_, t) => { for (let i = 0; i < data.n; i++) if (codes.code(t, i) === code && counts(t, i) && passes(i, t)) values[t]++; });
  }
  const band = field ? quantiles(data.m, every, (t, i) => (passes(i, t) ? valueAt(t, i) : NaN)) : null;
  const style = { ...textStyle(), line: variable("--line"), mark: variable("--deposit"), band: dark() ? "rgb(173 185 197 / 28%)" : "rgb(76 89 102 / 20%)" };
  plot.draw({
    times: data.times, unit: field?.unit ?? "", band, curves, counts: numbers, style,
    table: field && textures[state.map]?.bytes, limits: [state.low, state.high],
  });
  const { unit, clock } = plot.scale, name = field ? capital(nameOf(field, state.part)) : "Bodies in the flow or on walls";
  $("plot-title").textContent = `${name}${unit ? ` (${unit})` : ""} over time (${clock})`;
  $("plot-words").textContent = field ? "Median and 5–95 % of the shown bodies" : "";
  $("plot-keys").replaceChildren(...[...curves.map(({ text }, k) => [text, CURVES[k], k]), ...numbers.map(({ code, text }) => [text, colourOfName(code), 0])]
    .map(([text, colour, k]) => curveKey(text, colour, k)));
  plot.at(data.times[state.t]);
}

// Show only the bodies whose curves pass through a box of the plot; all if it is null.
function setBox(box) {
  plot.box = box;
  const field = data.fields[state.name], codes = data.codes[state.name];
  state.boxed = box && field && !codes ? through(data.times, data.n, box, valueAt) : null;
  const count = state.boxed?.reduce((a, b) => a + b, 0);
  $("plot-clear").hidden = !state.boxed;
  $("plot-clear").textContent = `${count} ${count === 1 ? "body passes" : "bodies pass"} through the box. Show all`;
  if (state.boxed) say($("plot-clear").textContent);
  restale();
  show(state.t);
}

function keep(on) {
  state.kept = state.kept.filter((i) => i !== state.chosen);
  if (on) state.kept = [...state.kept, state.chosen].slice(-CURVES.length + 1);
  if (on) openPlot(true);
  restale();
}

// Place the names of patches; a name that would overlap an earlier one is hidden.
function placeLabels() {
  const kept = [];
  const point = new Vector3();
  const blocked = [...$("stage").querySelectorAll("#heading, #facts, .legend, #compass")].map(boxOf);
  for (const label of $("labels").children) {
    const patch = walls.patches[label.dataset.patch], anchor = data.surfaces[label.dataset.patch].anchor;
    label.hidden = true;
    if (!$("names").checked || !patch.visible) continue;
    point.set(...anchor).project(eye.camera);
    if (Math.abs(point.x) > 1 || Math.abs(point.y) > 1 || point.z > 1) continue;
    label.hidden = false;
    const width = label.offsetWidth, height = label.offsetHeight;
    const x = Math.max(4, Math.min(eye.width - width - 4, (0.5 + 0.5 * point.x) * eye.width - width / 2));
    const y = Math.max(4, Math.min(eye.height - height - 4, (0.5 - 0.5 * point.y) * eye.height - height - 6));
    const box = { left: x, top: y, right: x + width, bottom: y + height };
    if ([...kept, ...blocked].some((b) => b.left < box.right && box.left < b.right && b.top < box.bottom && box.top < b.bottom)) {
      label.hidden = true;
      continue;
    }
    kept.push(box);
    label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  }
}

function boxOf(element) {
  const own = element.getBoundingClientRect(), stage = $("stage").getBoundingClientRect();
  return { left: own.left - stage.left, top: own.top - stage.top, right: own.right - stage.left, bottom: own.bottom - stage.top };
}

// ---------------------------------------------------------------------------------------------------------
// Actions of the controls

function describe(spec) {
  document.title = `${spec.title} – ${spec.subtitle}`;
  $("title").textContent = spec.title;
  $("subtitle").textContent = spec.subtitle;
  $("groups").textContent = spec.groups;
  $("made").textContent = spec.made;
  $("compass").style.width = `${compassWidth(spec)}px`;
  $("compass").style.height = `${compassHeight}px`;
  $("notes").textContent = spec.notes.join(" ");
  for (const [key, meaning] of keys) {
    const term = document.createElement("dt"), what = document.createElement("dd");
    term.textContent = key;
    what.textContent = meaning;
    $("keys").append(term, what);
  }
}

function option(select, value, text) {
  const element = document.createElement("option");
  element.value = value;
  element.textContent = text;
  select.append(element);
}

const partWords = { magnitude: "magnitude", x: "x", y: "y", z: "z" };
const nameOf = (field, part) => (part ? `${field.label}, ${partWords[part] ?? part}` : field.label);

function fill(spec) {
  for (const select of [$("colour"), $("filter")]) {
    if (select === $("filter")) option(select, "", "all values");
    for (const field of Object.values(data.fields)) {
      for (const part of field.parts) option(select, `${field.name}:${part}`, nameOf(field, part));
    }
    if (select === $("colour")) for (const codes of Object.values(data.codes)) option(select, `${codes.name}:`, codes.label);
  }
  for (const name of Object.keys(spec.maps)) option($("map"), name, name);
  // Physical time per time of the viewer, in round numbers.
  const speeds = SPEEDS.map((factor) => roundLength((factor * (data.times[data.m - 1] - data.times[0] || 1)) / DURATION));
  for (const speed of new Set(speeds)) option($("speed"), speed, speed < 1 ? `1/${number(1 / speed, 2)}×` : `${number(speed, 2)}×`);
  state.speed = speeds[SPEEDS.indexOf(1)];
  $("speed").value = state.speed;
  $("time").max = data.m - 1;
  const { fate, injector } = data.codes;
  choices($("fates"), fate, (i) => fate.code(0, i), state.fates);
  if (injector) choices($("injectors"), injector, (i) => injector.code(data.m - 1, i), state.injectors);
  $("injectors").hidden = !injector || injector.meanings.length < 2;
  $("deposits-row").hidden = !fate.meanings.some((word) => word.startsWith("stuck"));
  $("trails").value = data.m > 1 && spec.trail > 0 && data.n <= spec.mostTrails ? "fading" : "none";
  if (data.scene.deposits) option($("deposits"), "dense", "per area of walls");
  $("deposits").value = "marked";
  $("walls").hidden = data.surfaces.length === 0;
  walls.patches.forEach((patch, k) => {
    const label = check(`${patch.name}`, patch.visible, (on) => { patch.visible = on; paint(); });
    const kind = document.createElement("span");
    kind.className = "count";
    kind.textContent = patch.type;
    label.append(kind);
    $("patches").append(label);
    const name = document.createElement("span");
    name.textContent = patch.name;
    name.dataset.patch = k;
    $("labels").append(name);
  });
  $("flow").hidden = !data.flow;
  if (data.flow) fillFlow();
}

function check(text, on, change) {
  const label = document.createElement("label"), box = document.createElement("input");
  label.className = "check";
  box.type = "checkbox";
  box.checked = on;
  box.addEventListener("change", () => change(box.checked));
  label.append(box, text);
  return label;
}

function choices(details, codes, codeOf, hidden) {
  const counts = new Map();
  for (let i = 0; i < data.n; i++) counts.set(codeOf(i), (counts.get(codeOf(i)) ?? 0) + 1);
  const list = details.querySelector(".choices");
  for (const [code, count] of [...counts].sort((a, b) => a[0] - b[0])) {
    const label = check(codes.meanings[code] ?? "none", true, (on) => {
      hidden[on ? "delete" : "add"](code);
      restale();
      show(state.t);
    });
    const number = document.createElement("span");
    number.className = "count";
    number.textContent = count;
    label.append(number);
    list.append(label);
  }
}

function setColour(name, part, range = null) {
  Object.assign(state, { name, part });
  if (state.boxed) setBox(null);
  restale();
  $("colour").value = `${name}:${part}`;
  const codes = data.codes[name];
  for (const id of ["range-row", "range-buttons", "map-row"]) $(id).hidden = Boolean(codes);
  if (codes) {
    setTexture({ bytes: tableOfNames(codes.meanings.length), texture: null }, true);
    const present = new Uint8Array(256);
    for (const code of codes.whole) present[code] = 1;
    legends.colour = { label: capital(codes.label), names: codes.meanings.map((word, k) => [k, word]).filter(([k, word]) => present[k] && word) };
    showLegends();
  } else {
    setRange(...(range ?? data.fields[name].ranges[part].usual), false);
    const symmetric = state.low === -state.high;
    setMap(symmetric && data.scene.maps.coolwarm ? "coolwarm" : "viridis");
  }
  show(state.t);
}

function setRange(low, high, redraw = true) {
  if (!(high > low)) return;
  Object.assign(state, { low, high });
  $("range-low").value = number(low).replace("−", "-").replace(/ × 10(.*)/, (_, p) => `e${plain(p)}`);
  $("range-high").value = number(high).replace("−", "-").replace(/ × 10(.*)/, (_, p) => `e${plain(p)}`);
  const field = data.fields[state.name];
  const unit = field.unit ? ` (${pretty(field.unit)})` : "";
  $("range-word").textContent = `Range${unit}`;
  const [least, most] = field.ranges[state.part].extremes;
  legends.colour = { label: capital(nameOf(field, state.part)), unit: field.unit, low, high, least, most, table: textures[state.map]?.bytes };
  restale();
  if (redraw) { showLegends(); show(state.t); }
}

const plain = (text) => [...text].map((c) => ({ "⁻": "-" })[c] ?? "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)).join("");
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function setMap(name) {
  state.map = name;
  $("map").value = name;
  setTexture(textures[name], false);
  restale();
  if (legends.colour && !legends.colour.names) legends.colour.table = textures[name].bytes;
  showLegends();
}

function setTexture(entry, sharp) {
  for (const { material } of [bodies, trails, ownTrail]) material.uniforms.colours.value = textureOf(entry, sharp);
  dirty = true;
}

function textureOf(entry, sharp) {
  if (!entry.texture) {
    entry.texture = new DataTexture(entry.bytes, 256, 1, RGBAFormat);
    entry.texture.magFilter = entry.texture.minFilter = sharp ? NearestFilter : LinearFilter;
    entry.texture.needsUpdate = true;
  }
  return entry.texture;
}

// Names and directions of the normals of planes.
let normals = [];

function fillFlow() {
  const { plane: given, values } = data.flow;
  option($("slice"), "none", "none");
  values.forEach((value, k) => option($("slice"), k, value.label));
  normals = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];
  const like = given && normals.findIndex(([, normal]) => normal.every((c, k) => Math.abs(Math.abs(c) - Math.abs(given[1][k])) < 1e-9));
  if (like === -1) normals.push([data.flow.plane[1].map((c) => number(c, 2)).join(", "), given[1]]);
  normals.forEach(([name], k) => option($("normal"), k, name));
  // Without a plane of its own: the middle of the box, normal to the shortest side.
  const sides = plane.high.clone().sub(plane.low).toArray(), thin = sides.indexOf(Math.min(...sides));
  $("normal").value = given ? (like + normals.length) % normals.length : thin;
  $("slice").value = given ? "0" : "none";
  turnPlane();
  if (given) setOffset(new Vector3(...given[0]).dot(plane.normal));
}

function turnPlane() {
  const normal = new Vector3(...normals[Number($("normal").value)][1]), [low, high] = plane.range(normal);
  plane.place(normal, 0.5 * (low + high));
  setOffset(0.5 * (low + high));
}

function setOffset(offset) {
  const [low, high] = plane.range(plane.normal), { middle, size } = data.scene.frame;
  plane.place(plane.normal, Math.max(low, Math.min(high, offset)));
  $("offset").value = (plane.offset - low) / (high - low || 1);
  const text = written(plane.normal.dot(new Vector3(...middle)) + size * plane.offset, "m", size);
  $("offset").setAttribute("aria-valuetext", text);
  $("offset-text").textContent = text;
  dirty = true;
}

// Pixels by which a point of the plane moves on the screen if the plane moves by the unit of length along its normal.
function pixelsOfPlane() {
  const [from, to] = [0, 1e-3].map((step) => plane.centre.clone().addScaledVector(plane.normal, step).project(eye.camera));
  return [(to.x - from.x) * 500 * eye.width, (from.y - to.y) * 500 * eye.height];
}

function placeHandle() {
  const shown = plane?.group.visible, handle = $("handle");
  handle.hidden = !shown;
  if (!shown) return;
  const { x, y } = plane.centre.clone().project(eye.camera), [dx, dy] = pixelsOfPlane();
  const [left, top] = [(0.5 + 0.5 * x) * eye.width, (0.5 - 0.5 * y) * eye.height];
  handle.hidden = !(left > 0 && left < eye.width && top > 0 && top < eye.height);
  const angle = Math.hypot(dx, dy) < 1 ? 0 : Math.atan2(dx, -dy);
  handle.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px) rotate(${angle.toFixed(3)}rad)`;
}

function dragPlane() {
  const handle = $("handle");
  let last = null;
  handle.addEventListener("pointerdown", (event) => { handle.setPointerCapture(event.pointerId); last = event; });
  handle.addEventListener("pointermove", (event) => {
    if (!last) return;
    const [dx, dy] = pixelsOfPlane(), [mx, my] = [event.clientX - last.clientX, event.clientY - last.clientY];
    // A plane that is seen from the front moves with the vertical motion.
    const unit = eye.height / eye.distance, size = dx * dx + dy * dy;
    setOffset(plane.offset + (size > (0.1 * unit) ** 2 ? (mx * dx + my * dy) / size : -my / unit));
    last = event;
  });
  for (const kind of ["pointerup", "pointercancel"]) handle.addEventListener(kind, () => { last = null; });
  handle.addEventListener("keydown", (event) => {
    const way = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
    if (!way) return;
    const [low, high] = plane.range(plane.normal);
    setOffset(plane.offset + 0.02 * way * (high - low));
    event.preventDefault();
  });
}

function setSlice() {
  if (!plane) return;
  const k = $("slice").value, field = data.flow.values[k], map = textures[dark() ? "dark" : "light"];
  plane.show(k, textureOf(map, false));
  $("plane-place").hidden = !field;
  if (field) legends.plane = { label: capital(field.label), unit: field.unit, low: field.range[0], high: field.range[1], least: field.extremes[0], most: field.extremes[1], table: map.bytes };
  else delete legends.plane;
  showLegends();
  dirty = true;
}

const legendsShown = () => [legends.plane, legends.deposits, legends.colour].filter((spec) => spec?.names || spec?.table);

function showLegends() {
  $("legends").replaceChildren();
  for (const spec of legendsShown()) showLegend($("legends"), spec);
  if (eye.width) resize();
}

function setEnlargement(value) {
  state.enlargement = value;
  bodies.material.uniforms.enlargement.value = value;
  const most = Math.log10(Math.max(10, 10 * data.scene.enlargement));
  $("enlargement").value = Math.log10(value) / most;
  const text = value === 1 ? "to scale" : `${number(value, 3)}×`;
  $("enlargement-text").textContent = text;
  $("enlargement").setAttribute("aria-valuetext", value === 1 ? "to scale" : `${number(value, 3)} times`);
  $("caption").textContent = caption();
  dirty = true;
}

const dark = () => document.documentElement.dataset.theme === "dark";

function setTheme(wanted) {
  $("theme").value = wanted;
  const system = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = wanted === "auto" ? (system ? "dark" : "light") : wanted;
  paint();
  setSlice();
  restale();
}

function variable(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

const dense = () => $("deposits").value === "dense";

function setDeposits() {
  if (dense()) legends.deposits = { label: "Deposits per area", low: 0, ...data.scene.deposits, table: textures.magma.bytes };
  else delete legends.deposits;
  showDeposits();
  showLegends();
  paint();
}

function paint() {
  const rgb = (name) => bytesOf(variable(name)).map((byte) => byte / 255);
  const paper = rgb("--paper");
  // Colours are given in the colour space of the screen; no conversion.
  renderer.setClearColor(new Color().setRGB(...paper), 1);
  walls.paint({ glass: rgb("--glass"), glassDeep: rgb("--glass-deep"), edge: rgb("--edge"), accent: rgb("--accent") }, $("opacity").value, dark(), dense() ? textureOf(textures.magma, false) : null);
  bodies.material.uniforms.darkness.value = dark() ? 1 : 0;
  bodies.material.uniforms.accent.value.set(...rgb("--accent"));
  if (streams) {
    streams.visible = $("streams").checked;
    streams.material.uniforms.base.value.set(...rgb("--soft"));
  }
  deposits.points.material.uniforms.base.value.set(...rgb("--deposit"));
  deposits.points.material.uniforms.paper.value.set(...paper);
  haze.value.set(...paper, haze.value.w);
  dirty = true;
}

function play(on) {
  state.playing = on && data.m > 1;
  loop.last = undefined;
  loop.clock = data.times[state.t];
  document.documentElement.classList.toggle("playing", state.playing);
  $("play-word").textContent = state.playing ? "Stop" : "Play";
  $("play").title = state.playing ? "Stop (space)" : "Play (space)";
}

function step(by) {
  play(false);
  show(Math.max(0, Math.min(data.m - 1, state.t + by)));
  say($("time-text").textContent);
}

function halves() {
  return data.scene.frame.halves;
}

// ---------------------------------------------------------------------------------------------------------
// One body

function rayAt(x, y) {
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2((2 * x) / eye.width - 1, 1 - (2 * y) / eye.height), eye.camera);
  return ray.ray;
}

function bodyAt(x, y) {
  const { origin, direction } = rayAt(x, y);
  return bodies.pick(state.t, origin, direction, bodies.material.uniforms.pixel.value);
}

function tap({ x, y }) {
  choose(bodyAt(x, y));
}

function choose(i) {
  state.chosen = i;
  restale();
  $("keep").checked = state.kept.includes(i);
  if (i < 0) follow(false);
  $("card").hidden = i < 0;
  if (i >= 0) {
    openPanel(false);
    say(`Body ${data.ids[i]} is selected.`);
  }
  show(state.t);
  resize();
  if (i >= 0) bringIntoView(i);
}

function bringIntoView(i) {
  const { x, y, z } = placeOf(i), [above, below] = eye.insets;
  if (z < 1 && x > 0 && x < eye.width && y > above && y < eye.height - below) return;
  if (!data.present(state.t, i)) return;
  const p = 3 * (data.n * state.t + i);
  eye.target.set(data.x[p], data.x[p + 1], data.x[p + 2]);
  eye.place();
}

// Position of the centre of a body in the picture, in pixels.
function placeOf(i) {
  const p = 3 * (data.n * state.t + i);
  const point = new Vector3(data.x[p], data.x[p + 1], data.x[p + 2]).project(eye.camera);
  return { x: (0.5 + 0.5 * point.x) * eye.width, y: (0.5 - 0.5 * point.y) * eye.height, z: point.z };
}

function chooseNext(by) {
  const shown = [...bodies.shown.keys()].filter((i) => bodies.shown[i]);
  if (shown.length === 0) return;
  const at = shown.indexOf(state.chosen);
  choose(shown[at < 0 ? (by > 0 ? 0 : shown.length - 1) : (at + by + shown.length) % shown.length]);
}

function follow(on) {
  state.follow = on && state.chosen >= 0;
  $("follow").checked = state.follow;
  if (!state.follow) return;
  const p = 3 * (data.n * state.t + state.chosen);
  eye.target.set(data.x[p], data.x[p + 1], data.x[p + 2]);
  eye.distance = Math.min(eye.distance, Math.max(eye.fit / 3, 30 * data.radius[state.chosen] * state.enlargement));
  eye.place();
}

function series(field, part, i) {
  const { status } = data.codes;
  return data.times.map((_, t) => (data.present(t, i) && inside(status.meaning(t, i)) ? field.value(t, i, part) : NaN));
}

function showCard() {
  const i = state.chosen, { t } = state, { fate, injector } = data.codes;
  $("card-title").textContent = `Body ${data.ids[i]}`;
  const { t0, t1 } = data.fields;
  const story = [];
  if (injector) story.push(`from ${injector.meaning(data.m - 1, i)}`);
  if (t0) story.push(`released at ${written(t0.value(0, i, ""), "s", data.times[data.m - 1])}`);
  story.push(t1 ? `${fate.meaning(0, i)} at ${written(t1.value(0, i, ""), "s", data.times[data.m - 1])}` : fate.meaning(0, i));
  $("card-story").textContent = capital(story.join(", "));
  const [some] = Object.values(data.fields);
  const field = state.curve ?? (data.fields[state.name] ? { name: state.name, part: state.part } : { name: some.name, part: some.parts[0] });
  const rows = [];
  if (!data.present(t, i)) rows.push(["", "not released yet", null]);
  else {
    const p = 3 * (data.n * t + i), { middle, size } = data.scene.frame;
    const x = [0, 1, 2].map((c) => middle[c] + size * data.x[p + c]);
    const { factor, unit } = readable("m", size);
    rows.push([`position (${unit})`, x.map((v) => number((Math.abs(v) < 1e-6 * size ? 0 : v) / factor, 4)).join(", "), null]);
    for (const f of Object.values(data.fields)) {
      if (f.name === "t0" || f.name === "t1") continue;
      for (const part of f.parts) rows.push([nameOf(f, part), written(f.value(t, i, part), f.unit), { name: f.name, part }]);
    }
  }
  const list = $("card-rows");
  const focused = list.contains(document.activeElement) ? document.activeElement.dataset.key : null;
  list.replaceChildren();
  for (const [name, value, target] of rows) {
    const row = document.createElement("button");
    row.type = "button";
    const left = document.createElement("span"), right = document.createElement("span");
    left.textContent = name;
    right.textContent = value;
    row.append(left, right);
    row.disabled = !target;
    if (target) {
      row.dataset.key = `${target.name}:${target.part}`;
      row.title = "Plot over time";
      row.setAttribute("aria-pressed", String(target.name === field.name && target.part === field.part));
      row.addEventListener("click", () => { state.curve = target; showCard(); });
    }
    list.append(row);
    if (focused && row.dataset.key === focused) row.focus();
  }
  const f = data.fields[field.name];
  if (f) drawChart($("chart"), { label: nameOf(f, field.part), unit: f.unit, times: data.times, values: series(f, field.part, i), now: t });
}

function saveTable() {
  const i = state.chosen, { middle, size } = data.scene.frame;
  const columns = [["t [s]", data.times, 7]];
  for (let c = 0; c < 3; c++) columns.push([`${"xyz"[c]} [m]`, data.times.map((_, t) => middle[c] + size * data.x[3 * (data.n * t + i) + c]), 7]);
  for (const f of Object.values(data.fields)) {
    for (const part of f.parts) columns.push([`${f.name}${part ? `_${part}` : ""}${f.unit ? ` [${f.unit}]` : ""}`, series(f, part, i), DIGITS]);
  }
  const rows = data.times.map((_, t) => (data.present(t, i) ? columns.map(([, values, digits]) => Number(values[t].toPrecision(digits))).join(",") : null));
  const text = [columns.map(([name]) => name).join(","), ...rows.filter(Boolean)].join("\n");
  save(new Blob([`${text}\n`], { type: "text/csv" }), `${data.scene.title}_body_${data.ids[i]}.csv`);
}

// ---------------------------------------------------------------------------------------------------------
// Saving

function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name.replace(/[^\w.-]+/g, "_");
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

// The picture with its texts, at twice the resolution of the screen.
async function paintPicture() {
  const { width, height } = eye, before = renderer.getPixelRatio(), s = 2;
  renderer.setPixelRatio(s);
  renderer.setSize(width, height, false);
  deposits.points.material.uniforms.ratio.value = s;
  draw();
  const page = new OffscreenCanvas(width * s, height * s), context = page.getContext("2d");
  context.drawImage(renderer.domElement, 0, 0);
  renderer.setPixelRatio(before);
  renderer.setSize(width, height, false);
  deposits.points.material.uniforms.ratio.value = before;
  draw();
  const style = textStyle();
  const write = (text, x, y, font, colour, align) => {
    context.font = font;
    context.fillStyle = colour;
    context.textAlign = align;
    context.fillText(text, x, y);
  };
  write(data.scene.title, 22 * s, 32 * s, `600 ${17 * s}px ${style.font}`, style.ink, "left");
  write([data.scene.subtitle, data.scene.groups].filter(Boolean).join("  ·  "), 22 * s, 53 * s, `${14 * s}px ${style.font}`, style.soft, "left");
  write($("clock").textContent, (width - 22) * s, 32 * s, `600 ${17 * s}px ${style.font}`, style.ink, "right");
  write(caption(), (width - 22) * s, 53 * s, `${14 * s}px ${style.font}`, style.soft, "right");
  context.textAlign = "center";
  for (const label of $("labels").children) {
    if (label.hidden) continue;
    const box = boxOf(label);
    write(label.textContent, ((box.left + box.right) / 2) * s, (box.bottom - 5) * s, `${12 * s}px ${style.font}`, style.soft, "center");
  }
  context.textAlign = "left";
  paintLegends(context, legendsShown().reverse(), style, s, height * s);
  const corner = boxOf($("compass"));
  paintCompass(context, corner.left * s, corner.top * s, eye.axes(), metresOfPixel(), data.scene, style, s);
  return page;
}

async function savePicture() {
  const page = await paintPicture();
  save(await page.convertToBlob({ type: "image/png" }), `${data.scene.title}_t${number(data.times[state.t])}.png`);
  say("The picture is saved.");
}

// ---------------------------------------------------------------------------------------------------------
// Controls

function say(text) {
  $("status").textContent = text;
}

function openPanel(on) {
  $("panel").classList.toggle("open", on);
  $("open-panel").setAttribute("aria-expanded", String(on));
  if (on && getComputedStyle($("corner")).display !== "none") $("close-panel").focus();
}

function toggle(id) {
  $(id).checked = !$(id).checked;
  $(id).dispatchEvent(new Event("change"));
}

function readNumber(id, otherwise) {
  const text = $(id).value.trim().replace(",", ".").replace("−", "-");
  const value = text === "" ? otherwise : Number(text);
  const wrong = Number.isNaN(value);
  $(id).setAttribute("aria-invalid", String(wrong));
  if (wrong) say("Not a number.");
  return wrong ? otherwise : value;
}

function setFilter() {
  const [name, part] = $("filter").value.split(":");
  state.filter = name ? { field: data.fields[name], part, low: readNumber("filter-low", -Infinity), high: readNumber("filter-high", Infinity) } : null;
  restale();
  show(state.t);
}

function listen() {
  const on = (id, kind, react) => $(id).addEventListener(kind, react);
  on("time", "input", () => { play(false); show(Number($("time").value)); });
  on("play", "click", () => play(!state.playing));
  on("backward", "click", () => step(-1));
  on("forward", "click", () => step(1));
  on("speed", "change", () => { state.speed = Number($("speed").value); });
  on("colour", "change", () => setColour(...$("colour").value.split(":")));
  for (const id of ["range-low", "range-high"]) on(id, "change", () => setRange(readNumber("range-low", state.low), readNumber("range-high", state.high)));
  on("range-all", "click", () => setRange(...data.fields[state.name].ranges[state.part].whole));
  on("range-now", "click", () => {
    let low = Infinity, high = -Infinity;
    for (let i = 0; i < data.n; i++) {
      const value = bodies.shown[i] ? data.fields[state.name].value(state.t, i, state.part) : NaN;
      if (value < low) low = value;
      if (value > high) high = value;
    }
    setRange(low, high);
  });
  on("map", "change", () => setMap($("map").value));
  on("enlargement", "input", () => {
    const most = Math.log10(Math.max(10, 10 * data.scene.enlargement));
    const value = 10 ** (most * Number($("enlargement").value));
    setEnlargement(value < 1.02 ? 1 : Number(value.toPrecision(2)));
  });
  on("mark", "change", () => { bodies.material.uniforms.mark.value = $("mark").checked ? 1 : 0; dirty = true; });
  on("trails", "change", showTrails);
  on("deposits", "change", setDeposits);
  on("gone", "change", () => { state.gone = $("gone").checked; show(state.t); });
  for (const id of ["filter", "filter-low", "filter-high"]) on(id, "change", setFilter);
  const chooseWanted = () => {
    const i = data.ids.indexOf(Number($("wanted").value));
    if ($("wanted").value.trim() === "" || i < 0) say("No such body.");
    else choose(i);
  };
  on("choose", "click", chooseWanted);
  on("wanted", "keydown", (event) => { if (event.key === "Enter") chooseWanted(); });
  on("opacity", "change", paint);
  on("names", "change", () => { dirty = true; });
  on("slice", "change", setSlice);
  on("normal", "change", turnPlane);
  on("offset", "input", () => {
    const [low, high] = plane.range(plane.normal);
    setOffset(low + Number($("offset").value) * (high - low));
  });
  on("streams", "change", paint);
  dragPlane();
  on("home", "click", () => eye.goHome());
  on("whole", "click", () => eye.showAll(halves()));
  on("theme", "change", () => setTheme($("theme").value));
  on("picture", "click", savePicture);
  on("help", "click", () => $("about").showModal());
  on("follow", "change", () => follow($("follow").checked));
  on("keep", "change", () => keep($("keep").checked));
  on("open-plot", "click", () => openPlot($("plot").hidden));
  on("plot-close", "click", () => { openPlot(false); $("open-plot").focus(); });
  on("plot-clear", "click", () => setBox(null));
  on("card-close", "click", () => { choose(-1); $("canvas").focus(); });
  on("card-next", "click", () => chooseNext(1));
  on("card-previous", "click", () => chooseNext(-1));
  on("card-table", "click", saveTable);
  on("open-panel", "click", () => openPanel(true));
  on("close-panel", "click", () => { openPanel(false); $("open-panel").focus(); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => setTheme($("theme").value));
  document.addEventListener("keydown", onKey);
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || $("about").open) return;
  const target = event.target;
  if (target.matches("input[type=text], select")) return;
  const onSlider = target.matches("input[type=range]");
  const onButton = target.matches("button, summary, input[type=checkbox]");
  const turned = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
  if (turned) {
    if (onSlider || target !== $("canvas")) return;
    if (event.shiftKey) eye.move(-40 * turned[0], 40 * turned[1]);
    else eye.turn(-0.09 * turned[0], -0.09 * turned[1]);
    event.preventDefault();
    return;
  }
  if (event.key === " " && onButton) return;
  const actions = {
    " ": () => play(!state.playing), ",": () => step(-1), ".": () => step(1), "+": () => eye.zoom(0.85), "=": () => eye.zoom(0.85),
    "-": () => eye.zoom(1 / 0.85), n: () => chooseNext(1), p: () => chooseNext(-1),
  };
  if (!onSlider) Object.assign(actions, { Home: () => step(-Infinity), End: () => step(Infinity) });
  for (const [key, , act] of keys) if (act && key !== "Space") actions[key.length === 1 ? key.toLowerCase() : key] = act;
  const act = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!act) return;
  act();
  event.preventDefault();
}

// Interface for tests and other scripts.
const ready = start();
ready.catch((error) => {
  $("notice").textContent = `This page cannot be shown: ${error.message}.`;
  $("notice").classList.add("failed");
  throw error;
});
window.foamprb = {
  ready, state, show, choose, bodyAt, setColour, setEnlargement, paintPicture, draw, placeOf,
  get data() { return data; },
  get eye() { return eye; },
  get plot() { return plot; },
  get bodies() { return bodies; },
  get renderer() { return renderer; },
};
