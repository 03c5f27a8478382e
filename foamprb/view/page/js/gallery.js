// One body at eight times of its life, side by side at one scale, seen in the direction of the scene, beside a bar.

import { Color, Matrix4, PerspectiveCamera, Scene, Vector4 } from "three";
import { amplitude, Bodies } from "./bodies.js";
import { roundLength } from "./compass.js";
import { written } from "./colours.js";

const COLUMNS = 4, ROWS = 2, TEXT = 15, BAR = 22, ANGLE = 8;
export const GALLERY = COLUMNS * ROWS;

export class Gallery {
  constructor(data) {
    this.data = data;
    const own = { n: GALLERY, x: new Float32Array(3 * GALLERY), F: new Int16Array(9 * GALLERY), radius: new Float32Array(GALLERY), shapeStep: data.shapeStep,
      B: data.B && new Int16Array(7 * GALLERY), modeStep: data.modeStep };
    this.own = own;
    // Without haze: all are near.
    this.bodies = new Bodies(own, { value: new Vector4(0, 0, 0, 1e9) });
    this.bodies.material.uniforms.smallest.value = 0;
    this.scene = new Scene();
    this.scene.add(this.bodies.mesh);
    this.camera = new PerspectiveCamera(ANGLE, 1, 1, 100);
  }

  // Paint a body at some of its times; `colour(t, i)` is its place in the colours.
  paint(canvas, renderer, body, frames, now, colour, axes, like, style) {
    const { data, own } = this, ratio = renderer.getPixelRatio(), width = canvas.clientWidth, tile = Math.floor(width / COLUMNS);
    const height = ROWS * (tile + TEXT);
    let longest = 0;
    frames.forEach((t, k) => {
      own.F.set(data.F.subarray(9 * (data.n * t + body), 9 * (data.n * t + body) + 9), 9 * k);
      const f = own.F.subarray(9 * k, 9 * k + 9);
      let bulge = 0;
      if (data.B) {
        const from = 7 * (data.n * t + body), B = data.B.subarray(from, from + 7);
        own.B.set(B, 7 * k);
        bulge = amplitude(B) * data.modeStep;
      }
      for (let c = 0; c < 3; c++) longest = Math.max(longest, Math.hypot(f[c], f[c + 3], f[c + 6]) * data.shapeStep + bulge);
    });
    // An ellipsoid reaches no farther than the root of the sum of the squares of three conjugate half axes.
    const half = 1.25 * longest, step = (tile + TEXT) / tile;
    frames.forEach((_, k) => {
      const column = (k % COLUMNS) - (COLUMNS - 1) / 2, row = (ROWS - 1) / 2 - Math.floor(k / COLUMNS);
      const at = axes.right.clone().multiplyScalar(column).addScaledVector(axes.up, row * step + 0.5 * (TEXT / tile));
      own.x.set([at.x, at.y, at.z], 3 * k);
      own.radius[k] = 0.5 / half;
    });
    for (const name of ["colours", "darkness", "mark"]) this.bodies.material.uniforms[name].value = like.uniforms[name].value;
    this.bodies.mesh.geometry.attributes.radius.needsUpdate = true;
    this.bodies.show(0, (k) => k < frames.length, (k) => colour(frames[k], body));
    const camera = this.camera, distance = (0.5 * height) / tile / Math.tan((ANGLE * Math.PI) / 360);
    camera.aspect = width / height;
    camera.near = distance - 3;
    camera.far = distance + 3;
    camera.position.copy(axes.towards).multiplyScalar(distance);
    camera.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(axes.right, axes.up, axes.towards));
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld(true);
    const before = renderer.getClearColor(new Color()), [w, h] = [width * ratio, (height + BAR) * ratio].map(Math.round);
    renderer.setClearColor(style.raised, 1);
    renderer.setViewport(0, 0, width, height);
    renderer.setScissor(0, 0, width, height);
    renderer.setScissorTest(true);
    renderer.render(this.scene, camera);
    if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
    canvas.style.height = `${height + BAR}px`;
    const context = canvas.getContext("2d"), gl = renderer.domElement;
    context.clearRect(0, 0, w, h);
    context.drawImage(gl, 0, gl.height - Math.round(height * ratio), w, Math.round(height * ratio), 0, 0, w, Math.round(height * ratio));
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, gl.width / ratio, gl.height / ratio);
    renderer.setClearColor(before, 1);
    return this.write(context, body, frames, now, tile, half, style, ratio, width, height);
  }

  write(context, body, frames, now, tile, half, style, s, width, height) {
    const { times, radius, scene } = this.data, last = times[frames[frames.length - 1]];
    context.textAlign = "center";
    const nearest = frames.reduce((a, b) => (Math.abs(times[b] - times[now]) < Math.abs(times[a] - times[now]) ? b : a));
    frames.forEach((t, k) => {
      const x = (k % COLUMNS + 0.5) * tile * s, y = (Math.floor(k / COLUMNS) * (tile + TEXT) + tile + 10) * s;
      context.font = `${t === nearest ? "600 " : ""}${11 * s}px ${style.font}`;
      context.fillStyle = t === nearest ? style.ink : style.soft;
      context.fillText(written(times[t], "s", last), x, y);
    });
    // Length of a pixel, m.
    const pixel = (2 * half * radius[body] * scene.frame.size) / tile, length = roundLength(1.6 * tile * pixel), text = written(length, "m");
    const y = (height + 9) * s, right = (width - 4) * s, left = right - (length / pixel) * s;
    context.strokeStyle = style.ink;
    context.lineWidth = 1.5 * s;
    context.beginPath();
    for (const [k, [x, dy]] of [[left, -4], [left, 0], [right, 0], [right, -4]].entries()) context[k ? "lineTo" : "moveTo"](x, y + dy * s);
    context.stroke();
    context.textAlign = "right";
    context.font = `${11 * s}px ${style.font}`;
    context.fillStyle = style.ink;
    context.fillText(text, left - 6 * s, y + 1 * s);
    return `Shape at ${frames.length} times from ${written(times[frames[0]], "s", last)} to ${written(last, "s", last)}, to scale; bar of ${text}`;
  }
}
