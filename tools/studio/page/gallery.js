// Choosing by looking: small pictures of this view, one for each choice, made while nobody waits for anything else. Names are there at
// once and work without the pictures.
import { api } from "./api.js";
import { by_id, clamp, element } from "./dom.js";

const width_px = 240; // of a picture
const kept_texts = 8; // so many scenes' pictures are kept, as they came: some kB each
const rest_ms = 250;
const again_ms = 1000; // after another picture came first

// The pictures: asked for one at a time when the last rung is complete and the hand rests, given up with the next change.
export class Thumbnails {
  constructor(store, ladder) {
    Object.assign(this, { store, ladder, asked: null, pressed: false, held: false });
    this.galleries = new Set();
    this.made = new Map(); // text of the scene: Map of changes as JSON to a picture; null is one that the program refused
    for (const kind of ["pending", "changed"]) store.on(kind, () => this.stop());
    for (const kind of ["drawn", "panel", "locks", "refused"]) store.on(kind, () => this.soon());
    by_id("panels").addEventListener("scroll", () => this.soon());
    const pressed = (is) => () => {
      this.pressed = is;
      if (is) this.stop();
      else this.soon();
    };
    // A list that the browser opens over the page may take the end of a press.
    document.addEventListener("pointermove", ({ buttons }) => this.pressed && buttons === 0 && pressed(false)());
    document.addEventListener("pointerdown", pressed(true), true);
    for (const kind of ["pointerup", "pointercancel"]) window.addEventListener(kind, pressed(false), true);
  }
  // Something else that is drawn comes first.
  hold(on) {
    this.held = on;
    if (on) this.stop();
    else this.soon();
  }
  stop() {
    clearTimeout(this.timer);
    this.asked?.abort();
  }
  soon(ms = rest_ms) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.next(), ms);
  }
  rests() {
    const { store, ladder } = this;
    return ladder.complete && !store.busy && store.queue.length === 0 && !this.pressed && !this.held && !document.hidden;
  }
  pictures() {
    const { text } = this.store.state;
    const found = this.made.get(text) ?? new Map();
    this.made.delete(text); // the newest stands last
    this.made.set(text, found);
    if (this.made.size > kept_texts) this.made.delete(this.made.keys().next().value);
    return found;
  }
  // The picture of the scene with changes, null if there is none to be had. 409: another one was asked for.
  async picture(changes, width, signal) {
    const made = this.pictures();
    const key = `${width}${JSON.stringify(changes)}`;
    if (!made.has(key)) {
      let blob = null;
      try {
        blob = await api.look(changes, width, signal);
      } catch (error) {
        if (error.name === "AbortError" || error.status === 409 || error.status === 0) throw error;
      }
      made.set(key, blob);
    }
    return made.get(key);
  }
  // What is there already; undefined if it has not been asked for.
  known(changes) {
    return this.made.get(this.store.state.text)?.get(`${width_px}${JSON.stringify(changes)}`);
  }
  async next() {
    if (this.asked || !this.rests()) return;
    const tile = [...this.galleries].flatMap((gallery) => gallery.unseen())[0];
    if (!tile) return;
    const asked = new AbortController();
    this.asked = asked;
    let wait = 0;
    try {
      await this.picture(tile.changes(), width_px, asked.signal);
    } catch {
      wait = again_ms;
    }
    this.asked = null;
    for (const gallery of this.galleries) gallery.show();
    this.soon(asked.signal.aborted ? rest_ms : wait);
  }
}

