/* Browsers run no workers for pages that are opened from the file system. The search of the documentation asks for one:
   there, this stands in for `Worker`. The script runs in a hidden frame instead, and messages go to and fro. */
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      document.body.appendChild(this.frame);
      const inside = this.frame.contentWindow;
      const load = (address) =>
        new Promise((done, failed) => {
          const script = inside.document.createElement("script");
          script.src = new URL(address, location.href).href;
          script.onload = done;
          script.onerror = failed;
          inside.document.body.appendChild(script);
        });
      inside.postMessage = (data) => this.tell(this, MessageEvent, data);
      inside.importScripts = (...addresses) =>
        addresses.reduce((before, address) => before.then(() => load(address)), Promise.resolve());
      this.ready = load(url);
      this.ready.catch((error) => this.dispatchEvent(new ErrorEvent("error", { error })));
    }
    postMessage(data) {
      const inside = this.frame.contentWindow;
      this.ready.then(() => this.tell(inside, inside.MessageEvent, data));
    }
    terminate() {
      this.frame.remove();
    }
    tell(target, Kind, data) {
      const message = new Kind("message", { data });
      target.dispatchEvent(message);
      if (target === this && this.onmessage) this.onmessage(message);
    }
  };
}
