// Serves tools/studio/page and answers the JSON interface of `belvedere studio` (docs/studio.md) with drawn pictures, to work on the page and to
// test it without the program:
//   node tests/studio/mock_server.mjs [PORT]
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { setTimeout as sleep } from "node:timers/promises";
import { camera, draw, ground, part, png, relief, seen } from "./mock_picture.mjs";
import { edit, Fault, parse, schema } from "./mock_scene.mjs";

const token = "0123456789abcdef0123456789abcdef";
const page = new URL("../../tools/studio/page/", import.meta.url);
const types = { html: "text/html; charset=utf-8", css: "text/css", js: "text/javascript", svg: "image/svg+xml" };
const policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'";

const first_text = `# A scene of the mock server.
version = 1
title = "Karwendel"

[generalize]
# Lowest band first.
foreground = [1.2, 1.2, 1.1, 1.0, 1.1, 0.9]
background = [1.5, 1.5, 1.1, 0.6, 0.3, 0.15]
crest = 0.9

[deform]
exaggeration = 1.6
[deform.bend]
radius_m = 140000
crest_m = 82000

[camera]
position = [692000, 5302000]  # above Bad Tölz
height_m = 22000
look_at = [690000, 5249000]
tilt_deg = 1.1
field_of_view_deg = 50

[sun]
azimuth_deg = 315
altitude_deg = 30

[[light.regions]]
name = "Bettelwurf chain"
position = [690000, 5247000]
radius_m = 6000
turn_deg = 60

[output]
width = 2400
height = 1100
`;

// What the program finds for a picture, of all that its scene leaves open.
function found(values) {
  const by_target = values["camera.look_at"] !== undefined;
  const hour = Number(values["sun.time"]?.slice(11, 13));
  const all = [
    { key: "air.from_m", value: "34000", why: "0.45 times the distance of the horizon" },
    { key: "air.scale_m", value: "46000", why: "0.6 times the distance of the horizon" },
    { key: "air.rim_fade_m", value: "2700", why: "0.035 times the distance of the horizon" },
    { key: "generalize.foreground_to_m", value: "32000", why: "0.42 times the distance of the horizon" },
    { key: "generalize.background_from_m", value: "73000", why: "0.95 times the distance of the horizon" },
    ...(by_target
      ? [{ key: "camera.tilt_deg", value: "3.25", why: "an eighth of the picture is sky" }]
      : [
          { key: "camera.azimuth_deg", value: "180", why: "it shows most" },
          { key: "camera.pitch_deg", value: "-12", why: "an eighth of the picture is sky" },
        ]),
    { key: "sun.azimuth_deg", value: hour ? String(15 * hour + 3.47) : "68", why: hour ? "at that time" : "upper left of the picture" },
    { key: "sun.altitude_deg", value: hour ? String(hour + 11.21) : "31", why: hour ? "at that time" : "as painters place it" },
    { key: "deform.exaggeration", value: "1.5", why: "as tall as in painted panoramas" },
    { key: "deform.exaggeration_base_m", value: "560", why: "a tenth of the ground lies below" },
    { key: "style.scale", value: "1.37", why: "by the painting's size" },
  ];
  const open = (key) => values[key] === undefined || values[key] === "auto";
  return all.filter(({ key }) => open(key) && (key !== "deform.exaggeration_base_m" || open("deform.exaggeration")));
}
let derived = []; // of the last picture

const scene = { text: first_text, saved: first_text, revision: 1, undo: [], redo: [], step: "", outside: false, drawn: null };
let newest = 0; // of the requests for pictures
let newest_loupe = 0;
let job_s = 3; // POST mock/job
let stage = { stage: "", done: 0 };
let slow_ms = 0; // what each of them takes longer: POST mock/slow
const jobs = { render: { state: "idle" }, fetch: { state: "idle" }, painting: { state: "idle" } };
const timers = {};

