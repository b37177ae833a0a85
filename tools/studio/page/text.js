// The scene as text, with line numbers and the error at its line. What is typed is asked of the program when the hand rests; its messages
// are those of the command line. Text that it refuses stays as a draft beside the scene: its message stays with it, and once the scene has
// changed elsewhere the draft, which lacks that change, is only sent on request.
import { api } from "./api.js";
import { by_id, element } from "./dom.js";

const rest_ms = 700;

export class Text {
  constructor(store) {
    this.store = store;
    this.area = by_id("text");
    this.lines = by_id("lines");
    this.fault_box = by_id("text-fault");
    this.mark = by_id("text-mark");
    this.typed = false; // there is a draft: text that the program has not taken
    this.base = ""; // the scene's text when the draft was begun
    this.refused = null; // what the program said of the draft
    this.area.addEventListener("input", () => {
      if (!this.typed) this.base = this.store.state.text;
      this.typed = true;
      this.number();
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.send(), rest_ms);
    });
    this.area.addEventListener("scroll", () => this.scroll());
    this.area.addEventListener("blur", () => this.typed && this.send());
    this.area.addEventListener("keydown", (event) => {
      // Tab leaves the text, as everywhere; Ctrl-Enter asks at once.
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.send(true);
    });
    by_id("text-back").addEventListener("click", () => this.back());
    store.on("state", () => this.show());
    store.on("fault", (fault) => this.fault(fault));
  }

  show() {
    if (this.typed || this.area.value === this.store.state.text) return;
    const { scrollTop, selectionStart, selectionEnd } = this.area;
    this.area.value = this.store.state.text;
    this.area.setSelectionRange(selectionStart, selectionEnd);
    this.area.scrollTop = scrollTop;
    this.number();
  }
  // on_request: also over what has changed in the scene since the draft was begun.
  async send(on_request = false) {
    clearTimeout(this.timer);
    const text = this.area.value;
    if (text === this.store.state.text) return this.done();
    if (this.store.state.text !== this.base && !on_request) {
      by_id("text-back").hidden = false;
      return this.fault(null);
    }
    this.refused = null;
    this.sending = true;
    const taken = await this.store.act(() => api.text(text));
    this.sending = false;
    if (taken && this.area.value === text) return this.done();
    if (taken) this.base = this.store.state.text; // and typed on since
    by_id("text-back").hidden = taken;
  }
  done() {
    this.typed = false;
    this.refused = null;
    by_id("text-back").hidden = true;
    this.fault(null);
  }
  // Drops the draft.
  back() {
    this.done();
    this.show();
    this.store.tell("fault", null);
  }

  number() {
    const count = this.area.value.split("\n").length;
    if (count !== this.count) this.lines.replaceChildren(...Array.from({ length: count }, (_, k) => element("span", {}, String(k + 1))));
    this.count = count;
    this.scroll();
  }
  scroll() {
    this.lines.scrollTop = this.area.scrollTop;
    this.place_mark();
  }
  fault(fault) {
    if (this.sending && fault) this.refused = fault;
    const shown = this.typed ? (this.refused ?? fault) : fault;
    this.line = shown?.line ?? 0;
    const here = Boolean(shown) && this.line > 0;
    const says = [
      here ? `Line ${this.line}: ${shown.message}` : "",
      this.typed && !this.sending && this.store.state.text !== this.base
        ? "The scene has changed beside this draft. Ctrl-Enter takes the draft, which undoes that change."
        : "",
    ].filter(Boolean);
    this.fault_box.hidden = says.length === 0;
    this.fault_box.textContent = says.join(" ");
    for (const each of this.lines.children) each.classList.remove("faulty");
    this.lines.children[this.line - 1]?.classList.add("faulty");
    this.area.setAttribute("aria-invalid", String(here));
    if (here && !this.typed) this.area.scrollTop = Math.max(0, (this.line - 6) * this.line_height());
    this.place_mark();
  }
  line_height() {
    return Number.parseFloat(getComputedStyle(this.area).lineHeight);
  }
  place_mark() {
    this.mark.hidden = !this.line;
    if (this.line) this.mark.style.transform = `translateY(${(this.line - 1) * this.line_height() - this.area.scrollTop}px)`;
  }
}
