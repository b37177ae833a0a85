// The equalizer page: a preview that is redrawn while sliders and switches move. `equalizer` is written into the page before this file:
// terrains, presets, weights, switches and figures to check against.
"use strict";

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

function commandLine(weights, on) {
  const options = ["--global", "--ridges", "--valleys", "--background-global", "--background-ridges", "--background-valleys"];
  const far = [0, 1, 2].some((k) => weights[k].join() !== weights[k + 3].join());
  let text = `belvedere generalize ${equalizer.input} out.tif`;
  for (let k = 0; k < (far ? 6 : 3); ++k) {
    const zeros = k % 3 !== 0 && weights[k].every((v) => v === 0);
    // The background follows the foreground where nothing is said of it.
    if (!zeros || (k > 3 && weights[k - 3].some((v) => v !== 0))) text += ` ${options[k]}=${weights[k].join(",")}`;
  }
  for (const each of equalizer.switches) text += on[each.name] ? each.on_option : each.off_option;
  return (far ? `${text} ${equalizer.viewer}` : text) + equalizer.others;
}

// ---- the page

function start() {
  const weights = equalizer.weights.map((set) => set.slice());
  const on = Object.fromEntries(equalizer.switches.map((each) => [each.name, each.on]));
  const canvas = document.getElementById("preview");
  const prepared = new Map();
  let terrain = equalizer.terrains[0];
  let original = false;
  let waiting = false;
  const sliders = [];
  const boxes = new Map();

  function redraw() {
    waiting = false;
    if (!prepared.has(terrain)) prepared.set(terrain, prepare(terrain));
    const made = prepared.get(terrain);
    draw(canvas, original ? made.levels[0] : generalized(terrain, made, weights, on), terrain.cell);
    document.getElementById("command").textContent = commandLine(weights, on);
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
    for (const [name, box] of boxes) box.checked = on[name];
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
  for (const each of equalizer.switches) {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.id = `switch-${each.name}`;
    box.addEventListener("change", () => {
      on[each.name] = box.checked;
      changed();
    });
    label.append(box, each.label);
    document.getElementById("switches").append(label);
    boxes.set(each.name, box);
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
      on.foot = preset.foot;
      on.slope = preset.slope;
      show();
    });
  }
  for (const each of equalizer.terrains) button("views", each.name, () => { terrain = each; changed(); });
  button("views", "original / generalized", () => { original = !original; changed(); });
  document.getElementById("copy").addEventListener("click", () => navigator.clipboard.writeText(commandLine(weights, on)));
  show();
}

// Compares with what the program itself made of the same terrain, weights and masks: open the page with #self-check. A millimetre is a few
// last bits of an altitude. Where ground is level to such a bit its rounding decides which way a break line runs: one place in a hundred
// may be up to a centimetre off.
function selfCheck() {
  let most = 0, largest = 0;
  for (const check of equalizer.checks) {
    const terrain = equalizer.terrains[check.terrain];
    const out = generalized(terrain, prepare(terrain), check.weights, check.on);
    const off = check.altitudes.map(([index, altitude]) => Math.abs(out.values[index] - altitude)).sort((a, b) => a - b);
    most = Math.max(most, off[Math.floor(0.99 * off.length)]);
    largest = Math.max(largest, off[off.length - 1]);
  }
  const passed = most <= 0.001 && largest <= 0.01;
  const verdict = `self-check ${passed ? "passed" : "FAILED"}: ${most.toFixed(6)} m, at most ${largest.toFixed(6)} m`;
  document.title = verdict;
  document.getElementById("verdict").textContent = verdict;
}

start();
if (location.hash === "#self-check") selfCheck();
