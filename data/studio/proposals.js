// Other compositions of the same ground, as `belvedere new` proposes them: thumbnails to take.
import { api } from "./api.js";
import { by_id, element } from "./dom.js";
import { alone, new_step } from "./store.js";

export class Proposals {
  constructor(store, status) {
    this.store = store;
    this.status = status;
    this.turn = 0;
    by_id("propose").addEventListener("click", () => this.read());
  }

  async read() {
    const box = by_id("proposals");
    by_id("propose").disabled = true;
    box.replaceChildren(element("p", { class: "none" }, "Looking for views …"));
    try {
      const { proposals } = await api.proposals();
      ++this.turn;
      box.replaceChildren(...proposals.map((each, index) => this.one(each, index)));
      if (proposals.length === 0) box.append(element("p", { class: "none" }, "There is nothing to propose for this ground."));
    } catch (error) {
      box.replaceChildren(element("p", { class: "none" }, error.message));
    } finally {
      by_id("propose").disabled = false;
    }
  }
  one({ name, why, changes }, index) {
    return element(
      "button",
      {
        type: "button",
        class: "proposal",
        title: why,
        click: () => {
          this.store.edit(alone(this.store, changes), new_step());
          this.status.say(`${name} taken. Ctrl-Z goes back.`);
        },
      },
      element("img", { src: api.thumbnail(index, this.turn), alt: "", loading: "lazy" }),
      element("span", { class: "name" }, name),
      element("span", { class: "why" }, why ?? ""),
    );
  }
}
