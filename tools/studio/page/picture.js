// The picture on its canvas: rungs drawn over each other, a kept version beside it under a movable border, and the drawn picture gliding
// with the hand until the next one is there. Nothing is kept but two canvases.
import { by_id, clamp, draggable, element } from "./dom.js";
import { view } from "./camera.js";
import { recall, remember } from "./memory.js";

const max_width = 4096; // px of the canvas
const rung_px = [64, 2400]; // what the program draws as the last rung
const remembered = { width: 1400, characters: 2e6 }; // at most, of the kept picture

export class Picture {
  constructor(store) {
    this.store = store;
    this.stage = by_id("stage");
    this.canvas = by_id("picture");
    this.kept = by_id("kept");
    this.border = by_id("border");
    this.kept_text = null; // the scene of the kept version
    this.share = 0.5;
    this.shown = null; // the view of the picture that is drawn
    this.fitted = () => {}; // called when the frame has another size
    this.frame_width = this.stage.clientWidth;
    this.paper = null; // the sheet around it, {left, top, width, height} in widths of the picture
    this.listen();
    store.on("pending", () => this.glide());
  }

  // The canvas has the size of the last rung; what was drawn stays, scaled.
  resize({ width, height }) {
    const scale = Math.min(1, max_width / width);
    const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
    if (this.canvas.width === w && this.canvas.height === h) return;
    const before = this.shown ? element("canvas", { width: this.canvas.width, height: this.canvas.height }) : null;
    before?.getContext("2d").drawImage(this.canvas, 0, 0);
    this.canvas.width = w;
    this.canvas.height = h;
    if (before) this.context().drawImage(before, 0, 0, w, h);
    this.stage.style.setProperty("--aspect", w / h);
    this.fit();
  }
  context() {
    const context = this.canvas.getContext("2d", { alpha: false });
    context.imageSmoothingQuality = "high";
    return context;
  }
  // The frame is the largest of the picture's shape that the stage holds.
  fit() {
    const [width, height] = [this.stage.clientWidth, this.stage.clientHeight];
    const aspect = this.canvas.width / this.canvas.height;
    const paper = this.paper ?? { left: 0, top: 0, width: 1, height: 1 / aspect };
    const w = (this.paper ? 0.96 : 1) * Math.min(width / paper.width, height / paper.height);
    const frame = by_id("frame");
    frame.style.width = `${w}px`;
    frame.style.height = `${w / aspect}px`;
    // Frame and paper are both centred in the stage.
    frame.style.translate = `${w * (paper.left + 0.5 - paper.width / 2)}px ${w * (paper.top + 0.5 / aspect - paper.height / 2)}px`;
    this.frame_width = w;
    this.store.tell("fitted", w);
    this.fitted();
  }
  // Pixels of the screen across the frame.
  wanted_width() {
    return clamp(Math.round(this.frame_width * window.devicePixelRatio), ...rung_px);
  }

  // The view of the scene as the program has it.
  view() {
    return view(this.store.settled());
  }
  async show(blob, seen) {
    const bitmap = await createImageBitmap(blob);
    this.context().drawImage(bitmap, 0, 0, this.canvas.width, this.canvas.height);
    bitmap.close();
    this.shown = seen;
    document.body.dataset.drawn = String(Number(document.body.dataset.drawn ?? 0) + 1);
    this.glide();
    this.store.tell("shown");
  }
  async tile({ x, y, blob }, { width }) {
    const scale = this.canvas.width / width;
    const bitmap = await createImageBitmap(blob);
    this.context().drawImage(bitmap, x * scale, y * scale, bitmap.width * scale, bitmap.height * scale);
    bitmap.close();
  }
  // Moves the picture that is drawn to where the view of the changes on their way will be.
  glide() {
    let move = "";
    if (this.shown) {
      const wanted = view(this.store);
      const per_degree = this.canvas.clientWidth / this.shown.field;
      const right = ((wanted.azimuth - this.shown.azimuth + 540) % 360) - 180;
      const up = wanted.pitch + wanted.tilt - this.shown.pitch - this.shown.tilt;
      if (!wanted.parallel && (Math.abs(right) > 0.01 || Math.abs(up) > 0.01) && Math.abs(right) < this.shown.field)
        move = `translate(${(-right * per_degree).toFixed(1)}px, ${(up * per_degree).toFixed(1)}px)`;
    }
    this.canvas.style.transform = move;
  }

  // A place of the page as shares of the picture.
  share_of(event) {
    const box = this.kept.parentElement.getBoundingClientRect();
    return [clamp((event.clientX - box.left) / box.width, 0, 1), clamp((event.clientY - box.top) / box.height, 0, 1)];
  }

  // ---- comparing
  keep() {
    this.kept.width = this.canvas.width;
    this.kept.height = this.canvas.height;
    this.kept.getContext("2d").drawImage(this.canvas, 0, 0);
    this.kept_text = this.store.state.text;
    remember("kept", { text: this.kept_text, picture: small_jpeg(this.canvas) });
  }
  // The version that was kept before the page was loaded again; false if there is none.
  async restore() {
    const { text, picture } = recall("kept") ?? {};
    if (!text || !picture) return false;
    const bytes = Uint8Array.from(atob(picture.split(",")[1]), (each) => each.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes]));
    this.kept.width = bitmap.width;
    this.kept.height = bitmap.height;
    this.kept.getContext("2d").drawImage(bitmap, 0, 0);
    bitmap.close();
    this.kept_text = text;
    return true;
  }
  comparing() {
    return !this.kept.hidden;
  }
  compare(on) {
    const shows = on && this.kept_text !== null;
    this.kept.hidden = this.border.hidden = !shows;
    this.set_share(this.share);
    return shows;
  }
  set_share(share) {
    this.share = clamp(share, 0, 1);
    this.kept.style.clipPath = `inset(0 ${100 * (1 - this.share)}% 0 0)`;
    this.border.style.left = `${100 * this.share}%`;
    this.border.setAttribute("aria-valuenow", Math.round(100 * this.share));
    this.border.setAttribute("aria-valuetext", `${Math.round(100 * this.share)} % kept version`);
  }
  listen() {
    new ResizeObserver(() => this.fit()).observe(this.stage);
    draggable(this.border, {
      start: () => this.border.focus(),
      move: (event) => this.set_share(this.share_of(event)[0]),
    });
    this.border.addEventListener("keydown", (event) => {
      const steps = { ArrowLeft: -0.02, ArrowRight: 0.02, PageDown: -0.1, PageUp: 0.1, Home: -1, End: 1 };
      if (!(event.key in steps)) return;
      event.preventDefault();
      event.stopPropagation();
      this.set_share(this.share + steps[event.key]);
    });
  }
}

// A picture that a page can remember; none if it is too large for that.
function small_jpeg(canvas) {
  const scale = Math.min(1, remembered.width / canvas.width);
  const small = element("canvas", { width: Math.round(scale * canvas.width), height: Math.round(scale * canvas.height) });
  small.getContext("2d").drawImage(canvas, 0, 0, small.width, small.height);
  const url = small.toDataURL("image/jpeg", 0.9);
  return url.length <= remembered.characters ? url : null;
}
