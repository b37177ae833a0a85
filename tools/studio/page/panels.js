// The panels beside the picture, made from their table: tabs, groups, rows, lists of blocks, and the editors.
import { Bend } from "./bend.js";
import { view } from "./camera.js";
import { row, show_fault } from "./controls.js";
import { by_id, element, rounded } from "./dom.js";
import { Equalizer } from "./equalizer.js";
import { Blocks } from "./lists.js";
import { recall, remember } from "./memory.js";
import { panels } from "./panels_table.js";
import { new_step } from "./store.js";
import { Sheet } from "./sheet.js";
import { Sun } from "./sun.js";
import { weights } from "./weights.js";

export class Panels {
  // beside: editors that are made elsewhere, by name.
  constructor(store, hands, beside = {}) {
    this.store = store;
    this.hands = hands;
    this.made = new Map(); // id: what is shown in it, each with element, update() and rows
    this.shown = null;
    this.editors = { sun: Sun, bend: Bend, equalizer: Equalizer, sheet: Sheet };
    this.actions = { target: () => hands.target(), angles: () => this.by_angles() };
    this.beside = beside;
    for (const { id, label, groups, more } of panels) {
      const parts = [];
      const box = element("div", { id: `panel-${id}`, role: "tabpanel", "aria-labelledby": `tab-${id}`, hidden: true });
      box.append(...groups.map((group) => this.section(parts, group)));
      if (more) {
        const own = parts.map((part) => part.more).filter(Boolean); // of editors
        box.append(this.folded(id, [...own, ...more.map((group) => this.section(parts, group))]));
      }
      this.made.set(id, parts);
      by_id("panels").append(box);
      this.tab(id, label);
    }
    for (const kind of ["state", "map", "pending"]) store.on(kind, () => this.update());
    store.on("fault", (fault) => this.fault(fault));
  }
  section(parts, group) {
    const { store, hands } = this;
    const section = element("section", {}, element("h3", {}, group.title));
    if (group.when)
      parts.push({
        element: section,
        update: () => {
          section.hidden = !group.when(store);
        },
      });
    for (const spec of group.rows ?? []) this.add(parts, section, row(store, spec));
    for (const { label: text, action, when } of group.actions ?? []) {
      const button = element("button", { type: "button", class: "wide", click: this.actions[action] }, text);
      this.add(parts, section, {
        element: button,
        update: () => {
          button.hidden = when ? !when(store) : false;
        },
      });
    }
    if (group.list) this.add(parts, section, new Blocks(store, hands, group.list));
    if (group.editor === "weights") for (const each of weights(store)) this.add(parts, section, each);
    else if (group.editor) this.add(parts, section, this.beside[group.editor] ?? new this.editors[group.editor](store));
    return section;
  }
  // What is not needed often; it is found open if it was left open.
  folded(id, sections) {
    const more = element("details", { class: "more" }, element("summary", {}, "More"), ...sections);
    more.open = recall(`more ${id}`) ?? false;
    more.addEventListener("toggle", () => remember(`more ${id}`, more.open));
    return more;
  }
  add(parts, section, part) {
    if (!part) return;
    parts.push(part);
    section.append(part.element);
  }

  // ---- tabs
  tab(id, label) {
    const tab = element(
      "button",
      {
        type: "button",
        role: "tab",
        id: `tab-${id}`,
        "aria-controls": `panel-${id}`,
        "aria-selected": "false",
        tabindex: -1,
        click: () => this.show(id),
      },
      label,
    );
    tab.addEventListener("keydown", (event) => {
      const tabs = Array.from(by_id("tabs").children);
      const at = tabs.indexOf(tab);
      const to = { ArrowDown: at + 1, ArrowUp: at - 1, ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      const next = tabs[(to + tabs.length) % tabs.length];
      next.click();
      next.focus();
    });
    by_id("tabs").append(tab);
  }
  show(id) {
    this.shown = id;
    document.body.dataset.panel = id;
    for (const tab of by_id("tabs").children) {
      const chosen = tab.id === `tab-${id}`;
      tab.setAttribute("aria-selected", String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      by_id(tab.getAttribute("aria-controls")).hidden = !chosen;
    }
    by_id("panels").scrollTop = 0;
    this.store.tell("panel", id);
    this.update();
  }
  // Only what is seen is kept up to date.
  update() {
    if (this.waiting || !this.store.state) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      for (const part of this.made.get(this.shown) ?? []) part.update();
    });
  }

  // ---- errors
  rows(id) {
    return this.made
      .get(id)
      .flatMap((part) => (part.rows ? part.rows() : [part]))
      .filter((part) => part.fault);
  }
  fault(fault) {
    if (!fault && !this.faulty) return; // with every change
    this.faulty = Boolean(fault);
    for (const id of this.made.keys()) {
      let here = false;
      for (const each of this.rows(id)) {
        const hit = fault?.key !== undefined && each.element.dataset.key === fault.key;
        show_fault(each, hit ? fault : null);
        here ||= hit;
      }
      by_id(`tab-${id}`).classList.toggle("faulty", here);
      if (here) fault.panel = id;
    }
  }
  // Goes to the control of a key; false if there is none.
  go(key) {
    for (const id of this.made.keys())
      for (const each of this.rows(id))
        if (each.element.dataset.key === key) {
          this.show(id);
          const folded = each.element.closest(".more");
          if (folded) folded.open = true;
          each.element.scrollIntoView({ block: "center" });
          each.focus();
          return true;
        }
    return false;
  }

  // The same view without a target, by angles.
  by_angles() {
    const from = view(this.store);
    const away = ["camera.look_at", "camera.look_at_lonlat", "camera.look_at_altitude_m"].filter(
      (key) => this.store.value(key) !== undefined,
    );
    this.store.edit(
      [...away.map((key) => ({ key, remove: true })), { key: "camera.azimuth_deg", value: rounded(from.azimuth, 0.01) }],
      new_step(),
    );
  }
}
