// The equalizer: for each band of landforms, by their width in metres, two upright sliders over one axis, near and far, joined by two
// curves; for all ground, ridges and valleys. The band in hand is tinted in the picture (forms.js).
import { row } from "./controls.js";
import { clamp, drawing, element, rounded } from "./dom.js";
import { presets } from "./looks.js";
import { new_step } from "./store.js";

const sets = [
  {
    id: "",
    label: "All ground",
    of: "forms",
    sign: 0,
    min: 0,
    max: 3,
    says: "1 keeps forms of this width, 0 removes them, more exaggerates them.",
  },
  {
    id: "_ridges",
    label: "Ridges",
    of: "ridges",
    sign: 1,
    min: -2,
    max: 3,
    says: "Added along ridges of this width: more than 0 sharpens them, less rounds them off.",
  },
  {
    id: "_valleys",
    label: "Valleys",
    of: "valleys",
    sign: -1,
    min: -2,
    max: 3,
    says: "Added along valleys of this width: more than 0 cuts them deeper, less fills them.",
  },
];
const sides = [
  { id: "foreground", label: "Near" },
  { id: "background", label: "Far" },
];
const track = { height: 108, thumb: 14 }; // px of an upright slider, as in studio.css

// The widths of the forms of a band, m, from one side of a ridge or valley to the other: half the distance between crests. The finest band,
// the last, passes distances between crests of 3.6 to 7.2 cells by more than half (the kernel of base/pyramid.h), so widths of about two
// to four cells; each band before it twice these.
export function band_widths(cell_m, bands, band) {
  const from = 2 * cell_m * 2 ** (bands - 1 - band);
  return [from, 2 * from];
}
export function width_words([from, to]) {
  if (to < 1000) return `${rounded(from, from < 10 ? 0.1 : 1)}–${rounded(to, to < 10 ? 0.1 : 1)} m`;
  const km = (value) => rounded(value / 1000, value < 10000 ? 0.1 : 1);
  return from < 600 ? `${Math.round(from)}–${Math.round(to)} m` : `${km(from)}–${km(to)} km`;
}

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
    this.preset = row(store, { key: "generalize.preset", label: "Presets", kind: "gallery", looks: presets, lock: true });
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
    this.says = element("p", { class: "none" });
    this.box = element("div", { class: "bands" });
    this.curves = drawing("svg", { class: "curves", preserveAspectRatio: "none", "aria-hidden": "true" });
    this.curves.append(...["neutral", "background", "foreground"].map((name) => drawing("path", { class: name })));
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
      this.preset.element,
      this.tabs,
      this.says,
      this.box,
      element(
        "p",
        { class: "axis" },
        element("span", { class: "foreground" }, "● near"),
        element("span", { class: "background" }, "● far"),
        element("span", { class: "neutral" }, "┄ neutral"),
        element("span", {}, "width of forms"),
      ),
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
    if (bands !== this.bands || this.cell_m !== this.store.map?.cell_m) this.build(bands);
    this.says.textContent = this.set.says;
    this.draw_curves(bands);
    this.preset.update();
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
    this.cell_m = this.store.map?.cell_m;
    this.sliders = [];
    this.curves.setAttribute("viewBox", `0 0 ${bands} ${track.height}`);
    const columns = element("div", { class: "columns" }, this.curves);
    this.box.replaceChildren(columns);
    for (let band = 0; band < bands; ++band) {
      const widths = this.cell_m ? band_widths(this.cell_m, bands, band) : null;
      const words = widths ? width_words(widths) : `band ${band + 1}`;
      const pair = sides.map(({ id, label }) => this.slider(id, label, band, widths, words));
      const [from, to] = widths ? words.split(/(?<=–)/) : [String(band + 1), ""];
      columns.append(
        element(
          "div",
          { class: "column" },
          element("div", { class: "pair" }, ...pair),
          element("span", { class: "unit", "aria-hidden": "true" }, from, element("br"), to),
        ),
      );
    }
  }
  slider(side, label, band, widths, words) {
    const name = `${label}, ${this.set.of} ${widths ? `${words.replace("–", " to ")} wide` : `of ${words}`}`;
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
    // The band pointed at, else the one with the focus.
    const tint = (by, on) => () => {
      this[by] = on && widths ? { from: widths[0], to: widths[1], side, sign: this.set.sign } : null;
      this.store.tell("band", this.pointed ?? this.focused ?? null);
    };
    const listeners = {
      pointerenter: tint("pointed", true),
      pointerleave: tint("pointed", false),
      focusin: tint("focused", true),
      focusout: tint("focused", false),
    };
    return element("div", { class: `band ${side}`, ...listeners }, slider, field);
  }
  // Through the thumbs of the sliders, which stand at a quarter and at three quarters of their column.
  draw_curves(bands) {
    const { min, max } = this.set;
    const y = (value) => track.thumb / 2 + (track.height - track.thumb) * (1 - clamp((value - min) / (max - min), 0, 1));
    const line = (side, at) =>
      this.weights(side)
        .map((value, band) => `${band + at},${y(value).toFixed(1)}`)
        .join("L");
    const [neutral, far, near] = this.curves.children;
    neutral.setAttribute("d", `M0,${y(this.neutral())}H${bands}`);
    far.setAttribute("d", `M${line("background", 0.75)}`);
    near.setAttribute("d", `M${line("foreground", 0.25)}`);
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
          changes.push({
            key: this.key(id, set),
            value: by > 0 ? [...Array(bands - all.length).fill(this.neutral(set)), ...all] : all.slice(-bands),
          });
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
}
