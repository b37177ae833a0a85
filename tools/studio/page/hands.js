// Hands on the picture: dragging looks around, wheel and two fingers move, keys do the same in small steps, pointing tells what is there,
// and a summit can be pulled.
import { api } from "./api.js";
import { moved, turned, view, widened } from "./camera.js";
import { by_id, metres } from "./dom.js";
import { new_step, running_step } from "./store.js";

const click_px = 4; // a pointer that moves less has clicked

export class Hands {
  constructor(store, picture) {
    this.store = store;
    this.picture = picture;
    this.canvas = picture.canvas;
    this.pointers = new Map();
    this.mode = "look";
    this.pick = null; // takes the next click: {done(pointed, step)}
    this.asked = new AbortController();
    this.listen();
  }

  // The next click on the picture or the map is no movement: done(pointed, step, share, near_m) gets its ground and may return what follows the hand,
  // pull(dx, dy). left() is called where it is given up.
  choose(hint, done, left = () => {}) {
    this.pick = { hint, done, left };
    by_id("hint").textContent = `${hint} Enter takes the middle, Esc leaves it.`;
    by_id("hint").hidden = false;
    this.canvas.classList.add("picking");
    this.canvas.focus();
  }
  leave() {
    this.pick = null;
    by_id("hint").hidden = true;
    this.canvas.classList.remove("picking");
  }

  give_up() {
    const { left } = this.pick ?? {};
    this.leave();
    left?.();
  }

