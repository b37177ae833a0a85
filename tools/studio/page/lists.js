// A list of blocks [[key]] of the scene: one row of controls for each, new ones by a click on the picture, each can be removed, and those
// that have a key `enabled` can be switched off.
import { row } from "./controls.js";
import { element } from "./dom.js";
import { work_on } from "./painting.js";
import { lists } from "./panels_table.js";
import { new_step } from "./store.js";

export class Blocks {
  constructor(store, hands, key) {
    Object.assign(this, { store, key, about: lists[key] });
    this.open = new Set();
    this.made = [];
    this.box = element("div", { class: "blocks" });
    this.none = element("p", { class: "none" }, this.about.none);
    const add = element("span", { class: "add" });
    if (this.about.pull)
      add.append(element("button", { type: "button", class: "wide", id: "pull", click: () => hands.pull_summit() }, this.about.pull));
    if (this.about.pick) {
      const { label, hint, template } = this.about.pick;
      add.append(element("button", { type: "button", class: "wide", click: () => hands.place(hint, key, template) }, label));
    }
    this.element = element("div", {}, this.none, this.box, add);
  }

  rows() {
    return this.made.flatMap((block) => block.rows);
  }

  update() {
    const count = this.store.count(this.key);
    // A new block is opened, so that it can be worked on at once.
    if (this.known !== undefined && count > this.known) this.open.add(count - 1);
    this.known = count;
    this.none.hidden = count > 0;
    while (this.made.length > count) this.made.pop().element.remove();
    while (this.made.length < count) {
      this.made.push(this.block(this.made.length));
      this.box.append(this.made.at(-1).element);
    }
    this.made.forEach((block, index) => {
      const at = `${this.key}.${index}`;
      const named = this.store.value(`${at}.name`) ?? (this.about.title ? this.store.value(`${at}.${this.about.title}`) : "");
      block.name.textContent = named || `${this.about.one} ${index + 1}`;
      block.element.open = this.open.has(index);
      block.enabled?.update();
      if (block.element.open) for (const each of block.rows) each.update();
    });
  }

  block(index) {
    const at = `${this.key}.${index}`;
    const rows = this.about.rows.map((spec) => row(this.store, { ...spec, key: `${at}.${spec.key}` })).filter(Boolean);
    const name = element("span", { class: "name" });
    const remove = element(
      "button",
      {
        type: "button",
        class: "remove",
        title: "Remove",
        "aria-label": `Remove ${this.about.one.toLowerCase()} ${index + 1}`,
        click: (event) => {
          event.preventDefault();
          this.open.delete(index);
          this.store.edit([{ key: at, remove: true }], new_step());
        },
      },
      "×",
    );
    const enabled = this.enabled(index);
    const details = element(
      "details",
      {},
      element("summary", {}, name, enabled?.element, remove),
      ...rows.map((each) => each.element),
      this.about.room ? this.door(at, this.about.room) : null,
    );
    details.addEventListener("toggle", () => {
      if (details.open) this.open.add(index);
      else this.open.delete(index);
      if (details.open) for (const each of rows) each.update();
    });
    return { element: details, rows, name, enabled };
  }

  // Leads to another page of the program, about the file of a block; what was changed here stays.
  door(at, { label, of, work }) {
    const button = element("button", { type: "button", class: "wide", hidden: !this.store.value(`${at}.${of}`) }, label);
    button.addEventListener("click", async () => {
      button.disabled = true;
      try {
        location.assign(await work_on(work, this.store.value(`${at}.${of}`), (words) => (button.textContent = words)));
      } catch (error) {
        this.store.fail(error);
      }
      [button.disabled, button.textContent] = [false, label];
    });
    return button;
  }

  enabled(index) {
    const key = `${this.key}.${index}.enabled`;
    if (!this.store.describe(key)) return null;
    const input = element("input", {
      type: "checkbox",
      role: "switch",
      "data-key": key,
      title: "On or off",
      "aria-label": `${this.about.one} ${index + 1} on or off`,
      change: () => this.store.edit([{ key, value: input.checked }], new_step()),
    });
    return {
      element: input,
      update: () => {
        input.checked = this.store.value(key) !== false;
        input.closest("details").classList.toggle("off", !input.checked);
      },
    };
  }
}
