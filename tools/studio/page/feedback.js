// What the hand is about to do, drawn at once over the picture from the ground last seen, before the program answers: the ring of a light,
// a mist or a handle on the ground, the outline of a summit that is pulled, and the horizon while the view turns.
import { view } from "./camera.js";
import { cleared, layer, same_place, same_view } from "./seen.js";

const blocks = /^((?:light\.regions|light\.clouds|air\.mist|deform\.handles|deform\.summits)\.\d+)\.(\w+)$/;
const lists = /^(light\.regions|light\.clouds|air\.mist|deform\.handles|deform\.summits)$/;
const camera = /^camera\.(azimuth_deg|pitch_deg|tilt_deg|look_at)$/;
const stays_ms = 900; // after the last change
const degree = Math.PI / 180;

export class Feedback {
  constructor(store, picture, seen) {
    Object.assign(this, { store, picture, seen, held: null, pulled: false, turns: false, focused: null });
    this.canvas = layer("feedback");
    store.on("pending", () => this.changing());
    for (const kind of ["seen", "shown"]) store.on(kind, () => this.draw());
    const focus = (target) => {
      const block = blocks.exec(target?.closest?.("[data-key]")?.dataset.key ?? "")?.[1] ?? null;
      if (block === this.focused) return;
      this.focused = block;
      this.draw();
    };
    document.addEventListener("focusin", ({ target }) => focus(target));
    document.addEventListener("focusout", ({ relatedTarget }) => focus(relatedTarget));
  }

  // The newest change says what the hand holds.
  changing() {
    const changes = this.store.queue.at(-1)?.changes ?? [];
    for (const { key, append } of changes) {
      const found = blocks.exec(append && lists.test(key) ? `${key}.${this.store.count(key)}.position` : key);
      if (found) {
        if (found[1] !== this.held) this.pulled = false;
        this.held = found[1];
        this.pulled ||= /^(raise_m|move_m)$/.test(found[2]);
      }
      if (camera.test(key)) this.turns = true;
    }
    if (!this.held && !this.turns) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      Object.assign(this, { held: null, pulled: false, turns: false });
      this.draw();
    }, stays_ms);
    this.draw();
  }

  // A value of a block, one that is on its way to the program included.
  value(block, name) {
    const known = this.store.value(`${block}.${name}`);
    if (known !== undefined) return known;
    const [list, index] = [block.replace(/\.\d+$/, ""), Number(/\d+$/.exec(block)[0]) - this.store.count(block.replace(/\.\d+$/, ""))];
    const made = [this.store.sent, ...this.store.queue]
      .flatMap((batch) => batch?.changes ?? [])
      .filter((each) => each.append && each.key === list);
    return made[index]?.append[name] ?? this.store.describe(`${block}.${name}`)?.default;
  }

  position(block) {
    const handle = /^deform\.handles\.(\d+)$/.exec(block);
    return this.value(block, "position") ?? (handle ? this.store.map?.handles?.[handle[1]]?.position : undefined);
  }

  draw() {
    const { grid } = this.seen;
    const drawn = this.canvas.dataset.draws !== undefined;
    const block = this.held ?? this.focused;
    if (!block && !this.turns && !drawn) return;
    const context = cleared(this.canvas);
    delete this.canvas.dataset.draws;
    if (!grid) return;
    const now = view(this.store);
    const paths = [];
    if (this.turns && same_place(grid.view, now)) paths.push(["horizon", this.horizon(grid, now)]);
    const position = block && same_view(grid.view, now) ? this.position(block) : null;
    if (position) {
      const radius = this.value(block, "radius_m");
      if (radius > 0) paths.push(["ring", ring(grid, position, radius, this.scale(grid))]);
      if (this.pulled && radius > 0) paths.push(["summit", this.summit(grid, block, position, radius, now)]);
    }
    for (const [name, path] of paths) {
      context.lineJoin = "round";
      for (const [style, width] of [
        ["#000a", 4],
        [name === "ring" ? "#ffd37a" : "#fff", 1.6],
      ]) {
        Object.assign(context, { strokeStyle: style, lineWidth: width });
        context.stroke(path);
      }
    }
    if (paths.length > 0) this.canvas.dataset.draws = paths.map(([name]) => name).join(" ");
  }
  // px of the page for a pixel of the grid.
  scale(grid) {
    return [this.canvas.clientWidth / grid.width, this.canvas.clientHeight / grid.height];
  }
  perspective() {
    return (this.store.value("camera.projection") ?? "perspective") === "perspective";
  }
  // px for a radian in the middle of the picture.
  focal(field) {
    const width = this.canvas.clientWidth;
    return this.perspective() ? width / (2 * Math.tan((field * degree) / 2)) : width / (field * degree);
  }

  // The skyline of then, where it will be: in perspective its rays are turned, else it moves by the change of the angles.
  horizon(grid, now) {
    const { view: then, width, height, depth } = grid;
    const [sx, sy] = this.scale(grid);
    const [cx, cy] = [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2];
    const focal = this.focal(then.field);
    const right = (((now.azimuth - then.azimuth + 540) % 360) - 180) * degree;
    const [p0, p1] = [(then.pitch + then.tilt) * degree, (now.pitch + now.tilt) * degree];
    const turned = (u, v) => {
      if (!this.perspective()) return [u - right * focal, v - (p1 - p0) * focal];
      const ahead = focal * Math.cos(p0) - v * Math.sin(p0);
      const up = focal * Math.sin(p0) + v * Math.cos(p0);
      const [u1, ahead1] = [u * Math.cos(right) - ahead * Math.sin(right), u * Math.sin(right) + ahead * Math.cos(right)];
      const before = ahead1 * Math.cos(p1) + up * Math.sin(p1);
      if (before < 0.1 * focal) return null; // beside or behind
      return [(u1 * focal) / before, ((up * Math.cos(p1) - ahead1 * Math.sin(p1)) * focal) / before];
    };
    const path = new Path2D();
    let open = false;
    for (let x = 0; x < width; ++x) {
      let y = 0;
      while (y < height && !Number.isFinite(depth[y * width + x])) ++y;
      const to = y > 0 && y < height ? turned((x + 0.5) * sx - cx, cy - y * sy) : null;
      if (to) path[open ? "lineTo" : "moveTo"](cx + to[0], cy - to[1]);
      open = to !== null;
    }
    return path;
  }

  // The upper border of the handle's ground, each pixel shifted by what is new of the pull, by its distance.
  summit(grid, block, position, radius, now) {
    const [sx, sy] = this.scale(grid);
    const focal = this.focal(grid.view.field);
    const [east, north] = [position[0] - grid.origin[0], position[1] - grid.origin[1]];
    const then = (name, otherwise) => grid.values[`${block}.${name}`] ?? otherwise;
    const raise = ((this.value(block, "raise_m") ?? 0) - then("raise_m", 0)) * (this.store.number("deform.exaggeration") ?? 1);
    const [from, to] = [then("move_m", [0, 0]), this.value(block, "move_m") ?? [0, 0]];
    const aside = (to[0] - from[0]) * Math.cos(now.azimuth * degree) - (to[1] - from[1]) * Math.sin(now.azimuth * degree);
    const core = Math.min(this.value(block, "core_m") ?? radius / 2, 0.99 * radius);
    const top = new Float32Array(grid.width).fill(Infinity);
    for (let i = 0; i < grid.depth.length; ++i) {
      const far = Math.hypot(grid.x[i] - east, grid.y[i] - north);
      if (!(far < radius)) continue; // sky is NaN
      const t = Math.min(1, (radius - far) / (radius - core));
      const share = (t * t * (3 - 2 * t) * focal) / grid.depth[i];
      const x = (i % grid.width) + (aside * share) / sx;
      const y = Math.floor(i / grid.width) - (raise * share) / sy;
      for (const column of [Math.floor(x), Math.ceil(x)]) if (column >= 0 && column < grid.width) top[column] = Math.min(top[column], y);
    }
    const path = new Path2D();
    let open = false;
    // Where the pull stretches the ground its pixels lie apart: a column takes the highest of its neighbours.
    top
      .map((_, x) => Math.min(...top.subarray(Math.max(0, x - 1), x + 2)))
      .forEach((y, x) => {
        if (!Number.isFinite(y)) return;
        path[open ? "lineTo" : "moveTo"]((x + 0.5) * sx, y * sy);
        open = true;
      });
    return path;
  }
}

