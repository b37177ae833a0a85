// A picture in tiles on a canvas: moved, zoomed and compared, by hand, wheel and keys. No server and no library: tiles are pictures beside the
// page.
"use strict";

class Viewer {
  // pictures: [{name, folder, width, height, tilePx, levels}], all of one size; changed(): called when what is shown has changed.
  constructor(canvas, pictures, changed) {
    this.canvas = canvas;
    this.pictures = pictures;
    this.changed = changed;
    this.width = pictures[0].width;
    this.height = pictures[0].height;
    this.tiles = new Map();
    this.x = this.width / 2;  // pixel of the picture in the middle
    this.y = this.height / 2;
    this.scale = 0;  // pixels of the page for one of the picture
    this.second = 0;  // picture to the right of the swipe; 0: none
    this.swipe = 0.5;  // of the canvas' width
    this.overlays = [];  // functions (context, viewer) that draw over the picture
    this.pointers = new Map();
    this.listen();
    this.resize();
    this.home();
  }

  // ---- places ----
  toPage(x, y) { return [(x - this.x) * this.scale + this.canvas.clientWidth / 2, (y - this.y) * this.scale + this.canvas.clientHeight / 2]; }
  toPicture(px, py) { return [(px - this.canvas.clientWidth / 2) / this.scale + this.x, (py - this.canvas.clientHeight / 2) / this.scale + this.y]; }
  leastScale() { return Math.min(this.canvas.clientWidth / this.width, this.canvas.clientHeight / this.height); }
  mostScale() { return Math.max(2, this.leastScale()); }

  home() {
    this.scale = this.leastScale();
    this.show(this.width / 2, this.height / 2);
  }
  show(x, y, scale = this.scale) {
    this.fitted = this.leastScale();
    this.scale = Math.max(this.fitted, Math.min(this.mostScale(), scale));
    // The picture fills the page where it is larger, and stays in the middle where it is not.
    const held = (at, size, seen) => (seen >= size ? size / 2 : Math.max(seen / 2, Math.min(size - seen / 2, at)));
    this.x = held(x, this.width, this.canvas.clientWidth / this.scale);
    this.y = held(y, this.height, this.canvas.clientHeight / this.scale);
    this.redraw();
    this.changed();
  }
  // Zooms so that what is at a place of the page stays there.
  zoom(factor, px = this.canvas.clientWidth / 2, py = this.canvas.clientHeight / 2) {
    const [x, y] = this.toPicture(px, py);
    const scale = Math.max(this.leastScale(), Math.min(this.mostScale(), this.scale * factor));
    this.show(x - (px - this.canvas.clientWidth / 2) / scale, y - (py - this.canvas.clientHeight / 2) / scale, scale);
  }
  move(dx, dy) { this.show(this.x - dx / this.scale, this.y - dy / this.scale); }

