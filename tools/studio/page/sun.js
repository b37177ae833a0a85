// The sun: a dial for its direction, an arc for its altitude, and the same by date and time of day. All show the sun of the picture, which
// by date and time only the program knows.
import { view } from "./camera.js";
import { row } from "./controls.js";
import { clamp, draggable, drawing, element, rounded } from "./dom.js";
import { new_step, running_step } from "./store.js";

const degree = Math.PI / 180;
const full = (angle) => ((angle % 360) + 360) % 360;

export class Sun {
  constructor(store) {
    this.store = store;
    this.dial = drawing("svg", {
      viewBox: "-62 -62 124 124",
      class: "dial",
      role: "slider",
      tabindex: 0,
      "aria-label": "Direction of the sun",
      "aria-valuemin": 0,
      "aria-valuemax": 360,
    });
    this.cone = drawing("path", { class: "cone" });
    this.ray = drawing("path", { class: "ray" });
    this.sign = drawing("circle", { r: 6, class: "sun" });
    const letters = [
      ["N", 0, -53],
      ["E", 54, 4],
      ["S", 0, 59],
      ["W", -54, 4],
    ].map(([text, x, y]) => drawing("text", { x, y, "text-anchor": "middle" }, text));
    const ticks = Array.from({ length: 24 }, (_, k) =>
      drawing("path", { d: `M0,-${k % 6 === 0 ? 38 : 41}V-44`, transform: `rotate(${15 * k})`, class: "tick" }),
    );
    this.dial.append(drawing("circle", { r: 44, class: "ring" }), this.cone, ...ticks, ...letters, this.ray, this.sign);

    this.arc = drawing("svg", {
      viewBox: "-12 -62 78 84",
      class: "arc",
      role: "slider",
      tabindex: 0,
      "aria-label": "Altitude of the sun",
      "aria-valuemin": -20,
      "aria-valuemax": 90,
    });
    this.height = drawing("circle", { r: 6, class: "sun" });
    this.lift = drawing("path", { class: "ray" });
    this.arc.append(
      drawing("path", { d: "M0,-50A50,50 0 0 1 50,0A50,50 0 0 1 46.985,17.1", class: "ring" }),
      drawing("path", { d: "M-8,0H62", class: "tick" }),
      ...[0, 15, 30, 45, 60, 75, 90].map((each) => drawing("path", { d: "M47,0H53", class: "tick", transform: `rotate(${-each})` })),
      this.lift,
      this.height,
    );
    this.listen();

    this.seen = { azimuth: 315, altitude: 30 }; // what was told last
    const angle = { unit: "°", step: 0.5, by_itself: () => this.is_timed() };
    this.numbers = [
      row(store, {
        ...angle,
        key: "sun.azimuth_deg",
        label: "Azimuth",
        min: 0,
        max: 360,
        get: () => this.azimuth(),
        set: (_, value) => this.changes(value, undefined),
      }),
      row(store, {
        ...angle,
        key: "sun.altitude_deg",
        label: "Altitude",
        min: -20,
        max: 90,
        get: () => this.altitude(),
        set: (_, value) => this.changes(undefined, value),
      }),
    ];
    this.timed = element("input", { type: "checkbox", id: "sun-timed", role: "switch", change: () => this.switch_time() });
    this.date = element("input", { type: "date", "aria-label": "Date", change: () => this.set_time() });
    this.zone = element("input", {
      type: "text",
      size: 7,
      "aria-label": "Time zone, such as +02:00",
      pattern: "Z|[+\\-]\\d\\d:\\d\\d",
      change: () => this.set_time(),
    });
    this.minutes = element("input", { type: "range", min: 0, max: 1439, step: 5, "aria-label": "Time of day" });
    this.clock = element("input", { type: "time", "aria-label": "Time of day", change: () => this.set_time() });
    let step = null;
    this.minutes.addEventListener("input", () => {
      this.clock.value = clock_of(Number(this.minutes.value));
      this.set_time((step ??= new_step()));
    });
    this.minutes.addEventListener("change", () => {
      step = null;
    });
    this.by_time = element(
      "div",
      { class: "by-time" },
      element("span", { class: "fields" }, this.date, this.clock, this.zone),
      this.minutes,
    );
    this.fault = element("p", { class: "fault", hidden: true });
    const time_row = element(
      "div",
      { class: "row switch", "data-key": "sun.time" },
      element("label", { for: "sun-timed" }, "By date and time"),
      this.timed,
      this.fault,
    );
    this.time_row = { element: time_row, fault: this.fault, focus: () => this.timed.focus() };
    this.element = element(
      "div",
      { class: "sun" },
      element("div", { class: "dials" }, this.dial, this.arc),
      ...this.numbers.map((each) => each.element),
      time_row,
      this.by_time,
    );
  }
  rows() {
    return [...this.numbers, this.time_row];
  }

  is_timed() {
    return this.store.value("sun.time") !== undefined;
  }
  // A picture that is still being drawn does not yet tell where its sun stands: it is shown where it was.
  azimuth() {
    return (this.seen.azimuth = this.store.number("sun.azimuth_deg") ?? this.seen.azimuth);
  }
  altitude() {
    return (this.seen.altitude = this.store.number("sun.altitude_deg") ?? this.seen.altitude);
  }

