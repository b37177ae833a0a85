// What lies under the picture's pixels: place, altitude, distance and class, and the way back from a place on the map to a pixel.
"use strict";

function numbersOf(base64, bytes) {
  const text = atob(base64);
  const out = bytes === 1 ? new Uint8Array(text.length) : new Uint16Array(text.length / 2);
  for (let i = 0; i < out.length; ++i) out[i] = bytes === 1 ? text.charCodeAt(i) : text.charCodeAt(2 * i) | (text.charCodeAt(2 * i + 1) << 8);
  return out;
}

const earthDegree = 111320;  // m of a degree of latitude

class Ground {
  // scale: pixels of the picture for one that the data were taken from
  constructor(data, scale) {
    this.step = data.step * scale;
    this.width = data.width;
    this.height = data.height;
    this.data = data;
    this.classes = numbersOf(data.classes, 1);
    this.altitudes = numbersOf(data.altitudes, 2);
    this.distances = numbersOf(data.distances, 2);
    this.places = Boolean(data.longitude);
    if (!this.places) return;
    const degrees = ({ from, to, values }) => Float64Array.from(numbersOf(values, 2), (v) => from + ((to - from) * v) / 65535);
    this.longitudes = degrees(data.longitude);
    this.latitudes = degrees(data.latitude);
    this.sort();
  }

  isSky(i) { return this.classes[i] === 255; }

  // At a pixel of the picture: null outside of it, {sky: true} in the sky.
  at(x, y) {
    const column = Math.floor(x / this.step);
    const row = Math.floor(y / this.step);
    if (column < 0 || row < 0 || column >= this.width || row >= this.height) return null;
    const i = row * this.width + column;
    if (this.isSky(i)) return { sky: true };
    const out = {
      sky: false,
      kind: this.data.classNames[this.classes[i]],
      altitude_m: this.altitudes[i] + this.data.altitudeFrom,
      distance_m: this.distances[i] * this.data.distanceStep,
    };
    if (this.places) Object.assign(out, { longitude: this.longitudes[i], latitude: this.latitudes[i] });
    return out;
  }

  // Cells by squares of the map, for look-ups by place.
  sort() {
    const { longitude, latitude } = this.data;
    this.squares = 192;
    this.perDegree = [this.squares / (longitude.to - longitude.from || 1), this.squares / (latitude.to - latitude.from || 1)];
    this.shrink = Math.cos((((latitude.from + latitude.to) / 2) * Math.PI) / 180);
    this.cells = new Map();
    for (let i = 0; i < this.classes.length; ++i) {
      if (this.isSky(i)) continue;
      const key = this.square(this.longitudes[i], this.latitudes[i]).join();
      if (!this.cells.has(key)) this.cells.set(key, []);
      this.cells.get(key).push(i);
    }
  }
  square(longitude, latitude) {
    return [
      Math.floor((longitude - this.data.longitude.from) * this.perDegree[0]),
      Math.floor((latitude - this.data.latitude.from) * this.perDegree[1]),
    ];
  }
  // From cell i to a place, m east and north.
  offset(i, longitude, latitude) {
    return [(longitude - this.longitudes[i]) * earthDegree * this.shrink, (latitude - this.latitudes[i]) * earthDegree];
  }

  // The pixel [x, y] where a place on the map is seen; null where it is hidden, or outside of the picture.
  locate(longitude, latitude) {
    if (!this.places) return null;
    const [column, row] = this.square(longitude, latitude);
    let best = -1;
    let least = Infinity;
    for (let y = row - 1; y <= row + 1; ++y)
      for (let x = column - 1; x <= column + 1; ++x)
        for (const i of this.cells.get(`${x},${y}`) || []) {
          const [east, north] = this.offset(i, longitude, latitude);
          const far = Math.hypot(east, north);
          if (far < least) [best, least] = [i, far];
        }
    if (best < 0) return null;
    // How far a step across and a step down go on the map, to the side where the same ground goes on.
    const steps = [this.stepFrom(best, 1, 0), this.stepFrom(best, 0, 1)];
    const [east, north] = this.offset(best, longitude, latitude);
    const [across, down] = steps;
    const reach = Math.hypot(...(across || [0, 0])) + Math.hypot(...(down || [0, 0]));
    if (least > Math.max(reach, 1)) return null;
    let [u, v] = [0, 0];
    if (across && down) {
      const determinant = across[0] * down[1] - across[1] * down[0];
      if (Math.abs(determinant) > 1e-6) {
        u = (east * down[1] - north * down[0]) / determinant;
        v = (across[0] * north - across[1] * east) / determinant;
      }
    }
    const limit = (t) => Math.max(-1, Math.min(1, t));
    const middle = (k) => (k + 0.5) * this.step;
    return [middle((best % this.width) + limit(u)), middle(Math.floor(best / this.width) + limit(v))];
  }
  // The shorter way on the map to the cell on the one or the other side, as if it went to the right or down.
  stepFrom(i, right, down) {
    let shortest = null;
    for (const side of [1, -1]) {
      const x = (i % this.width) + side * right;
      const y = Math.floor(i / this.width) + side * down;
      if (x < 0 || y < 0 || x >= this.width || y >= this.height) continue;
      const j = y * this.width + x;
      if (this.isSky(j)) continue;
      const [east, north] = this.offset(i, this.longitudes[j], this.latitudes[j]);
      const step = [side * east, side * north];
      if (!shortest || Math.hypot(...step) < Math.hypot(...shortest)) shortest = step;
    }
    return shortest;
  }
}

// Ways of a GPX file: lists of [longitude, latitude]. Throws where it is none.
function waysOfGpx(text) {
  const document_ = new DOMParser().parseFromString(text, "application/xml");
  if (document_.getElementsByTagName("parsererror").length > 0 || !document_.getElementsByTagName("gpx").length) throw new Error("is no GPX file");
  const points = (parent, tag) =>
    Array.from(parent.getElementsByTagName(tag), (p) => [Number(p.getAttribute("lon")), Number(p.getAttribute("lat"))]).filter(
      ([x, y]) => Number.isFinite(x) && Number.isFinite(y),
    );
  const ways = [];
  for (const segment of document_.getElementsByTagName("trkseg")) ways.push(points(segment, "trkpt"));
  for (const route of document_.getElementsByTagName("rte")) ways.push(points(route, "rtept"));
  return ways.filter((way) => way.length > 1);
}

// A way as it is seen: pieces {seen, points}; the hidden ones run straight from where the way is lost to where it comes back.
function drawnWay(ground, way) {
  const pieces = [];
  let piece = null;
  let lost = null;
  for (const [longitude, latitude] of way) {
    const pixel = ground.locate(longitude, latitude);
    if (!pixel) {
      if (piece) lost = piece.points[piece.points.length - 1];
      piece = null;
      continue;
    }
    if (!piece) {
      if (lost) pieces.push({ seen: false, points: [lost, pixel] });
      piece = { seen: true, points: [] };
      pieces.push(piece);
    }
    piece.points.push(pixel);
  }
  return pieces.filter((p) => p.points.length > 1);
}
