// The fragment of the page's address: camera, time, body and colours, so that a link restores the view.

const DIGITS = 5;

// `view` reads the state as words, `restore` sets it from words.
export class Link {
  constructor(words, view, restore) {
    Object.assign(this, { words, view, restore, timer: null });
    this.fixed = [...words].filter(([key]) => ["bare", "naked", "theme"].includes(key));
    this.initial = this.text();
    addEventListener("hashchange", () => restore(new URLSearchParams(location.hash.slice(1))));
  }

  text() {
    const rounded = (value) => (Array.isArray(value) ? value.map((v) => Number(v.toPrecision(DIGITS))).join(",") : value);
    return Object.entries(this.view()).map(([key, value]) => `${key}=${rounded(value)}`).join("&");
  }

  // Called after each change: the address changes when the view has rested, if it is not the first one.
  changed() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      const text = this.text();
      if (text === this.initial && !this.written) return;
      this.written = true;
      const all = [...this.fixed.map(([key, value]) => (value ? `${key}=${value}` : key)), text].join("&");
      // A page inside another one may have no address of its own.
      try { history.replaceState(null, "", `#${all}`); } catch { /* nothing to restore */ }
    }, 400);
  }
}