  update() {
    const [azimuth, altitude] = [full(this.azimuth()), this.altitude()];
    const angle = azimuth * degree;
    const [x, y] = [44 * Math.sin(angle), -44 * Math.cos(angle)];
    this.sign.setAttribute("cx", x);
    this.sign.setAttribute("cy", y);
    this.ray.setAttribute("d", `M${0.84 * x},${0.84 * y}L0,0`);
    const from = view(this.store);
    const end = (turn) => `${36 * Math.sin((from.azimuth + turn) * degree)},${-36 * Math.cos((from.azimuth + turn) * degree)}`;
    const half = Math.min(from.field, 359) / 2;
    this.cone.setAttribute("d", `M0,0L${end(-half)}A36,36 0 ${half > 90 ? 1 : 0} 1 ${end(half)}Z`);
    this.dial.setAttribute("aria-valuenow", Math.round(azimuth));
    this.dial.setAttribute("aria-valuetext", `${rounded(azimuth, 0.1)} degrees`);
    const up = altitude * degree;
    this.height.setAttribute("cx", 50 * Math.cos(up));
    this.height.setAttribute("cy", -50 * Math.sin(up));
    this.lift.setAttribute("d", `M0,0L${43 * Math.cos(up)},${-43 * Math.sin(up)}`);
    this.arc.setAttribute("aria-valuenow", Math.round(altitude));
    this.arc.setAttribute("aria-valuetext", `${rounded(altitude, 0.1)} degrees`);
    for (const each of this.numbers) each.update();
    const time = parsed(this.store.value("sun.time"));
    this.timed.checked = Boolean(time);
    this.by_time.hidden = !time;
    if (!time || (this.by_time.contains(document.activeElement) && document.activeElement !== this.minutes)) return;
    [this.date.value, this.clock.value, this.zone.value] = [time.date, time.clock, time.zone];
    this.minutes.value = minutes_of(time.clock);
  }

  // One angle instead of a time takes the other with it, which else would be left to the program.
  changes(azimuth, altitude) {
    const both = this.is_timed();
    const changes = [];
    if (both || azimuth !== undefined) changes.push({ key: "sun.azimuth_deg", value: rounded(azimuth ?? full(this.azimuth()), 0.01) });
    if (both || altitude !== undefined) changes.push({ key: "sun.altitude_deg", value: rounded(altitude ?? this.altitude(), 0.01) });
    return changes;
  }
  set(azimuth, altitude, step) {
    const up = altitude === undefined ? undefined : clamp(rounded(altitude, 0.5), -90, 90);
    this.store.edit(this.changes(azimuth === undefined ? undefined : rounded(full(azimuth), 0.5), up), step);
  }
  lift_to(altitude, step) {
    this.set(undefined, clamp(altitude, -20, 90), step);
  }
  listen() {
    const angle_of = (event, svg, [cx, cy]) => {
      const box = svg.getBoundingClientRect();
      const { x, y, width, height } = svg.viewBox.baseVal;
      return [((event.clientX - box.left) / box.width) * width + x - cx, ((event.clientY - box.top) / box.height) * height + y - cy];
    };
    const turn = (event, step) => {
      const [x, y] = angle_of(event, this.dial, [0, 0]);
      const raw = Math.atan2(x, -y) / degree;
      this.set(event.shiftKey ? 15 * Math.round(raw / 15) : Math.round(raw), undefined, step);
    };
    const raise = (event, step) => {
      const [x, y] = angle_of(event, this.arc, [0, 0]);
      this.lift_to(clamp(Math.round(Math.atan2(-y, Math.max(x, 0.01)) / degree), -20, 90), step);
    };
    for (const [svg, to] of [
      [this.dial, turn],
      [this.arc, raise],
    ])
      draggable(svg, {
        start: (event) => {
          svg.focus();
          const step = new_step();
          to(event, step);
          return step;
        },
        move: to,
      });
    const keys = (svg, change) =>
      svg.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: 15, PageDown: -15 }[event.key];
        if (by === undefined || event.ctrlKey || event.metaKey) return;
        event.preventDefault();
        change(by * (event.shiftKey ? 10 : 1));
      });
    keys(this.dial, (by) => this.set(this.azimuth() + by, undefined, running_step("sun-azimuth")));
    keys(this.arc, (by) => this.lift_to(this.altitude() + by, running_step("sun-altitude")));
  }

  // Switched off it leaves the sun where it stands in the picture of the last time.
  async switch_time() {
    if (!this.timed.checked) {
      this.timed.disabled = true;
      await this.store.settle();
      await this.store.refresh().catch((error) => this.store.fail(error));
      this.timed.disabled = false;
      return this.is_timed() && this.store.edit(this.changes(), new_step());
    }
    const now = this.store.value("season.date");
    const year = new Date().getFullYear();
    this.send(/^\d\d-\d\d$/.test(now ?? "") ? `${year}-${now}` : `${year}-06-21`, "09:00", "+02:00", new_step());
  }
  set_time(step = new_step()) {
    if (this.date.value && this.clock.value) this.send(this.date.value, this.clock.value.slice(0, 5), this.zone.value || "Z", step);
  }
  send(date, clock, zone, step) {
    this.store.edit([{ key: "sun.time", value: `${date}T${clock}:00${zone}` }], step);
  }
}

function parsed(time) {
  const match = /^(\d{4}-\d\d-\d\d)[T ](\d\d:\d\d)(?::\d\d(?:\.\d+)?)?(Z|[+-]\d\d:\d\d)?$/.exec(time ?? "");
  return match ? { date: match[1], clock: match[2], zone: match[3] ?? "Z" } : null;
}
const minutes_of = (clock) => 60 * Number(clock.slice(0, 2)) + Number(clock.slice(3, 5));
const clock_of = (minutes) => `${String(Math.floor(minutes / 60)).padStart(2, "0")}:${String(minutes % 60).padStart(2, "0")}`;
