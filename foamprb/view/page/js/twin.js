// A page beside another one: what it posts to the page around both, and what it takes from there. Lengths in metres.

export class Twin {
  constructor({ ready, take }) {
    this.taking = false;
    this.post({ ready });
    addEventListener("message", ({ source, data }) => {
      if (source !== parent || !data.foamprb) return;
      this.taking = true;
      take(data.foamprb);
      this.taking = false;
    });
  }

  post(message) {
    if (!this.taking) parent.postMessage({ foamprb: message }, "*");
  }
}
