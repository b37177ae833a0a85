// The forms of a band of the equalizer, tinted in the picture: ridges warm, valleys cool. On the ground last seen, along its rows and
// columns, heights are averaged over the smallest and over the largest width of the band, in as many pixels as that width has there; the
// difference of both means is what the band holds: crests that are 1.6 of these widths apart pass by half, nearer and farther ones less.
import { cleared, layer, same_view } from "./seen.js";

const opaque = 0.62;

export class Forms {
  constructor(store, picture, seen) {
    Object.assign(this, { store, picture, seen, band: null });
    this.canvas = layer("forms");
    store.on("band", (band) => {
      this.band = band; // {from, to: m, side, sign: 1 ridges, -1 valleys, 0 both}, or null
      this.draw();
    });
    for (const kind of ["seen", "shown"]) store.on(kind, () => this.band && this.draw());
  }

  draw() {
    const context = cleared(this.canvas);
    const { grid } = this.seen;
    if (!this.band || !grid || !same_view(grid.view, this.picture.view())) return;
    const { from, to, side, sign } = this.band;
    const found = band_pass(grid, from, to);
    const near = this.store.number("generalize.foreground_to_m") ?? Infinity;
    const far = Math.max(near + 1, this.store.number("generalize.background_from_m") ?? Infinity);
    const sizes = found.filter((each) => each > 0).sort(); // a Float32Array: by number
    const large = Math.max(sizes[Math.floor(0.9 * sizes.length)] ?? 0, 0.004 * from); // flat ground has no forms
    const image = new ImageData(grid.width, grid.height);
    for (let i = 0; i < found.length; ++i) {
      if (!(sign * found[i] >= 0)) continue;
      const share = Number.isFinite(far) ? Math.min(1, Math.max(0, (far - grid.depth[i]) / (far - near))) : 1;
      const t = Math.min(1, Math.max(0, Math.abs(found[i]) / large - 0.3) / 0.6) * (side === "background" ? 1 - share : share);
      image.data.set([...(found[i] > 0 ? [255, 150, 40] : [60, 150, 255]), 255 * opaque * t], 4 * i);
    }
    const small = new OffscreenCanvas(grid.width, grid.height);
    small.getContext("2d").putImageData(image, 0, 0);
    context.imageSmoothingQuality = "high";
    context.drawImage(small, 0, 0, this.canvas.width, this.canvas.height);
  }
}

// Heights of forms so wide, m, per pixel of the grid: 0 where the grid is too coarse for them, NaN in the sky.
export function band_pass(grid, from, to) {
  const fine = smoothed(grid, from);
  const coarse = smoothed(grid, to);
  return fine.map((z, i) => z - coarse[i]);
}

// Means over so many metres along rows, then along columns; each twice, so that forms of other widths pass little.
function smoothed(grid, metres) {
  grid.pieces ??= [...pieces(grid, grid.broken_right, 1), ...pieces(grid, grid.broken_down, grid.width)];
  const out = Float32Array.from(grid.z);
  const sum = new Float64Array(Math.max(grid.width, grid.height) + 1);
  for (const piece of grid.pieces) for (let turn = 0; turn < 2; ++turn) average(out, piece, metres / Math.SQRT2, sum);
  return out;
}

// Ground without an edge in it along rows (stride 1) or columns: {first, stride, size, inverse: pixels for a metre}.
function pieces({ width, height, x, y, depth }, broken, stride) {
  const out = [];
  const [lines, count, next] = stride === 1 ? [height, width, width] : [width, height, 1];
  for (let line = 0; line < lines; ++line)
    for (let begin = 0, end; begin < count; begin = end) {
      const at = (k) => line * next + (begin + k) * stride;
      end = begin + 1;
      if (!Number.isFinite(depth[at(0)])) continue;
      while (end < count && !broken[at(end - 1 - begin)]) ++end;
      const size = end - begin;
      const length = new Float32Array(size); // in plan, up to each pixel
      for (let k = 1; k < size; ++k) length[k] = length[k - 1] + Math.hypot(x[at(k)] - x[at(k - 1)], y[at(k)] - y[at(k - 1)]);
      const inverse = length.map((_, k) => {
        const [a, b] = [Math.max(0, k - 2), Math.min(size - 1, k + 2)];
        return (b - a) / Math.max(1e-3, length[b] - length[a]);
      });
      if (size > 2) out.push({ first: at(0), stride, size, inverse });
    }
  return out;
}

// The mean of a piece over so many metres around each pixel, over less at its ends.
function average(values, { first, stride, size, inverse }, metres, sum) {
  const base = values[first];
  for (let k = 0; k < size; ++k) sum[k + 1] = sum[k] + values[first + k * stride] - base;
  for (let k = 0; k < size; ++k) {
    const half = Math.min(Math.max(0.5, 0.5 * metres * inverse[k]), k + 0.5, size - k - 0.5);
    if (half <= 0.5) continue;
    const [low, high] = [k + 0.5 - half, k + 0.5 + half];
    const [i, j] = [Math.floor(low), Math.min(size - 1, Math.floor(high))];
    const until = sum[j] + (high - j) * (sum[j + 1] - sum[j]) - sum[i] - (low - i) * (sum[i + 1] - sum[i]);
    values[first + k * stride] = base + until / (2 * half);
  }
}
