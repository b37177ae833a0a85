// The critique beside the picture: what `belvedere check` says of this view, and the notes of the picture.
import { api } from "./api.js";
import { by_id, element } from "./dom.js";

const signs = { good: "●", note: "◆", bad: "▲" };
const words = { good: "good", note: "worth a look", bad: "to mend" };

export class Check {
  constructor(store) {
    this.store = store;
    this.box = by_id("critique");
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
    const list = sorted.map(({ name, value, meaning, verdict, advice }) =>
      element(
        "li",
        { class: verdict, title: meaning ? `${value} ${meaning}` : null },
        element("span", { class: "sign", role: "img", "aria-label": words[verdict] ?? verdict }, signs[verdict] ?? "●"),
        element("span", { class: "name" }, name),
        element("span", { class: "value" }, value ?? ""),
        advice && verdict !== "good" ? element("span", { class: "advice" }, advice) : null,
      ),
    );
    for (const note of this.store.state.notes ?? [])
      list.push(element("li", { class: "note" }, element("span", { class: "sign" }, "◆"), element("span", { class: "advice" }, note)));
    this.box.replaceChildren(...list);
    this.box.classList.remove("old");
  }
}