  // ---- drawing ----
  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    this.redraw();
  }
  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }
  draw() {
    const ratio = window.devicePixelRatio || 1;
    const context = this.canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    context.clearRect(0, 0, width, height);
    this.drawPicture(context, this.pictures[0], 0, width);
    if (this.second > 0) {
      const x = this.swipe * width;
      this.drawPicture(context, this.pictures[this.second], x, width);
      context.fillStyle = "#fff";
      context.fillRect(x - 1, 0, 2, height);
    }
    for (const overlay of this.overlays) overlay(context, this);
    this.forget();
  }
  // The part of the page between two columns: the finest level that is needed, and where its tiles are not there yet, coarser ones.
  drawPicture(context, picture, left, right) {
    context.save();
    context.beginPath();
    context.rect(left, 0, right - left, this.canvas.clientHeight);
    context.clip();
    context.imageSmoothingQuality = "high";
    const ratio = window.devicePixelRatio || 1;
    const wanted = Math.max(0, Math.min(picture.levels - 1, Math.floor(Math.log2(1 / (this.scale * ratio)))));
    const [x0, y0] = this.toPicture(left, 0);
    const [x1, y1] = this.toPicture(right, this.canvas.clientHeight);
    for (let level = picture.levels - 1; level >= wanted; --level) {
      const size = picture.tilePx * 2 ** level;  // of a tile in pixels of the picture
      for (let row = Math.max(0, Math.floor(y0 / size)); row * size < Math.min(this.height, y1); ++row)
        for (let column = Math.max(0, Math.floor(x0 / size)); column * size < Math.min(this.width, x1); ++column) {
          const tile = this.tile(picture, level, column, row, level === wanted || level === picture.levels - 1);
          if (!tile || !tile.complete || tile.naturalWidth === 0) continue;
          const [px, py] = this.toPage(column * size, row * size);
          const grow = this.scale * 2 ** level;
          context.drawImage(tile, px, py, tile.naturalWidth * grow + 0.5, tile.naturalHeight * grow + 0.5);
        }
    }
    context.restore();
  }
  // Asks for a tile where `load` is true; else the one that is there.
  tile(picture, level, column, row, load) {
    const address = `${picture.folder}/${level}/${column}_${row}.jpg`;
    let tile = this.tiles.get(address);
    if (!tile && load) {
      tile = new Image();
      tile.onload = () => this.redraw();
      tile.src = address;
      this.tiles.set(address, tile);
    }
    if (tile) tile.used = performance.now();
    return tile;
  }
  // Keeps some hundred tiles.
  forget() {
    if (this.tiles.size < 300) return;
    const byAge = Array.from(this.tiles).sort((a, b) => a[1].used - b[1].used);
    for (const [address] of byAge.slice(0, 100)) this.tiles.delete(address);
  }

  // ---- hands ----
  listen() {
    const canvas = this.canvas;
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0016)), ...place(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      const at = place(event);
      const atSwipe = this.second > 0 && Math.abs(at[0] - this.swipe * canvas.clientWidth) < 18;
      this.pointers.set(event.pointerId, { at, swipes: atSwipe });
    });
    canvas.addEventListener("pointermove", (event) => {
      const held = this.pointers.get(event.pointerId);
      if (!held) return;
      const at = place(event);
      if (held.swipes) {
        this.setSwipe(at[0] / canvas.clientWidth);
      } else if (this.pointers.size === 1) {
        this.move(at[0] - held.at[0], at[1] - held.at[1]);
      } else {
        const other = Array.from(this.pointers).find(([id]) => id !== event.pointerId)[1].at;
        const span = (p) => Math.max(10, Math.hypot(p[0] - other[0], p[1] - other[1]));
        this.zoom(span(at) / span(held.at), (at[0] + other[0]) / 2, (at[1] + other[1]) / 2);
        this.move((at[0] - held.at[0]) / 2, (at[1] - held.at[1]) / 2);
      }
      held.at = at;
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener("dblclick", (event) => this.zoom(2, ...place(event)));
    canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const step = 80;
      const actions = {
        ArrowLeft: () => this.move(step, 0),
        ArrowRight: () => this.move(-step, 0),
        ArrowUp: () => this.move(0, step),
        ArrowDown: () => this.move(0, -step),
        "+": () => this.zoom(1.4),
        "=": () => this.zoom(1.4),
        "-": () => this.zoom(1 / 1.4),
        0: () => this.home(),
        Home: () => this.home(),
        "[": () => this.setSwipe(this.swipe - 0.05),
        "]": () => this.setSwipe(this.swipe + 0.05),
      };
      if (!actions[event.key]) return;
      event.preventDefault();
      actions[event.key]();
    });
    // Also where a line more or less of the page around changes the room: what was whole stays whole.
    new ResizeObserver(() => {
      if (!this.scale) return;
      const whole = this.scale <= this.fitted * 1.001;
      this.resize();
      this.show(this.x, this.y, whole ? 0 : this.scale);
    }).observe(canvas);
  }
  setSwipe(share) {
    this.swipe = Math.max(0, Math.min(1, share));
    this.redraw();
    this.changed();
  }
}
