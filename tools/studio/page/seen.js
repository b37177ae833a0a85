// The ground of the last picture on a small grid (api/seen): from it the page draws over the picture by itself, without asking the program.
import { api } from "./api.js";
import { by_id, element } from "./dom.js";

export class Seen {
  constructor(store, picture) {
    Object.assign(this, { store, picture, grid: null });
  }
  // When the hand rests. What cannot be had now comes with the next rest.
  async read() {
    const { revision, values } = this.store.state;
    if (this.grid?.revision === revision || this.asked === revision) return;
    this.asked = revision;
    const view = this.picture.view();
    try {
      this.grid = { ...decoded(await api.seen(revision)), revision, values, view };
      document.body.dataset.seen = String(revision);
      this.store.tell("seen");
    } catch {
      this.asked = null;
    }
  }
}

// {width, height, origin, x, y, z, depth, broken_right, broken_down}: x and y in m from the origin, row by row from the upper left.
export function decoded(bytes) {
  const head = new DataView(bytes);
  const [width, height] = [head.getUint32(0, true), head.getUint32(4, true)];
  const plane = (index) => new Float32Array(bytes, 24 + 4 * index * width * height, width * height);
  const [x, y, z, depth] = [0, 1, 2, 3].map(plane);
  return {
    width,
    height,
    origin: [head.getFloat64(8, true), head.getFloat64(16, true)],
    x,
    y,
    z,
    depth,
    broken_right: breaks(depth, width, height, 1),
    broken_down: breaks(depth, width, height, width),
  };
}

// Where the ground does not go on from a pixel to the one `stride` after it: sky, or the edge of a ridge, behind which ground is hidden. The
// distance jumps there by much more than it changes on both sides.
function breaks(depth, width, height, stride) {
  const out = new Uint8Array(width * height);
  const step = (a, b) => {
    const by = Math.abs(depth[a] - depth[b]);
    return Number.isFinite(by) ? by : 0;
  };
  const [count, along] = stride === 1 ? [width, (i) => i % width] : [height, (i) => Math.floor(i / width)];
  for (let i = 0; i < out.length; ++i) {
    const at = along(i);
    if (at + 1 >= count) continue;
    const jump = Math.abs(depth[i + stride] - depth[i]);
    const around = Math.max(at > 0 ? step(i, i - stride) : 0, at + 2 < count ? step(i + stride, i + 2 * stride) : 0);
    out[i] = jump <= 3 * around + 0.004 * depth[i] ? 0 : 1; // NaN and infinite: broken
  }
  return out;
}

// The same place, direction and field, so that what was seen then is where it is seen now.
export function same_place(a, b) {
  return ["viewer", "height", "field", "parallel"].every((name) => JSON.stringify(a?.[name]) === JSON.stringify(b?.[name]));
}
export function same_view(a, b) {
  return same_place(a, b) && Math.abs(a.azimuth - b.azimuth) < 0.01 && Math.abs(a.pitch + a.tilt - b.pitch - b.tilt) < 0.01;
}

// A canvas over the picture that takes no pointer, and its context, empty and of the size at which the picture is shown.
export function layer(id) {
  const canvas = element("canvas", { id, class: "over", "aria-hidden": "true" });
  by_id("kept").before(canvas);
  return canvas;
}
export function cleared(canvas) {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, width, height);
  return context;
}
