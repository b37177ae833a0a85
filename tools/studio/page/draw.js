// Lines and areas drawn on the ground: ski runs, lifts, paths, roads, waters. Points are clicked in the picture, which knows the ground below
// them; the program writes them as GeoJSON beside the scene, and undo takes them back like any other change.
import { api } from "./api.js";
import { by_id, draggable, drawing, element } from "./dom.js";
import { new_step } from "./store.js";

// What can be drawn, in words of the styles of features (docs/features.md). area: a closed outline.
const kinds = {
  run_easy: { label: "Ski run, easy" },
  run_intermediate: { label: "Ski run, medium" },
  run_difficult: { label: "Ski run, difficult" },
  route: { label: "Ski route or tour" },
  lift: { label: "Lift or cable car" },
  path: { label: "Trail" },
  road: { label: "Road" },
  railway: { label: "Railway" },
  river: { label: "River" },
  lake: { label: "Lake", area: true },
  town: { label: "Town", area: true },
  forest: { label: "Forest", area: true },
};
const end_px = 9; // a click so near to the last point ends the line

export class Drawing {
  constructor(store, hands, seen) {
    Object.assign(this, { store, hands, seen });
    this.layer = by_id("drawn");
    this.points = null; // of the line that is being drawn
    this.chosen = -1; // the drawn feature whose points are shown
    this.kind = element("select", { "aria-label": "Kind of line" });
    this.kind.append(...Object.entries(kinds).map(([kind, { label }]) => element("option", { value: kind }, label)));
    this.name = element("input", { type: "text", "aria-label": "Its number or name", placeholder: "number or name", size: 14 });
    this.begin = element("button", { type: "button", id: "draw", class: "wide", click: () => this.start() }, "Draw it…");
    this.finish = element("button", { type: "button", class: "wide", hidden: true, click: () => this.end() }, "Done");
    this.list = element("div", { class: "blocks" });
    this.part = {
      element: element("div", { class: "drawing" }, element("div", { class: "row" }, this.kind, this.name), this.begin, this.finish, this.list),
      update: () => this.update(),
    };
    for (const kind of ["state", "seen"]) store.on(kind, () => this.draw());
    // Lines on the map: what is drawn, and the one in hand.
    store.lines = () => [...this.features().map(points_of), this.points ?? []].filter((each) => each.length > 0).map((each) => each.map((point) => point.position));
  }
  features() {
    return this.store.state.drawn?.features ?? [];
  }

  // ---- drawing a line
  start() {
    this.points = [];
    this.chosen = -1;
    this.next();
  }
  next() {
    const { area, label } = kinds[this.kind.value];
    const least = area ? 3 : 2;
    this.finish.hidden = this.points.length < least;
    this.begin.hidden = !this.finish.hidden;
    const hint = `${label}: click point ${this.points.length + 1}${this.points.length < least ? "" : ", or the last one again to end"}.`;
    this.hands.choose(hint, (pointed, _, share, near_m) => this.take(pointed, share, near_m), () => this.leave());
    this.draw();
  }
  take(pointed, share, near_m) {
    if (!this.points) return;
    if (!pointed.lonlat) {
      this.leave();
      return this.hands.say("The terrain states no coordinate system, so nothing can be drawn on it.");
    }
    const last = this.points.at(-1);
    const box = by_id("frame").getBoundingClientRect();
    const apart = (a, b, x, y) => Math.hypot((a[0] - b[0]) * x, (a[1] - b[1]) * y);
    const again =
      last && (share ? last.share && apart(share, last.share, box.width, box.height) < end_px : apart(pointed.position, last.position, 1, 1) < near_m);
    if (again) return this.end();
    this.points.push({ ...pointed, share: share ?? this.share_of(pointed.position) });
    this.next();
  }
  end() {
    const { area } = kinds[this.kind.value];
    const points = this.points ?? [];
    this.leave();
    if (points.length < (area ? 3 : 2)) return;
    const features = [...this.features(), feature(this.kind.value, this.name.value.trim(), points)];
    this.name.value = next_name(this.name.value);
    this.save(features);
  }
  leave() {
    this.points = null;
    this.finish.hidden = true;
    this.begin.hidden = false;
    this.hands.leave();
    this.draw();
  }

  // All drawn features, with the blocks of the scene that name their file.
  save(features, step = new_step()) {
    const file = this.store.state.drawn_file;
    const changes = [
      ...this.block("features", "source", file, features.length > 0, { kind_of: "kind" }),
      ...this.block(
        "labels.shapes",
        "file",
        file,
        features.some((each) => each.properties.name),
        {},
      ),
    ];
    const collection = features.length > 0 ? { type: "FeatureCollection", features } : null;
    return this.store.act(() => api.draw(collection, changes, step), { name: "Lines drawn on the ground" });
  }
  block(key, member, file, wanted, more) {
    const index = Array.from({ length: this.store.count(key) }, (_, at) => at).find((at) => this.store.value(`${key}.${at}.${member}`) === file);
    if (wanted === (index !== undefined)) return [];
    return wanted ? [{ key, append: { [member]: file, ...more } }] : [{ key: `${key}.${index}`, remove: true }];
  }

