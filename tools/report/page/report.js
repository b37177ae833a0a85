// Draws the report that stands in the page: a title, and sections of texts, pictures, tables and charts. What all of them may hold stands
// in tools/report/report.h.
"use strict";

const report = JSON.parse(document.getElementById("report").textContent);

// An element with its attributes and what is in it; text is never markup.
function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

const svg_space = new DOMParser().parseFromString("<svg></svg>", "text/html").body.firstChild.namespaceURI;

function drawing(name, attributes = {}, text = "") {
  const made = document.createElementNS(svg_space, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
}

// A number as its column wants it: "" as it is, ".3f" with so many digits behind the point, ".3g" with so many in all, ".0%" as a share,
// "+.1f" with its sign.
function shown(value, format = "") {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return String(value);
  const [, sign, digits, kind] = /^(\+?)\.?(\d*)([fg%]?)$/.exec(format);
  const text = kind === "f" ? value.toFixed(digits) : kind === "g" ? String(Number(value.toPrecision(digits)))
    : kind === "%" ? `${(100 * value).toFixed(digits)} %` : String(value);
  return sign && value >= 0 ? `+${text}` : text;
}

function range(min, max) {
  const text = (value) => shown(value, Number.isInteger(value) ? "" : ".3g");
  if (max === null) return "–";
  if (min === max) return text(max);
  return min === 0 ? `≤ ${text(max)}` : `${text(min)} – ${text(max)}`;
}

// A line over a grey area, both 0…1, at places 0…1.
function curve({ places, line, area, colour }) {
  const width = 128, height = 64;
  const points = (values, of, room) => values.map((v, i) => `${(width * of[i]).toFixed(1)},${(height - room - (height - 2 * room) * v).toFixed(1)}`).join(" ");
  const svg = drawing("svg", { width, height });
  svg.append(drawing("rect", { width, height, fill: "#f4f4f4" }),
    drawing("polygon", { points: `0,${height} ${points(area, places, 0)} ${width},${height}`, fill: "#ccc" }),
    drawing("polyline", { points: points(line, places, 1), fill: "none", stroke: colour, "stroke-width": 2 }));
  return svg;
}

function cell(value, format) {
  if (value === null || typeof value !== "object") return element("td", {}, shown(value, format));
  if ("line" in value) return element("td", {}, curve(value));
  if ("colour" in value) return element("td", {}, element("span", { class: "swatch", style: `background:${value.colour}` }), value.colour);
  if ("max" in value) return element("td", {}, range(value.min, value.max));
  const text = shown(value.value, format);
  const td = element("td", {}, "href" in value ? element("a", { href: value.href }, text) : value.good === false ? element("b", {}, text) : text);
  if ("before" in value) td.append(element("small", {}, `${shown(value.before, ".3g")} → ${shown(value.after, ".3g")} ${value.unit}`));
  return td;
}

function table({ title, columns: all, rows }) {
  const columns = all.filter(({ format }) => format !== "hidden");
  const head = element("tr");
  for (const { title: name, meaning } of columns) head.append(element("th", meaning ? { title: meaning } : {}, name));
  const words = rows.length > 0 && rows.every((row) => columns.every(({ key }) => typeof row[key] === "string"));
  const body = element("table", words ? { class: "words" } : {}, head);
  for (const row of rows) body.append(element("tr", {}, ...columns.map(({ key, format }) => cell(row[key], format))));
  const box = element("div", { class: "wide" }, body);
  return title ? [element("h3", {}, title), box] : [box];
}

const image = ({ src, width, height, caption }) => element("img", { src, width, height, alt: caption });

function pictures(list) {
  const row = element("div", { class: "row" });
  for (const one of list)
    row.append(element("figure", { style: `max-width:${one.width}px` }, image(one), element("figcaption", {}, one.caption)));
  return [row];
}

// Two pictures of one size over each other: the first left of the slider.
function slider([left, right]) {
  const above = image(left);
  const show = (share) => { above.style.clipPath = `inset(0 ${100 - share}% 0 0)`; };
  const input = element("input", { type: "range", min: 0, max: 100, value: 50, style: `width:${left.width}px`,
    "aria-label": `${left.caption} on the left, ${right.caption} on the right` });
  input.addEventListener("input", () => show(input.value));
  show(50);
  return [element("div", { class: "slider", style: `width:${left.width}px;height:${left.height}px` }, image(right), above), input];
}

// Groups of bars, dark to light, a dashed line across at `line`.
function bars({ title, groups, max, line }) {
  const bar = 16, gap = 26, high = 160, top = 8;
  const count = groups[0].values.length;
  const step = count * bar + gap;
  const svg = drawing("svg", { width: groups.length * step + gap, height: high + 40, role: "img", "aria-label": title });
  groups.forEach(({ name, values }, s) => {
    const x0 = gap + s * step;
    values.forEach((value, b) => {
      // To a tenth of a pixel, as it is written: so all bars stand on one line.
      const height = Math.round(10 * Math.min(value || 0, max) * high / max) / 10;
      svg.append(drawing("rect", { x: x0 + b * bar, y: (top + high - height).toFixed(1), width: bar - 2, height: height.toFixed(1),
        fill: `hsl(205,45%,${25 + Math.floor(45 * b / Math.max(count - 1, 1))}%)` }));
    });
    svg.append(drawing("text", { x: x0 + count * bar / 2, y: top + high + 18, "text-anchor": "middle" }, name));
  });
  const y = top + high - high * line / max;
  svg.append(drawing("line", { x1: gap / 2, x2: groups.length * step + gap / 2, y1: y, y2: y, stroke: "#a33", "stroke-dasharray": "5 4" }));
  return [svg];
}

// A row a name: how often each value of 0…255 is there, black never, by red and yellow to white; below, in blue, which are asked for.
function coverage({ rows, scale }) {
  const names = 130, step = 3, high = 16, pitch = 24;
  const svg = drawing("svg", { width: names + 256 * step, height: rows.length * pitch + 22, role: "img" });
  const box = (x, y, width, height, fill) => svg.append(drawing("rect", { x, y, width, height, fill }));
  rows.forEach(({ name, counts, asked }, r) => {
    const y = r * pitch;
    svg.append(drawing("text", { x: 2, y: y + 12 }, name));
    box(names, y, 256 * step, high, "#000");
    // White is nearly the largest count, because the ends of a range may gather many; the root lets few be seen beside many.
    const some = counts.filter((n) => n > 0).sort((a, b) => a - b);
    const max = some[Math.floor((some.length - 1) * 19 / 20)];
    const light = (t) => Math.round(255 * Math.min(Math.max(t, 0), 1));
    counts.forEach((n, v) => {
      const t = 3 * Math.min(Math.sqrt(n / max), 1);
      if (n > 0) box(names + v * step, y, step, high, `rgb(${light(t)},${light(t - 1)},${light(t - 2)})`);
    });
    (asked || []).forEach((n, v) => { if (n > 0) box(names + v * step, y + high + 1, step, 3, "#1a4de6"); });
  });
  for (const [value, name] of scale) {
    const x = names + value * step;
    box(x, rows.length * pitch - 3, 1, 5, "#000");
    svg.append(drawing("text", { x: x + 2, y: rows.length * pitch + 14 }, name));
  }
  return [svg];
}

// The functions of a file of layers, plain numbers in its lines: points that are dragged, or moved by the arrow keys, and the file with them
// to be saved.
function functions({ file, text }) {
  const wide = 220, high = 110, edge = 8;
  const lines = text.split("\n");
  const box = element("div", { class: "functions" });
  let layer = "";
  lines.forEach((line, index) => {
    layer = /^name = "(.*)"$/.exec(line)?.[1] ?? layer;
    const found = /^(\w+) = \{ values = \[([\d., ]+)\]/.exec(line);
    if (!found) return;
    const values = found[2].split(",").map(Number);
    const svg = drawing("svg", { viewBox: `0 0 ${wide} ${high}`, width: wide, role: "group", "aria-label": `${layer}: ${found[1]}` });
    const curve = drawing("path", { fill: "none", stroke: "#357" });
    svg.append(drawing("rect", { x: edge, y: edge, width: wide - 2 * edge, height: high - 2 * edge, fill: "#fff", stroke: "#ddd" }), curve);
    const x = (k) => edge + (k * (wide - 2 * edge)) / (values.length - 1);
    const y = (value) => high - edge - value * (high - 2 * edge);
    const points = values.map((_, k) => {
      const point = drawing("circle", { cx: x(k), r: 3, fill: "#357", tabindex: k === 0 ? 0 : -1, role: "slider", "aria-valuemin": 0, "aria-valuemax": 1, "aria-label": `${found[1]}, ${k + 1} of ${values.length}` });
      svg.append(point);
      return point;
    });
    const draw = () => {
      curve.setAttribute("d", `M${values.map((value, k) => `${x(k).toFixed(1)},${y(value).toFixed(1)}`).join("L")}`);
      points.forEach((point, k) => { point.setAttribute("cy", y(values[k]).toFixed(1)); point.setAttribute("aria-valuenow", values[k]); });
      lines[index] = line.replace(found[2], values.join(", "));
    };
    const set = (k, value) => {
      values[k] = Math.round(1000 * Math.min(Math.max(value, 0), 1)) / 1000;
      draw();
    };
    // Whatever the hand passes over follows it, so that a curve can be drawn in one stroke.
    const follow = (event) => {
      const at = svg.getBoundingClientRect();
      const k = Math.round(((event.clientX - at.left) / at.width * wide - edge) / (wide - 2 * edge) * (values.length - 1));
      if (k >= 0 && k < values.length) set(k, 1 - ((event.clientY - at.top) / at.height * high - edge) / (high - 2 * edge));
    };
    svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); follow(event); });
    svg.addEventListener("pointermove", (event) => { if (svg.hasPointerCapture(event.pointerId)) follow(event); });
    svg.addEventListener("keydown", (event) => {
      const k = points.indexOf(event.target);
      const [aside, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 0.02], ArrowDown: [0, -0.02] }[event.key] ?? [0, 0];
      if (k < 0 || (!aside && !up)) return;
      event.preventDefault();
      if (up) set(k, values[k] + up);
      points[k + aside]?.focus();
    });
    draw();
    box.append(element("figure", {}, svg, element("figcaption", {}, `${layer}: ${found[1]}`)));
  });
  const save = element("button", { type: "button" }, `Save as ${file}`);
  save.addEventListener("click", () => {
    const address = URL.createObjectURL(new Blob([lines.join("\n")], { type: "application/toml" }));
    element("a", { href: address, download: file }).click();
    URL.revokeObjectURL(address);
  });
  return [box, save];
}

const kinds = {
  text: (text) => [element("p", {}, text)],
  small: (text) => [element("p", {}, element("small", {}, text))],
  list: (texts) => [element("ul", {}, ...texts.map((text) => element("li", {}, text)))],
  listing: (text) => [element("pre", {}, text)],
  pictures, table, slider, bars, coverage, functions,
};

const page = [element("h1", {}, report.title), element("p", {}, report.lead)];
if (report.command) page.push(element("pre", {}, report.command));
for (const { id, title, state, text, parts } of report.sections) {
  const section = element("section", { id });
  if (title) section.append(element("h2", state ? { class: state } : {}, title));
  if (text) section.append(element("p", {}, text));
  for (const part of parts) for (const [kind, value] of Object.entries(part)) section.append(...kinds[kind](value));
  page.push(section);
}
document.body.append(...page);
