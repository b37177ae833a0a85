// The map beside the picture: relief from above, the data's edge, the view's cone, and what can be moved on it: viewer, target, handles,
// lights and mist.
import { api } from "./api.js";
import { placed, view } from "./camera.js";
import { by_id, draggable, drawing } from "./dom.js";
import { new_step, running_step } from "./store.js";

// Blocks with a position, and how they are called.
const blocks = [
  { key: "deform.handles", name: "handle", sign: "handle" },
  { key: "deform.summits", name: "summit", sign: "handle" },
  { key: "light.regions", name: "light", sign: "light" },
  { key: "light.clouds", name: "cloud shadow", sign: "cloud" },
  { key: "air.mist", name: "mist", sign: "mist" },
];
// Distances from the viewer that a panel is about, as arcs in the cone.
const distances = {
  equalizer: ["generalize.foreground_to_m", "generalize.background_from_m"],
  ground: ["deform.foreground_to_m", "deform.background_from_m"],
  air: ["air.from_m"],
};
const near_px = 6; // clicks so near mean one place
// The relief changes only with these.
const ground = /^(terrain|generalize|land_cover|deform\.handles|deform\.summits)\b/;

export class Map_view {
  constructor(store, hands) {
    this.store = store;
    this.box = by_id("map");
    this.relief = by_id("relief");
    this.relief.addEventListener("error", () => {
      this.relief_of = null;
      this.relief.removeAttribute("src");
    });
    this.relief_of = null;
    this.signs = new Map();
    this.layer = {
      cone: drawing("path", { class: "cone" }),
      edge: drawing("path", { class: "edge" }),
      circles: drawing("g"),
      signs: drawing("g"),
    };
    by_id("signs").append(this.layer.edge, this.layer.circles, this.layer.cone, this.layer.signs);
    store.on("changed", ({ before, state }) => {
      const names = new Set([...Object.keys(before.values), ...Object.keys(state.values)].filter((key) => ground.test(key)));
      if ([...names].some((key) => JSON.stringify(before.values[key]) !== JSON.stringify(state.values[key]))) this.relief_of = null;
    });
    for (const kind of ["pending", "state", "panel", "lines"]) store.on(kind, () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.box);
    this.box.addEventListener("click", (event) => hands.pick && this.store.map && hands.placed(this.to_ground(event), near_px / this.scale));
  }

  // When the hand rests: what the program has found, and the relief if it has changed.
  async read() {
    try {
      this.store.map = await api.map();
    } catch (error) {
      return this.store.fail(error);
    }
    if (this.relief_of === null) {
      this.relief_of = this.store.map.revision;
      this.relief.src = api.map_picture(this.store.map.revision);
    }
    this.store.tell("map");
    this.draw();
  }

  // The map shows the data and the viewer, who may stand outside of them.
  frame() {
    const { extent } = this.store.map;
    const { viewer } = view(this.store);
    // While a sign is held the map stays.
    if (!this.held || !this.framed) {
      const pad = 0.06 * Math.max(extent[2] - extent[0], extent[3] - extent[1]);
      this.framed = [
        Math.min(extent[0], viewer[0]) - pad,
        Math.min(extent[1], viewer[1]) - pad,
        Math.max(extent[2], viewer[0]) + pad,
        Math.max(extent[3], viewer[1]) + pad,
      ];
    }
    const [w, h] = [this.box.clientWidth, this.box.clientHeight];
    const [x0, y0, x1, y1] = this.framed;
    this.scale = Math.min(w / (x1 - x0), h / (y1 - y0)); // px for a metre
    this.origin = [w / 2 - (this.scale * (x0 + x1)) / 2, h / 2 + (this.scale * (y0 + y1)) / 2];
  }
  to_page([east, north]) {
    return [this.origin[0] + this.scale * east, this.origin[1] - this.scale * north];
  }
  to_ground(event) {
    const box = this.box.getBoundingClientRect();
    return [(event.clientX - box.left - this.origin[0]) / this.scale, (this.origin[1] - event.clientY + box.top) / this.scale];
  }

