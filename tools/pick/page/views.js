// The painting and the map side by side, with what is known over each.
import { by_id, clamp, draggable, metres } from "./dom.js";
import { badge, colours, cross, line, ring, Room, square, sureness, terrain, text, triangle } from "./draw.js";
import { Pane } from "./pane.js";

// Where a place is labelled: beside its mark, if there is room.
function label(context, room, words, [x, y], style) {
  context.font = `${style.size ?? 12}px system-ui, sans-serif`;
  const width = context.measureText(words).width;
  for (const [dx, align] of [
    [9, "left"],
    [-9, "right"],
  ]) {
    const left = align === "left" ? x + dx : x + dx - width;
    if (!room.take(left, y - 8, left + width, y + 8)) continue;
    text(context, words, [x + dx, y], { ...style, align });
    return;
  }
}

export class Views {
  constructor(pairs, picking) {
    this.pairs = pairs;
    this.picking = picking;
    const { setup } = pairs;
    this.painting = new Pane("painting", "painting", setup.painting);
    this.map = new Pane("relief-map", "map", setup.map);
    this.shows = { terrain: true, names: true };
    // The likeliest to be looked for first: named ones, then those that stand out.
    this.order = setup.places.map((_, index) => index);
    this.order.sort((a, b) => Boolean(setup.names[b]) - Boolean(setup.names[a]) || setup.places[b][3] - setup.places[a][3]);
    for (const [pane, key] of [
      [this.painting, "pixel"],
      [this.map, "position"],
    ]) {
      pane.marks = () => [...pairs.list.map((pair, index) => ({ index, at: this.at(pane, pair[key]), words: this.words(index) })), ...this.handles(pane)];
      pane.overlays.push((context) => (pane === this.painting ? this.draw_painting(context) : this.draw_map(context)));
      pane.taken = (mark, at, exact) => (picking.half || mark.handle ? this.clicked(pane, at, exact) : pairs.select(mark.index));
      pane.dragged = (mark, at, exact) => (mark.handle ? this.handle_dragged(pane, mark.handle, at) : this.dragged(pane, mark.index, at, exact));
      pane.clicked = (at, exact) => this.clicked(pane, at, exact);
      pane.keeps_enter = () => picking.can_take();
    }
    this.map.changed = () => this.draw_scale();
    for (const kind of ["state", "fit", "terrain"]) pairs.on(kind, () => this.redraw());
    pairs.on("selected", () => this.redraw());
    picking.on("half", () => this.show_half());
    this.split();
    this.draw_scale();
  }
  redraw() {
    this.painting.redraw();
    this.map.redraw();
  }

  // ---- places of the map
  to_ground([x, y]) {
    const { origin, px_m } = this.pairs.setup.map;
    return [origin[0] + x * px_m[0], origin[1] - y * px_m[1]];
  }
  to_map([east, north]) {
    const { origin, px_m } = this.pairs.setup.map;
    return [(east - origin[0]) / px_m[0], (origin[1] - north) / px_m[1]];
  }
  at(pane, place) {
    return pane === this.map ? this.to_map(place) : place;
  }
  // Of a click on the map: summits within it are meant.
  radius() {
    const finger_px = 16;
    return (finger_px / this.map.scale) * this.pairs.setup.map.px_m[0];
  }
  words(index) {
    const finding = this.pairs.finding(index);
    return `${index + 1} · ${this.pairs.called(index)}${finding ? ` · ${finding.others_px.toFixed(1)} px off` : ""}`;
  }

