// Pictures of the mock server: ridges behind each other that depend visibly on camera, sun, bands, exaggeration, air and palette.
import { deflateSync } from "node:zlib";

const degree = Math.PI / 180;
const mix = (a, b, t) => a + (b - a) * t;

function hash(n) {
  const x = Math.sin(n * 127.1) * 43758.5453;
  return x - Math.floor(x);
}
function noise(x) {
  const i = Math.floor(x);
  const f = x - i;
  return mix(hash(i), hash(i + 1), f * f * (3 - 2 * f));
}

function camera(values) {
  const viewer = values["camera.position"] ?? [0, 0];
  const target = values["camera.look_at"];
  const azimuth = target
    ? Math.atan2(target[0] - viewer[0], target[1] - viewer[1]) / degree
    : values["camera.azimuth_deg"] === "auto"
      ? 180
      : values["camera.azimuth_deg"];
  const pitch =
    (values["camera.pitch_deg"] === "auto" || values["camera.pitch_deg"] === undefined ? -12 : values["camera.pitch_deg"]) +
    (values["camera.tilt_deg"] === "auto" ? 0 : (values["camera.tilt_deg"] ?? 0));
  return {
    viewer,
    azimuth,
    pitch,
    field: values["camera.field_of_view_deg"],
    target: target ?? [viewer[0] + 50000 * Math.sin(azimuth * degree), viewer[1] + 50000 * Math.cos(azimuth * degree)],
  };
}
export { camera };

const palettes = {
  summer: [86, 116, 66],
  autumn: [140, 104, 58],
  winter: [206, 214, 222],
  evening: [150, 96, 84],
  morning: [112, 128, 128],
  desert: [176, 130, 88],
};

// {width, height, rgb}
export function draw(values, width, height) {
  const { viewer, azimuth, pitch, field } = camera(values);
  const weights = values["generalize.foreground"];
  const far_weights = values["generalize.background"] ?? weights;
  const number = (key, otherwise) => (typeof values[key] === "number" ? values[key] : otherwise);
  const up = number("deform.exaggeration", 1.5);
  const haze = number("air.haze", 0.85);
  const sun = number("sun.azimuth_deg", 315);
  const light = Math.max(0.15, Math.sin(number("sun.altitude_deg", 31) * degree + 0.35));
  const ground = palettes[values.palette] ?? palettes.summer;
  const rgb = Buffer.alloc(3 * width * height);
  const scale = height / 26; // px for a degree
  const horizon = height * 0.5 + (pitch + 3) * scale;
  const handles = Object.keys(values)
    .filter((key) => /^deform\.handles\.\d+\.raise_m$/.test(key))
    .reduce((sum, key) => sum + values[key], 0);
  const layers = 7;
  for (let x = 0; x < width; ++x) {
    const bearing = azimuth + (x / width - 0.5) * field;
    const tops = [];
    for (let layer = 0; layer < layers; ++layer) {
      const near = layer / (layers - 1);
      let h = 0;
      for (let band = 0; band < weights.length; ++band) {
        const frequency = 0.09 * 2 ** band * mix(1.2, 0.7, near);
        h +=
          (mix(far_weights[band] ?? 1, weights[band], near) *
            noise(bearing * frequency + 37 * layer + viewer[0] / 9000 + (viewer[1] / 15000) * near)) /
          1.7 ** band;
      }
      tops.push([
        horizon +
          near * near * height * 0.75 -
          (h - 0.9) * up * scale * mix(1.1, 3, near) -
          (layer === 3 ? (handles / 400) * Math.exp(-((x / width - 0.5) ** 2) * 90) * scale : 0),
        h,
      ]);
    }
    let slope = 0;
    for (let y = 0; y < height; ++y) {
      let found = -1;
      for (let layer = layers - 1; layer >= 0; --layer)
        if (y >= tops[layer][0]) {
          found = layer;
          break;
        }
      const at = 3 * (y * width + x);
      if (found < 0) {
        const t = Math.min(1, Math.max(0, y / Math.max(1, horizon)));
        rgb[at] = mix(112, 214, t);
        rgb[at + 1] = mix(148, 222, t);
        rgb[at + 2] = mix(186, 226, t);
        continue;
      }
      const near = found / (layers - 1);
      const depth = (y - tops[found][0]) / height;
      slope = noise(bearing * 1.3 + 11 * found + depth * 9) - noise(bearing * 1.3 + 0.35 + 11 * found + depth * 9);
      const lit = Math.min(1.25, Math.max(0.35, 0.75 + 1.5 * slope * Math.sin((sun - azimuth) * degree) + 0.25 * light));
      const rock = Math.max(0, 1 - depth * 11) * 0.8;
      const veil = Math.min(1, haze * (1 - near) ** 1.3);
      const colour = [mix(ground[0], 172, rock), mix(ground[1], 166, rock), mix(ground[2], 158, rock)];
      rgb[at] = Math.min(255, mix(colour[0] * lit, 196, veil));
      rgb[at + 1] = Math.min(255, mix(colour[1] * lit, 210, veil));
      rgb[at + 2] = Math.min(255, mix(colour[2] * lit, 224, veil));
    }
  }
  return { width, height, rgb };
}