// A job of two stages.
function begin(name, stages, folder, result) {
  if (jobs[name].state === "running") throw new Fault({ message: "another one is running" });
  const started = Date.now();
  jobs[name] = { state: "running", stage: stages[0], done: 0, elapsed_s: 0, left_s: job_s, folder, error: null };
  timers[name] = setInterval(() => {
    const elapsed_s = (Date.now() - started) / 1000;
    const done = Math.min(1, elapsed_s / job_s);
    Object.assign(jobs[name], { elapsed_s, done, left_s: job_s - elapsed_s, stage: stages[done > 0.5 ? 1 : 0] });
    if (done < 1) return;
    clearInterval(timers[name]);
    Object.assign(jobs[name], { state: "done", ...result });
  }, 100).unref();
  return jobs[name];
}
function cancel(name) {
  clearInterval(timers[name]);
  if (jobs[name].state === "running") jobs[name].state = "cancelled";
  return jobs[name];
}

function state() {
  const { values } = parse(scene.text);
  return {
    revision: scene.revision,
    file: "/home/user/scenes/mock.toml",
    name: "mock",
    title: values.title ?? "",
    saved: scene.text === scene.saved,
    can_undo: scene.undo.length > 0,
    can_redo: scene.redo.length > 0,
    text: scene.text,
    drawn: scene.drawn,
    drawn_file: "mock_drawn.geojson",
    values,
    derived,
    error: null,
    notes: [],
    outside: scene.outside,
  };
}

function change(text, step) {
  parse(text);
  if (text === scene.text) return;
  if (!step || step !== scene.step) scene.undo.push(scene.text);
  scene.step = step;
  scene.redo = [];
  scene.text = text;
  ++scene.revision;
}
function back(from, to) {
  if (from.length === 0) throw new Fault({ message: "there is nothing to go back to" });
  to.push(scene.text);
  scene.text = from.pop();
  scene.step = "";
  ++scene.revision;
}

// The ladder of a page: the last rung has the width that it asks for, and no more than the sheet.
const rungs = (query) => {
  const { values } = parse(scene.text);
  const width = Math.min(values["output.width"], Math.max(64, Math.min(2400, Number(query?.get("width") || 1000))));
  const misty = Object.keys(values).some((key) => key.startsWith("air.mist.")) ? ["mist"] : [];
  const ratio = values["output.height"] / values["output.width"];
  const rung = (index, name, width, without) => ({ rung: index, name, width, height: Math.round(width * ratio), without });
  return [
    rung(0, "light and colour", 400, ["fine ground", "rock relief", "strokes", "paint", ...misty]),
    rung(1, "fine ground", 800, ["rock relief", "strokes", "paint", ...misty]),
    rung(2, "strokes", 1000, ["paint"]),
    rung(3, "paint", width, []),
  ];
};

const superseded = () => Object.assign(new Fault({ message: "superseded" }), { status: 409 });