  // ---- hands
  clicked(pane, at, exact) {
    if (pane === this.painting) this.picking.painted(at);
    else this.picking.placed(this.to_ground(at), exact ? 0 : this.radius());
  }
  async dragged(pane, index, at, exact) {
    if (pane === this.painting) {
      await this.pairs.act("change", { pair: index, pixel: [clamp(at[0], 0, pane.width), clamp(at[1], 0, pane.height)] });
    } else {
      const position = this.to_ground(at);
      try {
        const found = await this.pairs.place_at(position, exact ? 0 : this.radius());
        await this.pairs.act("change", {
          pair: index,
          position: found.position,
          ...(found.name ? { name: found.name } : {}),
        });
      } catch (error) {
        this.pairs.fail(error);
      }
    }
    this.pairs.select(index);
  }
  // Ground that the painter moved as a whole: marks at its centre, where it stands now.
  handles(pane) {
    if (!this.shows.terrain) return [];
    return (this.pairs.terrain.handles ?? []).map((handle, k) => {
      const far = Math.hypot(handle.moved[0] - handle.position[0], handle.moved[1] - handle.position[1]);
      const words = `moved ground · ${(far / 1000).toFixed(1)} km, turned by ${handle.turn_deg.toFixed(0)}° · drag it`;
      return { index: `handle ${k}`, handle, at: pane === this.map ? this.to_map(handle.moved) : handle.pixel, words };
    });
  }
  // Where a handle is dropped its centre is painted, or stands: a sure pair.
  async handle_dragged(pane, { position }, at) {
    const where = pane === this.map ? { moved: this.to_ground(at) } : { pixel: [clamp(at[0], 0, pane.width), clamp(at[1], 0, pane.height)] };
    const same = this.pairs.list.findIndex((pair) => Math.hypot(pair.position[0] - position[0], pair.position[1] - position[1]) < 1);
    const body = { ...where, position, sure: true };
    const taken = await (same < 0 ? this.pairs.act("add", { ...body, name: "" }) : this.pairs.act("change", { ...body, pair: same }));
    if (taken) this.pairs.select(same < 0 ? this.pairs.list.length - 1 : same);
  }
  // All pairs on the map, with room around them.
  show_pairs() {
    const places = this.pairs.list.map((pair) => this.to_map(pair.position));
    if (places.length < 2) return;
    const [xs, ys] = [0, 1].map((k) => places.map((place) => place[k]));
    const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const room = 1.5;
    const { clientWidth, clientHeight } = this.map.canvas;
    this.map.show((x0 + x1) / 2, (y0 + y1) / 2, Math.min(clientWidth / (room * (x1 - x0) + 1), clientHeight / (room * (y1 - y0) + 1)));
  }
  // A pair in both views.
  bring(index) {
    const pair = this.pairs.list[index];
    this.painting.bring(pair.pixel, 1.6 * this.painting.leastScale());
    this.map.bring(this.to_map(pair.position), 2.2 * this.map.leastScale());
  }
  show_half() {
    const { half } = this.picking;
    if (half && by_id("follow").getAttribute("aria-pressed") === "true") {
      const first = half.offers[0];
      if (half.pixel && first) this.map.bring(this.to_map(first.position), 2.5 * this.map.leastScale());
      if (half.place && first) {
        // So near that the ring has its room.
        const sigma = Math.max(first.sigma_px, 3);
        this.painting.bring(first.pixel, Math.min(1.5, 45 / sigma));
      }
    }
    this.redraw();
  }

