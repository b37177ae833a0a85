// The equalizer: one upright slider for each band of landforms, near and far, for slopes, ridges and valleys.
import { clamp, element, rounded } from "./dom.js";
import { new_step } from "./store.js";

const sets = [
  { id: "", label: "All ground", min: 0, max: 3 },
  { id: "_ridges", label: "Ridges", min: -2, max: 3 },
  { id: "_valleys", label: "Valleys", min: -2, max: 3 },
];
const sides = [
  { id: "foreground", label: "Near" },
  { id: "background", label: "Far" },
];

export class Equalizer {
  constructor(store) {
    this.store = store;
    this.set = sets[0];
    this.linked = false;
    this.bands = 0;
    this.halved = 0; // so many of the finest bands are not in the picture shown
    this.sliders = [];
    store.on("level", (halved) => {
      this.halved = halved;
      this.update();
    });
    this.preset = element("select", { id: "equalizer-preset", change: () => this.choose_preset() });
    for (const word of store.describe("generalize.preset")?.enum ?? [])
      this.preset.append(element("option", { value: word }, word.replaceAll("_", " ") || "none"));
    this.tabs = element(
      "div",
      { class: "segments", role: "group", "aria-label": "Weights of" },
      ...sets.map((set) =>
        element(
          "button",
          {
            type: "button",
            "aria-pressed": "false",
            click: () => {
              this.set = set;
              this.bands = 0;
              this.update();
            },
          },
          set.label,
        ),
      ),
    );
    this.box = element("div", { class: "bands" });
    const link = element("input", {
      type: "checkbox",
      id: "equalizer-link",
      change: () => {
        this.linked = link.checked;
      },
    });
    this.fault = element("p", { class: "fault", hidden: true });
    this.element = element(
      "div",
      { class: "equalizer" },
      element(
        "div",
        { class: "row choice" },
        element("label", { for: "equalizer-preset" }, "Preset"),
        element("span", { class: "tools" }),
        this.preset,
      ),
      this.tabs,
      this.box,
      element("p", { class: "axis" }, element("span", {}, "largest forms"), element("span", {}, "smallest")),
      element("div", { class: "row switch" }, element("label", { for: link.id }, "Near and far together"), link),
      element(
        "div",
        { class: "tools" },
        element("button", { type: "button", click: () => this.add(1) }, "One band more"),
        element("button", { type: "button", click: () => this.add(-1) }, "One less"),
        element("button", { type: "button", click: () => this.flat() }, "All to neutral"),
      ),
    );
    this.element.dataset.key = "generalize.foreground";
    this.element.append(this.fault);
  }
  focus() {
    this.sliders[0]?.slider.focus();
  }

  key(side, set = this.set) {
    return `generalize.${side}${set.id}`;
  }
  neutral(set = this.set) {
    return set.id === "" ? 1 : 0;
  }
  weights(side, set = this.set) {
    const bands = (this.store.value("generalize.foreground") ?? [1, 1, 1, 1, 1, 1]).length;
    const found =
      this.store.value(this.key(side, set)) ?? (side === "background" ? this.store.value(this.key("foreground", set)) : undefined);
    return Array.from({ length: bands }, (_, band) => found?.[band] ?? this.neutral(set));
  }

  update() {
    const bands = this.weights("foreground").length;
    if (bands !== this.bands) this.build(bands);
    this.preset.value = this.store.value("generalize.preset") ?? "";
    for (const each of this.sliders) {
      const value = this.weights(each.side)[each.band];
      if (document.activeElement !== each.field || Number(each.field.value) !== value) each.field.value = rounded(value, 0.01);
      each.slider.value = value;
      each.slider.setAttribute("aria-valuetext", String(rounded(value, 0.01)));
      const shown = each.band < bands - this.halved;
      each.slider.parentElement.classList.toggle("beyond", !shown);
      each.slider.title = shown ? each.name : `${each.name}: too small for this preview, shown once the picture is drawn as rendered`;
    }
    Array.from(this.tabs.children).forEach((tab, k) => tab.setAttribute("aria-pressed", String(sets[k] === this.set)));
  }

  build(bands) {
    this.bands = bands;
    this.sliders = [];
    this.box.replaceChildren();
    for (const { id: side, label } of sides) {
      const group = element("div", { class: "side", role: "group", "aria-label": label }, element("span", { class: "name" }, label));
      for (let band = 0; band < bands; ++band) {
        const name = `${label}, ${this.set.label.toLowerCase()}, band ${band + 1}${band === 0 ? ", the largest landforms" : band === bands - 1 ? ", the smallest" : ""}`;
        const slider = element("input", {
          type: "range",
          min: this.set.min,
          max: this.set.max,
          step: 0.05,
          "aria-label": name,
          title: name,
          "aria-orientation": "vertical",
        });
        const field = element("input", {
          type: "number",
          min: this.set.id === "" ? 0 : -5,
          max: 5,
          step: 0.05,
          "aria-label": `${name}, number`,
        });
        let step = null;
        slider.addEventListener("input", () => this.change(side, band, Number(slider.value), (step ??= new_step())));
        slider.addEventListener("change", () => {
          step = null;
        });
        slider.addEventListener("dblclick", () => this.change(side, band, this.neutral(), new_step()));
        field.addEventListener("change", () => {
          if (field.value !== "") this.change(side, band, clamp(Number(field.value), Number(field.min), 5), new_step());
        });
        this.sliders.push({ side, band, name, slider, field });
        group.append(
          element("div", { class: "band" }, slider, field, element("span", { class: "unit", "aria-hidden": "true" }, String(band + 1))),
        );
      }
      this.box.append(group);
    }
  }

  change(side, band, value, step) {
    const changes = [];
    for (const { id } of sides)
      if (id === side || this.linked) {
        const all = this.weights(id);
        all[band] = value;
        changes.push({ key: this.key(id), value: all });
      }
    // Far weights that the scene does not give follow the near ones: what is moved on one side must leave the other.
    const [near, far] = sides.map(({ id }) => this.weights(id));
    if (side === "foreground" && !this.linked && near.join() === far.join()) changes.push({ key: this.key("background"), value: far });
    this.store.edit(changes, step);
  }
  // Each set that the scene has gets the new number of bands. Bands count from the finest, which is the last: one more of neutral weight
  // in front changes no ground.
  add(by) {
    const bands = clamp(this.weights("foreground").length + by, 1, 12);
    const changes = [];
    for (const set of sets)
      for (const { id } of sides)
        if (set.id === "" || this.store.value(this.key(id, set)) !== undefined) {
          const all = this.weights(id, set);
          changes.push({ key: this.key(id, set), value: by > 0 ? [...Array(bands - all.length).fill(this.neutral(set)), ...all] : all.slice(-bands) });
        }
    this.store.edit(changes, new_step());
  }
  flat() {
    const bands = this.weights("foreground").length;
    this.store.edit(
      sides.map(({ id }) => ({ key: this.key(id), value: Array(bands).fill(this.neutral()) })),
      new_step(),
    );
  }
  // A preset's weights count where the scene gives none beside it.
  choose_preset() {
    const away = sets.flatMap((set) => sides.map(({ id }) => this.key(id, set))).filter((key) => this.store.given(key));
    const change = this.preset.value ? { key: "generalize.preset", value: this.preset.value } : { key: "generalize.preset", remove: true };
    this.store.edit([...away.map((key) => ({ key, remove: true })), change], new_step());
  }
}