  draw() {
    if (!this.store.map || this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw_now();
    });
  }
  draw_now() {
    this.frame();
    const { extent } = this.store.map;
    const from = view(this.store);
    const [left, top] = this.to_page([extent[0], extent[3]]);
    const [right, bottom] = this.to_page([extent[2], extent[1]]);
    Object.assign(this.relief.style, { left: `${left}px`, top: `${top}px`, width: `${right - left}px`, height: `${bottom - top}px` });
    this.layer.edge.setAttribute("d", `M${left},${top}H${right}V${bottom}H${left}Z`);

    const at = this.to_page(from.viewer);
    const reach = Math.hypot(this.box.clientWidth, this.box.clientHeight);
    this.layer.cone.setAttribute("d", from.parallel ? "" : cone(at, from.azimuth, Math.min(from.field, 359), reach));

    const wanted = new Set();
    this.layer.circles.replaceChildren();
    for (const key of distances[document.body.dataset.panel] ?? []) {
      const far = this.scale * this.store.number(key);
      if (far > 0 && !from.parallel)
        this.layer.circles.append(drawing("path", { class: "distance", d: arc(at, from.azimuth, Math.min(from.field, 359), far) }));
    }
    for (const line of this.store.lines?.() ?? [])
      this.layer.circles.append(drawing("path", { class: "line", d: `M${line.map((each) => this.to_page(each).join()).join("L")}` }));
    for (const { key, name, sign } of blocks)
      for (let index = 0; index < this.store.count(key); ++index) {
        const outline = this.store.value(`${key}.${index}.points`);
        if (outline)
          this.layer.circles.append(drawing("path", { class: sign, d: `M${outline.map((each) => this.to_page(each).join()).join("L")}Z` }));
        const position = this.store.value(`${key}.${index}.position`) ?? this.found(key, index);
        if (!position) continue;
        const radius = this.store.number(`${key}.${index}.radius_m`);
        const [x, y] = this.to_page(position);
        if (radius) this.layer.circles.append(drawing("circle", { class: sign, cx: x, cy: y, r: this.scale * radius }));
        const called = this.store.value(`${key}.${index}.name`) || `${name} ${index + 1}`;
        this.sign(wanted, `${key}.${index}`, sign, called, position, (to) => [
          { key: `${key}.${index}.position`, value: to.map(Math.round) },
        ]);
      }
    const target = from.by_target ? from.target : this.ahead(from);
    if (target)
      this.sign(wanted, "target", "target", from.by_target ? "target" : "direction of view", target, (to) =>
        placed(this.store, "target", to),
      );
    this.sign(wanted, "viewer", "viewer", "viewer", from.viewer, (to) => placed(this.store, "viewer", to), from.azimuth);
    for (const [id, sign] of this.signs)
      if (!wanted.has(id)) {
        sign.element.remove();
        this.signs.delete(id);
      }
  }
  // A centre given by longitude and latitude, as the program found it.
  found(key, index) {
    return key === "deform.handles" ? this.store.map.handles?.[index]?.position : undefined;
  }
  // Where the direction of view can be taken hold of, if it is given as an angle.
  ahead(from) {
    const far = (0.3 * Math.min(this.box.clientWidth, this.box.clientHeight)) / this.scale;
    const angle = (from.azimuth * Math.PI) / 180;
    return [from.viewer[0] + far * Math.sin(angle), from.viewer[1] + far * Math.cos(angle)];
  }

  // A sign that is dragged or moved with the arrow keys; changes(position) are what that asks for.
  sign(wanted, id, kind, name, position, changes, turn = 0) {
    wanted.add(id);
    let sign = this.signs.get(id);
    if (!sign) {
      const made = drawing(
        "g",
        { class: `sign ${kind}`, tabindex: 0, role: "button", "aria-roledescription": "place on the map" },
        ...shape(kind),
      );
      sign = { element: made };
      draggable(made, {
        start: () => {
          made.focus();
          this.held = true;
          return new_step();
        },
        move: (event, step) => this.store.edit(sign.changes(this.to_ground(event)), step),
        end: () => {
          this.held = false;
          this.draw();
        },
      });
      made.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
        if (!by || event.ctrlKey || event.metaKey) return;
        event.preventDefault();
        event.stopPropagation();
        const step = (event.shiftKey ? 10 : 1) / this.scale;
        this.store.edit(sign.changes([sign.position[0] + step * by[0], sign.position[1] + step * by[1]]), running_step(`map-${id}`));
      });
      this.signs.set(id, sign);
      this.layer.signs.append(made);
    }
    Object.assign(sign, { position, changes });
    const [x, y] = this.to_page(position);
    sign.element.setAttribute("transform", `translate(${x.toFixed(1)},${y.toFixed(1)}) rotate(${turn})`);
    sign.element.setAttribute("aria-label", `${name}, E ${Math.round(position[0])} N ${Math.round(position[1])}; arrow keys move it`);
    const title = sign.element.querySelector("title");
    if (title.textContent !== name) title.textContent = name;
  }
}

function arc([x, y], azimuth, field, reach) {
  const end = (angle) => `${x + reach * Math.sin((angle * Math.PI) / 180)},${y - reach * Math.cos((angle * Math.PI) / 180)}`;
  return `M${end(azimuth - field / 2)}A${reach},${reach} 0 ${field > 180 ? 1 : 0} 1 ${end(azimuth + field / 2)}`;
}
const cone = (at, azimuth, field, reach) => `${arc(at, azimuth, field, reach)}L${at.join()}Z`;

function shape(kind) {
  const title = drawing("title");
  const grip = drawing("circle", { class: "grip", r: 16 }); // a finger's room
  const shapes = {
    viewer: () => drawing("path", { d: "M0,-9L6,7L0,3.5L-6,7Z" }),
    target: () => drawing("path", { d: "M-7,0H7M0,-7V7M-4.5,0A4.5,4.5 0 1 1 4.5,0A4.5,4.5 0 1 1 -4.5,0" }),
    handle: () => drawing("path", { d: "M0,-6L6,5H-6Z" }),
    light: () => drawing("circle", { r: 5 }),
    cloud: () => drawing("rect", { x: -5, y: -4, width: 10, height: 8, rx: 4 }),
    mist: () => drawing("path", { d: "M-6,-3H6M-6,0H6M-6,3H6" }),
  };
  return [title, grip, shapes[kind]()];
}
