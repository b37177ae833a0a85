// Other states of the scene: the steps of undo as a list, what was saved, and versions that are kept; each with its picture.
import { api } from "./api.js";
import { differences, named, panel_of } from "./differences.js";
import { by_id, element } from "./dom.js";
import { panels } from "./panels_table.js";

const small_px = 120;
const max_steps = 200;
const max_kept = 6;
const before_px = 1000;

function small(canvas) {
  const made = element("canvas", { width: small_px, height: Math.round((small_px * canvas.height) / canvas.width), "aria-hidden": "true" });
  made.getContext("2d").drawImage(canvas, 0, 0, made.width, made.height);
  return made;
}
const is_view = (key) => key.startsWith("camera.") || key.startsWith("output.");

// A list that a button opens below itself.
function popover(opener, fill) {
  const box = by_id(opener.getAttribute("popovertarget"));
  box.addEventListener("beforetoggle", (event) => {
    if (event.newState !== "open") return;
    fill();
    const at = opener.getBoundingClientRect();
    box.style.top = `${at.bottom + 4}px`;
    box.style.left = `${Math.max(8, Math.min(at.left, document.documentElement.clientWidth - 508))}px`;
  });
  box.addEventListener("toggle", (event) => {
    if (event.newState === "open") (box.querySelector("[aria-current]") ?? box.querySelector("button, input"))?.focus();
  });
  // Arrow keys go from state to state.
  box.addEventListener("keydown", (event) => {
    const by = { ArrowUp: "previousElementSibling", ArrowDown: "nextElementSibling" }[event.key];
    if (!by || event.target.matches("select")) return;
    event.preventDefault();
    event.target.closest("li")?.[by]?.querySelector("button, input").focus();
  });
  return box;
}

// The steps of undo. Each is one change with its name; the program keeps their texts, the page their names and pictures.
export class Steps {
  constructor(store, status, picture, ladder) {
    Object.assign(this, { store, status, picture, ladder, at: 0, base: null, step: "" });
    this.list = [{ name: "As opened", text: store.state.text }];
    store.on("changed", (detail) => this.follow(detail));
    this.box = popover(by_id("history-open"), () => this.fill());
    store.on("state", () => this.box.matches(":popover-open") && this.fill());
    by_id("revert").addEventListener("click", () => store.act(() => api.act("revert"), { name: "Back to what was saved" }));
  }
  // The picture of a state, if it is drawn.
  capture(revision) {
    if (this.ladder.reached?.revision === revision) this.list[this.at].picture = small(this.picture.canvas);
  }
  follow({ before, state, cause }) {
    const { text } = state;
    if (cause.outside) return this.begin("Changed elsewhere", text);
    if (cause.by) {
      this.capture(before.revision);
      this.at += cause.by;
      this.step = "";
      if (this.at < 0) this.at = this.list.unshift({ name: "Earlier", text }) * 0;
      this.list[this.at] ??= { name: "Later", text };
      if (this.list[this.at].text !== text) this.begin("Changed elsewhere", text);
      return;
    }
    // As in the program, changes of one step are one entry.
    if (cause.step && cause.step === this.step) return Object.assign(this.list[this.at], { name: named(this.base, state.values), text, picture: null });
    this.capture(before.revision);
    this.step = cause.step ?? "";
    this.base = before.values;
    this.list.splice(++this.at, Infinity, { name: cause.name ?? named(before.values, state.values), text });
    if (this.list.length <= max_steps) return;
    this.list.shift();
    --this.at;
  }
  begin(name, text) {
    Object.assign(this, { list: [{ name, text }], at: 0, step: "" });
  }
  // Goes to a state by steps of undo or redo; only the last is drawn.
  async go(to) {
    const by = to - this.at;
    if (by === 0) return;
    const walk = async () => {
      let state;
      for (let k = 0; k < Math.abs(by); ++k) state = await api.act(by < 0 ? "undo" : "redo");
      return state;
    };
    if (await this.store.act(walk, { by })) this.status.say(`${this.list[this.at].name}. ${by < 0 ? "Redo goes forward again." : ""}`);
  }
  fill() {
    this.capture(this.store.state.revision);
    by_id("revert").disabled = this.store.state.saved;
    const row = ({ name, picture }, index) =>
      element(
        "li",
        { class: index > this.at ? "undone" : "" },
        element(
          "button",
          { type: "button", "aria-current": index === this.at ? "step" : null, click: () => this.go(index) },
          picture ?? element("canvas", { width: 1, height: 1, "aria-hidden": "true" }),
          element("span", {}, name),
        ),
      );
    const focused = this.box.contains(document.activeElement);
    by_id("history-list").replaceChildren(...this.list.map(row).reverse());
    if (focused) this.box.querySelector("[aria-current]").focus();
  }
}

