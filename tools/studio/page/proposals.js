// Other compositions of the same ground, as `belvedere new` proposes them: thumbnails to take.
import { api } from "./api.js";
import { by_id, element } from "./dom.js";
import { recall, remember } from "./memory.js";

export class Proposals {
  constructor(store, status, ladder) {
    this.store = store;
    this.status = status;
    this.ladder = ladder;
    this.turn = 0;
    by_id("propose").addEventListener("click", () => this.read());
  }
  // Asks again for those that were there before the page was loaded again.
  async restore() {
    if (recall("proposals")) await this.read();
  }

  async read() {
    const box = by_id("proposals");
    by_id("propose").disabled = true;
    box.replaceChildren(element("p", { class: "none" }, "Looking for views …"));
    this.ladder.stop(); // somebody waits for the views
    this.store.thumbnails.hold(true);
    try {
      const { proposals } = await api.proposals();
      ++this.turn;
      remember("proposals", true);
      box.replaceChildren(...proposals.map((each) => this.one(each)));
      if (proposals.length === 0) box.append(element("p", { class: "none" }, "There is nothing to propose for this ground."));
    } catch (error) {
      box.replaceChildren(element("p", { class: "none" }, error.message));
    } finally {
      by_id("propose").disabled = false;
    }
    await this.draw(Array.from(box.querySelectorAll("img")), this.turn);
    this.store.thumbnails.hold(false);
    this.ladder.resume(this.store.state.revision);
  }
  // One after the other. What is changed meanwhile is drawn first: they would take the ground from it.
  async draw(images, turn) {
    for (const [index, image] of images.entries())
      for (let attempt = 0; attempt < 60 && this.turn === turn && image.isConnected; ++attempt) {
        const drawn = new Promise((resolve) => {
          image.onload = () => resolve(true);
          image.onerror = () => resolve(false);
        });
        image.src = api.thumbnail(index, `${turn}-${attempt}`);
        if (await drawn) break;
        do await new Promise((resolve) => setTimeout(resolve, 1000));
        while (this.store.busy || !(this.ladder.complete || this.ladder.stopped));
      }
  }
  one({ name, why, changes }) {
    return element(
      "button",
      {
        type: "button",
        class: "proposal",
        title: why,
        click: () => {
          this.store.locks.edit(changes, `${name} taken. Ctrl-Z goes back.`);
        },
      },
      element("img", { alt: "" }),
      element("span", { class: "name" }, name),
      element("span", { class: "why" }, why ?? ""),
    );
  }
}
