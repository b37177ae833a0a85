// The sheet in print: its paper format, what its resolution means, and the paper with margin and bleed around the picture.
import { by_id, clamp, element, rounded } from "./dom.js";
import { new_step } from "./store.js";

const formats = { A4: [297, 210], A3: [420, 297], A2: [594, 420], A1: [841, 594], A0: [1189, 841] }; // mm, landscape
const inch = 25.4; // mm
const max_px = 65535;
const strip_share = 0.06; // height of the strip with title and legend below the picture, in its widths; the program sets it by its content
const spaced = (number) => String(Math.round(number)).replace(/\B(?=(\d{3})+$)/g, "\u202f");

// {width, height: px, mm, dpi, margin, strip: mm} of the scene.
export function print_of(store) {
  const [width, height, mm] = ["output.width", "output.height", "output.sheet_width_mm"].map((key) => store.number(key));
  // Only a scene that has a margin at all has a picture with paper around it.
  const has = /^\s*(\[margin\]|margin\.\w+\s*=)/m.test(store.state.text) || store.given("margin.frame_mm");
  return { width, height, mm, dpi: (inch * width) / mm, margin: has ? store.number("margin.frame_mm") : 0, strip: has ? strip_share : 0 };
}

// What a resolution means for who looks at the print.
export function judged({ width, mm, dpi }) {
  const told = `${Math.round(dpi)} dpi on ${spaced(mm)} mm`;
  const full = Math.round((300 * mm) / inch);
  if (dpi >= 250) return `${told}: sharp at reading distance.`;
  const need = full > max_px ? `300 dpi would need ${spaced(full)} px, more than a picture can have` : `300 dpi need ${spaced(full)} px`;
  if (dpi >= 120) return `${told}: good on a wall, soft at reading distance; ${need}.`;
  return `${told}: letters and strokes will look coarse; ${need}.`;
}

// The largest picture of a shape on a paper, {mm, ratio}; without `keep` its height follows the paper.
export function fitted([paper_width, paper_height], { width, height, margin, strip }, keep) {
  const [w, h] = [paper_width - 2 * margin, paper_height - 2 * margin];
  const ratio = keep ? height / width : h / w - strip;
  return { mm: rounded(Math.min(w, h / (ratio + strip)), 0.1), ratio };
}
const fits = (paper, print) => Math.abs(fitted(paper, print, true).mm - print.mm) < 0.6;
const paper_of = (format, upright) => (upright ? [...formats[format]].reverse() : formats[format]);

// The format whose largest picture this one is, {format, upright}, or null.
export function format_of(print) {
  for (const upright of [print.height > print.width, print.height <= print.width])
    for (const format of Object.keys(formats)) if (fits(paper_of(format, upright), print)) return { format, upright };
  return null;
}

export class Sheet {
  constructor(store) {
    this.store = store;
    this.upright = false;
    this.format = element("select", { id: "sheet-format", change: () => this.choose() });
    for (const name of ["", ...Object.keys(formats)]) this.format.append(element("option", { value: name }, name || "free"));
    const turn = (upright, label) =>
      element("button", { type: "button", "aria-pressed": "false", click: () => this.choose((this.upright = upright)) }, label);
    this.turns = element(
      "div",
      { class: "segments", role: "group", "aria-label": "Sheet" },
      turn(false, "Landscape"),
      turn(true, "Portrait"),
    );
    this.keep = element("input", { type: "checkbox", id: "sheet-keep", checked: true });
    this.judged = element("p", { id: "sheet-dpi", role: "status" });
    this.better = element("button", { type: "button", class: "wide", click: () => this.pixels(300) }, "300 dpi");
    const press = (id, label, title) => element("button", { type: "button", class: "wide", title, click: () => by_id(id).click() }, label);
    this.element = element(
      "div",
      { class: "sheet" },
      row("Paper", this.format),
      this.turns,
      row("Keep the picture's shape", this.keep),
      this.judged,
      this.better,
      press("show-sheet", "Sheet around the picture", "Paper, margin and bleed (S)"),
      press("show-loupe", "1 : 1 loupe…", "A piece as it is printed (L)"),
    );
  }
  focus() {
    this.format.focus();
  }

  update() {
    const print = print_of(this.store);
    const known = format_of(print);
    // A paper that was chosen by hand is another one with the same width.
    const paper = this.chosen && fits(paper_of(this.chosen, this.upright), print);
    this.format.value = paper ? this.chosen : (known?.format ?? "");
    if (!paper && known) this.upright = known.upright;
    this.chosen = this.format.value;
    Array.from(this.turns.children).forEach((each, k) => {
      each.setAttribute("aria-pressed", String(Boolean(this.chosen) && this.upright === (k === 1)));
      each.disabled = !this.chosen;
    });
    this.judged.textContent = judged(print);
    this.judged.classList.toggle("note", print.dpi < 120);
    const full = Math.round((300 * print.mm) / inch);
    this.better.hidden = print.dpi >= 250 || full > max_px;
    this.better.textContent = `300 dpi: ${spaced(full)} × ${spaced((full * print.height) / print.width)} px`;
    this.store.tell("paper", this.chosen ? paper_of(this.chosen, this.upright) : null);
  }