// What was saved, over the picture while a key or button is held.
export class Before {
  constructor(store, status, picture, ladder) {
    Object.assign(this, { store, status, picture, ladder, saved: null, held: false });
    this.canvas = by_id("before");
    this.remember();
    store.on("state", () => this.remember());
    store.on("changed", ({ before }) => this.capture(before));
    document.addEventListener("keyup", (event) => event.key.toLowerCase() === "b" && this.hide());
    window.addEventListener("blur", () => this.hide());
    const button = by_id("show-before");
    button.addEventListener("pointerdown", () => this.show());
    for (const kind of ["pointerup", "pointercancel", "pointerleave"]) button.addEventListener(kind, () => this.hide());
    for (const [kind, does] of [["keydown", "show"], ["keyup", "hide"]])
      button.addEventListener(kind, ({ key }) => (key === " " || key === "Enter") && this[does]());
  }
  remember() {
    const { saved, text, values } = this.store.state;
    if (saved && this.saved?.text !== text) this.saved = { text, values, canvas: null };
  }
  // The complete picture of the saved text, before another one is drawn over it.
  capture({ text, revision }) {
    if (text !== this.saved?.text || !this.ladder.complete || this.ladder.reached?.revision !== revision) return;
    const { canvas } = this.picture;
    this.saved.canvas = element("canvas", { width: canvas.width, height: canvas.height });
    this.saved.canvas.getContext("2d").drawImage(canvas, 0, 0);
  }
  async show() {
    if (this.held) return;
    const { store, saved, status } = this;
    if (store.state.saved) return status.say("This is what is saved.");
    if (!saved) return status.say("What is saved is shown once you have saved here.");
    this.held = true;
    const changes = differences(store.state.values, saved.values, store);
    if (saved.canvas && !changes.some(({ key }) => is_view(key))) return this.lay(saved.canvas);
    // Another view has no picture of the saved state yet.
    status.say("What is saved is being drawn for this view …");
    this.asked = new AbortController();
    try {
      const blob = await store.thumbnails.picture(changes.filter(({ key }) => !is_view(key)), before_px, this.asked.signal);
      if (blob && this.held) this.lay(await createImageBitmap(blob));
    } catch (error) {
      if (error.name !== "AbortError") status.say("The picture was being drawn: hold it again.");
    }
  }
  lay(image) {
    Object.assign(this.canvas, { width: image.width, height: image.height });
    this.canvas.getContext("2d").drawImage(image, 0, 0);
    this.canvas.hidden = !this.held;
    if (this.held) this.status.say("As saved");
  }
  hide() {
    this.held = false;
    this.asked?.abort();
    this.canvas.hidden = true;
  }
}

