// The line below the picture: what is drawn, what it lacks, how long it took, and what is wrong where no control shows it.
import { by_id, element } from "./dom.js";

export class Status {
  constructor(store) {
    this.store = store;
    this.rung = by_id("rung");
    this.message = by_id("message");
    this.bar = by_id("progress");
    this.go = () => false; // shows the control of a key
  }

  // What the ladder tells.
  drawn({ rung, rungs, name, without, milliseconds, working, waiting, done, stage, fault }) {
    if (fault) {
      document.body.dataset.working = "false";
      this.bar.hidden = true;
      this.rung.textContent = "not drawn";
      return;
    }
    if (waiting) {
      document.body.dataset.working = "false";
      this.bar.hidden = true;
      this.rung.textContent = `${name}; the next when the rendering is done`;
      return;
    }
    const last = rung === rungs - 1;
    document.body.dataset.rung = working ? String(Math.max(0, rung - 1)) : String(rung);
    document.body.dataset.working = String(Boolean(working) || !last);
    this.bar.hidden = !working || (!last && !stage);
    if (working) this.bar.value = done ?? 0;
    // While a rung is being drawn the line says what is there, unless it takes long.
    if (working && !last && !stage) return;
    const lacks = without.length > 0 ? `without ${without.join(", ")}` : "complete";
    const time = milliseconds >= 2000 ? `${(milliseconds / 1000).toFixed(1)} s` : `${Math.round(milliseconds ?? 0)} ms`;
    const share = done > 0 ? `${Math.round(100 * done)} %` : "";
    const state = working ? `${name}: ${[stage, share].filter(Boolean).join(", ") || "…"}` : `${name}, ${lacks}, ${time}`;
    this.rung.textContent = state;
    this.rung.dataset.lacks = String(without.length);
    by_id("steps").replaceChildren(
      ...Array.from({ length: rungs }, (_, k) => element("i", { class: k < rung || (k === rung && !working) ? "done" : "" })),
    );
  }

  // An error that is shown where it belongs, at a control or a line in sight, is not told here again.
  fault(fault) {
    const panel = document.body.dataset.panel;
    const seen = Boolean(fault) && (fault.panel === panel || (fault.line > 0 && panel === "text"));
    this.message.replaceChildren();
    this.message.hidden = !fault || seen;
    if (this.message.hidden) return;
    const where = fault.where && !fault.message.includes(fault.where) ? `${fault.where}: ` : "";
    this.message.append(element("span", {}, `${where}${fault.message}`));
    if (fault.panel) this.message.append(element("button", { type: "button", click: () => this.go(fault.key) }, "Show"));
    else if (fault.line)
      this.message.append(element("button", { type: "button", click: () => by_id("tab-text").click() }, "Show the line"));
    this.message.append(element("button", { type: "button", "aria-label": "Close the message", click: () => this.fault(null) }, "×"));
  }

  // A short word that goes away by itself.
  say(text) {
    const said = by_id("said");
    said.textContent = text;
    said.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      said.hidden = true;
    }, 3500);
  }
}
