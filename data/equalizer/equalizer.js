// The equalizer page: terrain generalization by bands, redrawn while sliders move. The equations are those of terrain/generalize.cpp,
// 1 to 5 of Jenny, Jenny & Hurni 2011. `equalizer` is written into the page before this file: terrains, presets, weights and figures to
// check against. A grid is { width, height, values }, row 0 in the north.
"use strict";

// ---- pyramid (renderer/base/pyramid.cpp): 5-tap kernel, borders extended linearly

function makeGrid(width, height) {
  return { width, height, values: new Float32Array(width * height) };
}

// line[margin … margin + count) is known; fills `margin` values on both sides.
function extendLine(line, count, margin) {
  const first = margin, last = margin + count - 1;
  for (let i = 1; i <= margin; ++i) {
    if (count === 1) {
      line[first - i] = line[last + i] = line[first];
    } else if (count === 2) {
      line[first - i] = line[first] + i * (line[first] - line[last]);
      line[last + i] = line[last] + i * (line[last] - line[first]);
    } else {
      line[first - i] = 2 * line[first] - line[first + i];
      line[last + i] = 2 * line[last] - line[last - i];
    }
  }
}

function reduceLine(line, count, out, outCount) {
  extendLine(line, count, 2);
  for (let i = 0; i < outCount; ++i) {
    const at = 2 * i + 2;
    out[i] = 0.4 * line[at] + 0.25 * (line[at - 1] + line[at + 1]) + 0.05 * (line[at - 2] + line[at + 2]);
  }
}

function expandLine(line, count, out, outCount) {
  extendLine(line, count, 2);
  for (let i = 0; i < outCount; ++i) {
    const at = (i >> 1) + 2;
    out[i] = i % 2 === 0 ? 0.8 * line[at] + 0.1 * (line[at - 1] + line[at + 1]) : 0.5 * (line[at] + line[at + 1]);
  }
}

// A line filter down the columns, then along the rows.
function filterGrid(grid, width, height, filterLine) {
  const longest = Math.max(grid.width, grid.height, width, height) + 4;
  const line = new Float64Array(longest), made = new Float64Array(longest);
  const tall = makeGrid(grid.width, height);
  for (let x = 0; x < grid.width; ++x) {
    for (let y = 0; y < grid.height; ++y) line[y + 2] = grid.values[y * grid.width + x];
    filterLine(line, grid.height, made, height);
    for (let y = 0; y < height; ++y) tall.values[y * grid.width + x] = made[y];
  }
  const out = makeGrid(width, height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < grid.width; ++x) line[x + 2] = tall.values[y * grid.width + x];
    filterLine(line, grid.width, made, width);
    for (let x = 0; x < width; ++x) out.values[y * width + x] = made[x];
  }
  return out;
}

function reduce(grid) {
  return filterGrid(grid, (grid.width + 1) >> 1, (grid.height + 1) >> 1, reduceLine);
}

function expand(grid, width, height) {
  return filterGrid(grid, width, height, expandLine);
}

// ---- break lines

// The grid with a rim of one cell that continues its slope.
function padded(grid) {
  const w = grid.width, h = grid.height, stride = w + 2;
  const out = new Float64Array(stride * (h + 2));
  for (let y = 0; y < h; ++y) {
    const row = (y + 1) * stride;
    for (let x = 0; x < w; ++x) out[row + x + 1] = grid.values[y * w + x];
    out[row] = 2 * out[row + 1] - out[row + 2];
    out[row + w + 1] = 2 * out[row + w] - out[row + w - 1];
  }
  for (let x = 0; x < stride; ++x) {
    out[x] = 2 * out[stride + x] - out[2 * stride + x];
    out[(h + 1) * stride + x] = 2 * out[h * stride + x] - out[(h - 1) * stride + x];
  }
  return out;
}