// Up to six kept versions. One of them is chosen: compared with, returned to.
export class Versions {
  constructor(store, status, picture) {
    Object.assign(this, { store, status, picture, kept: [], count: 0, chosen: null });
    this.box = popover(by_id("versions-open"), () => this.fill());
    by_id("keep").addEventListener("click", () => this.keep());
    by_id("compare").addEventListener("click", () => this.compare());
    by_id("to-kept").addEventListener("click", () => this.to_kept());
  }
  keep() {
    if (this.kept.length >= max_kept) {
      this.status.say(`${max_kept} versions are kept: remove one of them under Versions.`);
      return this.box.showPopover();
    }
    const { canvas } = this.picture;
    const { text, values } = this.store.state;
    const last = this.kept.at(-1);
    const what = last?.values ? named(last.values, values) : "as it was";
    const name = `${++this.count}: ${last && last.text === text ? "the same" : what}`;
    // A picture of full size is some MB as JPEG, ten times that on a canvas.
    const picture = new Promise((resolve) => canvas.toBlob(resolve, "image/jpeg", 0.95));
    this.picture.keep();
    this.kept.push({ name, text, values, small: small(canvas), picture });
    this.choose(this.kept.at(-1));
    this.status.say("Kept. C compares with it.");
  }
  // The version that was kept last before the page was loaded again.
  async restore() {
    if (!(await this.picture.restore().catch(() => false))) return;
    const { kept, kept_text } = this.picture;
    const picture = new Promise((resolve) => kept.toBlob(resolve, "image/jpeg", 0.95));
    const { text, values } = this.store.state;
    this.kept.push({ name: `${++this.count}: kept before`, text: kept_text, values: kept_text === text ? values : null, small: small(kept), picture });
    this.choose(this.kept.at(-1));
  }
  choose(version) {
    this.chosen = version;
    by_id("compare").disabled = by_id("to-kept").disabled = !version;
    by_id("versions-count").textContent = this.kept.length > 0 ? `${this.kept.length} ▾` : "▾";
    by_id("versions-open").disabled = this.kept.length === 0;
    by_id("kept-name").textContent = version?.name ?? "";
    if (!version) this.show(false);
    if (this.box.matches(":popover-open")) this.fill();
  }
  show(on) {
    const shows = this.picture.compare(on);
    by_id("compare").setAttribute("aria-pressed", String(shows));
    if (shows) this.picture.border.focus();
  }
  compare() {
    if (this.chosen) this.show(!this.picture.comparing());
  }
  async compare_with(version) {
    this.box.hidePopover();
    this.choose(version);
    const bitmap = await createImageBitmap(await version.picture);
    if (this.chosen !== version) return;
    Object.assign(this.picture.kept, { width: bitmap.width, height: bitmap.height });
    this.picture.kept.getContext("2d").drawImage(bitmap, 0, 0);
    bitmap.close();
    this.picture.kept_text = version.text;
    this.show(true);
  }
  to_kept(version = this.chosen) {
    if (version) this.store.act(() => api.text(version.text), { name: `Return to ${version.name}` });
  }
  // The keys of one panel, and what the scene has of them beside the version goes.
  copy(version, panel) {
    const changes = differences(this.store.state.values, version.values, this.store).filter(({ key }) => panel_of(key) === panel);
    if (changes.length === 0) return this.status.say(`${panel.label}: there is no difference.`);
    this.store.locks.edit(changes, `${panel.label} of ${version.name} copied. Ctrl-Z goes back.`);
  }
  remove(version) {
    this.kept = this.kept.filter((each) => each !== version);
    this.choose(this.chosen === version ? null : this.chosen);
    if (this.kept.length === 0) this.box.hidePopover();
  }
  fill() {
    const button = (text, does, title) => element("button", { type: "button", click: does, title }, text);
    by_id("versions-list").replaceChildren(
      ...this.kept.map((version) => {
        const name = element("input", { type: "text", "aria-label": "Name of the version", value: version.name });
        name.addEventListener("change", () => {
          version.name = name.value || version.name;
          this.choose(this.chosen);
        });
        const copy = element("select", { "aria-label": `Copy from ${version.name}` }, element("option", { value: "" }, "Copy from it …"));
        for (const { id, label } of panels) copy.append(element("option", { value: id }, label));
        copy.addEventListener("change", () => {
          this.copy(version, panels.find(({ id }) => id === copy.value));
          copy.value = "";
        });
        return element(
          "li",
          { class: version === this.chosen ? "chosen" : "" },
          version.small,
          name,
          element(
            "span",
            { class: "tools" },
            button("Compare", () => this.compare_with(version)),
            button("Return to it", () => this.to_kept(version)),
            version.values && copy,
            element("button", { type: "button", class: "remove", "aria-label": `Remove ${version.name}`, click: () => this.remove(version) }, "×"),
          ),
        );
      }),
    );
  }
}
