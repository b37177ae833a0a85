// The 1 : 1 loupe: a frame in the picture, and beside it the piece in that frame with the pixels of the print, one on each of the screen's.
import { api } from "./api.js";
import { by_id, clamp, draggable, element, metres } from "./dom.js";
import { print_of } from "./sheet.js";

const size = [480, 320]; // px of the print
const rest_ms = 300; // the hand rests when the frame has not moved for so long
const stage_ms = 500;
const again_ms = 1500; // a piece that something else has taken the place of is asked for again

export class Loupe {
  constructor(store, picture) {
    Object.assign(this, { store, picture, at: null, picking: false });
    this.frame = element("div", {
      id: "loupe-frame",
      role: "slider",
      tabindex: 0,
      "aria-label": "Place of the loupe; arrow keys move it",
      hidden: true,
    });
    this.canvas = element("canvas", { id: "loupe-picture", role: "img", "aria-label": "The piece as it is printed", width: 1, height: 1 });
    this.says = element("p", { id: "loupe-says", role: "status" });
    this.bar = element("progress", { max: 1, "aria-label": "The piece in print" });
    const close = element("button", { type: "button", "aria-label": "Close the loupe", title: "Esc", click: () => this.close() }, "×");
    this.panel = element(
      "section",
      { id: "loupe", "aria-label": "1 : 1 loupe", hidden: true },
      this.canvas,
      this.bar,
      element("div", {}, this.says, close),
    );
    by_id("frame").append(this.frame);
    document.body.append(this.panel);
    by_id("show-loupe").addEventListener("click", () => this.toggle());
    // The click that puts the frame down is no movement of the view.
    by_id("frame").addEventListener("pointerdown", (event) => this.picked(event), { capture: true });
    document.addEventListener("keydown", (event) => this.key(event), { capture: true });
    draggable(this.frame, {
      start: (event) => {
        this.frame.focus();
        const [x, y] = this.picture.share_of(event);
        return [this.at[0] - x, this.at[1] - y];
      },
      move: (event, [dx, dy]) => {
        const [x, y] = this.picture.share_of(event);
        this.move(x + dx, y + dy);
      },
    });
    this.frame.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!by || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      const step = event.shiftKey ? 0.05 : 0.01;
      this.move(this.at[0] + step * by[0], this.at[1] + step * by[1]);
    });
    store.on("changed", () => this.at && this.later());
    store.on("fitted", () => this.at && this.place());
  }

  toggle() {
    if (this.picking || this.at) return this.close();
    this.pick(true);
    this.picture.canvas.focus();
  }
  pick(on) {
    this.picking = on;
    by_id("hint").textContent = "Click where you want to see the print. Enter takes the middle, Esc leaves it.";
    by_id("hint").hidden = !on;
    this.picture.canvas.classList.toggle("picking", on);
    by_id("show-loupe").setAttribute("aria-pressed", String(on || this.at !== null));
  }
  picked(event) {
    if (!this.picking || event.target !== this.picture.canvas || event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    this.put(...this.picture.share_of(event));
  }
  key(event) {
    if (event.key === "Enter" && this.picking && event.target === this.picture.canvas) this.put(0.5, 0.5);
    else if (event.key === "Escape" && (this.picking || this.at) && !document.querySelector("dialog[open]")) this.close();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
  put(x, y) {
    this.at = [x, y];
    this.pick(false);
    this.frame.hidden = this.panel.hidden = false;
    this.move(x, y);
    this.frame.focus();
  }
  close() {
    this.stop();
    this.at = null;
    this.pick(false);
    this.frame.hidden = this.panel.hidden = true;
    this.canvas.width = this.canvas.height = 1;
    this.picture.canvas.focus();
  }
  stop() {
    clearTimeout(this.timer);
    clearInterval(this.waits);
    this.abort?.abort();
  }

  // {width, height: px of the print, of the piece; print}
  piece() {
    const print = print_of(this.store);
    const room = Math.floor((window.innerWidth - 48) * window.devicePixelRatio);
    return { width: Math.min(size[0], print.width, room), height: Math.min(size[1], print.height), print };
  }
  move(x, y) {
    const { width, height, print } = this.piece();
    const half = [width / print.width / 2, height / print.height / 2];
    this.at = [clamp(x, half[0], 1 - half[0]), clamp(y, half[1], 1 - half[1])];
    this.place();
    this.later();
  }
  place() {
    const { width, height, print } = this.piece();
    const share = [width / print.width, height / print.height];
    Object.assign(this.frame.style, {
      left: `${100 * (this.at[0] - share[0] / 2)}%`,
      top: `${100 * (this.at[1] - share[1] / 2)}%`,
      width: `${100 * share[0]}%`,
      height: `${100 * share[1]}%`,
    });
    this.frame.setAttribute("aria-valuenow", Math.round(100 * this.at[0]));
    this.frame.setAttribute(
      "aria-valuetext",
      `${Math.round(100 * this.at[0])} % from the left, ${Math.round(100 * this.at[1])} % from the top`,
    );
    // Beside what it shows.
    this.panel.classList.toggle("left", this.at[0] > 0.5);
    this.canvas.style.width = `${width / window.devicePixelRatio}px`;
    this.canvas.style.height = `${height / window.devicePixelRatio}px`;
  }

  later(ms = rest_ms) {
    this.stop();
    this.panel.classList.add("old");
    this.tell("When the hand rests …");
    this.timer = setTimeout(() => this.ask(), ms);
  }
  async ask() {
    const { signal } = (this.abort = new AbortController());
    const { width, height, print } = this.piece();
    const { revision } = this.store.state;
    const started = performance.now();
    const waits = setInterval(() => this.stage(started, signal), stage_ms);
    this.waits = waits;
    this.tell("Painting this piece …", 0);
    try {
      const { blob, left, top } = await api.loupe(...this.at, width, height, revision, signal);
      const bitmap = await createImageBitmap(blob);
      if (signal.aborted) return;
      Object.assign(this.canvas, { width: bitmap.width, height: bitmap.height });
      this.canvas.getContext("2d").drawImage(bitmap, 0, 0);
      this.at = [(left + bitmap.width / 2) / print.width, (top + bitmap.height / 2) / print.height];
      bitmap.close();
      this.place();
      this.panel.classList.remove("old");
      const mm = (width * print.mm) / print.width;
      this.tell(
        `1 : 1, ${Math.round(print.dpi)} dpi; ${mm < 1000 ? `${Math.round(mm)} mm` : metres(mm / 1000)} of the print, at ${left}, ${top} px`,
      );
    } catch (error) {
      if (signal.aborted || error.name === "AbortError") return;
      if (error.status === 409) this.timer = setTimeout(() => this.ask(), again_ms);
      this.tell(error.status === 409 ? "Something else is being drawn; this piece comes after it." : error.message);
    } finally {
      clearInterval(waits);
    }
  }
  async stage(started, signal) {
    const { stage, done } = await api.stage().catch(() => ({}));
    if (!signal.aborted && this.panel.classList.contains("old"))
      this.tell(`${stage || "Painting this piece"} … ${Math.round((performance.now() - started) / 1000)} s`, done);
  }
  // `done`: a share, 0 where it is not known; undefined: nothing is being made.
  tell(text, done) {
    this.says.textContent = text;
    this.bar.classList.toggle("rests", done === undefined);
    if (done > 0) this.bar.value = done;
    else this.bar.removeAttribute("value");
  }
}