// Calls visit(index, p, q, r, s, t) with the quadric through each cell's 3 × 3 (Evans 1980, Young 1978).
function fitQuadrics(grid, cell, visit) {
  const z = padded(grid), stride = grid.width + 2;
  const ix = 1 / cell[0], iy = 1 / cell[1];
  for (let y = 0; y < grid.height; ++y) {
    for (let x = 0; x < grid.width; ++x) {
      const n = y * stride + x, m = n + stride, o = m + stride;
      const z1 = z[n], z2 = z[n + 1], z3 = z[n + 2], z4 = z[m], z5 = z[m + 1], z6 = z[m + 2], z7 = z[o], z8 = z[o + 1], z9 = z[o + 2];
      visit(y * grid.width + x,
            (z3 + z6 + z9 - z1 - z4 - z7) * ix / 6,
            (z1 + z2 + z3 - z7 - z8 - z9) * iy / 6,
            (z1 + z3 + z4 + z6 + z7 + z9 - 2 * (z2 + z5 + z8)) * ix * ix / 3,
            (z3 + z7 - z1 - z9) * ix * iy / 4,
            (z1 + z2 + z3 + z7 + z8 + z9 - 2 * (z4 + z5 + z6)) * iy * iy / 3);
    }
  }
}

const blurRadius = 3;  // of a Gaussian of one cell
const blurTaps = (() => {
  const taps = [];
  for (let k = -blurRadius; k <= blurRadius; ++k) taps.push(Math.exp(-0.5 * k * k));
  const sum = taps.reduce((a, b) => a + b);
  return taps.map((tap) => tap / sum);
})();

function blur(grid) {
  const w = grid.width, h = grid.height;
  const across = makeGrid(w, h), out = makeGrid(w, h);
  for (let y = 0; y < h; ++y) {
    for (let x = 0; x < w; ++x) {
      let sum = 0;
      for (let k = -blurRadius; k <= blurRadius; ++k) {
        sum += blurTaps[k + blurRadius] * grid.values[y * w + Math.min(Math.max(x + k, 0), w - 1)];
      }
      across.values[y * w + x] = sum;
    }
  }
  for (let y = 0; y < h; ++y) {
    for (let x = 0; x < w; ++x) {
      let sum = 0;
      for (let k = -blurRadius; k <= blurRadius; ++k) {
        sum += blurTaps[k + blurRadius] * across.values[Math.min(Math.max(y + k, 0), h - 1) * w + x];
      }
      out.values[y * w + x] = sum;
    }
  }
  return out;
}

// c of equation 4: |N/g²| · cell / full curvature, at most 1, blurred.
function breakLines(partialSum, cell) {
  const fullCurvature = 0.15;
  const gain = 0.5 * (cell[0] + cell[1]) / fullCurvature;
  const c = makeGrid(partialSum.width, partialSum.height);
  fitQuadrics(partialSum, cell, (i, p, q, r, s, t) => {
    const n = q * q * r - 2 * p * q * s + p * p * t;
    c.values[i] = Math.min(Math.abs(n) * gain / (p * p + q * q + 1e-12), 1);
  });
  return blur(c);
}

// How far a band adds convex detail around each cell, 0…1, by its profile curvature: the mean of p²r + 2pqs + q²t over the nine cells,
// which tells also on the very top of a roof, where p = q = 0.
function convexShare(band, cell) {
  const w = band.width, h = band.height;
  const spreadX = 2 / 3 * cell[0] * cell[0], spreadY = 2 / 3 * cell[1] * cell[1];
  const convex = new Float64Array(w * h), both = new Float64Array(w * h);
  fitQuadrics(band, cell, (i, p, q, r, s, t) => {
    const bendX = r * (r * r + 2 * s * s) + s * s * t;
    const bendY = t * (t * t + 2 * s * s) + s * s * r;
    const curve = p * p * r + 2 * p * q * s + q * q * t + spreadX * bendX + spreadY * bendY;
    both[i] = Math.abs(curve);
    convex[i] = 0.5 * (Math.abs(curve) - curve);
  });
  const out = makeGrid(w, h);
  for (let y = 0; y < h; ++y) {
    for (let x = 0; x < w; ++x) {
      let up = 0.59e-38, all = 1.18e-38;
      for (let dy = -1; dy <= 1; ++dy) {
        for (let dx = -1; dx <= 1; ++dx) {
          const i = Math.min(Math.max(y + dy, 0), h - 1) * w + Math.min(Math.max(x + dx, 0), w - 1);
          up += convex[i];
          all += both[i];
        }
      }
      out.values[y * w + x] = up / all;
    }
  }
  return out;
}

// ---- generalization

function decodeFloats(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const values = new Float32Array(bytes.length / 4);
  for (let i = 0; i < values.length; ++i) values[i] = view.getFloat32(4 * i, true);
  return values;
}

