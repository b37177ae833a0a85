// The bend: how much level ground tilts towards the viewer, by distance. Either the parabola (radius and crest) or a curve through points
// that are dragged in a chart; the numbers stand below it.
import { row } from "./controls.js";
import { view } from "./camera.js";
import { clamp, draggable, drawing, element, rounded } from "./dom.js";
import { recall, remember } from "./memory.js";
import { new_step, running_step } from "./store.js";

const size = { width: 288, height: 132, left: 26, bottom: 18, top: 8, right: 8 };
const key = "deform.bend.points";
const names = ["radius_m", "crest_m", "far_from_m", "far_amount_per_m"].map((name) => `deform.bend.${name}`);
const fine_deg = 0.001; // a tenth of a degree is 170 m in 100 km
const degree = Math.PI / 180;

export class Bend {
  constructor(store) {
    this.store = store;
    this.grips = [];
    this.chart = drawing("svg", {
      class: "chart",
      viewBox: `0 0 ${size.width} ${size.height}`,
      role: "group",
      "aria-label": "Tilt of level ground by distance",
    });
    this.grid = drawing("g", { class: "grid" });
    this.line = drawing("path", { class: "line" });
    this.chart.append(this.grid, this.line);
    this.chart.addEventListener("dblclick", (event) => this.add(...this.place(event)));
    this.parabola = [
      { key: "deform.bend.radius_m", label: "Radius", unit: "m", min: 0, max: 1000000, step: 1000, log: 10000, otherwise: () => 0 },
      { key: "deform.bend.crest_m", label: "Level at", unit: "m", min: 0, max: 300000, step: 500, log: 1000, otherwise: () => 0 },
      { key: "deform.bend.far_from_m", label: "Sinks faster from", unit: "m", min: 0, max: 300000, step: 500, log: 1000 },
      { key: "deform.bend.far_amount_per_m", label: "How much faster", unit: "1/m", min: 0, max: 0.0001, step: 0.0000001 },
    ].map((spec) => row(store, { ...spec, when: () => store.count(key) === 0 }));
    this.table = element("div", { class: "points" });
    this.by_points = element("button", { type: "button", class: "wide", click: () => this.to_points() }, "Shape it by points");
    this.one_more = element("button", { type: "button", class: "wide", click: () => this.add_one() }, "One point more");
    this.by_parabola = element("button", { type: "button", class: "wide", click: () => this.to_parabola() }, "Back to the parabola");
    this.element = element(
      "div",
      { class: "bend" },
      this.chart,
      ...this.parabola.slice(0, 2).map((each) => each.element),
      this.table,
      this.by_points,
      this.one_more,
      this.by_parabola,
    );
    this.more = element("section", {}, element("h3", {}, "Bend in the distance"), ...this.parabola.slice(2).map((each) => each.element));
  }
  rows() {
    return this.parabola;
  }

  points() {
    return Array.from({ length: this.store.count(key) }, (_, index) => ({
      distance: this.store.value(`${key}.${index}.distance_m`) ?? 0,
      tilt: this.store.value(`${key}.${index}.inclination_deg`),
      drop: this.store.value(`${key}.${index}.drop_m`),
    }));
  }
  // The tilt of the parabola, °: drop = (d - crest)² / (2 radius) + [d > far_from] far_amount (d - far_from)².
  tilt(distance) {
    const radius = this.store.number("deform.bend.radius_m") ?? 0;
    const crest = this.store.number("deform.bend.crest_m") ?? 0;
    const far = this.store.number("deform.bend.far_from_m") ?? 0;
    const more = this.store.number("deform.bend.far_amount_per_m") ?? 0;
    const slope = (radius > 0 ? (crest - distance) / radius : 0) - (distance > far ? 2 * more * (distance - far) : 0);
    return Math.atan(slope) / degree;
  }

