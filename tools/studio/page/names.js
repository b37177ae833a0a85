// Names over the picture, as the print has them: drawn by the program as SVG, moved here by hand. What is dragged, hidden or changed becomes
// a block [[labels.by_hand]] of the scene; the program places the other names around it.
import { api } from "./api.js";
import { by_id, draggable, drawing, element } from "./dom.js";
import { new_step, running_step } from "./store.js";

const click_px = 3; // a pointer that moves less has chosen the name

export class Names {
  constructor(store) {
    this.store = store;
    this.layer = by_id("names");
    this.tools = by_id("name-tools");
    this.sheet = null; // the last answer of api/names
    this.revision = null;
    this.chosen = null; // the name that the tools are about
    this.on = true;
    by_id("show-names").addEventListener("click", () => this.show(!this.on));
    store.on("changed", ({ before, state }) => this.age(before.values, state.values));
    this.rank = element("select", { "aria-label": "Rank", title: "Rank, 1 the most important", change: () => this.change({ rank: Number(this.rank.value) }) });
    this.rank.append(...Array.from({ length: 9 }, (_, index) => element("option", { value: index + 1 }, `Rank ${index + 1}`)));
    this.kind = element("select", { "aria-label": "Kind", change: () => this.change({ kind: this.kind.value }) });
    const button = (label, title, click) => element("button", { type: "button", title, click }, label);
    this.title = element("b");
    this.tools.append(
      this.title,
      this.rank,
      this.kind,
      button("Hide", "Leave this name out (Delete)", () => this.change({ hidden: true })),
      button("Automatic", "Let the program place it again", () => this.release()),
    );
  }

  show(on) {
    this.on = on;
    by_id("show-names").setAttribute("aria-pressed", String(on));
    this.draw();
  }

  // Names of another ground or view would stand beside their summits: they are pale until new ones are there.
  age(before, now) {
    const stays = /^(sun|light|air|sky|palette|style|water|season|seed|synthesis|title|labels\.by_hand)\b/;
    const keys = new Set([...Object.keys(before), ...Object.keys(now)]);
    for (const key of keys)
      if (!stays.test(key) && JSON.stringify(before[key]) !== JSON.stringify(now[key])) return this.layer.classList.add("old");
  }

  // After each picture but the first, quick one.
  async read(revision) {
    try {
      const sheet = await api.names(revision);
      if (revision !== this.store.state.revision || this.held) return;
      Object.assign(this, { sheet, revision });
      this.draw();
      this.store.tell("names", sheet);
    } catch (error) {
      if (error.status !== 409) this.store.fail(error);
    }
  }

  draw() {
    const { sheet } = this;
    const names = sheet?.names ?? [];
    by_id("show-names").hidden = names.length === 0 && !sheet?.tracks;
    this.layer.classList.remove("old");
    this.layer.toggleAttribute("hidden", !this.on || !sheet?.width);
    if (!sheet?.width) return this.choose(null);
    const focused = this.layer.contains(document.activeElement) && document.activeElement.dataset.name;
    this.layer.setAttribute("viewBox", `0 0 ${sheet.width} ${sheet.height}`);
    const tracks = drawing("g", { class: "tracks" });
    tracks.innerHTML = sheet.tracks;
    this.layer.replaceChildren(tracks, ...names.filter((name) => name.placed).map((name) => this.name(name)));
    if (focused) Array.from(this.layer.querySelectorAll(".name")).find((each) => each.dataset.name === focused)?.focus();
    const again = this.chosen && names.find((name) => name.name === this.chosen.name && name.placed);
    this.choose(again ?? null);
  }

  // One name with its mark and leader; what has no name, as the altitude of an unnamed summit, stays where it is.
  name(name) {
    const [left, top, right, bottom] = name.box;
    const made = drawing("g", { class: "name" });
    made.innerHTML = name.svg;
    if (!name.name) return made;
    made.append(drawing("rect", { class: "hold", x: left, y: top, width: right - left, height: bottom - top }));
    made.setAttribute("tabindex", 0);
    made.setAttribute("role", "button");
    made.setAttribute("aria-label", `${name.name}, ${name.kind}; arrow keys move it, Delete hides it`);
    made.dataset.name = name.name;
    const by = (event, from) => {
      const scale = this.sheet.width / this.layer.getBoundingClientRect().width;
      return [(event.clientX - from[0]) * scale, (event.clientY - from[1]) * scale];
    };
    draggable(made, {
      start: (event) => {
        made.focus();
        this.held = true;
        return [event.clientX, event.clientY];
      },
      move: (event, from) => made.setAttribute("transform", `translate(${by(event, from).join()})`),
      end: (event, from) => {
        this.held = false;
        if (event.type === "pointerup" && Math.hypot(event.clientX - from[0], event.clientY - from[1]) >= click_px)
          return this.move(name, by(event, from), new_step());
        made.removeAttribute("transform");
      },
    });
    made.addEventListener("focus", () => this.choose(name));
    made.addEventListener("keydown", (event) => this.key(event, name));
    return made;
  }
  key(event, name) {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!by && event.key !== "Delete") return;
    if (event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key === "Delete") return this.change({ hidden: true });
    const px = (event.shiftKey ? 5 : 1) * this.sheet.px_per_mm;
    this.move(name, [by[0] * px, by[1] * px], running_step(`name-${name.name}`));
  }

  // Millimetres from the mark to the foot of the name; along a line its shift.
  move(name, [dx, dy], step) {
    const [left, , right, bottom] = name.box;
    const from = name.along ? (name.by_hand ?? [0, 0]).map((mm) => mm * this.sheet.px_per_mm) : [(left + right) / 2 - name.mark[0], bottom - name.mark[1]];
    const mm = (px) => Math.round((10 * px) / this.sheet.px_per_mm) / 10;
    // Until the program has placed it, further moves begin from here.
    name.box = [left + dx, name.box[1] + dy, right + dx, bottom + dy];
    name.by_hand = [mm(from[0] + dx), mm(from[1] + dy)];
    this.change({ dx_mm: name.by_hand[0], dy_mm: name.by_hand[1] }, name, step);
  }
  change(values, name = this.chosen, step = new_step()) {
    const index = this.index_of(name);
    if (index < 0) return this.store.edit([{ key: "labels.by_hand", append: { name: name.name, ...values } }], step);
    return this.store.edit(
      Object.entries(values).map(([key, value]) => ({ key: `labels.by_hand.${index}.${key}`, value })),
      step,
    );
  }
  index_of(name) {
    return Array.from({ length: this.store.count("labels.by_hand") }, (_, index) => index).findIndex(
      (index) => this.store.value(`labels.by_hand.${index}.name`) === name.name,
    );
  }
  release() {
    const index = this.index_of(this.chosen);
    if (index >= 0) this.store.edit([{ key: `labels.by_hand.${index}`, remove: true }], new_step());
  }

  choose(name) {
    this.chosen = name;
    this.tools.hidden = !name || !this.on;
    for (const each of this.layer.querySelectorAll(".name")) each.classList.toggle("chosen", Boolean(name) && each.dataset.name === name.name);
    if (!name) return;
    this.title.textContent = name.name;
    this.rank.value = Math.round(name.rank);
    if (this.kind.options.length !== this.sheet.kinds.length)
      this.kind.replaceChildren(...this.sheet.kinds.map((kind) => element("option", { value: kind }, kind.replaceAll("_", " "))));
    this.kind.value = name.kind;
    this.tools.lastChild.disabled = this.index_of(name) < 0;
  }
}