  // ---- pointers
  down(event) {
    if (event.button !== 0) return;
    this.canvas.focus();
    this.canvas.setPointerCapture(event.pointerId);
    const at = [event.clientX, event.clientY];
    this.pointers.set(event.pointerId, { at, first: at });
    this.held = { from: view(this.store), step: new_step(), moved: false, pull: null, span: this.span() };
    if (this.pick) this.picked(event);
  }
  span() {
    const [a, b] = Array.from(this.pointers.values());
    return b
      ? { size: Math.max(20, Math.hypot(a.at[0] - b.at[0], a.at[1] - b.at[1])), x: (a.at[0] + b.at[0]) / 2, y: (a.at[1] + b.at[1]) / 2 }
      : null;
  }
  async picked(event) {
    const { hint, done, left } = this.pick;
    const held = this.held;
    held.pull = () => {};
    this.leave();
    const pointed = await this.ground(event);
    if (!pointed || pointed.sky) {
      this.choose(hint, done, left);
      return this.say(pointed ? "There is no ground at this place: click on ground." : "The picture was being drawn: click again.");
    }
    held.pull = done(pointed, held.step, this.picture.share_of(event)) ?? (() => {});
    if (held.last) held.pull(...held.last);
  }
  // The same on the map; clicks within near_m mean one place.
  async placed(position, near_m) {
    const { hint, done, left } = this.pick;
    this.leave();
    const pointed = await api.place(...position).catch(() => null);
    if (pointed && !pointed.sky) return done(pointed, new_step(), null, near_m);
    this.choose(hint, done, left);
    this.say("The map has no data at this place.");
  }
  moving(event) {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) return this.hover(event);
    pointer.at = [event.clientX, event.clientY];
    const { from, step } = this.held;
    const [dx, dy] = [pointer.at[0] - pointer.first[0], pointer.at[1] - pointer.first[1]];
    if (!this.held.moved && Math.hypot(dx, dy) < click_px) return;
    this.held.moved = true;
    this.held.last = [dx, dy];
    if (this.held.pull) return this.held.pull(dx, dy);
    const width = this.canvas.clientWidth;
    if (this.pointers.size > 1 && this.held.span) {
      const span = this.span();
      const near = Math.log(span.size / this.held.span.size);
      const aside = (this.held.span.x - span.x) / width;
      this.edit(
        moved(this.store, from, Math.max(-2, Math.min(0.9, 0.6 * near)), aside, ((span.y - this.held.span.y) * from.height) / width),
        step,
      );
    } else if (event.shiftKey || this.mode === "move") {
      const share = (2 * Math.tan((Math.min(from.field, 120) * Math.PI) / 360)) / width;
      this.edit(moved(this.store, from, 0, -dx * share, (dy * from.height) / width), step);
    } else {
      this.edit(turned(this.store, from, (-dx * from.field) / width, (dy * from.field) / width), step);
    }
  }
  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    if (this.pointers.size === 0 && this.held && !this.held.moved && event.type === "pointerup" && !this.held.pull) this.read(event);
    // The finger that stays begins from where things are now.
    for (const pointer of this.pointers.values()) pointer.first = pointer.at;
    if (this.pointers.size > 0) this.held = { from: view(this.store), step: new_step(), moved: true, pull: null, span: this.span() };
  }
  wheel(event) {
    event.preventDefault();
    const turn = -event.deltaY * (event.deltaMode === 1 ? 0.03 : 0.001);
    if (event.ctrlKey) this.edit(widened(this.store, Math.exp(-turn)), running_step("wheel-field"));
    else if (event.shiftKey) this.aside(event.deltaX || event.deltaY, "wheel-aside");
    else this.forward(turn, "wheel");
  }
  edit(changes, step) {
    if (changes.length > 0) this.store.edit(changes, step);
  }
  forward(share, what = "forward") {
    this.edit(moved(this.store, view(this.store), Math.max(-0.5, Math.min(0.5, share)), 0), running_step(what));
  }
  aside(px, what = "aside") {
    this.edit(moved(this.store, view(this.store), 0, px / this.canvas.clientWidth), running_step(what));
  }
  higher(share) {
    const from = view(this.store);
    this.edit(moved(this.store, from, 0, 0, Math.max(20, Math.abs(from.height * share)) * Math.sign(share)), running_step("height"));
  }
  turn(right, up) {
    this.edit(turned(this.store, view(this.store), right, up), running_step("turn"));
  }
  widen(factor) {
    this.edit(widened(this.store, factor), running_step("field"));
  }

  keys(event) {
    if (event.ctrlKey || event.metaKey) return;
    const coarse = event.altKey ? 0.2 : 1;
    const angle = (coarse * view(this.store).field) / 25;
    const px = (coarse * this.canvas.clientWidth) / 25;
    const actions = {
      ArrowLeft: () => (event.shiftKey ? this.aside(-px) : this.turn(-angle, 0)),
      ArrowRight: () => (event.shiftKey ? this.aside(px) : this.turn(angle, 0)),
      ArrowUp: () => (event.shiftKey ? this.forward(0.05 * coarse) : this.turn(0, angle)),
      ArrowDown: () => (event.shiftKey ? this.forward(-0.05 * coarse) : this.turn(0, -angle)),
      PageUp: () => this.higher(0.05 * coarse),
      PageDown: () => this.higher(-0.05 * coarse),
      "+": () => this.forward(0.05 * coarse),
      "=": () => this.forward(0.05 * coarse),
      "-": () => this.forward(-0.05 * coarse),
      "[": () => this.widen(1 / 1.05),
      "]": () => this.widen(1.05),
    };
    if (event.key === "Enter") {
      event.preventDefault();
      return this.middle();
    }
    if (event.key === "Escape" && this.pick) {
      event.stopPropagation();
      return this.give_up();
    }
    if (!actions[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    actions[event.key]();
  }

  // Keys point at the middle of the picture.
  middle() {
    const box = this.canvas.parentElement.getBoundingClientRect();
    const event = { clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 };
    this.held = { step: new_step() };
    return this.pick ? this.picked(event) : this.read(event);
  }

  // ---- pointing
  // What was clicked: asked until the program answers, for at most 3 s, and not given up for what the pointer passes over meanwhile.
  async ground(event) {
    clearTimeout(this.hovers);
    const share = this.picture.share_of(event);
    for (const until = performance.now() + 3000; ; await new Promise((resolve) => setTimeout(resolve, 100))) {
      try {
        return await api.pointer(...share, this.store.state.revision);
      } catch {
        if (performance.now() > until) return null;
      }
    }
  }
  async point(event) {
    this.asked.abort();
    this.asked = new AbortController();
    try {
      return await api.pointer(...this.picture.share_of(event), this.store.state.revision, this.asked.signal);
    } catch {
      return null; // the picture has changed since
    }
  }
  hover(event) {
    if (event.pointerType === "touch") return;
    clearTimeout(this.hovers);
    const { clientX, clientY } = event;
    this.hovers = setTimeout(() => !this.store.busy && this.read({ clientX, clientY }), 120);
  }
  async read(event) {
    const pointed = await this.point(event);
    if (pointed) this.say(pointed.sky ? "sky" : told(pointed));
  }
  say(text) {
    by_id("pointed").textContent = text;
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.moving(event));
    for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, (event) => this.up(event));
    canvas.addEventListener("pointerleave", () => clearTimeout(this.hovers));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("keydown", (event) => this.keys(event));
    const buttons = {
      nearer: () => this.forward(0.08),
      farther: () => this.forward(-0.08),
      narrower: () => this.widen(1 / 1.1),
      wider: () => this.widen(1.1),
    };
    for (const [id, action] of Object.entries(buttons)) by_id(id).addEventListener("click", action);
    by_id("mode").addEventListener("click", (event) => {
      this.mode = this.mode === "look" ? "move" : "look";
      event.currentTarget.setAttribute("aria-pressed", String(this.mode === "move"));
    });
  }

  // ---- pulling a summit
  pull_summit() {
    this.choose("Press on a summit and pull it up or down, to the left or right.", (pointed, step) => {
      const index = this.store.count("deform.handles");
      const from = view(this.store);
      // Metres of a pixel of the page at that distance, before exaggeration.
      const metres_px = (2 * Math.tan((Math.min(from.field, 120) * Math.PI) / 360) * pointed.distance_m) / this.canvas.clientWidth;
      const radius = Math.max(500, Math.round(pointed.distance_m / 1500) * 100);
      this.store.edit(
        [{ key: "deform.handles", append: { position: pointed.position.map(Math.round), radius_m: radius, raise_m: 0 } }],
        step,
      );
      return (dx, dy) => {
        const raise = Math.round((-dy * metres_px) / (this.store.number("deform.exaggeration") ?? 1));
        const aside = Math.abs(dx) < 6 ? 0 : dx * metres_px;
        const azimuth = (from.azimuth * Math.PI) / 180;
        const move = [Math.round(aside * Math.cos(azimuth)), Math.round(-aside * Math.sin(azimuth))];
        const at = `deform.handles.${index}`;
        this.store.edit(
          [
            { key: `${at}.raise_m`, value: Math.max(-5000, Math.min(5000, raise)) },
            { key: `${at}.move_m`, value: move },
          ],
          step,
        );
      };
    });
  }
  // A block with a position, put down by a click.
  place(hint, key, template) {
    this.choose(hint, (pointed, step) => {
      this.store.edit([{ key, append: { position: pointed.position.map(Math.round), ...template } }], step);
    });
  }
  target() {
    this.choose("Click what the picture shall look at.", (pointed, step) => {
      this.store.edit([{ key: "camera.look_at", value: pointed.position.map(Math.round) }], step);
    });
  }
}

const degrees = (angle, positive, negative) => `${Math.abs(angle).toFixed(4)}° ${angle < 0 ? negative : positive}`;

function told({ altitude_m, distance_m, class: ground, lonlat, position }) {
  const parts = [metres(altitude_m), `${(distance_m / 1000).toFixed(1)} km away`];
  if (ground) parts.push(ground.replaceAll("_", " "));
  if (lonlat) parts.push(`${degrees(lonlat[1], "N", "S")} ${degrees(lonlat[0], "E", "W")}`);
  else if (position) parts.push(`E ${Math.round(position[0])} N ${Math.round(position[1])}`);
  return parts.join(" · ");
}