// Where the ground in sight is so far from a place in plan: the contour of the distance, cell by cell, not across edges behind which ground
// is hidden.
function ring({ width, height, origin, x, y, depth, broken_right, broken_down }, position, radius, [sx, sy]) {
  const path = new Path2D();
  const [east, north] = [position[0] - origin[0], position[1] - origin[1]];
  const beyond = new Float32Array(width * height);
  for (let i = 0; i < beyond.length; ++i)
    beyond[i] = Number.isFinite(depth[i]) ? Math.sqrt((x[i] - east) ** 2 + (y[i] - north) ** 2) - radius : NaN;
  const ends = [];
  const cross = (a, b, row, column, down) => {
    if (beyond[a] < 0 === beyond[b] < 0) return;
    const t = beyond[a] / (beyond[a] - beyond[b]);
    ends.push((column + 0.5 + (down ? 0 : t)) * sx, (row + 0.5 + (down ? t : 0)) * sy);
  };
  for (let row = 0; row + 1 < height; ++row)
    for (let column = 0; column + 1 < width; ++column) {
      const i = row * width + column;
      const inside = (beyond[i] < 0) + (beyond[i + 1] < 0) + (beyond[i + width] < 0) + (beyond[i + width + 1] < 0);
      if (inside === 0 || inside === 4) continue;
      if (broken_right[i] || broken_down[i] || broken_right[i + width] || broken_down[i + 1]) continue;
      ends.length = 0;
      cross(i, i + 1, row, column, false);
      cross(i + width, i + width + 1, row + 1, column, false);
      cross(i, i + width, row, column, true);
      cross(i + 1, i + width + 1, row, column + 1, true);
      for (let k = 0; k + 3 < ends.length; k += 4) {
        path.moveTo(ends[k], ends[k + 1]);
        path.lineTo(ends[k + 2], ends[k + 3]);
      }
    }
  return path;
}