// The ground of the mock under a share of the picture, {distance, position, altitude} or null for the sky: it rises to the horizon at a fifth
// of the height, and an edge across the middle hides 3 km of it. Ridges stand 5400 m apart in the left half, 1350 m in the right one.
export function ground(values, x, y) {
  if (y < 0.2) return null;
  const { viewer, azimuth, field } = camera(values);
  const distance = y < 0.5 ? 60000 * (1.05 - y) : 60000 * (1 - y) + 1000;
  const bearing = (azimuth + (x - 0.5) * field) * degree;
  const position = [viewer[0] + distance * Math.sin(bearing), viewer[1] + distance * Math.cos(bearing)];
  return { distance, position, altitude: 2600 - 1800 * y + 120 * Math.sin((2 * Math.PI * position[0]) / (x < 0.5 ? 5400 : 1350)) };
}

// The answer of api/seen.
export function seen(values, width, height) {
  const { viewer } = camera(values);
  const out = Buffer.alloc(24 + 16 * width * height);
  out.writeUInt32LE(width, 0);
  out.writeUInt32LE(height, 4);
  out.writeDoubleLE(viewer[0], 8);
  out.writeDoubleLE(viewer[1], 16);
  for (let i = 0; i < width * height; ++i) {
    const found = ground(values, ((i % width) + 0.5) / width, (Math.floor(i / width) + 0.5) / height);
    const { position, altitude, distance } = found ?? { position: [NaN, NaN], altitude: NaN, distance: Infinity };
    [position[0] - viewer[0], position[1] - viewer[1], altitude, distance].forEach((value, plane) =>
      out.writeFloatLE(value, 24 + 4 * (plane * width * height + i)),
    );
  }
  return out;
}

export function relief(width, height) {
  const rgb = Buffer.alloc(3 * width * height);
  const z = (x, y) =>
    noise(x / 40 + noise(y / 55) * 2) + noise(y / 30 + x / 90) + 0.4 * noise(x / 9 + y / 14) + 0.3 * noise(y / 8 - x / 17);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const shade = 150 + 700 * (z(x + 1, y + 1) - z(x, y)) + 12 * z(x, y);
      rgb.fill(Math.max(40, Math.min(235, shade)), 3 * (y * width + x), 3 * (y * width + x) + 3);
    }
  return { width, height, rgb };
}

export function part({ width, rgb }, x0, y0, w, h) {
  const out = Buffer.alloc(3 * w * h);
  for (let y = 0; y < h; ++y) rgb.copy(out, 3 * y * w, 3 * ((y0 + y) * width + x0), 3 * ((y0 + y) * width + x0 + w));
  return { width: w, height: h, rgb: out };
}

const table = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});
function crc(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) c = table[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}
function chunk(name, data) {
  const out = Buffer.alloc(12 + data.length);
  out.writeUInt32BE(data.length, 0);
  out.write(name, 4, "latin1");
  data.copy(out, 8);
  out.writeUInt32BE(crc(out.subarray(4, 8 + data.length)), 8 + data.length);
  return out;
}
export function png({ width, height, rgb }) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  const rows = Buffer.alloc((3 * width + 1) * height);
  for (let y = 0; y < height; ++y) rgb.copy(rows, y * (3 * width + 1) + 1, 3 * y * width, 3 * (y + 1) * width);
  return Buffer.concat([
    Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]),
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(rows, { level: 1 })),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}