  // ---- what is drawn
  update() {
    const features = this.features();
    this.list.replaceChildren(
      ...features.map((each, index) => {
        const { kind, name } = each.properties;
        const label = kinds[kind]?.label ?? kind;
        return element(
          "div",
          { class: "row drawn" },
          element(
            "button",
            {
              type: "button",
              class: "link",
              "aria-pressed": String(index === this.chosen),
              title: "Show its points",
              click: () => {
                this.chosen = index === this.chosen ? -1 : index;
                this.update();
                this.draw();
              },
            },
            label,
          ),
          element("input", {
            type: "text",
            size: 10,
            value: name ?? "",
            "aria-label": `Number or name of ${label}`,
            change: (event) => this.rewrite(index, (old) => ({ ...old, properties: { ...old.properties, name: event.target.value.trim() } })),
          }),
          element(
            "button",
            { type: "button", class: "remove", title: "Remove", "aria-label": `Remove ${label} ${name ?? ""}`, click: () => this.rewrite(index, null) },
            "×",
          ),
        );
      }),
    );
    if (this.chosen >= features.length) this.chosen = -1;
  }
  rewrite(index, change, step) {
    const features = this.features().flatMap((each, at) => (at !== index ? [each] : change ? [change(each)] : []));
    if (!change) this.chosen = -1;
    return this.save(features, step);
  }

  // The line in hand, or the points of the chosen feature where they are seen; those between points make new ones.
  draw() {
    this.store.tell("lines");
    const box = by_id("frame").getBoundingClientRect(); // the layer has no size while it is hidden
    const chosen = this.features()[this.chosen];
    const shares = this.points ? this.points.map((each) => each.share) : chosen ? points_of(chosen).map((each) => this.share_of(each.position)) : [];
    this.layer.toggleAttribute("hidden", shares.length === 0);
    if (shares.length === 0) return this.layer.replaceChildren();
    this.layer.setAttribute("viewBox", `0 0 ${box.width || 1} ${box.height || 1}`);
    const at = shares.map((share) => share && [share[0] * box.width, share[1] * box.height]);
    const line = at.filter(Boolean).map((each) => each.map((px) => px.toFixed(1)).join());
    this.layer.replaceChildren(drawing("path", { d: line.length > 0 ? `M${line.join("L")}` : "" }));
    if (this.points) return this.layer.append(...at.filter(Boolean).map(([cx, cy]) => drawing("circle", { class: "point", cx, cy, r: 4 })));
    at.forEach((each, index) => {
      const before = at[index - 1];
      if (each && before) this.grip([(each[0] + before[0]) / 2, (each[1] + before[1]) / 2], index, true);
      if (each) this.grip(each, index, false);
    });
  }
  grip([cx, cy], index, between) {
    const made = drawing("circle", {
      class: between ? "between" : "point",
      cx,
      cy,
      r: between ? 4 : 6,
      tabindex: between ? -1 : 0,
      role: "button",
      "aria-label": between ? "New point here" : `Point ${index + 1}; Delete removes it`,
    });
    draggable(made, {
      start: () => made.focus() ?? true,
      move: (event) => {
        const box = this.layer.getBoundingClientRect();
        made.setAttribute("cx", event.clientX - box.left);
        made.setAttribute("cy", event.clientY - box.top);
      },
      end: async (event) => {
        const pointed = event.type === "pointerup" ? await this.hands.ground(event) : null;
        if (!pointed || pointed.sky) return this.draw();
        this.change_points((points) => points.splice(index, between ? 0 : 1, pointed));
      },
    });
    made.addEventListener("keydown", (event) => {
      if (event.key !== "Delete" || between) return;
      event.preventDefault();
      event.stopPropagation();
      this.change_points((points) => points.splice(index, 1));
    });
    this.layer.append(made);
  }
  change_points(change) {
    this.rewrite(this.chosen, (old) => {
      const points = points_of(old);
      change(points);
      const { kind, name } = old.properties;
      return points.length < (kinds[kind]?.area ? 3 : 2) ? old : feature(kind, name, points);
    });
  }

  // Where a place of the ground is seen, in shares of the picture; null where it is hidden.
  share_of([east, north]) {
    const seen = this.seen.grid;
    if (!seen) return null;
    let best = Infinity;
    let found = -1;
    for (let i = 0; i < seen.depth.length; ++i) {
      if (!Number.isFinite(seen.depth[i])) continue;
      const [dx, dy] = [seen.x[i] + seen.origin[0] - east, seen.y[i] + seen.origin[1] - north];
      const far = dx * dx + dy * dy;
      if (far < best) [best, found] = [far, i];
    }
    // A pixel of the grid covers about this much ground, more on slopes that are seen from the side.
    const pixel_m = found < 0 ? 0 : seen.depth[found] / seen.width;
    if (found < 0 || best > (12 * pixel_m) ** 2) return null;
    return [((found % seen.width) + 0.5) / seen.width, (Math.floor(found / seen.width) + 0.5) / seen.height];
  }
}

// Positions in the terrain's own coordinates stay beside those in degrees, so that the page needs no map projection.
function feature(kind, name, points) {
  const coordinates = points.map(({ lonlat }) => lonlat.map((degrees) => Number(degrees.toFixed(6))));
  const positions = points.map(({ position }) => position.map((metres) => Number(metres.toFixed(1))));
  const { area } = kinds[kind] ?? {};
  return {
    type: "Feature",
    properties: { kind, ...(name ? { name } : {}), positions },
    geometry: area ? { type: "Polygon", coordinates: [[...coordinates, coordinates[0]]] } : { type: "LineString", coordinates },
  };
}
function points_of({ properties, geometry }) {
  const coordinates = geometry.type === "Polygon" ? geometry.coordinates[0].slice(0, -1) : geometry.coordinates;
  return coordinates.map((lonlat, index) => ({ lonlat, position: properties.positions?.[index] ?? lonlat }));
}
// "12" is followed by "13"; a name by nothing.
const next_name = (name) => (/^\d+$/.test(name.trim()) ? String(Number(name) + 1) : "");