const answers = {
  "GET api/scene": () => state(),
  "GET api/schema": () => schema,
  "GET api/choices": () => ({
    styles: ["bruegel", "gogh", "monet", "segantini", "turner"],
    palettes: ["autumn", "desert", "evening", "morning", "summer", "winter"],
    projections: ["perspective", "oblique", "cylindrical", "panini"],
  }),
  "POST api/set": (_, body) => {
    const { changes, step } = JSON.parse(body);
    let text = scene.text;
    for (const each of changes) text = edit(text, each);
    change(text, step);
    return state();
  },
  "POST api/draw": (_, body) => {
    const { features, changes, step } = JSON.parse(body);
    const before = scene.drawn;
    scene.drawn = features;
    let text = scene.text;
    for (const each of changes) text = edit(text, each);
    if (text !== scene.text) change(text, step);
    else if (JSON.stringify(before) !== JSON.stringify(features)) ++scene.revision;
    return state();
  },
  // One summit, where the scene names a file of points; the engine's SVG stands for a letter.
  "GET api/names": () => {
    const { values } = parse(scene.text);
    if (!values["labels.points.0.file"]) return { names: [] };
    const at = values["labels.by_hand.0.name"] ? "labels.by_hand.0." : "none.";
    const px_per_mm = 2;
    const mark = [300, 200];
    const by_hand = values[`${at}dx_mm`] === undefined ? null : [values[`${at}dx_mm`], values[`${at}dy_mm`]];
    const foot = by_hand ? [mark[0] + px_per_mm * by_hand[0], mark[1] + px_per_mm * by_hand[1]] : [300, 190];
    const box = [foot[0] - 60, foot[1] - 40, foot[0] + 60, foot[1]];
    const svg = `<text x="${foot[0]}" y="${foot[1]}" font-size="40" text-anchor="middle">Birkkar</text>`;
    const name = { name: "Birkkar", text: "Birkkar", kind: values[`${at}kind`] ?? "summit", rank: 3, placed: true, along: false, by_hand, mark, box, svg };
    return { width: 2400, height: 1100, px_per_mm, kinds: ["summit", "hut"], tracks: "", names: values[`${at}hidden`] ? [] : [name] };
  },
  "POST api/text": (_, body) => {
    change(JSON.parse(body).text, "");
    return state();
  },
  "POST api/undo": () => {
    back(scene.undo, scene.redo);
    return state();
  },
  "POST api/redo": () => {
    back(scene.redo, scene.undo);
    return state();
  },
  "POST api/save": () => {
    scene.saved = scene.text;
    scene.outside = false;
    return state();
  },
  "POST api/reload": () => {
    scene.outside = false;
    change(scene.saved, "");
    return state();
  },
  "POST api/revert": () => {
    change(scene.saved, "");
    return state();
  },
  "GET api/rungs": (query) => rungs(query),
  "GET api/stage": () => stage,
  "GET api/pointer": async (query) => {
    await sleep(slow_ms);
    const y = Number(query.get("y"));
    const found = ground(parse(scene.text).values, Number(query.get("x")), y);
    if (!found) return { sky: true };
    return {
      sky: false,
      position: found.position,
      lonlat: [11.4 + Number(query.get("x")) / 2, 47.5 - y / 4],
      altitude_m: found.altitude,
      distance_m: found.distance,
      class: y > 0.6 ? "forest" : "rock",
    };
  },
  "GET api/place": (query) => {
    const [east, north] = [Number(query.get("east")), Number(query.get("north"))];
    return { sky: false, position: [east, north], lonlat: [11 + (east - 650000) / 75000, 47 + (north - 5200000) / 111000], altitude_m: 900 };
  },
  "GET api/map": () => {
    const { values } = parse(scene.text);
    const { viewer, target, azimuth, field } = camera(values);
    return {
      revision: scene.revision,
      extent: [650000, 5220000, 730000, 5290000],
      width: 600,
      height: 525,
      crs: "EPSG:32632",
      viewer,
      height_m: 22000,
      target,
      azimuth_deg: azimuth,
      field_of_view_deg: field,
      handles: [],
      cell_m: 30,
    };
  },
  "GET api/check": () => {
    const { values } = parse(scene.text);
    return {
      revision: scene.revision,
      items: [
        { name: "sky", value: "18 %", meaning: "of the picture is above the skyline", verdict: "good", advice: "" },
        { name: "rim", value: "hidden", verdict: "good", advice: "" },
        {
          name: "forms",
          value: "9 %",
          side: "low",
          verdict: "note",
          advice: "A smaller radius of the bend shows more of it: try belvedere deform --search-bend.",
        },
        values["camera.field_of_view_deg"] > 70
          ? {
              name: "edges",
              value: `${values["camera.field_of_view_deg"]}°`,
              verdict: "bad",
              advice: "Perspective stretches the edges: take panini.",
            }
          : { name: "edges", value: "not stretched", verdict: "good", advice: "" },
        { name: "summits", value: "2 cut", verdict: "note", advice: "Tilt the view up by 0.6°." },
      ],
    };
  },
  "GET api/proposals": () => ({
    proposals: [
      {
        name: "From the north",
        why: "The valley lies open and three ranges stand one behind the other.",
        changes: [
          { key: "camera.position", value: [692000, 5302000] },
          { key: "camera.look_at", value: [690000, 5249000] },
        ],
      },
      {
        name: "From the west",
        why: "Along the valley, with morning light on the walls.",
        changes: [
          { key: "camera.position", value: [640000, 5250000] },
          { key: "camera.look_at", value: [700000, 5250000] },
        ],
      },
      {
        name: "Wide",
        why: "All of the data, on a cylinder.",
        changes: [
          { key: "camera.projection", value: "cylindrical" },
          { key: "camera.field_of_view_deg", value: 110 },
        ],
      },
    ],
  }),
  "POST api/render": (_, body) => {
    const { width } = JSON.parse(body);
    if (!(width >= 16 && width <= 65535)) throw new Fault({ message: `the width is ${width}, allowed: 16 … 65535 px` });
    return begin("render", ["Rays", "Strokes"], "/home/user/scenes/mock_rendered", { page: "render/index.html" });
  },
  "GET api/render": () => jobs.render,
  "POST api/render/cancel": () => cancel("render"),
  "POST api/fetch": (_, body) => {
    const { place } = JSON.parse(body);
    const [lon, lat] = place.split(",").map(Number);
    if (place.split(",").length !== 2 || !Number.isFinite(lon + lat))
      throw new Fault({ message: `"${place}"`, allowed: "longitude and latitude in degrees: 11.4, 47.35" });
    if (Math.abs(lat) > 90) throw new Fault({ message: `latitude is ${lat}`, allowed: "-90 … 90 °" });
    return begin("fetch", ["fetching", "looking for views"], `/home/user/scenes/place_${lon}_${lat}`, {
      text: first_text.replace('"Karwendel"', `"${place}"`),
    });
  },
  "POST api/style": (_, body) => begin("painting", ["segmenting"], "", { result: JSON.parse(body).painting.replace(/\.\w+$/, "_style.toml") }),
  "POST api/pick": () => begin("painting", ["looking for summits"], "", { result: "pick/" }),
  "GET api/painting": () => jobs.painting,
  "GET api/fetch": () => jobs.fetch,
  "POST api/fetch/cancel": () => cancel("fetch"),
  "POST api/files": (query) => {
    const name = query.get("name");
    if (/[/\\]/.test(name)) throw new Fault({ message: "a name without folders" });
    const kind = { tif: "terrain", gpx: "track", geojson: "features", jpg: "painting", toml: "scene", csv: "names" }[name.split(".").at(-1)] ?? "other";
    return { file: name, kind };
  },
  // The mock's own: a file changed by another program.
  "POST mock/outside": () => {
    scene.outside = true;
    return {};
  },
  "POST mock/job": (_, body) => {
    job_s = Number(body);
    return {};
  },
  "POST mock/slow": (_, body) => {
    slow_ms = Number(body);
    return {};
  },
};

