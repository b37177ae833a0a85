// The camera: what the keys in effect say of the view, and which keys a movement changes.
import { clamp, rounded } from "./dom.js";

const degree = Math.PI / 180;
const full = (angle) => ((angle % 360) + 360) % 360;
const position_step = 1; // m
const angle_step = 0.05; // °

// {viewer, target, by_target, azimuth, pitch, tilt, field, height, parallel}: angles in °, positions in m.
export function view(store) {
  const map = store.map ?? {};
  const viewer = store.value("camera.position") ?? map.viewer ?? [0, 0];
  const by_target = Boolean(store.value("camera.look_at") ?? store.value("camera.look_at_lonlat"));
  const target = by_target ? (store.value("camera.look_at") ?? map.target) : map.target;
  const seen = by_target && target ? full(Math.atan2(target[0] - viewer[0], target[1] - viewer[1]) / degree) : undefined;
  return {
    viewer,
    target,
    by_target,
    azimuth: seen ?? store.number("camera.azimuth_deg") ?? map.azimuth_deg ?? 0,
    pitch: store.number("camera.pitch_deg") ?? 0,
    tilt: store.number("camera.tilt_deg") ?? 0,
    field: store.number("camera.field_of_view_deg") ?? map.field_of_view_deg ?? 50,
    height: store.number("camera.height_m") ?? map.height_m ?? 3000,
    parallel: store.value("camera.projection") === "oblique",
  };
}

const direction = (azimuth) => [Math.sin(azimuth * degree), Math.cos(azimuth * degree)];
const point = (at) => at.map((each) => rounded(each, position_step));
const distance = (from) => (from.target ? Math.hypot(from.target[0] - from.viewer[0], from.target[1] - from.viewer[1]) : 20000);

// Turns the view from where it was by angles: to the right and upwards, °.
export function turned(store, from, right, up) {
  const azimuth = full(from.azimuth + right);
  const changes = [];
  if (from.by_target) {
    const [east, north] = direction(azimuth);
    const far = distance(from);
    if (right !== 0) changes.push({ key: "camera.look_at", value: point([from.viewer[0] + far * east, from.viewer[1] + far * north]) });
    if (up !== 0) changes.push({ key: "camera.tilt_deg", value: clamp(rounded(from.tilt + up, angle_step), -45, 45) });
  } else {
    if (right !== 0) changes.push({ key: "camera.azimuth_deg", value: rounded(azimuth, angle_step) });
    if (up !== 0) changes.push({ key: "camera.pitch_deg", value: clamp(rounded(from.pitch + up, angle_step), -90, 90) });
  }
  return changes;
}

// Moves the viewer by shares of the distance to what it looks at: forwards and to the right; and up by metres.
export function moved(store, from, forward, right, up = 0) {
  const [east, north] = direction(from.azimuth);
  const far = distance(from);
  const by = [far * (forward * east + right * north), far * (forward * north - right * east)];
  const aside = [far * right * north, -far * right * east];
  const changes = [];
  if (forward !== 0 || right !== 0)
    changes.push({ key: "camera.position", value: point([from.viewer[0] + by[0], from.viewer[1] + by[1]]) });
  if (right !== 0 && from.by_target && from.target)
    changes.push({ key: "camera.look_at", value: point([from.target[0] + aside[0], from.target[1] + aside[1]]) });
  // A direction that the program chose for the old position would jump.
  else if (changes.length > 0 && !from.by_target && store.value("camera.azimuth_deg") === "auto")
    changes.push({ key: "camera.azimuth_deg", value: rounded(from.azimuth, angle_step) });
  if (up !== 0) changes.push({ key: "camera.height_m", value: clamp(Math.round(from.height + up), -12000, 1000000) });
  return changes;
}

// The viewer or what it looks at, put down somewhere on the map.
export function placed(store, what, position) {
  const from = view(store);
  if (what === "viewer") return [{ key: "camera.position", value: point(position) }];
  if (from.by_target) return [{ key: "camera.look_at", value: point(position) }];
  const azimuth = full(Math.atan2(position[0] - from.viewer[0], position[1] - from.viewer[1]) / degree);
  return [{ key: "camera.azimuth_deg", value: rounded(azimuth, angle_step) }];
}

// The field of view, or the width of a parallel view, by a factor.
export function widened(store, factor) {
  const key = view(store).parallel ? "camera.view_width_m" : "camera.field_of_view_deg";
  const limits = { perspective: 150, cylindrical: 360, panini: 240 };
  const max = key === "camera.view_width_m" ? 1e7 : (limits[store.value("camera.projection")] ?? 150);
  return [{ key, value: clamp(rounded((store.number(key) ?? 50) * factor, 0.1), 1, max) }];
}
