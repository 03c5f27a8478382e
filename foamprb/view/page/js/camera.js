// Camera that turns about an upright axis, moves and zooms by mouse, touch and keys.

import { Matrix4, PerspectiveCamera, Vector3 } from "three";

const MOST_PITCH = 1.55;

export class Eye {
  constructor(canvas, home, insets, onChange, onTap) {
    this.canvas = canvas;
    this.home = home;
    this.insets = insets;
    this.camera = new PerspectiveCamera(home.angle, 1, 0.01, 10);
    this.onChange = onChange;
    this.onTap = onTap;
    this.pointers = new Map();
    this.up = new Vector3(...home.up);
    const towards = new Vector3(...home.towards);
    // A frame whose third axis is upright.
    const flat = towards.clone().addScaledVector(this.up, -towards.dot(this.up));
    this.front = flat.length() > 1e-6 ? flat.normalize() : new Vector3(1, 0, 0).cross(this.up).normalize();
    this.side = new Vector3().crossVectors(this.up, this.front);
    this.homePitch = Math.asin(Math.max(-1, Math.min(1, towards.dot(this.up))));
    this.target = new Vector3();
    this.listen();
  }

  resize(width, height) {
    const before = this.fit;
    this.width = width;
    this.height = height;
    this.camera.aspect = width / height;
    this.fit = this.distanceFor(this.home.corners, this.home.leastWidth);
    if (before && this.distance) this.distance *= this.fit / before;
    this.place();
  }

  // Share of the height of the picture without texts, and offset of its middle downwards, in pixels.
  free() {
    const [above, below] = this.insets;
    return { share: Math.max(0.3, 1 - (above + below) / this.height), shift: (above - below) / 2 };
  }

  // Distance at which points are visible, given right of, above and in front of the target. A long object is cut so
  // that it is tall enough.
  distanceFor(corners, leastWidth) {
    const slope = Math.tan((this.home.angle * Math.PI) / 360), { aspect } = this.camera, { share } = this.free();
    const tallest = Math.max(...corners.map(([, y]) => Math.abs(y)));
    const widest = Math.max(leastWidth, this.home.tall * tallest * aspect);
    return Math.max(...corners.map(([x, y, z]) => z
      + this.home.margin * Math.max(Math.min(Math.abs(x), widest) / (slope * aspect), Math.abs(y) / (slope * share))));
  }

  goHome() {
    this.yaw = 0;
    this.pitch = this.homePitch;
    this.target.set(...this.home.focus);
    this.distance = this.fit;
    this.place();
  }

  look(yaw, pitch, distances, x, y, z) {
    Object.assign(this, { yaw, pitch, distance: distances * this.fit });
    this.target.set(x, y, z);
    this.place();
  }

  // Show a whole box, given by its half sides about the origin, in the current direction.
  showAll(halves) {
    this.target.set(0, 0, 0);
    const { towards, right, up } = this.axes(), corners = [];
    for (const i of [-1, 1]) for (const j of [-1, 1]) for (const k of [-1, 1]) {
      const corner = new Vector3(i * halves[0], j * halves[1], k * halves[2]);
      corners.push([corner.dot(right), corner.dot(up), corner.dot(towards)]);
    }
    this.distance = this.distanceFor(corners, Infinity);
    this.place();
  }

  axes() {
    const towards = this.towards();
    const right = new Vector3().crossVectors(this.up, towards).normalize();
    return { towards, right, up: new Vector3().crossVectors(towards, right) };
  }

  towards() {
    const flat = Math.cos(this.pitch);
    return new Vector3()
      .addScaledVector(this.front, flat * Math.cos(this.yaw))
      .addScaledVector(this.side, flat * Math.sin(this.yaw))
      .addScaledVector(this.up, Math.sin(this.pitch));
  }

  place() {
    if (this.yaw === undefined || !this.width) return;
    const { towards, right, up } = this.axes();
    const camera = this.camera;
    camera.position.copy(this.target).addScaledVector(towards, this.distance);
    camera.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(right, up, towards));
    // The scene lies within a distance of 2 from the origin.
    camera.near = Math.max(0.02 * this.distance, this.distance - 4);
    camera.far = this.distance + 4;
    const { width, height } = this;
    camera.setViewOffset(width, height, 0, -this.free().shift, width, height);
    camera.updateMatrixWorld(true);
    this.onChange();
  }

  turn(right, upwards) {
    this.yaw -= right;
    this.pitch = Math.max(-MOST_PITCH, Math.min(MOST_PITCH, this.pitch + upwards));
    this.place();
  }

  // Move by pixels of the picture.
  move(dx, dy) {
    const { right, up } = this.axes();
    const pixel = (2 * this.distance * Math.tan((this.home.angle * Math.PI) / 360)) / this.height;
    this.target.addScaledVector(right, -dx * pixel).addScaledVector(up, dy * pixel);
    this.place();
  }

  // Zoom by a factor; the point under a pixel stays there.
  zoom(factor, x = this.width / 2, y = this.height / 2 + this.free().shift) {
    const before = this.distance;
    this.distance = Math.max(1e-6, Math.min(20, before * factor));
    const shift = this.distance / before - 1;
    this.move((x - this.width / 2) * shift, (y - this.height / 2 - this.free().shift) * shift);
  }

  listen() {
    const canvas = this.canvas;
    const at = (event) => {
      const box = canvas.getBoundingClientRect();
      return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      const place = at(event);
      this.pointers.set(event.pointerId, { ...place, moving: event.button !== 0 || event.shiftKey });
      this.travelled = this.pointers.size > 1 ? Infinity : 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = this.pointers.get(event.pointerId);
      if (!before) return;
      const now = at(event);
      const dx = now.x - before.x, dy = now.y - before.y;
      if (this.pointers.size === 1) {
        this.travelled += Math.hypot(dx, dy);
        // Small movements of a finger count as a tap.
        if (this.travelled < 4) { return; }
        if (before.moving) this.move(dx, dy);
        else this.turn((dx * 3.2) / this.height, (dy * 3.2) / this.height);
      } else if (this.pointers.size === 2) {
        const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
        const apart = Math.hypot(now.x - other.x, now.y - other.y);
        const apartBefore = Math.hypot(before.x - other.x, before.y - other.y);
        if (apart > 0 && apartBefore > 0) this.zoom(apartBefore / apart, (now.x + other.x) / 2, (now.y + other.y) / 2);
        this.move(dx / 2, dy / 2);
      }
      Object.assign(before, now);
    });
    const end = (event) => {
      const place = this.pointers.get(event.pointerId);
      this.pointers.delete(event.pointerId);
      if (place && event.type === "pointerup" && this.travelled < 4 && !place.moving) this.onTap(at(event), event.pointerType);
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    // In a frame of another page, the wheel and one finger scroll that page until this one is clicked.
    const isPassive = () => window.parent !== window && !document.hasFocus();
    const update = () => { canvas.style.touchAction = isPassive() ? "pan-y" : ""; };
    for (const name of ["focus", "blur"]) addEventListener(name, update);
    update();
    canvas.addEventListener("wheel", (event) => {
      if (isPassive() && !event.ctrlKey) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      const place = at(event);
      this.zoom(Math.exp(Math.max(-0.5, Math.min(0.5, event.deltaY * lines * 0.0012))), place.x, place.y);
    }, { passive: false });
  }
}