const image = (response, bytes, headers = {}) =>
  response.writeHead(200, { "Content-Type": "image/png", "Cache-Control": "no-store", ...headers }).end(bytes);

const pictures = {
  "GET api/picture": async (query, response) => {
    if (Number(query.get("revision")) !== scene.revision) throw superseded();
    const mine = ++newest;
    const { width, height, without } = rungs(query)[Number(query.get("rung"))];
    const started = performance.now();
    await sleep(slow_ms + 5 + 30 * Number(query.get("rung")));
    if (mine !== newest) throw superseded();
    const { values } = parse(scene.text);
    derived = found(values);
    const bytes = png(draw(values, width, height));
    image(response, bytes, {
      "X-Belvedere-Revision": scene.revision,
      "X-Belvedere-Without": without.join(", "),
      "X-Belvedere-Halved": without.length > 0 ? 2 : 0,
      "X-Belvedere-Milliseconds": Math.round(performance.now() - started),
    });
  },
  "GET api/tiles": async (query, response) => {
    if (jobs.render.state === "running") throw superseded();
    if (Number(query.get("revision")) !== scene.revision) throw superseded();
    const mine = ++newest;
    const { width, height } = rungs(query).at(-1);
    const picture = draw(parse(scene.text).values, width, height);
    const record = (header, bytes = Buffer.alloc(0)) => {
      const text = Buffer.from(JSON.stringify({ ...header, bytes: bytes.length }));
      const size = Buffer.alloc(4);
      size.writeUInt32BE(text.length);
      response.write(Buffer.concat([size, text, bytes]));
    };
    response.writeHead(200, { "Content-Type": "application/octet-stream" });
    record({ stage: "choosing texture", done: 0 });
    const tiles = [];
    for (let y = 0; y < height; y += 256)
      for (let x = 0; x < width; x += 256) tiles.push({ x, y, width: Math.min(256, width - x), height: Math.min(256, height - y) });
    const far = (tile) => Math.hypot(tile.x + tile.width / 2 - width / 2, tile.y + tile.height / 2 - height / 2);
    tiles.sort((a, b) => far(a) - far(b));
    for (const [index, tile] of tiles.entries()) {
      await sleep(25);
      if (mine !== newest || response.destroyed) return response.end();
      record({ ...tile, done: (index + 1) / tiles.length }, png(part(picture, tile.x, tile.y, tile.width, tile.height)));
    }
    response.end();
  },
  "GET api/seen": (query, response) => {
    if (Number(query.get("revision")) !== scene.revision) throw superseded();
    const { values } = parse(scene.text);
    const height = Math.round((360 * values["output.height"]) / values["output.width"]);
    response.writeHead(200, { "Content-Type": "application/octet-stream" }).end(seen(values, 360, height));
  },
  "GET api/loupe": async (query, response) => {
    const [x, y, width, height] = ["x", "y", "width", "height"].map((name) => Number(query.get(name)));
    if (Number(query.get("revision")) !== scene.revision) throw superseded();
    if (!(width <= 800 && height <= 800)) throw new Fault({ message: `${width} × ${height} px, allowed: 800` });
    const mine = ++newest_loupe;
    const { values } = parse(scene.text);
    stage = { stage: "strokes", done: 0.4 };
    await sleep(slow_ms + 900);
    if (mine !== newest_loupe || Number(query.get("revision")) !== scene.revision) throw superseded();
    stage = { stage: "", done: 0 };
    const [print_width, print_height] = [values["output.width"], values["output.height"]];
    const place = (share, size, whole) => Math.max(0, Math.min(whole - size, Math.round(share * whole - size / 2)));
    const [left, top] = [place(x, width, print_width), place(y, height, print_height)];
    const bytes = png(part(draw(values, print_width, print_height), left, top, width, height));
    image(response, bytes, { "X-Belvedere-Left": left, "X-Belvedere-Top": top });
  },
  "POST api/thumbnail": async (_, response, body) => {
    const { changes, width } = JSON.parse(body);
    const mine = ++newest;
    await sleep(slow_ms + 20);
    if (mine !== newest) throw superseded();
    const { values } = parse(changes.reduce(edit, scene.text));
    image(response, png(draw(values, width, Math.round((width * values["output.height"]) / values["output.width"]))));
  },
  "GET api/map.png": (_, response) => image(response, png(relief(600, 525))),
};

