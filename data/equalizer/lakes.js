// Lakes that keep their level, as terrain/generalize/generalize_lakes.cpp settles the land around them.
"use strict";

const surroundingsCells = 32, shoreCells = 6, reachCells = 48, blockCells = 4;
const meanTaps = gaussianTaps(10 / blockCells, 10);
const pullTaps = gaussianTaps(1.5, 6);

const smoothstep = (t) => t * t * (3 - 2 * t);

// Distance to the nearest lake cell, in cells; more than reachCells where that is too far to count.
function shoreDistances(width, height, lakes) {
  const far = 1e6;
  const down = new Float64Array(width * height).fill(far);  // to the nearest in the same column
  for (let x = 0; x < width; ++x) {
    let since = far;
    for (let y = 0; y < height; ++y) down[y * width + x] = since = lakes[y * width + x] !== 0 ? 0 : since + 1;
    since = far;
    for (let y = height - 1; y >= 0; --y) {
      since = lakes[y * width + x] !== 0 ? 0 : since + 1;
      down[y * width + x] = Math.min(down[y * width + x], since);
    }
  }
  const out = new Float32Array(width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      let least = far * far;
      for (let i = Math.max(x - reachCells, 0); i <= Math.min(x + reachCells, width - 1); ++i) {
        const g = down[y * width + i];
        least = Math.min(least, (i - x) * (i - x) + g * g);
      }
      out[y * width + x] = least <= reachCells * reachCells ? Math.sqrt(least) : 256;
    }
  }
  return out;
}

// What no slider changes.
function prepareShores(width, height, lakes) {
  const distance = shoreDistances(width, height, lakes);
  const across = Math.ceil(width / blockCells), along = Math.ceil(height / blockCells);
  const count = makeGrid(across, along), fade = makeGrid(across, along);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      if (lakes[y * width + x] !== 0) count.values[Math.floor(y / blockCells) * across + Math.floor(x / blockCells)] += 1;
    }
  }
  for (let j = 0; j < along; ++j) {
    for (let i = 0; i < across; ++i) {
      const x = Math.min(i * blockCells + blockCells / 2, width - 1), y = Math.min(j * blockCells + blockCells / 2, height - 1);
      fade.values[j * across + i] = 1 - smoothstep(unit(distance[y * width + x] / surroundingsCells));
    }
  }
  return { lakes, distance, fade, count: blur(count, meanTaps) };
}

// Weights of the four coefficients of a cubic B-spline around t in 0…1 after the second.
function splineWeights(t) {
  const u = 1 - t;
  return [u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6, t * t * t / 6];
}

function splineSample(grid, x, y) {
  const x0 = Math.floor(x), y0 = Math.floor(y);
  const wx = splineWeights(x - x0), wy = splineWeights(y - y0);
  let sum = 0;
  for (let j = 0; j < 4; ++j) {
    const row = Math.min(Math.max(y0 - 1 + j, 0), grid.height - 1) * grid.width;
    for (let i = 0; i < 4; ++i) sum += wx[i] * wy[j] * grid.values[row + Math.min(Math.max(x0 - 1 + i, 0), grid.width - 1)];
  }
  return sum;
}

// Takes `change` back to 0 in lakes, takes little of it beside them and leaves all of it farther off: the mean change of the lakes nearby
// goes from the land around, fading with the distance, and the rest at the shore itself.
function settleAroundLakes(change, shores) {
  const sum = makeGrid(shores.count.width, shores.count.height);
  for (let y = 0; y < change.height; ++y) {
    for (let x = 0; x < change.width; ++x) {
      const j = y * change.width + x;
      if (shores.lakes[j] !== 0) sum.values[Math.floor(y / blockCells) * sum.width + Math.floor(x / blockCells)] += change.values[j];
    }
  }
  let pull = blur(sum, meanTaps);
  pull.values.forEach((v, j, all) => {
    all[j] = shores.count.values[j] > 0 ? shores.fade.values[j] * v / shores.count.values[j] : 0;
  });
  pull = blur(pull, pullTaps);
  for (let y = 0; y < change.height; ++y) {
    for (let x = 0; x < change.width; ++x) {
      const j = y * change.width + x, distance = shores.distance[j];
      if (distance >= reachCells) continue;
      const u = (x - 0.5 * (blockCells - 1)) / blockCells, v = (y - 0.5 * (blockCells - 1)) / blockCells;
      change.values[j] = (change.values[j] - splineSample(pull, u, v)) * smoothstep(unit(distance / shoreCells));
    }
  }
}
