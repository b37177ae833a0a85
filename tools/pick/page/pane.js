// A picture in tiles that is looked at and clicked on: the viewer of rendered panoramas, with marks that can be taken hold of.
import { by_id } from "./dom.js";

const reach_px = 11; // of a mark, on the page
const still_px = 4; // what moves less is a click

/* global Viewer */
export class Pane extends Viewer {
  // canvas: its id, as well as the folder of its tiles with `folder`.
  constructor(id, folder, tiles) {
    super(by_id(id), [{ ...tiles, folder, name: folder }], () => {});
    this.tip = by_id(`${id}-tip`);
    this.marks = () => []; // [{at: [x, y], words, index}] in pixels of the picture, those that can be dragged
    this.clicked = () => {};
    this.dragged = () => {};
    this.taken = () => {};
    this.held = null;
    this.take_clicks();
  }
  mostScale() {
    return Math.max(8 / (window.devicePixelRatio || 1), this.leastScale());
  }

  // Brings a place into view, not nearer than it is unless it is seen from farther than `scale`.
  bring([x, y], scale = 0) {
    const [px, py] = this.toPage(x, y);
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const inside = px > 0.12 * width && px < 0.88 * width && py > 0.12 * height && py < 0.88 * height;
    const wanted = Math.max(this.scale, Math.min(scale, this.mostScale()));
    if (inside && wanted <= this.scale * 1.05) return;
    this.glide(x, y, wanted);
  }
  glide(x, y, scale) {
    const from = [this.x, this.y, Math.log(this.scale)];
    const began = performance.now();
    const quick = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    cancelAnimationFrame(this.gliding);
    const step = () => {
      const share = quick ? 1 : Math.min(1, (performance.now() - began) / 260);
      const eased = share * share * (3 - 2 * share);
      const between = (a, b) => a + (b - a) * eased;
      this.show(between(from[0], x), between(from[1], y), Math.exp(between(from[2], Math.log(scale))));
      if (share < 1) this.gliding = requestAnimationFrame(step);
    };
    step();
  }

  mark_at(px, py) {
    let best = null;
    let nearest = reach_px;
    for (const mark of this.marks()) {
      const [x, y] = this.toPage(...mark.at);
      const distance = Math.hypot(x - px, y - py);
      if (distance < nearest) {
        nearest = distance;
        best = mark;
      }
    }
    return best;
  }
  inside([x, y]) {
    return x >= 0 && y >= 0 && x <= this.width && y <= this.height;
  }

  // The viewer moves the picture with the pointer. A press that stays where it is is a click; one on a mark holds that.
  take_clicks() {
    const { canvas } = this;
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    const around = canvas.parentElement;
    const only_here = (event) => {
      event.stopPropagation();
      event.preventDefault();
    };
    around.addEventListener("dblclick", only_here, { capture: true });
    around.addEventListener(
      "pointerdown",
      (event) => {
        if (event.target !== canvas) return;
        if (event.button !== 0) return only_here(event);
        cancelAnimationFrame(this.gliding);
        const at = place(event);
        const mark = this.mark_at(...at);
        this.press = { id: event.pointerId, at, mark, moved: false };
        if (!mark) return;
        canvas.setPointerCapture(event.pointerId);
        only_here(event); // the picture stays
      },
      { capture: true },
    );
    canvas.addEventListener("pointermove", (event) => {
      const at = place(event);
      const { press } = this;
      if (press?.id === event.pointerId) {
        press.moved ||= Math.hypot(at[0] - press.at[0], at[1] - press.at[1]) > still_px;
        canvas.classList.toggle("panning", press.moved && !press.mark);
        if (press.moved && press.mark) {
          this.held = { mark: press.mark, at: this.toPicture(...at) };
          this.redraw();
        }
      }
      const over = press ? null : this.mark_at(...at);
      canvas.classList.toggle("on-mark", Boolean(over));
      this.show_tip(over, at);
    });
    canvas.addEventListener("pointerleave", () => this.show_tip(null));
    canvas.addEventListener("pointercancel", () => {
      this.press = this.held = null;
      this.redraw();
    });
    canvas.addEventListener("pointerup", (event) => {
      const { press } = this;
      if (press?.id !== event.pointerId) return;
      this.press = this.held = null;
      canvas.classList.remove("panning");
      const at = this.toPicture(...place(event));
      if (press.mark && press.moved) this.dragged(press.mark, at, event.shiftKey);
      else if (press.mark) this.taken(press.mark, at, event.shiftKey);
      else if (!press.moved && this.inside(at)) this.clicked(at, event.shiftKey);
      this.redraw();
    });
    canvas.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || event.ctrlKey || event.metaKey || event.altKey || this.keeps_enter?.()) return;
      event.preventDefault();
      event.stopPropagation();
      this.clicked([this.x, this.y], event.shiftKey);
    });
  }
  show_tip(mark, at) {
    this.tip.hidden = !mark?.words;
    if (!mark?.words) return;
    this.tip.textContent = mark.words;
    this.tip.style.left = `${Math.min(at[0], this.canvas.clientWidth - 180)}px`;
    this.tip.style.top = `${Math.max(at[1], 26)}px`;
  }
}