async function answer(request, response) {
  const address = new URL(request.url, "http://127.0.0.1");
  if (!address.pathname.startsWith(`/${token}/`)) return response.writeHead(403).end("The address has no token.");
  const path = address.pathname.slice(token.length + 2);
  const name = `${request.method} ${path}`;
  const chunks = [];
  for await (const each of request) chunks.push(each);
  try {
    if (pictures[name]) return await pictures[name](address.searchParams, response, Buffer.concat(chunks).toString());
    if (name.startsWith("GET api/proposals/")) {
      const { proposals } = answers["GET api/proposals"]();
      const values = { ...parse(scene.text).values };
      for (const { key, value } of proposals[Number.parseInt(path.split("/").at(-1), 10)].changes) values[key] = value;
      return image(response, png(draw(values, 300, 138)));
    }
    if (answers[name]) {
      const body = JSON.stringify(await answers[name](address.searchParams, Buffer.concat(chunks).toString()));
      return response
        .writeHead(["POST api/render", "POST api/fetch"].includes(name) ? 202 : 200, { "Content-Type": "application/json" })
        .end(body);
    }
    const file = path === "" ? "index.html" : path;
    if (!/^[a-z_]+\.(html|css|js|svg)$/.test(file)) return response.writeHead(404).end();
    response
      .writeHead(200, { "Content-Type": types[file.split(".")[1]], "Content-Security-Policy": policy })
      .end(await readFile(new URL(file, page)));
  } catch (error) {
    if (!(error instanceof Fault)) console.error(error);
    const fault = error.fault ?? { message: error.message };
    if (!response.headersSent) response.writeHead(error.status ?? 422, { "Content-Type": "application/json" });
    response.end(JSON.stringify({ error: fault }));
  }
}

// Starts on a port, 0 for a free one: {address, close()}.
export async function serve(port = 0) {
  const server = createServer(answer);
  await new Promise((resolve) => server.listen(port, "127.0.0.1", resolve));
  return {
    address: `http://127.0.0.1:${server.address().port}/${token}/`,
    close: () => {
      server.closeAllConnections();
      server.close();
    },
  };
}

if (process.argv[1] === new URL(import.meta.url).pathname) console.log((await serve(Number(process.argv[2] ?? 0))).address);
