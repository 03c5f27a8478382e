// Two pages of foamprb view with one camera, one clock and one legend. Each page posts its view and takes that of the other.
"use strict";
const $ = (id) => document.getElementById(id);
const frames = [...document.querySelectorAll("iframe")], found = new Map();
const SECONDS = 8;
let times = [], playing = false, last = null, clock = 0;

const post = (message, to = frames) => to.forEach((frame) => frame.contentWindow.postMessage({ foamprb: message }, "*"));

addEventListener("message", ({ source, data }) => {
  const from = frames.find((frame) => frame.contentWindow === source);
  if (!from || !data.foamprb) return;
  const { ready, eye } = data.foamprb;
  if (ready) {
    found.set(from, ready);
    if (found.size === frames.length) begin();
  } else if (eye && found.size === frames.length) post({ eye }, frames.filter((frame) => frame !== from));
});

function begin() {
  const [first, ...others] = frames.map((frame) => found.get(frame));
  times = [...new Set([first, ...others].flatMap((own) => own.times))].sort((a, b) => a - b);
  $("time").max = times.length - 1;
  for (const [key, { label }] of Object.entries(first.arrays)) {
    if (others.every((own) => key in own.arrays)) $("colour").append(new Option(label, key));
  }
  $("colour").value = first.colour;
  post({ enlargement: Math.min(first.enlargement, ...others.map((own) => own.enlargement)), eye: first.eye });
  paint();
  show(times.reduce((best, t, k) => (Math.abs(t - first.t) < Math.abs(times[best] - first.t) ? k : best), 0));
  document.documentElement.dataset.ready = "true";
}

function paint() {
  const key = $("colour").value, ranges = [...found.values()].map((own) => own.arrays[key].range).filter(Boolean);
  post({ colour: key, range: ranges.length ? [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))] : null });
}

function show(k) {
  $("time").value = k;
  const most = times[times.length - 1], [factor, unit] = most >= 0.5 ? [1, "s"] : most >= 5e-4 ? [1e-3, "ms"] : [1e-6, "µs"];
  $("time-text").textContent = `${Number((times[k] / factor).toPrecision(4))} ${unit}`;
  $("time").setAttribute("aria-valuetext", $("time-text").textContent);
  post({ t: times[k] });
}

function play(on) {
  playing = on;
  $("play-word").textContent = on ? "Stop" : "Play";
  last = null;
  clock = times[Number($("time").value)];
  if (on) requestAnimationFrame(step);
}

function step(now) {
  if (!playing) return;
  const [first, end] = [times[0], times[times.length - 1]];
  clock += ((now - (last ?? now)) / 1000) * ((end - first) / SECONDS);
  last = now;
  if (clock > end) clock = first;
  const k = Math.max(0, times.findLastIndex((t) => t <= clock));
  if (k !== Number($("time").value)) show(k);
  requestAnimationFrame(step);
}

$("time").addEventListener("input", () => { play(false); show(Number($("time").value)); });
$("play").addEventListener("click", () => play(!playing));
$("colour").addEventListener("change", paint);
document.addEventListener("keydown", (event) => {
  if (event.key !== " " || event.target.matches("button, select, input")) return;
  play(!playing);
  event.preventDefault();
});
