// Terrain generalization by bands, as terrain/generalize/generalize.cpp does it: equations 1 to 6 of Jenny, Jenny & Hurni 2011. `equalizer` is written
// into the page before this file. A grid is { width, height, values }, row 0 in the north.
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

// A Gaussian's weights from the middle outwards; every one but the first counts twice.
function gaussianTaps(sigma, radius) {
  const taps = [];
  for (let k = 0; k <= radius; ++k) taps.push(Math.exp(-0.5 * k * k / (sigma * sigma)));
  const sum = 2 * taps.reduce((a, b) => a + b) - taps[0];
  return taps.map((tap) => tap / sum);
}

// Along the rows, then down the columns; borders replicated.
function blur(grid, taps) {
  const w = grid.width, h = grid.height, z = grid.values;
  const across = makeGrid(w, h), out = makeGrid(w, h);
  for (let y = 0; y < h; ++y) {
    for (let x = 0; x < w; ++x) {
      let sum = taps[0] * z[y * w + x];
      for (let k = 1; k < taps.length; ++k) sum += taps[k] * (z[y * w + Math.max(x - k, 0)] + z[y * w + Math.min(x + k, w - 1)]);
      across.values[y * w + x] = sum;
    }
  }
  for (let y = 0; y < h; ++y) {
    for (let x = 0; x < w; ++x) {
      let sum = taps[0] * across.values[y * w + x];
      for (let k = 1; k < taps.length; ++k) {
        sum += taps[k] * (across.values[Math.max(y - k, 0) * w + x] + across.values[Math.min(y + k, h - 1) * w + x]);
      }
      out.values[y * w + x] = sum;
    }
  }
  return out;
}

// c of equation 4: |N/g²| (or N/g³) · cell / full curvature, at most 1, blurred, to the power of the exponent, as `equalizer.lines` says.
function breakLines(partialSum, cell) {
  const { plan, full, blur: sigma, exponent } = equalizer.lines;
  const gain = 0.5 * (cell[0] + cell[1]) / full;
  const c = makeGrid(partialSum.width, partialSum.height);
  fitQuadrics(partialSum, cell, (i, p, q, r, s, t) => {
    const n = q * q * r - 2 * p * q * s + p * p * t;
    const g2 = p * p + q * q + (plan ? 1e-6 : 1e-12);
    c.values[i] = exponent === 0 ? 1 : Math.min(Math.abs(n) * gain / (plan ? g2 * Math.sqrt(g2) : g2), 1);
  });
  if (exponent === 0) return c;
  const made = sigma > 0 ? blur(c, gaussianTaps(sigma, Math.max(1, Math.ceil(3 * sigma)))) : c;
  if (exponent !== 1) made.values.forEach((v, i, values) => { values[i] = v > 1e-37 ? Math.min(v, 1) ** exponent : 0; });
  return made;
}

// The mean of 3 × 3 cells by 1 2 1 across and down.
function binomialMean(band) {
  const z = padded(band), stride = band.width + 2, out = makeGrid(band.width, band.height);
  for (let y = 0; y < band.height; ++y) {
    for (let x = 0; x < band.width; ++x) {
      const n = y * stride + x, m = n + stride, o = m + stride;
      const west = z[n] + z[o] + 2 * z[m], middle = z[n + 1] + z[o + 1] + 2 * z[m + 1], east = z[n + 2] + z[o + 2] + 2 * z[m + 2];
      out.values[y * band.width + x] = (west + east + 2 * middle) / 16;
    }
  }
  return out;
}

// How far the ridge set counts at each cell, 0…1: by the sign of the band's profile curvature, -(p²r + 2pqs + q²t), where that is clear, else
// by that of the mean around the cell.
function convexShare(band, cell) {
  const out = makeGrid(band.width, band.height);
  const spreadX = 2 / 3 * cell[0] * cell[0], spreadY = 2 / 3 * cell[1] * cell[1];
  const mean = binomialMean(band);
  fitQuadrics(mean, cell, (i, p, q, r, s, t) => {
    const bendX = r * (r * r + 2 * s * s) + s * s * t;
    const bendY = t * (t * t + 2 * s * s) + s * s * r;
    const around = p * p * r + 2 * p * q * s + q * q * t + spreadX * bendX + spreadY * bendY;
    // The squares have units of their own: (p² + q²) / cell² stands beside r².
    const size = ((p * p + q * q) / (cell[0] * cell[1]) + 2 / 3 * (r * r + t * t + 2 * s * s)) * Math.abs(mean.values[i]);
    out.values[i] = Math.min(Math.max(0.5 - around / (0.1 * size + 1e-300), 0), 1);
  });
  fitQuadrics(band, cell, (i, p, q, r, s, t) => {
    const own = p * p * r + 2 * p * q * s + q * q * t;
    const unclear = 0.22 * ((p * p + q * q) / (cell[0] * cell[1]) + 0.01 * (r * r + t * t + 2 * s * s)) * Math.abs(band.values[i]);
    const rules = Math.min(Math.abs(own) / (unclear + 1e-300), 1);
    out.values[i] += rules * ((own < 0 ? 1 : 0) - out.values[i]);
  });
  return out;
}

// ---- generalization

function decodeBytes(base64) {
  return Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
}