  update() {
    const points = this.points();
    this.drops = points.some((each) => each.drop !== undefined);
    const crest = this.store.number("deform.bend.crest_m") ?? 60000;
    // While a point is held the chart keeps its scale.
    if (!this.held) {
      this.far = Math.max(20000, 1.3 * crest * (points.length === 0), 1.2 * Math.max(0, ...points.map((each) => each.distance)));
      const values =
        points.length > 0 ? points.map((each) => (this.drops ? each.drop : each.tilt) ?? 0) : [this.tilt(0), this.tilt(this.far)];
      this.top = this.drops ? Math.max(500, 1.2 * Math.max(...values)) : Math.max(20, 5 * Math.ceil(Math.max(...values) / 5 + 0.5));
      this.bottom = this.drops ? Math.min(0, 1.2 * Math.min(...values)) : Math.min(-5, 5 * Math.floor(Math.min(...values) / 5 - 0.2));
    }
    this.draw_grid();
    this.line.setAttribute("d", points.length > 0 ? this.curve(points) : this.parabola_line());
    this.show_grips(points);
    this.show_table(points);
    for (const each of this.parabola) each.update();
    this.more.hidden = points.length > 0;
    this.by_points.hidden = points.length > 0;
    this.one_more.hidden = this.by_parabola.hidden = points.length === 0;
  }
  x(distance) {
    return size.left + ((size.width - size.left - size.right) * distance) / this.far;
  }
  y(value) {
    return size.top + ((size.height - size.top - size.bottom) * (this.top - value)) / (this.top - this.bottom);
  }
  place(event) {
    const box = this.chart.getBoundingClientRect();
    const [px, py] = [((event.clientX - box.left) * size.width) / box.width, ((event.clientY - box.top) * size.height) / box.height];
    return [
      ((px - size.left) / (size.width - size.left - size.right)) * this.far,
      this.top - ((py - size.top) / (size.height - size.top - size.bottom)) * (this.top - this.bottom),
    ];
  }

  draw_grid() {
    const parts = [];
    const step = [5, 10, 20, 50, 100, 200].find((km) => this.far / 1000 / km <= 6) ?? 500;
    for (let km = 0; km * 1000 <= this.far; km += step) {
      const x = this.x(km * 1000);
      parts.push(
        drawing("path", { d: `M${x},${size.top}V${size.height - size.bottom}` }),
        drawing("text", { x, y: size.height - 5, "text-anchor": "middle" }, km === 0 ? "0 km" : String(km)),
      );
    }
    const unit = this.drops
      ? ([100, 500, 1000, 2000, 5000].find((m) => (this.top - this.bottom) / m <= 6) ?? 20000)
      : this.top - this.bottom > 40
        ? 20
        : 10;
    for (let value = Math.ceil(this.bottom / unit) * unit; value <= this.top; value += unit) {
      const y = this.y(value);
      parts.push(
        drawing("path", { d: `M${size.left},${y}H${size.width - size.right}`, class: value === 0 ? "zero" : "" }),
        drawing("text", { x: size.left - 4, y: y + 3.5, "text-anchor": "end" }, this.drops ? String(value) : `${value}°`),
      );
    }
    this.grid.replaceChildren(...parts);
  }
  parabola_line() {
    return Array.from(
      { length: 41 },
      (_, k) =>
        `${k === 0 ? "M" : "L"}${this.x((k / 40) * this.far).toFixed(1)},${clamp(this.y(this.tilt((k / 40) * this.far)), -50, 400).toFixed(1)}`,
    ).join("");
  }
  // Through the points without overshooting (monotone cubic, as the program draws it), level beyond the ends.
  curve(points) {
    const p = points.map((each) => [this.x(each.distance), this.y((this.drops ? each.drop : each.tilt) ?? 0)]);
    const slope = p.slice(1).map((q, k) => (q[1] - p[k][1]) / Math.max(1e-6, q[0] - p[k][0]));
    const at = p.map((_, k) =>
      k === 0 || k === p.length - 1
        ? (slope[Math.min(k, slope.length - 1)] ?? 0)
        : slope[k - 1] * slope[k] <= 0
          ? 0
          : (2 * slope[k - 1] * slope[k]) / (slope[k - 1] + slope[k]),
    );
    let path = `M${size.left},${p[0][1]}L${p[0].join()}`;
    for (let k = 1; k < p.length; ++k) {
      const third = (p[k][0] - p[k - 1][0]) / 3;
      path += `C${p[k - 1][0] + third},${p[k - 1][1] + third * at[k - 1]} ${p[k][0] - third},${p[k][1] - third * at[k]} ${p[k].join()}`;
    }
    return `${path}H${size.width - size.right}`;
  }