  choose() {
    this.chosen = this.format.value;
    if (!this.chosen) return this.update();
    const print = print_of(this.store);
    const { mm, ratio } = fitted(paper_of(this.chosen, this.upright), print, this.keep.checked);
    const changes = [{ key: "output.sheet_width_mm", value: mm }];
    const height = clamp(Math.round(print.width * ratio), 16, max_px);
    if (height !== print.height) changes.push({ key: "output.height", value: height });
    this.store.edit(changes, new_step());
  }
  // As many pixels as a resolution needs, in the picture's shape.
  pixels(dpi) {
    const { width, height, mm } = print_of(this.store);
    const full = Math.round((dpi * mm) / inch);
    const changes = [
      ["width", full],
      ["height", Math.round((full * height) / width)],
    ];
    this.store.edit(
      changes.map(([name, value]) => ({ key: `output.${name}`, value: clamp(value, 16, max_px) })),
      new_step(),
    );
  }
}
const row = (label, control) =>
  element(
    "div",
    { class: control.type === "checkbox" ? "row switch" : "row choice" },
    element("label", { for: control.id }, label),
    control.type === "checkbox" ? null : element("span", { class: "tools" }),
    control,
  );

// The paper around the picture, and the line at which a press cuts.
export class Paper {
  constructor(store, picture) {
    Object.assign(this, { store, picture, size: null, on: false, bleed_mm: 3 });
    this.sheet = element("div", { id: "paper", hidden: true });
    this.trim = element("div", { id: "trim", hidden: true });
    this.bleed = element("input", { type: "number", id: "paper-bleed", min: 0, max: 20, step: 1, value: this.bleed_mm });
    this.says = element("span", { id: "paper-says" });
    const field = element("label", { title: "Not of the scene: belvedere pdf --bleed" }, "bleed ", this.bleed, " mm");
    this.line = element("p", { id: "paper-line", hidden: true }, this.says, field);
    by_id("frame").before(this.sheet);
    by_id("frame").after(this.trim, this.line);
    this.bleed.addEventListener("input", () => {
      this.bleed_mm = clamp(Number(this.bleed.value) || 0, 0, 20);
      this.draw();
    });
    store.on("paper", (size) => {
      this.size = size;
      this.draw();
    });
    for (const kind of ["state", "pending"]) store.on(kind, () => this.draw());
    store.on("fitted", (width) => this.place(width));
    by_id("show-sheet").addEventListener("click", () => this.show(!this.on));
  }
  show(on) {
    this.on = on;
    this.sheet.hidden = this.trim.hidden = this.line.hidden = !on;
    by_id("show-sheet").setAttribute("aria-pressed", String(on));
    if (on) this.draw();
    else if (this.picture.paper) {
      this.picture.paper = null;
      this.picture.fit();
    }
  }
  draw() {
    if (!this.on || !this.store.state) return;
    const print = print_of(this.store);
    const { mm, margin, strip } = print;
    const height = (mm * print.height) / print.width;
    const free = [mm + 2 * margin, height + 2 * margin + strip * mm];
    const known = format_of(print);
    const chosen = this.size && fits(this.size, print) ? this.size : null;
    const found = chosen ?? (known ? paper_of(known.format, known.upright) : free);
    const size = [Math.max(found[0], free[0]), Math.max(found[1], free[1])];
    const room = [(size[0] - mm) / 2, (size[1] - height - strip * mm) / 2];
    this.picture.paper = { left: room[0] / mm, top: room[1] / mm, width: size[0] / mm, height: size[1] / mm };
    const paper = `${spaced(size[0])} × ${spaced(size[1])} mm`;
    this.says.textContent = `${paper}; picture ${spaced(mm)} × ${spaced(height)} mm${margin > 0 ? `, margin ${margin} mm, title and legend below` : ""};`;
    this.print = print;
    this.picture.fit();
  }
  // In px of the page, for a picture of this width. A picture with paper around it is cut at the paper's edge, one without at its own.
  place(width) {
    const { paper } = this.picture;
    if (!this.on || !paper) return;
    Object.assign(this.sheet.style, { width: `${width * paper.width}px`, height: `${width * paper.height}px` });
    const cut = (2 * this.bleed_mm * width) / this.print.mm;
    const frame = by_id("frame");
    const of = this.print.margin > 0 ? this.sheet : frame;
    Object.assign(this.trim.style, {
      width: `${of.clientWidth - cut}px`,
      height: `${of.clientHeight - cut}px`,
      translate: of === frame ? frame.style.translate : "",
    });
    this.trim.hidden = this.bleed_mm === 0;
  }
}