function decodeFloats(base64) {
  const bytes = decodeBytes(base64);
  const view = new DataView(bytes.buffer);
  const values = new Float32Array(bytes.length / 4);
  for (let i = 0; i < values.length; ++i) values[i] = view.getFloat32(4 * i, true);
  return values;
}

// Equation 5's u_d: 1 near, 0 far, straight between, with corners rounded over an eighth of the span on either side.
function shareAt(t) {
  const rounding = 0.125;
  const corner = (along) => along * along / (4 * rounding);
  if (t <= -rounding) return 1;
  if (t < rounding) return 1 - corner(t + rounding);
  if (t <= 1 - rounding) return 1 - t;
  return t < 1 + rounding ? corner(1 + rounding - t) : 0;
}

function foregroundShare(terrain) {
  const share = makeGrid(terrain.width, terrain.height);
  const [vx, vy] = terrain.viewer, [near, far] = terrain.distances;
  for (let y = 0; y < share.height; ++y) {
    for (let x = 0; x < share.width; ++x) {
      const d = Math.hypot((x - vx) * terrain.cell[0], (y - vy) * terrain.cell[1]);
      share.values[y * share.width + x] = shareAt((d - near) / (far - near));
    }
  }
  return share;
}

const unit = (v) => Math.min(Math.max(v, 0), 1);

// The Gaussian levels of a grid; coarser ones may come from another.
function levelsOf(finest, count, coarsened = finest) {
  const levels = [finest];
  for (let i = 1; i < count; ++i) levels.push(reduce(i === 1 ? coarsened : levels[i - 1]));
  return levels;
}

// What no slider changes, finest level first.
function prepare(terrain) {
  const grid = (name) =>
    terrain[name] === undefined ? null : { width: terrain.width, height: terrain.height, values: decodeFloats(terrain[name]) };
  const levels = levelsOf(grid("altitude"), terrain.bands + 1);
  const bands = [], sides = [], cells = [];
  for (let i = 0; i < terrain.bands; ++i) {
    const smooth = expand(levels[i + 1], levels[i].width, levels[i].height);
    const band = makeGrid(smooth.width, smooth.height);
    for (let k = 0; k < band.values.length; ++k) band.values[k] = levels[i].values[k] - smooth.values[k];
    cells.push([terrain.cell[0] * 2 ** i, terrain.cell[1] * 2 ** i]);
    bands.push(band);
    sides.push(convexShare(band, cells[i]));
  }
  const foot = grid("foot");
  return {
    levels, bands, sides, cells,
    shares: levelsOf(foregroundShare(terrain), terrain.bands),
    feet: foot === null ? null : levelsOf(foot, terrain.bands),
    slope: grid("slope"),
    drawn: grid("drawn"),
    shores: terrain.lakes === undefined ? null : prepareShores(terrain.width, terrain.height, decodeBytes(terrain.lakes)),
    masks: new Map(),
  };
}

// The levels of equation 6's mask as the switches `on` stand; null where all is generalized. Coarser levels see lakes as masked.
function masksOf(terrain, made, on) {
  const slope = on.slope ? made.slope : null, drawn = on.drawn ? made.drawn : null;
  const lakes = on.lakes && made.shores !== null ? made.shores.lakes : null;
  const key = [slope, drawn, lakes].map((grid) => grid !== null).join();
  if (!made.masks.has(key)) {
    let finest = null;
    if (slope !== null || drawn !== null || lakes !== null) {
      finest = makeGrid(terrain.width, terrain.height);
      finest.values.forEach((_, j, v) => { v[j] = (slope === null ? 1 : slope.values[j]) * (drawn === null ? 1 : drawn.values[j]); });
    }
    let coarsened = finest;
    if (lakes !== null) {
      coarsened = makeGrid(terrain.width, terrain.height);
      coarsened.values.forEach((_, j, v) => { v[j] = lakes[j] !== 0 ? 0 : finest.values[j]; });
    }
    made.masks.set(key, finest === null ? null : levelsOf(finest, terrain.bands, coarsened));
  }
  return made.masks.get(key);
}

// A' - A by D_i = expand(D_i+1) + (w - 1) L_i; `weights` as in `equalizer.weights`, largest landforms first.
function change(terrain, made, weights, on) {
  const masks = masksOf(terrain, made, on);
  const feet = on.foot ? made.feet : null;
  const lakes = on.lakes && made.shores !== null ? made.shores.lakes : null;
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
      const near = unit(share[j]), far = 1 - near;
      let weight = near * ng + far * fg;
      if (local) weight += (convex[j] * (near * nr + far * fr) + (1 - convex[j]) * (near * nv + far * fv)) * c.values[j];
      let gain = weight - 1;
      if (feet !== null && gain > 0) gain *= unit(feet[i].values[j]);
      if (masks !== null) gain *= unit(masks[i].values[j]);
      if (i === 0 && lakes !== null && lakes[j] !== 0) gain = 0;
      below.values[j] += gain * band.values[j];
    }
    coarser = below;
  }
  if (coarser !== null && lakes !== null) settleAroundLakes(coarser, made.shores);
  return coarser;
}

function generalized(terrain, made, weights, on) {
  const out = change(terrain, made, weights, on) || makeGrid(terrain.width, terrain.height);
  for (let j = 0; j < out.values.length; ++j) out.values[j] += made.levels[0].values[j];
  return out;
}