  // ---- drawing
  draw_painting(context) {
    const { painting: pane, pairs, picking } = this;
    if (this.shows.terrain) terrain(context, pane, pairs.terrain.lines);
    const room = new Room();
    for (const pair of pairs.list) {
      const [x, y] = pane.toPage(...pair.pixel);
      room.take(x - 9, y - 9, x + 9, y + 9);
    }
    if (this.shows.names) this.draw_known(context, pane, room, (index) => pairs.shown.get(index), true);
    pairs.list.forEach((pair, index) => {
      const finding = pairs.finding(index);
      if (finding && finding.residual_px * pane.scale > 3) line(context, pane.toPage(...pair.pixel), pane.toPage(...finding.shown), colours[pairs.standing(index)]);
    });
    this.draw_handles(context, pane);
    this.draw_pairs(context, pane, (pair) => pair.pixel);
    const { half } = picking;
    if (half?.pixel) cross(context, pane.toPage(...half.pixel), colours.half);
    if (half?.place)
      for (const offer of half.offers) {
        const at = pane.toPage(...offer.pixel);
        ring(context, at, Math.max(10, 2 * offer.sigma_px * pane.scale), colours.offer, { dash: [6, 5], width: 1.5 });
        cross(context, at, colours.offer);
      }
  }
  draw_map(context) {
    const { map: pane, pairs, picking } = this;
    const room = new Room();
    if (pairs.fit.eye && pairs.fit.of === pairs.state.revision) this.draw_eye(context);
    for (const pair of pairs.list) {
      const [x, y] = pane.toPage(...this.to_map(pair.position));
      room.take(x - 9, y - 9, x + 9, y + 9);
    }
    const { half } = picking;
    // What waits, or is proposed, has its name before all others.
    const named = half?.place ? [half.place] : half?.pixel ? half.offers : [];
    const names = named.map((place) => [place.name || `${Math.round(place.altitude_m)} m`, pane.toPage(...this.to_map(place.position))]);
    context.font = "600 13px system-ui, sans-serif";
    for (const [words, [x, y]] of names) room.take(x - 14, y - 14, x + 30 + context.measureText(words).width, y + 14);
    if (this.shows.names) this.draw_known(context, pane, room, (index) => this.to_map(pairs.setup.places[index]), false);
    this.draw_handles(context, pane);
    this.draw_pairs(context, pane, (pair) => this.to_map(pair.position));
    for (const [words, [x, y]] of names) text(context, words, [x + 18, y + 4], { ink: "#101418", halo: "#fffd", size: 13, weight: 600 });
    if (half?.place) cross(context, pane.toPage(...this.to_map(half.place.position)), colours.half);
    if (half?.pixel)
      half.offers.forEach((offer, index) => {
        const at = pane.toPage(...this.to_map(offer.position));
        ring(context, at, 12, colours.offer, { dot: true });
        badge(context, [at[0] - 14, at[1] - 14], String(index + 1), colours.offer);
      });
  }
  // On the map with the ground that moves as one piece, and that which follows in part.
  draw_handles(context, pane) {
    for (const { index, handle, at } of this.handles(pane)) {
      const to = pane.toPage(...(pane.held?.mark.index === index ? pane.held.at : at));
      if (pane === this.map) {
        const from = pane.toPage(...this.to_map(handle.position));
        const px = pane.scale / this.pairs.setup.map.px_m[0];
        ring(context, from, handle.radius_m * px, colours.handle, { dash: [6, 5], dot: false, width: 1.5 });
        ring(context, from, handle.core_m * px, colours.handle, { dot: false, width: 1.5 });
        line(context, from, to, colours.handle, 2);
      }
      square(context, to, 5, colours.handle);
    }
  }
  draw_pairs(context, pane, of) {
    const { pairs } = this;
    const order = pairs.list.map((_, index) => index).filter((index) => index !== pairs.selected);
    if (pairs.selected !== null) order.push(pairs.selected);
    for (const index of order) {
      const held = pane.held?.mark.index === index ? pane.held.at : of(pairs.list[index]);
      const at = pane.toPage(...held);
      const chosen = index === pairs.selected;
      ring(context, at, chosen ? 8 : 6, colours[pairs.standing(index)], { width: chosen ? 3 : 2 });
      if (chosen) text(context, pairs.called(index), [at[0] + 14, at[1]], { size: 13 });
    }
  }
  // Known places: a triangle, and a name where there is room.
  draw_known(context, pane, room, of, painted) {
    const { pairs } = this;
    const { places, names } = pairs.setup;
    const [width, height] = [pane.canvas.clientWidth, pane.canvas.clientHeight];
    const zoom = pane.scale / pane.leastScale();
    const least = 260 / zoom ** 1.4; // prominence of summits without a name that are shown, m
    const taken = new Set(pairs.list.map((pair) => pair.position.map(Math.round).join()));
    const apart = new Room();
    const marks = [];
    for (const index of this.order) {
      if (marks.length > 220) break;
      const named = Boolean(names[index]);
      if (!named && places[index][3] < least) continue;
      const place = of(index);
      if (!place || (painted && sureness(place[2], pane.width) < 0.35) || taken.has(places[index].slice(0, 2).join())) continue;
      const at = pane.toPage(place[0], place[1]);
      if (at[0] < 0 || at[1] < 0 || at[0] > width || at[1] > height) continue;
      if (!apart.take(at[0] - 4, at[1] - 4, at[0] + 4, at[1] + 4)) continue;
      marks.push([index, at, named]);
    }
    for (const [index, at, named] of marks)
      if (places[index][3] > 0) triangle(context, at, named ? 5 : 3.6, painted ? colours.offer : "#4a2f1d", painted ? "#10141899" : "#fff9");
      else ring(context, at, 2.6, painted ? colours.offer : "#4a2f1d", { dot: false, width: 1.5 });
    for (const [index, at, named] of marks)
      if (named)
        label(context, room, names[index], at, painted ? { ink: "#dcefff", halo: "#000b" } : { ink: "#2b1a0e", halo: "#fffc" });
      else if (zoom > 4 && !painted) label(context, room, String(places[index][2]), at, { ink: "#5c4330", halo: "#fff9", size: 11 });
  }
  // The eye of the view, and where it looks.
  draw_eye(context) {
    const { map: pane, pairs } = this;
    const at = pane.toPage(...this.to_map(pairs.fit.eye));
    const angle = (pairs.fit.azimuth_deg * Math.PI) / 180;
    const far = 34;
    line(context, at, [at[0] + far * Math.sin(angle), at[1] - far * Math.cos(angle)], "#8fb6d9", 2);
    ring(context, at, 5, "#8fb6d9");
  }
  draw_scale() {
    const px_m = this.pairs.setup.map.px_m[0] / this.map.scale;
    const wanted = 110 * px_m;
    const power = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map((each) => each * power).find((each) => each <= wanted) ?? power;
    const bar = by_id("scale-bar");
    bar.textContent = length >= 1000 ? `${length / 1000} km` : metres(length);
    bar.style.width = `${length / px_m}px`;
  }

  // The border between both is dragged, or moved with the arrow keys.
  split() {
    const border = by_id("split");
    const main = border.parentElement;
    const set = (share) => {
      const left = clamp(share, 0.2, 0.8);
      main.style.setProperty("--left", `${left}fr`);
      main.style.setProperty("--right", `${1 - left}fr`);
      border.setAttribute("aria-valuenow", Math.round(100 * left));
    };
    // A wide painting has the larger part, as far as it fills the height.
    set(clamp((main.clientHeight * this.painting.width) / this.painting.height / main.clientWidth, 0.45, 0.64));
    draggable(border, {
      start: () => border.focus(),
      move: (event) => set(event.clientX / main.clientWidth),
    });
    border.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -2, ArrowRight: 2 }[event.key];
      if (!by) return;
      event.preventDefault();
      set((Number(border.getAttribute("aria-valuenow")) + by) / 100);
    });
  }
}