// 1 near, 0 far, by the distance from the viewer (equation 5's u_d).
function foregroundShare(terrain) {
  const share = makeGrid(terrain.width, terrain.height);
  const [vx, vy] = terrain.viewer, [near, far] = terrain.distances;
  for (let y = 0; y < share.height; ++y) {
    for (let x = 0; x < share.width; ++x) {
      const d = Math.hypot((x - vx) * terrain.cell[0], (y - vy) * terrain.cell[1]);
      const t = Math.min(Math.max((d - near) / (far - near), 0), 1);
      share.values[y * share.width + x] = 1 - t * t * (3 - 2 * t);
    }
  }
  return share;
}

// What no slider changes, finest level first.
function prepare(terrain) {
  const levels = [{ width: terrain.width, height: terrain.height, values: decodeFloats(terrain.altitude) }];
  const shares = [foregroundShare(terrain)];
  const bands = [], sides = [], cells = [];
  for (let i = 0; i < terrain.bands; ++i) {
    levels.push(reduce(levels[i]));
    shares.push(reduce(shares[i]));
    const smooth = expand(levels[i + 1], levels[i].width, levels[i].height);
    const band = makeGrid(smooth.width, smooth.height);
    for (let k = 0; k < band.values.length; ++k) band.values[k] = levels[i].values[k] - smooth.values[k];
    cells.push([terrain.cell[0] * 2 ** i, terrain.cell[1] * 2 ** i]);
    bands.push(band);
    sides.push(convexShare(band, cells[i]));
  }
  return { levels, shares, bands, sides, cells };
}

// A' - A by D_i = expand(D_i+1) + (w - 1) L_i; `weights` as in `equalizer.weights`, largest landforms first.
function change(terrain, made, weights) {
  let coarser = null;
  for (let i = terrain.bands - 1; i >= 0; --i) {
    const band = made.bands[i], w = band.width, h = band.height;
    const k = equalizer.bands - 1 - terrain.skipped - i;  // the slider of this band
    const [ng, nr, nv, fg, fr, fv] = weights.map((set) => set[k]);
    const below = coarser === null ? makeGrid(w, h) : expand(coarser, w, h);
    const sum = expand(made.levels[i + 1], w, h);
    for (let j = 0; j < sum.values.length; ++j) sum.values[j] += below.values[j];
    const local = nr !== 0 || nv !== 0 || fr !== 0 || fv !== 0;
    const c = local ? breakLines(sum, made.cells[i]) : null;
    const share = made.shares[i].values, convex = made.sides[i].values;
    for (let j = 0; j < below.values.length; ++j) {
      const near = Math.min(Math.max(share[j], 0), 1), far = 1 - near;
      let weight = near * ng + far * fg;
      if (local) weight += (convex[j] * (near * nr + far * fr) + (1 - convex[j]) * (near * nv + far * fv)) * c.values[j];
      below.values[j] += (weight - 1) * band.values[j];
    }
    coarser = below;
  }
  return coarser;
}

function generalized(terrain, made, weights) {
  const out = change(terrain, made, weights) || makeGrid(terrain.width, terrain.height);
  for (let j = 0; j < out.values.length; ++j) out.values[j] += made.levels[0].values[j];
  return out;
}

// ---- drawing