// One row of a panel: a grid of choices. looks: from the store; else the words of the key. bare: the title of the group is its label.
export function gallery_row(store, spec, about) {
  const grid = element("div", { class: "gallery", role: "radiogroup", "aria-label": spec.label });
  const words = spec.words?.(store) ?? about?.words ?? [];
  const of_word = (word) => ({
    name: word === "" ? "none" : String(word).replace(/^.*\/|\.\w+$/g, "").replaceAll("_", " "),
    changes: word === "" ? [{ key: spec.key, remove: true }] : [{ key: spec.key, value: word }],
    chosen: () => (store.value(spec.key) ?? about.default ?? "") === word,
  });
  const none = spec.none && !words.includes("") ? [""] : [];
  const tiles = [];
  const fill = () => {
    // A file of the user's own that the scene names stands with the others.
    const own = spec.looks ? [] : [store.value(spec.key) ?? ""].filter((word) => word !== "" && !words.includes(word));
    words.push(...own);
    const looks = spec.looks?.(store) ?? [...none, ...words].map(of_word);
    looks.forEach((look, index) => {
      tiles[index] ??= tile(index);
      tiles[index].look = look;
      tiles[index].name.textContent = look.name;
      tiles[index].button.title = look.title ?? look.name;
    });
  };
  const allowed = (look) => store.locks?.free(look.changes) ?? look.changes;
  function tile(index) {
    const name = element("span", {});
    const canvas = element("canvas", { width: 1, height: 1, "aria-hidden": "true" });
    const button = element("button", { type: "button", role: "radio", "aria-checked": "false", tabindex: -1 }, canvas, name);
    const made = { button, name, canvas, shown: undefined, changes: () => allowed(made.look) };
    button.addEventListener("click", () => {
      if (button.getAttribute("aria-checked") !== "true") store.locks.edit(made.look.changes);
    });
    button.addEventListener("keydown", (event) => {
      const columns = Math.max(1, tiles.filter((each) => each.button.offsetTop === tiles[0].button.offsetTop).length);
      const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns, Home: -tiles.length, End: tiles.length }[event.key];
      if (by === undefined) return;
      event.preventDefault();
      const to = Math.abs(by) === columns && !tiles[index + by] ? index : clamp(index + by, 0, tiles.length - 1);
      tiles[to].button.focus();
      tab_to(tiles[to]);
    });
    grid.append(button);
    return made;
  }
  const tab_to = (wanted) => {
    for (const each of tiles) each.button.tabIndex = each === wanted ? 0 : -1;
  };
  const is_chosen = (look) =>
    look.chosen?.() ??
    look.changes.every(({ key, value, remove }) => (remove ? !store.given(key) : JSON.stringify(store.value(key)) === JSON.stringify(value)));

  const gallery = {
    // Those in sight whose picture has not been asked for.
    unseen() {
      if (!grid.offsetParent) return [];
      const room = by_id("panels").getBoundingClientRect();
      return tiles.filter((each) => {
        const { top, bottom } = each.button.getBoundingClientRect();
        return bottom > room.top && top < room.bottom && store.thumbnails.known(each.changes()) === undefined;
      });
    },
    show() {
      if (!grid.offsetParent) return;
      for (const each of tiles) {
        const blob = store.thumbnails?.known(each.changes());
        each.button.classList.toggle("old", !blob);
        if (blob && each.shown !== blob) paint(each, blob);
      }
    },
  };
  async function paint(each, blob) {
    each.shown = blob;
    const bitmap = await createImageBitmap(blob);
    if (each.shown === blob) {
      Object.assign(each.canvas, { width: bitmap.width, height: bitmap.height });
      each.canvas.getContext("2d").drawImage(bitmap, 0, 0);
      each.button.classList.add("seen");
    }
    bitmap.close();
  }
  store.thumbnails?.galleries.add(gallery);
  fill();
  return {
    element: element("div", { class: "row looks" }, spec.bare ? null : element("span", { class: "label", title: about?.help }, spec.label), grid),
    update: () => {
      fill();
      for (const each of tiles) each.button.setAttribute("aria-checked", String(is_chosen(each.look)));
      const chosen = tiles.find((each) => each.button.getAttribute("aria-checked") === "true");
      if (!grid.contains(document.activeElement)) tab_to(chosen ?? tiles[0]);
      gallery.show();
    },
    focus: () => (tiles.find((each) => each.button.tabIndex === 0) ?? tiles[0])?.button.focus(),
  };
}