  show_grips(points) {
    while (this.grips.length > points.length) this.grips.pop().remove();
    while (this.grips.length < points.length) this.grips.push(this.grip(this.grips.length));
    points.forEach((each, index) => {
      const value = (this.drops ? each.drop : each.tilt) ?? 0;
      this.grips[index].setAttribute("transform", `translate(${this.x(each.distance).toFixed(1)},${this.y(value).toFixed(1)})`);
      this.grips[index].setAttribute(
        "aria-label",
        `Point ${index + 1}: ${(each.distance / 1000).toFixed(1)} km, ${rounded(value, 0.1)} ${this.drops ? "m" : "°"}; arrow keys move it, Delete removes it`,
      );
    });
  }
  grip(index) {
    const grip = drawing(
      "g",
      { class: "grip", tabindex: 0, role: "button" },
      drawing("circle", { r: 13, class: "room" }),
      drawing("circle", { r: 5 }),
    );
    draggable(grip, {
      start: () => {
        grip.focus();
        this.held = true;
        return new_step();
      },
      move: (event, step) => {
        const [distance, value] = this.place(event);
        this.move(index, distance, rounded(value, 0.1), step);
      },
      end: () => {
        this.held = false;
        this.update();
      },
    });
    grip.addEventListener("keydown", (event) => {
      const coarse = event.shiftKey ? 10 : 1;
      const point = this.points()[index];
      const value = (this.drops ? point.drop : point.tilt) ?? 0;
      const unit = this.drops ? 10 : 0.1;
      const to = {
        ArrowLeft: [point.distance - 100 * coarse, value],
        ArrowRight: [point.distance + 100 * coarse, value],
        ArrowUp: [point.distance, value + unit * coarse],
        ArrowDown: [point.distance, value - unit * coarse],
      }[event.key];
      if (event.key === "Delete" || event.key === "Backspace") this.remove(index);
      else if (to) this.move(index, ...to, running_step(`bend-${index}`));
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
    this.chart.append(grip);
    return grip;
  }
  move(index, distance, value, step) {
    const points = this.points();
    const low = index > 0 ? points[index - 1].distance + 100 : 0;
    const high = index + 1 < points.length ? points[index + 1].distance - 100 : 1e8;
    const at = `${key}.${index}`;
    this.store.edit(
      [
        { key: `${at}.distance_m`, value: clamp(rounded(distance, 1), low, high) },
        this.drops
          ? { key: `${at}.drop_m`, value: Math.round(value) }
          : { key: `${at}.inclination_deg`, value: clamp(rounded(value, fine_deg), -80, 80) },
      ],
      step,
    );
  }

  show_table(points) {
    if (this.table.children.length !== points.length) {
      this.table_rows = points.map((_, index) => this.table_row(index));
      this.table.replaceChildren(...this.table_rows.map((each) => each.element));
    }
    points.forEach((each, index) => {
      const { distance, value, unit } = this.table_rows[index];
      if (document.activeElement !== distance) distance.value = rounded(each.distance / 1000, 0.1);
      if (document.activeElement !== value) value.value = rounded((this.drops ? each.drop : each.tilt) ?? 0, 0.1);
      unit.textContent = this.drops ? "m" : "°";
    });
  }
  table_row(index) {
    const distance = element("input", { type: "number", step: 0.1, min: 0, "aria-label": `Point ${index + 1}, distance in km` });
    const value = element("input", { type: "number", step: 0.1, "aria-label": `Point ${index + 1}, value` });
    const unit = element("span", { class: "unit" });
    // The other number keeps the digits that are not shown.
    const now = () => this.points()[index];
    distance.addEventListener("change", () =>
      this.move(index, 1000 * Number(distance.value), (this.drops ? now().drop : now().tilt) ?? 0, new_step()),
    );
    value.addEventListener("change", () => this.move(index, now().distance, Number(value.value), new_step()));
    const remove = element(
      "button",
      { type: "button", class: "remove", "aria-label": `Remove point ${index + 1}`, title: "Remove", click: () => this.remove(index) },
      "×",
    );
    return { distance, value, unit, element: element("div", {}, distance, element("span", { class: "unit" }, "km"), value, unit, remove) };
  }

  // New blocks stand at the end of the list, and distances must increase: the whole list is written again.
  write(points, more = []) {
    const away = this.points()
      .map((_, index) => ({ key: `${key}.${index}`, remove: true }))
      .reverse();
    const made = points.map((each) => ({
      key,
      append: this.drops
        ? { distance_m: Math.round(each.distance), drop_m: Math.round(each.drop) }
        : { distance_m: Math.round(each.distance), inclination_deg: rounded(each.tilt, fine_deg) },
    }));
    this.store.edit([...more, ...away, ...made], new_step());
  }
  add(distance, value) {
    const points = this.points();
    if (points.length === 0) return;
    points.push(this.drops ? { distance, drop: value } : { distance, tilt: clamp(value, -80, 80) });
    this.write(points.sort((a, b) => a.distance - b.distance));
  }
  add_one() {
    // In the widest gap.
    const points = this.points();
    let best = 1;
    for (let k = 1; k < points.length; ++k)
      if (points[k].distance - points[k - 1].distance > points[best].distance - points[best - 1].distance) best = k;
    const [a, b] = [points[best - 1], points[best]];
    this.add((a.distance + b.distance) / 2, this.drops ? (a.drop + b.drop) / 2 : (a.tilt + b.tilt) / 2);
  }
  remove(index) {
    if (this.points().length > 2) this.store.edit([{ key: `${key}.${index}`, remove: true }], new_step());
    else this.to_parabola();
  }
  // Where the data end, as seen from the viewer, and beyond the crest.
  far_end() {
    const { extent } = this.store.map ?? {};
    const [x, y] = view(this.store).viewer;
    const corners = extent ? [0, 2].flatMap((k) => [1, 3].map((l) => Math.hypot(extent[k] - x, extent[l] - y))) : [];
    return Math.max(20000, 1.3 * (this.store.number("deform.bend.crest_m") ?? 0), ...corners);
  }
  // The same curve through points. Its tilt is straight by distance but for a bend where the ground begins to sink faster, with two points
  // close by that keep it straight on both sides.
  to_points() {
    const far = this.far_end();
    const crest = this.store.number("deform.bend.crest_m") || far / 2;
    const faster = this.store.number("deform.bend.far_amount_per_m") > 0 ? this.store.number("deform.bend.far_from_m") : 0;
    const close = 0.02 * far;
    const wanted = [0, crest / 2, crest, far, ...(faster > 0 && faster < far ? [faster - close, faster, faster + close] : [])];
    const distances = [];
    for (const each of wanted.sort((a, b) => a - b))
      if (each >= 0 && each <= far && each - (distances.at(-1) ?? -Infinity) >= close / 2) distances.push(each);
    const given = names.filter((name) => this.store.given(name)).map((name) => ({ key: name, value: this.store.value(name) }));
    remember("parabola", given);
    this.drops = false;
    this.write(
      distances.map((distance) => ({ distance, tilt: this.tilt(distance) })),
      given.map((each) => ({ key: each.key, remove: true })),
    );
  }
  // The parabola that was there before the points; the program's own where there was none.
  to_parabola() {
    const away = this.points().map((_, index) => ({ key: `${key}.${index}`, remove: true }));
    this.store.edit([...away.reverse(), ...(recall("parabola") ?? [])], new_step());
  }
}