// Shaded relief as gdaldem makes it, light from the north-west at 45°.
function draw(canvas, grid, cell) {
  canvas.width = grid.width;
  canvas.height = grid.height;
  const context = canvas.getContext("2d");
  const image = context.createImageData(grid.width, grid.height);
  const w = grid.width, h = grid.height, z = grid.values;
  for (let y = 0; y < h; ++y) {
    const n = Math.max(y - 1, 0) * w, m = y * w, s = Math.min(y + 1, h - 1) * w;
    for (let x = 0; x < w; ++x) {
      const a = Math.max(x - 1, 0), b = Math.min(x + 1, w - 1);
      const east = (z[n + b] + 2 * z[m + b] + z[s + b] - z[n + a] - 2 * z[m + a] - z[s + a]) / (8 * cell[0]);
      const north = (z[n + a] + 2 * z[n + x] + z[n + b] - z[s + a] - 2 * z[s + x] - z[s + b]) / (8 * cell[1]);
      const light = (1 + (east - north) * Math.SQRT1_2) * Math.SQRT1_2 / Math.sqrt(1 + east * east + north * north);
      const grey = light > 0 ? 1 + 254 * light : 1;
      const at = 4 * (m + x);
      image.data[at] = image.data[at + 1] = image.data[at + 2] = grey;
      image.data[at + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
}

function commandLine(weights) {
  const options = ["--global", "--ridges", "--valleys", "--background-global", "--background-ridges", "--background-valleys"];
  const far = [0, 1, 2].some((k) => weights[k].join() !== weights[k + 3].join());
  let text = `belvedere generalize ${equalizer.input} out.tif`;
  for (let k = 0; k < (far ? 6 : 3); ++k) {
    const zeros = k % 3 !== 0 && weights[k].every((v) => v === 0);
    // The background follows the foreground where nothing is said of it.
    if (!zeros || (k > 3 && weights[k - 3].some((v) => v !== 0))) text += ` ${options[k]}=${weights[k].join(",")}`;
  }
  return far ? `${text} ${equalizer.viewer}` : text;
}

// ---- the page

function start() {
  const weights = equalizer.weights.map((set) => set.slice());
  const canvas = document.getElementById("preview");
  const prepared = new Map();
  let terrain = equalizer.terrains[0];
  let original = false;
  let waiting = false;
  const sliders = [];

  function redraw() {
    waiting = false;
    if (!prepared.has(terrain)) prepared.set(terrain, prepare(terrain));
    const made = prepared.get(terrain);
    draw(canvas, original ? made.levels[0] : generalized(terrain, made, weights), terrain.cell);
    document.getElementById("command").textContent = commandLine(weights);
    document.getElementById("unseen").textContent = terrain.skipped === 0 ? "" :
      `The ${terrain.skipped} smallest bands are finer than this preview shows: look at them in the close-up.`;
  }
  function changed() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(redraw);
  }
  function show() {
    for (const { input, label, set, band } of sliders) {
      input.value = weights[set][band];
      label.textContent = weights[set][band].toFixed(2);
    }
    changed();
  }

  const names = ["global", "ridges", "valleys"];
  for (let set = 0; set < 6; ++set) {
    const group = document.createElement("fieldset");
    group.innerHTML = `<legend>${set < 3 ? "foreground" : "background"}: ${names[set % 3]}</legend>`;
    for (let band = 0; band < equalizer.bands; ++band) {
      const slot = document.createElement("label");
      const input = document.createElement("input");
      const label = document.createElement("output");
      input.type = "range";
      input.min = set % 3 === 0 ? 0 : -2;
      input.max = 3;
      input.step = 0.05;
      input.setAttribute("orient", "vertical");
      input.title = `band ${band + 1}${band === 0 ? ", the largest landforms" : band === equalizer.bands - 1 ? ", the smallest" : ""}`;
      input.addEventListener("input", () => {
        weights[set][band] = Number(input.value);
        label.textContent = weights[set][band].toFixed(2);
        changed();
      });
      slot.append(label, input, String(band + 1));
      group.append(slot);
      sliders.push({ input, label, set, band });
    }
    document.getElementById(set < 3 ? "foreground" : "background").append(group);
  }
  function button(place, text, action) {
    const made = document.createElement("button");
    made.textContent = text;
    made.addEventListener("click", action);
    document.getElementById(place).append(made);
  }
  for (const preset of equalizer.presets) {
    button("presets", preset.name, () => {
      preset.weights.forEach((set, k) => set.forEach((v, band) => { weights[k][band] = v; }));
      show();
    });
  }
  for (const each of equalizer.terrains) button("views", each.name, () => { terrain = each; changed(); });
  button("views", "original / generalized", () => { original = !original; changed(); });
  document.getElementById("copy").addEventListener("click", () => navigator.clipboard.writeText(commandLine(weights)));
  show();
}

// Compares with what the program itself made of the same terrain and weights: open the page with #self-check.
function selfCheck() {
  let largest = 0;
  for (const check of equalizer.checks) {
    const terrain = equalizer.terrains[check.terrain];
    const out = generalized(terrain, prepare(terrain), check.weights);
    for (const [index, altitude] of check.altitudes) largest = Math.max(largest, Math.abs(out.values[index] - altitude));
  }
  const verdict = `self-check ${largest <= 0.01 ? "passed" : "FAILED"}: ${largest.toFixed(6)} m`;
  document.title = verdict;
  document.getElementById("verdict").textContent = verdict;
}

start();
if (location.hash === "#self-check") selfCheck();
