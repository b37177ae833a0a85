// The critique beside the picture: what `belvedere check` says of this view, and the notes of the picture.
import { api } from "./api.js";
import { in_words } from "./critique.js";
import { by_id, element } from "./dom.js";

const signs = { good: "●", note: "◆", bad: "▲" };
const words = { good: "good", note: "worth a look", bad: "to mend" };

export class Check {
  constructor(store) {
    this.store = store;
    this.box = by_id("critique");
    this.mark = by_id("critique-mark");
    store.on("changed", () => this.box.classList.add("old"));
  }

  async read(signal) {
    let found;
    try {
      found = await api.check(signal);
    } catch (error) {
      if (error.name !== "AbortError" && error.status !== 409)
        this.show([{ name: "critique", value: "", verdict: "note", advice: error.message }]);
      return;
    }
    if (found.revision === undefined || found.revision === this.store.state.revision) this.show(found.items);
  }
  show(items) {
    const order = ["bad", "note", "good"];
    const sorted = [...items].sort((a, b) => order.indexOf(a.verdict) - order.indexOf(b.verdict));
    const list = sorted.map((item) => {
      const { value, meaning, verdict } = item;
      const { title, part, says, mend } = in_words(item);
      const point = (on) => () => this.point(on ? part : null);
      return element(
        "li",
        { class: verdict, title: meaning ? `${value} ${meaning}` : null, pointerenter: point(true), pointerleave: point(false), focusin: point(true), focusout: point(false) },
        element("span", { class: "sign", role: "img", "aria-label": words[verdict] ?? verdict }, signs[verdict] ?? "●"),
        element("span", { class: "name" }, title),
        element("span", { class: "value" }, value ?? ""),
        says && verdict !== "good"
          ? element(
              "span",
              { class: "advice" },
              `${says} `,
              mend && element("button", { type: "button", class: "mend", click: () => this.mend(mend) }, mend.label),
            )
          : null,
      );
    });
    for (const note of this.store.state.notes ?? [])
      list.push(element("li", { class: "note" }, element("span", { class: "sign" }, "◆"), element("span", { class: "advice" }, note)));
    this.box.replaceChildren(...list);
    this.box.classList.remove("old");
    this.point(null);
  }
  mend({ label, changes }) {
    const all = changes(this.store);
    if (all.length > 0) this.store.locks.edit(all, `${label}. Ctrl-Z goes back.`);
  }
  // Marks a part of the picture.
  point(part) {
    this.mark.hidden = !part;
    if (!part) return;
    const [left, top, width, height] = part.map((share) => `${100 * share}%`);
    Object.assign(this.mark.style, { left, top, width, height });
  }
}
