// What a user does on the page of the studio, in headless Chromium: against the mock server, or against a running program by its address:
//   npm --prefix tests/studio ci && node --test tests/studio/studio_test.mjs
//   BELVEDERE_STUDIO=http://127.0.0.1:PORT/TOKEN/ node --test tests/studio/studio_test.mjs
// The scene of that program needs a camera with look_at; it is saved by the test: give it a copy. BELVEDERE_RUNG=1 waits for that rung
// instead of the last one, where that takes long. BELVEDERE_PLACE="11.5, 47.5" is a place whose elevation its --mirror has.
import assert from "node:assert/strict";
import { mkdtemp, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import puppeteer from "puppeteer-core";
import { serve } from "./mock_server.mjs";

const enough = process.env.BELVEDERE_RUNG;
const patience = { timeout: Number(process.env.BELVEDERE_PATIENCE_MS ?? 15000) };
let server, browser, page, address;
const errors = [];

before(async () => {
  server = process.env.BELVEDERE_STUDIO ? null : await serve();
  address = process.env.BELVEDERE_STUDIO ?? server.address;
  browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 720 });
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("dialog", (dialog) => dialog.accept());
  await page.goto(address);
  await finished();
});
after(async () => {
  await browser?.close();
  server?.close();
});

const scene = () => page.evaluate(async () => (await fetch("api/scene")).json());
const value = async (key) => (await scene()).values[key];
const text_of = (selector) => page.$eval(selector, (found) => found.textContent);
// The ladder has reached its last rung, or the one that is enough, for the newest revision.
async function finished() {
  await sleep(150);
  await page.waitForFunction(
    (rung) => document.body.dataset.working === "false" || Number(document.body.dataset.rung) >= rung,
    patience,
    Number(enough ?? Infinity),
  );
}
// A number that changes when the picture does.
const picture = () =>
  page.evaluate(() => {
    const canvas = document.getElementById("picture");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0;
    for (let k = 0; k < data.length; k += 4) sum = (sum * 31 + data[k] + 3 * data[k + 1] + 7 * data[k + 2]) % 2147483647;
    return sum;
  });
async function middle(selector) {
  const box = await (await page.waitForSelector(selector, { visible: true, ...patience })).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}
async function drag(selector, dx, dy, steps = 12) {
  const [x, y] = await middle(selector);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps });
  await page.mouse.up();
}
async function panel(id) {
  await page.click(`#tab-${id}`);
}
async function changed(key, from) {
  const start = Date.now();
  for (;;) {
    const now = await value(key);
    if (JSON.stringify(now) !== JSON.stringify(from)) return now;
    assert.ok(Date.now() - start < patience.timeout, `${key} has not changed from ${JSON.stringify(from)}`);
    await sleep(50);
  }
}
async function becomes(key, wanted) {
  const start = Date.now();
  while (JSON.stringify(await value(key)) !== JSON.stringify(wanted)) {
    assert.ok(Date.now() - start < patience.timeout, `${key} is ${JSON.stringify(await value(key))}, not ${JSON.stringify(wanted)}`);
    await sleep(50);
  }
}
async function keys(...names) {
  for (const name of names.slice(0, -1)) await page.keyboard.down(name);
  await page.keyboard.press(names.at(-1));
  for (const name of names.slice(0, -1).reverse()) await page.keyboard.up(name);
}
const undo = async () => {
  const { revision } = await scene();
  await page.click("#undo");
  await page.waitForFunction((before) => Number(document.body.dataset.revision) > before, patience, revision);
};

test("opens with the whole ladder drawn, a map and a critique", async () => {
  if (!enough) assert.match(await text_of("#rung"), /complete/);
  await page.waitForFunction(
    () => document.querySelector("#relief").complete && document.querySelectorAll("#critique .sign").length > 0,
    patience,
  );
  assert.ok(await page.$("#signs .viewer"));
});

test("the camera's arithmetic", async () => {
  const found = await page.evaluate(async () => {
    const { moved, turned, view, widened } = await import("./camera.js");
    const made = (values, map = {}) => ({
      map,
      value: (key) => values[key],
      number: (key) => (typeof values[key] === "number" ? values[key] : undefined),
      given: (key) => values[key] !== undefined && values[key] !== "auto",
    });
    const north = made({ "camera.position": [0, 0], "camera.look_at": [0, 10000], "camera.tilt_deg": 1 });
    const angles = made({ "camera.position": [0, 0], "camera.azimuth_deg": 350, "camera.pitch_deg": -10 }, { target: [0, 10000] });
    const lonlat = made({ "camera.position_lonlat": [11, 47], "camera.azimuth_deg": 90 }, { viewer: [500, 600], target: [1500, 600] });
    return {
      right: turned(north, view(north), 90, 0),
      up: turned(north, view(north), 0, 2),
      around: turned(angles, view(angles), 20, -100),
      forward: moved(north, view(north), 0.5, 0),
      aside: moved(north, view(north), 0, 0.1),
      high: moved(north, view(north), 0, 0, 100),
      lonlat: moved(lonlat, view(lonlat), 0.5, 0),
      wide: widened(made({ "camera.field_of_view_deg": 149, "camera.projection": "perspective" }), 1.1),
    };
  });
  assert.deepEqual(found.right, [{ key: "camera.look_at", value: [10000, 0] }]);
  assert.deepEqual(found.up, [{ key: "camera.tilt_deg", value: 3 }]);
  assert.deepEqual(found.around, [
    { key: "camera.azimuth_deg", value: 10 },
    { key: "camera.pitch_deg", value: -90 },
  ]);
  assert.deepEqual(found.forward, [{ key: "camera.position", value: [0, 5000] }]);
  assert.deepEqual(found.aside, [
    { key: "camera.position", value: [1000, 0] },
    { key: "camera.look_at", value: [1000, 10000] },
  ]);
  assert.deepEqual(found.high, [{ key: "camera.height_m", value: 3100 }]);
  assert.deepEqual(found.lonlat, [{ key: "camera.position", value: [1000, 600] }]);
  assert.deepEqual(found.wide, [{ key: "camera.field_of_view_deg", value: 150 }]);
});

test("dragging the picture looks around, in one step of undo", async () => {
  const [before, drawn] = [await value("camera.look_at"), await picture()];
  await drag("#picture", 160, 30);
  await finished();
  const after_drag = await value("camera.look_at");
  assert.notDeepEqual(after_drag, before);
  assert.notEqual(await picture(), drawn);
  await undo();
  assert.deepEqual(await value("camera.look_at"), before);
  await finished();
  if (!enough) assert.equal(await picture(), drawn, "undo draws the same pixels again");
});

test("the wheel moves forwards, shift drag moves sideways", async () => {
  const before = await value("camera.position");
  await page.mouse.move(...(await middle("#picture")));
  await page.mouse.wheel({ deltaY: -120 });
  const nearer = await changed("camera.position", before);
  const target = await value("camera.look_at");
  const far = (at) => Math.hypot(at[0] - target[0], at[1] - target[1]);
  assert.ok(far(nearer) < far(before));
  await sleep(800);
  await page.keyboard.down("Shift");
  await drag("#picture", 80, 0);
  await page.keyboard.up("Shift");
  await changed("camera.position", nearer);
  await finished();
  await undo();
  assert.deepEqual(await value("camera.position"), nearer);
  await undo();
  assert.deepEqual(await value("camera.position"), before);
});

test("a slider, an upright slider of the equalizer and a number field", async () => {
  const bands = await value("generalize.foreground");
  await panel("equalizer");
  await drag(".band input[type=range]", 0, -30);
  const pulled = await changed("generalize.foreground", bands);
  assert.ok(pulled[0] > bands[0]);
  assert.deepEqual(pulled.slice(1), bands.slice(1));

  await panel("camera");
  const row = "[data-key='camera.field_of_view_deg']";
  const field = await value("camera.field_of_view_deg");
  await drag(`${row} input[type=range]`, 40, 0);
  const wider = await changed("camera.field_of_view_deg", field);
  await page.$eval(`${row} input[type=number]`, (input) => input.select());
  await page.type(`${row} input[type=number]`, "44");
  await page.keyboard.press("Enter");
  await changed("camera.field_of_view_deg", wider);
  assert.equal(await value("camera.field_of_view_deg"), 44);
  await undo();
  await undo();
  assert.equal(await value("camera.field_of_view_deg"), field);
  await undo();
  assert.deepEqual(await value("generalize.foreground"), bands);
});

test("one band more is a neutral one in front, so that the ground stays; one less takes it away", async () => {
  await panel("equalizer");
  const press = (label) =>
    page.evaluate(
      (wanted) => [...document.querySelectorAll(".equalizer button")].find((each) => each.textContent === wanted).click(),
      label,
    );
  const [near, far] = [await value("generalize.foreground"), await value("generalize.background")];
  await press("One band more");
  assert.deepEqual(await changed("generalize.foreground", near), [1, ...near]);
  assert.deepEqual(await value("generalize.background"), [1, ...far]);
  await press("One less");
  await becomes("generalize.foreground", near);
  await becomes("generalize.background", far);
  await undo();
  await undo();
});

test("sliders of landforms too small for a preview are grey while it is shown", async () => {
  await panel("equalizer");
  const bands = await value("generalize.foreground");
  await page.evaluate(() => {
    window.grey = 0;
    const count = () => (window.grey = Math.max(window.grey, document.querySelectorAll(".band.beyond").length));
    new MutationObserver(count).observe(document.querySelector(".bands"), { subtree: true, attributes: true });
  });
  await drag(".band input[type=range]", 0, -30);
  await changed("generalize.foreground", bands);
  await finished();
  assert.equal(await page.evaluate(() => window.grey), 4);
  assert.equal(await page.$$eval(".band.beyond", (found) => found.length), 0);
  await undo();
});

test("a value out of range is told at its control and changes nothing", async () => {
  await panel("camera");
  const row = "[data-key='camera.field_of_view_deg']";
  const { revision } = await scene();
  await page.click("#nearer"); // still being drawn when the next change is refused
  await page.waitForFunction((was) => Number(document.body.dataset.revision) > was, patience, revision);
  const before = await scene();
  await page.$eval(`${row} input[type=number]`, (input) => input.select());
  await page.type(`${row} input[type=number]`, "900");
  await page.keyboard.press("Enter");
  await page.waitForSelector(`${row} .fault:not([hidden])`, patience);
  assert.equal(await page.$eval(`${row} input[type=number]`, (input) => input.getAttribute("aria-invalid")), "true");
  assert.equal((await scene()).revision, before.revision);
  await finished();
  // What is told at its control is not told below the picture as well.
  assert.ok(await page.$("#message[hidden]"));
  await undo();
});

test("the sun turns on its dial", async () => {
  await panel("sun");
  const before = await value("sun.azimuth_deg");
  const [x, y] = await middle(".dial");
  await page.mouse.move(x + 45, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 45, { steps: 8 });
  await page.mouse.up();
  await changed("sun.azimuth_deg", before);
  await finished();
  assert.ok(Math.abs((await value("sun.azimuth_deg")) - 180) < 3);
  await page.click("#sun-timed");
  assert.match(await changed("sun.time", undefined), /T09:00:00/);
  await undo();
  await undo();
  assert.equal(await value("sun.azimuth_deg"), before);
});

test("a summit is pulled up in one step", async () => {
  await panel("ground");
  await page.click("#pull");
  await drag("#picture", 0, -60);
  await changed("deform.handles.0.raise_m", undefined);
  await finished();
  assert.ok((await value("deform.handles.0.raise_m")) > 0);
  await undo();
  assert.equal(await value("deform.handles.0.raise_m"), undefined);
});

test("a light is put down by keys", async () => {
  await panel("lights");
  const lights = await page.evaluate(() => document.querySelectorAll("#panel-lights details").length);
  await page.evaluate(() =>
    [...document.querySelectorAll("#panel-lights button")].find((each) => each.textContent.startsWith("Put a light")).focus(),
  );
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => document.activeElement.id), "picture");
  await page.keyboard.press("Enter");
  await changed(`light.regions.${lights}.turn_deg`, undefined);
  await finished();
  await undo();
});

test("the viewer moves on the map", async () => {
  const before = await value("camera.position");
  await drag("#signs .viewer", 12, 8, 4);
  await changed("camera.position", before);
  await finished();
  await undo();
  assert.deepEqual(await value("camera.position"), before);
});

test("a text with an error is told at its line, and mended", async () => {
  await panel("text");
  const { text } = await scene();
  const type = (what) =>
    page.$eval(
      "#text",
      (area, now) => {
        area.value = now;
        area.dispatchEvent(new Event("input", { bubbles: true }));
      },
      what,
    );
  await type(`${text}\nnonsense\n`);
  await page.waitForSelector("#text-fault:not([hidden])", patience);
  assert.equal(await page.$eval("#lines .faulty", (line) => line.textContent), String(text.split("\n").length + 1));
  assert.equal((await scene()).text, text);
  await type(`${text}# a remark\n`);
  await page.waitForFunction((before) => Number(document.body.dataset.revision) > before, patience, (await scene()).revision - 1);
  const start = Date.now();
  while (!(await scene()).text.endsWith("# a remark\n")) {
    assert.ok(Date.now() - start < patience.timeout);
    await sleep(50);
  }
  await page.waitForSelector("#text-fault[hidden]", patience);
  await page.click("#undo");
  await page.waitForFunction((was) => document.getElementById("text").value === was, patience, text);
});

test("a draft with an error stays with its message, and undoes nothing that is changed elsewhere", async () => {
  const haze = await value("air.haze");
  const { text } = await scene();
  await panel("text");
  await page.focus("#text");
  await keys("Control", "End");
  await page.keyboard.type("\nnonsense = 3\n");
  await page.waitForFunction(() => /nonsense/.test(document.getElementById("text-fault").textContent), patience);
  await panel("air");
  await page.$eval("[data-key='air.haze'] input[type=range]", (slider) => {
    slider.value = Number(slider.min) + 0.7 * (Number(slider.max) - Number(slider.min));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    slider.dispatchEvent(new Event("change", { bubbles: true }));
  });
  const now = await changed("air.haze", haze);
  await panel("text");
  const says = await text_of("#text-fault");
  assert.match(says, /nonsense/);
  assert.match(says, /changed beside this draft/);
  assert.match(await page.$eval("#text", (area) => area.value), /nonsense/);
  for (let k = 0; k < 16; ++k) await page.keyboard.press("Backspace");
  await page.focus("#text");
  await keys("Control", "End");
  for (let k = 0; k < 15; ++k) await page.keyboard.press("Backspace");
  await sleep(1200);
  assert.equal(await value("air.haze"), now, "the slider's value is not undone");
  await page.click("#text-back");
  await page.waitForFunction((wanted) => document.getElementById("text").value.includes(`haze = ${wanted}`), patience, now);
  await undo();
  assert.equal((await scene()).text, text);
  await finished();
});

test("a version is kept and compared by a border", async () => {
  await page.click("#keep");
  await panel("camera");
  const before = await value("camera.look_at");
  await drag("#picture", 120, 0);
  await changed("camera.look_at", before);
  await finished();
  await page.click("#compare");
  await page.waitForSelector("#border:not([hidden])", patience);
  const share = () => page.$eval("#border", (border) => Number(border.getAttribute("aria-valuenow")));
  assert.equal(await share(), 50);
  await drag("#border", -100, 0);
  assert.ok((await share()) < 45);
  await page.focus("#border");
  await page.keyboard.press("End");
  assert.equal(await share(), 100);
  await page.click("#to-kept");
  await becomes("camera.look_at", before);
  await finished();
  await page.click("#compare");
});

test("all by keyboard: look, move, a panel, a slider, undo, save, help", async () => {
  await page.focus("#picture");
  const before = await value("camera.look_at");
  await page.keyboard.press("ArrowRight");
  await changed("camera.look_at", before);
  const position = await value("camera.position");
  await page.keyboard.press("+");
  await changed("camera.position", position);
  await page.keyboard.press("5");
  assert.equal(await page.evaluate(() => document.activeElement.id), "tab-air");
  const haze = await value("air.haze");
  for (
    let k = 0;
    k < 40 &&
    !(await page.evaluate(() => document.activeElement.closest("[data-key='air.haze']") && document.activeElement.type === "range"));
    ++k
  )
    await page.keyboard.press("Tab");
  await page.keyboard.press("ArrowLeft");
  await changed("air.haze", haze);
  const less = await value("air.haze");
  await keys("Control", "z");
  await becomes("air.haze", haze);
  await keys("Control", "Shift", "z");
  await becomes("air.haze", less);
  await keys("Control", "s");
  const start = Date.now();
  while (!(await scene()).saved) {
    assert.ok(Date.now() - start < patience.timeout);
    await sleep(50);
  }
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("?");
  await page.waitForSelector("#help-dialog[open]", patience);
  await page.keyboard.press("Enter"); // its button
  await page.waitForSelector("#help-dialog:not([open])", patience);
});

test("proposals are shown, and taken in one step", async () => {
  await page.click("#propose");
  await page.waitForSelector(".proposal", { timeout: 4 * patience.timeout });
  const { text, revision } = await scene();
  await page.evaluate(() => document.querySelectorAll(".proposal")[1].click());
  await page.waitForFunction((before) => Number(document.body.dataset.revision) > before, patience, revision);
  assert.notEqual((await scene()).text, text);
  await finished();
  await undo();
  assert.equal((await scene()).text, text);
});

test("a file is sent, offered for what it is, and switched off and on", async () => {
  const file = join(await mkdtemp(join(tmpdir(), "studio-")), `tour ${Date.now()}.gpx`);
  await writeFile(
    file,
    `<gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1"><trk><name>Tour</name><trkseg>
    <trkpt lat="47.30" lon="11.40"/><trkpt lat="47.35" lon="11.45"/></trkseg></trk></gpx>`,
  );
  const tracks = ((await scene()).text.match(/\[\[labels\.tracks\]\]/g) ?? []).length;
  const key = `labels.tracks.${tracks}`;
  const input = await page.$("#choose-files");
  await input.uploadFile(file);
  await page.waitForSelector("#files-list .buttons button", patience);
  assert.equal(await text_of("#files-list .buttons button"), "Draw it as a track");
  await page.click("#files-list .buttons button");
  assert.match(await changed(`${key}.file`, undefined), /^tour.*gpx$/);
  const { text } = await scene();
  // Off and on again without opening its block; undo turns it back as well.
  await panel("names");
  const enabled = `[data-key='${key}.enabled']`;
  await page.waitForSelector(enabled, patience);
  const on = () => page.$eval(enabled, (input) => input.checked);
  assert.equal(await on(), true);
  await page.click(enabled);
  await becomes(`${key}.enabled`, false);
  assert.ok((await scene()).text.includes("enabled = false"));
  await undo();
  await page.waitForFunction((selector) => document.querySelector(selector).checked, patience, enabled);
  assert.equal((await scene()).text, text);
  await finished();
  await undo();
});

test("the picture is rendered, and the rendering cancelled", async () => {
  await page.click("#render");
  await page.$eval("#render-width", (field) => field.select());
  await page.type("#render-width", "160");
  await page.click("#render-start");
  await page.waitForSelector("#render-page:not([hidden])", { timeout: 8 * patience.timeout });
  await page.click("#render-start");
  await page.waitForSelector("#render-cancel:not([hidden])", patience);
  await page.click("#render-cancel");
  await page.waitForFunction(() => /Cancelled/.test(document.getElementById("render-says").textContent), patience);
  await page.keyboard.press("Escape");
});

const type_in = async (selector, text) => {
  await page.$eval(selector, (field) => field.select());
  await page.type(selector, text);
};

const at_rest = async () => {
  await finished();
  await page.waitForFunction(() => document.body.dataset.seen === document.body.dataset.revision, patience);
};
// Which parts of a canvas over the picture are drawn: a share of its pixels in a rectangle of shares.
const drawn_in = (id, left, top, right, bottom) =>
  page.evaluate(
    (name, box) => {
      const canvas = document.getElementById(name);
      const [x0, y0, x1, y1] = box.map((share, k) => Math.round(share * (k % 2 ? canvas.height : canvas.width)));
      if (x1 <= x0 || y1 <= y0) return 0;
      const { data } = canvas.getContext("2d").getImageData(x0, y0, x1 - x0, y1 - y0);
      let count = 0;
      for (let k = 3; k < data.length; k += 4) count += data[k] > 60;
      return (4 * count) / data.length;
    },
    id,
    [left, top, right, bottom],
  );

const no_place = Boolean(process.env.BELVEDERE_STUDIO) && !process.env.BELVEDERE_PLACE;
test("a change while the picture is rendered is drawn to the last rung when that is over", async () => {
  await page.click("#render");
  await page.click("#render-start");
  await page.waitForFunction(() => /so far/.test(document.getElementById("render-says").textContent), patience);
  await page.keyboard.press("Escape");
  await panel("air");
  await page.$eval("[data-key='air.haze'] input[type=range]", (slider) => {
    slider.value = Number(slider.min) + 0.4 * (Number(slider.max) - Number(slider.min));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    slider.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await page.waitForFunction(() => /when the rendering is done/.test(document.getElementById("rung").textContent), patience);
  await page.click("#render");
  await page.click("#render-cancel");
  await page.keyboard.press("Escape");
  await page.waitForFunction((last) => document.body.dataset.rung === last && document.body.dataset.working === "false", patience, "3");
  await undo();
  await finished();
});

const no_mock = Boolean(process.env.BELVEDERE_STUDIO);
const slow = (ms) => page.evaluate((body) => fetch("mock/slow", { method: "POST", body }), String(ms));
test("a click that places something counts, however late the program tells what is there", { skip: no_mock }, async () => {
  await panel("lights");
  const lights = await page.evaluate(() => document.querySelectorAll("#panel-lights details").length);
  await slow(800);
  await page.evaluate(() =>
    [...document.querySelectorAll("#panel-lights button")].find((each) => each.textContent.startsWith("Put a light")).click(),
  );
  const [x, y] = await middle("#picture");
  await page.mouse.click(x, y + 60);
  await page.mouse.move(x + 10, y + 70);
  await changed(`light.regions.${lights}.turn_deg`, undefined);
  await slow(0);
  await undo();
  await finished();
});

test("a burst of changes is not replayed: the newest is drawn within two pictures", { skip: no_mock }, async () => {
  const slow_ms = 300;
  await slow(slow_ms);
  const drawn = [];
  let last_answer = 0;
  const listen = (response) => {
    if (!response.url().includes("rung=0") || !response.ok()) return; // 409: out of date, nothing was drawn
    drawn.push(Number(new URL(response.url()).searchParams.get("revision")));
    last_answer = Date.now();
  };
  page.on("response", listen);
  const begun = Date.now();
  for (let k = 0; k < 30; ++k) await drag("#picture", k % 2 ? 40 : -40, 4, 2);
  const ended = Date.now();
  while (Date.now() - Math.max(ended, last_answer) < 3 * slow_ms || drawn.at(-1) !== (await scene()).revision) {
    assert.ok(Date.now() - ended < 2 * patience.timeout, "the newest is drawn");
    await sleep(50);
  }
  page.off("response", listen);
  assert.ok(drawn.length <= (ended - begun) / slow_ms + 2, `${drawn.length} pictures in ${ended - begun} ms`);
  assert.ok(last_answer - ended < 8 * slow_ms, `${last_answer - ended} ms after the last drag`);
  await slow(0);
  await finished();
  for (let k = 0; k < 30; ++k) await undo();
});

test("the sheet: a paper format, what the resolution means, and the paper around the picture", { skip: no_mock }, async () => {
  await panel("output");
  await page.waitForFunction(
    () =>
      /51 dpi on 1\s?200 mm: letters and strokes will look coarse; 300 dpi need 14\s173 px/.test(
        document.getElementById("sheet-dpi").textContent,
      ),
    patience,
  );
  const { text } = await scene();
  await page.select("#sheet-format", "A1");
  await becomes("output.sheet_width_mm", 841);
  assert.equal(await value("output.height"), 1100, "the picture keeps its shape");
  await page.waitForFunction(() => /72 dpi on 841 mm/.test(document.getElementById("sheet-dpi").textContent), patience);
  // The paper is A1 around the picture, which does not move out of its middle.
  await page.keyboard.press("Escape");
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("s");
  const boxes = () =>
    page.evaluate(() => ["paper", "frame", "trim"].map((id) => document.getElementById(id).getBoundingClientRect().toJSON()));
  const [paper, frame, trim] = await boxes();
  assert.ok(Math.abs(paper.width / paper.height - 841 / 594) < 0.01, `${paper.width} × ${paper.height}`);
  assert.ok(Math.abs(frame.width - paper.width) < 1.5 && frame.height < 0.66 * paper.height);
  assert.ok(Math.abs(trim.left - frame.left - (3 * frame.width) / 841) < 1.5, "3 mm of bleed are cut from the picture");
  // With a margin the picture stands within the paper.
  await page.evaluate(() =>
    fetch("api/set", { method: "POST", body: JSON.stringify({ changes: [{ key: "margin.frame_mm", value: 60 }] }) }),
  );
  await keys("u");
  await page.waitForFunction(() => /margin 60 mm/.test(document.getElementById("paper-says").textContent), patience);
  const [around, picture_box] = await boxes();
  assert.ok(Math.abs((picture_box.left - around.left) / picture_box.width - 60 / 841) < 0.01);
  await keys("s");
  assert.ok(await page.$("#paper[hidden]"));
  // Filling the sheet changes the shape; 300 dpi the pixels.
  await page.click("#sheet-keep");
  await page.select("#sheet-format", "A3");
  await becomes("output.sheet_width_mm", 300);
  assert.ok((await value("output.height")) > 1200, "the picture fills the sheet");
  await page.evaluate(() => [...document.querySelectorAll(".sheet button")].find((each) => each.textContent.startsWith("300 dpi")).click());
  await becomes("output.width", 3543);
  await page.waitForFunction(() => /300 dpi on 300 mm: sharp/.test(document.getElementById("sheet-dpi").textContent), patience);
  await page.click("#sheet-keep");
  while ((await scene()).text !== text) await undo();
  await finished();
});

test("the loupe shows a piece as the print has it, where the hand rests, and Esc closes it", { skip: no_mock }, async () => {
  await finished();
  await page.focus("#picture");
  await page.keyboard.press("l");
  assert.match(await text_of("#hint"), /Click where/);
  const before = await value("camera.look_at");
  const asked = [];
  const listen = (request) => request.url().includes("api/loupe") && asked.push(new URL(request.url()).searchParams);
  page.on("request", listen);
  const [x, y] = await middle("#picture");
  await page.mouse.click(x, y);
  await page.waitForFunction(() => /strokes …/.test(document.getElementById("loupe-says").textContent), patience);
  const there = () =>
    page.waitForFunction(() => /^1 : 1, 51 dpi; 240 mm/.test(document.getElementById("loupe-says").textContent), patience);
  await there();
  const canvas = () => page.$eval("#loupe-picture", ({ width, height }) => [width, height]);
  assert.deepEqual(await canvas(), [480, 320]);
  const share = async () =>
    page.evaluate(() => {
      const [frame, piece] = ["frame", "loupe-frame"].map((id) => document.getElementById(id).getBoundingClientRect());
      return [piece.width / frame.width, (piece.left + piece.width / 2 - frame.left) / frame.width];
    });
  assert.ok(Math.abs((await share())[0] - 480 / 2400) < 0.01);
  // Moving it asks once, when the hand rests; the view stays.
  const count = asked.length;
  await drag("#loupe-frame", 150, 20, 20);
  await page.waitForFunction(() => /strokes …/.test(document.getElementById("loupe-says").textContent), patience);
  await there();
  assert.equal(asked.length, count + 1);
  assert.ok((await share())[1] > 0.6);
  assert.deepEqual(await value("camera.look_at"), before);
  await page.keyboard.press("Escape");
  assert.ok(await page.$("#loupe[hidden]"));
  page.off("request", listen);
});

test("bands are told by the width of their forms, which are tinted in the picture", { skip: no_mock }, async () => {
  await panel("equalizer");
  await page.waitForFunction(() => /60–120 m/.test(document.querySelector(".bands").innerText.replaceAll("\n", "")), patience);
  const labels = await page.$$eval(".column > .unit", (found) => found.map((each) => each.innerText.replace("\n", "")));
  assert.deepEqual(labels, ["1.9–3.8 km", "1–1.9 km", "480–960 m", "240–480 m", "120–240 m", "60–120 m"]);
  assert.equal(await page.$eval(".band input", (slider) => slider.title), "Near, forms 1.9 to 3.8 km wide");
  // Both curves go through the thumbs; the neutral line is that of weight 1.
  const lines = await page.$$eval(".curves path", (found) => found.map((each) => each.getAttribute("d")));
  const neutral = Number(/M0,([\d.]+)/.exec(lines[0])[1]);
  assert.ok(Math.abs(neutral - (7 + 94 * (1 - 1 / 3))) < 0.1);
  const near = lines[2]
    .slice(1)
    .split("L")
    .map((each) => Number(each.split(",")[1]));
  assert.equal(near.length, 6);
  assert.ok(near[0] < neutral && near[5] > neutral && Math.abs(near[3] - neutral) < 0.1, "1.2, 1.0 and 0.9");
  // Ridges of the mock's ground are 2700 m wide in the left half and 675 m in the right one.
  await at_rest();
  const tint = async (index) => {
    await (await page.$$(".column .band.foreground input[type=range]"))[index].focus();
    const [left, right] = [await drawn_in("forms", 0.1, 0.55, 0.4, 0.9), await drawn_in("forms", 0.6, 0.55, 0.9, 0.9)];
    assert.equal(await drawn_in("forms", 0, 0, 1, 0.19), 0, "nothing in the sky");
    return [left, right];
  };
  await page.mouse.move(5, 5);
  const wide = await tint(0);
  assert.ok(wide[0] > 0.3 && wide[0] > 4 * wide[1], `1.9–3.8 km: ${wide}`);
  const narrow = await tint(2);
  assert.ok(narrow[1] > 0.3 && narrow[1] > 4 * narrow[0], `480–960 m: ${narrow}`);
  await page.focus("#tab-equalizer");
  assert.equal(await drawn_in("forms", 0, 0, 1, 1), 0, "no band, no tint");
});

test("a ring, a summit and the horizon are drawn under the hand, within a frame", { skip: no_mock }, async (context) => {
  await panel("lights");
  const before = await scene();
  await page.evaluate(() => {
    const block = document.querySelector("#panel-lights details");
    block.open = true;
  });
  await at_rest();
  const radius = "[data-key='light.regions.0.radius_m'] input[type=range]";
  await page.waitForSelector(radius, { visible: true, ...patience });
  const times = await page.evaluate(async (selector) => {
    const slider = document.querySelector(selector);
    const canvas = document.getElementById("feedback");
    const out = [];
    const begin = Number(slider.value);
    for (let k = 0; k < 20; ++k) {
      await new Promise((resolve) => setTimeout(resolve, 25));
      slider.value = begin + 4 * (k + 1);
      delete canvas.dataset.draws;
      const start = performance.now();
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      out.push(canvas.dataset.draws === "ring" ? performance.now() - start : Infinity);
    }
    slider.dispatchEvent(new Event("change", { bubbles: true }));
    return out.sort((a, b) => a - b);
  }, radius);
  context.diagnostic(`ring: median ${times[10].toFixed(1)} ms, slowest ${times[19].toFixed(1)} ms`);
  // Other programs of the machine take their share: a quarter of the moves tells what the page needs.
  assert.ok(times[5] < 16, `${times.map((each) => each.toFixed(1))} ms`);
  // On a radius of 15 km its near side lies where the ground is 40 km away, at y = 1.05 - 40/60; in the middle column nothing else is drawn.
  await at_rest();
  await page.evaluate((selector) => {
    const field = document.querySelector(selector.replace("range", "number"));
    field.value = 15000;
    field.dispatchEvent(new Event("change", { bubbles: true }));
    field.focus();
  }, radius);
  await becomes("light.regions.0.radius_m", 15000);
  await at_rest();
  const { values } = await scene();
  const far = Math.hypot(...[0, 1].map((k) => values["light.regions.0.position"][k] - values["camera.position"][k]));
  const y = 1.05 - (far - 15000) / 60000;
  assert.ok((await drawn_in("feedback", 0.49, y - 0.015, 0.51, y + 0.015)) > 0.1, "the near side of the ring");
  assert.equal(await drawn_in("feedback", 0.49, y + 0.03, 0.51, 1), 0);
  // The edge in the middle hides the ground between 31 and 33 km: no line there, where the ring would cross it.
  const hidden = Math.round(far - 32000);
  await page.evaluate(
    (selector, wide) => {
    const field = document.querySelector(selector.replace("range", "number"));
    field.value = wide;
    field.dispatchEvent(new Event("change", { bubbles: true }));
    field.focus();
  }, radius, hidden);
  await becomes("light.regions.0.radius_m", hidden);
  await at_rest();
  assert.equal(await drawn_in("feedback", 0.495, 0.4, 0.505, 0.6), 0, "hidden ground has no ring");
  await page.evaluate(() => document.activeElement.blur());
  while ((await scene()).text !== before.text) await undo();

  await panel("ground");
  await at_rest();
  await page.click("#pull");
  const [cx, cy] = await middle("#picture");
  await page.mouse.move(cx, cy + 40);
  await page.mouse.down();
  await page.mouse.move(cx, cy + 20, { steps: 3 });
  await page.waitForFunction(() => /summit/.test(document.getElementById("feedback").dataset.draws), patience);
  await page.mouse.up();
  await at_rest();
  while ((await scene()).text !== before.text) await undo();

  await at_rest();
  const [fx, fy] = await middle("#picture");
  await page.mouse.move(fx, fy);
  await page.mouse.down();
  await page.mouse.move(fx, fy + 10);
  const height = await page.$eval("#picture", (found) => found.clientHeight);
  await page.mouse.move(fx, fy + 30);
  assert.match(await page.$eval("#feedback", (found) => found.dataset.draws ?? ""), /horizon/);
  const top = await page.evaluate(() => {
    const canvas = document.getElementById("feedback");
    const { data } = canvas.getContext("2d").getImageData(canvas.width >> 1, 0, 1, canvas.height);
    for (let k = 0; k < canvas.height; ++k) if (data[4 * k + 3] > 120) return k;
    return -1;
  });
  // The skyline of the mock is at a fifth; the view has turned up by 30 px.
  assert.ok(Math.abs(top - (0.2 * height + 30)) < 6, `${top} of ${height}`);
  await page.mouse.up();
  await page.waitForFunction(() => document.getElementById("feedback").dataset.draws === undefined, patience);
  await finished();
  await undo();
  assert.equal((await scene()).text, before.text);
});

test(
  "the button tells how far a rendering is, also on a page that was opened again, and one beside it cancels at once",
  { skip: no_mock },
  async () => {
    const words = await page.evaluate(async () => {
      const { in_words } = await import("./progress.js");
      return [5, 30, 60, 130, 3400, 5000, 9000].map(in_words);
    });
    assert.deepEqual(words, [
      "a few seconds",
      "less than a minute",
      "about a minute",
      "about 2 minutes",
      "about an hour",
      "about an hour",
      "about 2.5 hours",
    ]);
    const job = (seconds) => page.evaluate((body) => fetch("mock/job", { method: "POST", body }), String(seconds));
    await job(100);
    await page.click("#render");
    await page.click("#render-start");
    const shares = () => page.waitForFunction(() => /Rendering \d+ %/.test(document.getElementById("render").textContent), patience);
    await shares();
    assert.match(await text_of("#render-says"), /about \d minutes left/);
    await page.goto("about:blank");
    await page.goto(address);
    await shares();
    assert.match(await page.$eval("#render", (found) => found.title), /(Rays|Strokes), (about|less than) .* left/);
    const told = await page.evaluate(() => {
      document.getElementById("render-stop").click();
      return document.getElementById("render").textContent;
    });
    assert.equal(told, "Cancelling…");
    await page.waitForFunction(() => document.getElementById("render").textContent === "Render…", patience);
    assert.ok(await page.$("#render-stop[hidden]"));
    assert.equal(await page.evaluate(async () => (await (await fetch("api/render")).json()).state), "cancelled");
    await job(3);
    await finished();
  },
);

test("a place is fetched and opened as a new scene, in one step of undo", { skip: no_place }, async () => {
  const { text } = await scene();
  await page.click("#fetch");
  for (const [nowhere, said] of [
    ["over there", "over there"],
    ["11.4, 99", "99"],
  ]) {
    await type_in("#fetch-place", nowhere);
    await page.click("#fetch-start");
    await page.waitForFunction((what) => document.getElementById("fetch-fault").textContent.includes(what), patience, said);
  }
  await type_in("#fetch-place", process.env.BELVEDERE_PLACE ?? "11.5, 47.5");
  await type_in("#fetch-size", "60");
  if (process.env.BELVEDERE_PLACE) await page.click("#fetch-cover"); // its server has elevation alone
  await page.focus("#fetch-size");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#fetch-cancel:not([hidden])", patience);
  await page.waitForSelector("#fetch-fault[hidden]", patience);
  await page.waitForSelector("#fetch-open:not([hidden])", { timeout: 8 * patience.timeout });
  assert.equal((await scene()).text, text, "nothing changes before it is asked for");
  await page.click("#fetch-open");
  await page.waitForFunction((before) => Number(document.body.dataset.revision) > before, patience, (await scene()).revision - 1);
  const start = Date.now();
  while ((await scene()).text === text) {
    assert.ok(Date.now() - start < patience.timeout);
    await sleep(50);
  }
  await finished();
  assert.ok(await page.$("#message[hidden]"), "the new place is drawn");
  await undo();
  assert.equal((await scene()).text, text);
  await finished();
});

test("fetching is cancelled", { skip: Boolean(process.env.BELVEDERE_STUDIO) }, async () => {
  await page.click("#fetch");
  await type_in("#fetch-place", "11.5, 47.5");
  await page.click("#fetch-start");
  await page.waitForSelector("#fetch-cancel:not([hidden])", patience);
  await page.click("#fetch-cancel");
  await page.waitForFunction(() => /Cancelled/.test(document.getElementById("fetch-says").textContent), patience);
  await page.keyboard.press("Escape");
});

test("every control has a name", async () => {
  const nameless = await page.evaluate(() =>
    Array.from(document.querySelectorAll("button, input, select, textarea, [role=slider], [tabindex='0']"))
      .filter(
        (each) =>
          !each.getAttribute("aria-label") && !each.getAttribute("aria-labelledby") && !each.labels?.length && !each.textContent.trim(),
      )
      .map((each) => each.outerHTML.slice(0, 120)),
  );
  assert.deepEqual(nameless, []);
});

test("many changes in a row: page, program and text agree, and undo leads back", async () => {
  const start = await scene();
  const count = Number(process.env.BELVEDERE_CHANGES ?? 40);
  const sliders = [
    "camera.field_of_view_deg",
    "camera.tilt_deg",
    "light.sun",
    "light.contrast",
    "air.haze",
    "air.range_mist",
    "generalize.crest",
    "generalize.base",
    "light.shadow_depth",
  ];
  const homes = { camera: "camera", light: "sun", air: "air", generalize: "equalizer" };
  let seed = 7;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  for (let k = 0; k < count; ++k) {
    const name = sliders[Math.floor(random() * sliders.length)];
    await panel(homes[name.split(".")[0]]);
    await page.$eval(
      `[data-key='${name}'] input[type=range]`,
      (slider, share) => {
        const [min, max] = [Number(slider.min), Number(slider.max)];
        slider.value = min + (max - min) * (0.2 + 0.6 * share);
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        slider.dispatchEvent(new Event("change", { bubbles: true }));
      },
      random(),
    );
    if (k % 8 === 7) await undo();
  }
  await finished();
  const now = await scene();
  for (const name of sliders) {
    await panel(homes[name.split(".")[0]]);
    await sleep(60);
    const shown = await page.$eval(`[data-key='${name}'] input[type=number]`, (field) => Number(field.value));
    assert.ok(Math.abs(shown - now.values[name]) < 1e-6, `${name}: ${shown} on the page, ${now.values[name]} in the scene`);
    assert.ok(
      now.text.includes(`${name.split(".").at(-1)} = ${now.values[name]}`) || now.values[name] === start.values[name],
      `${name} in the text`,
    );
  }
  while ((await scene()).text !== start.text) {
    assert.ok((await scene()).can_undo, "undo leads back to the text of before");
    await undo();
  }
});

test("a finger looks around, two fingers move", async () => {
  await page.setViewport({ width: 1024, height: 768, hasTouch: true });
  await finished();
  const before = await value("camera.look_at");
  const position = await value("camera.position");
  const [x, y] = await middle("#picture");
  const finger = await page.touchscreen.touchStart(x, y);
  for (let k = 1; k <= 6; ++k) await finger.move(x + 15 * k, y);
  await finger.end();
  const looked = await changed("camera.look_at", before);
  assert.deepEqual(await value("camera.position"), position);
  const one = await page.touchscreen.touchStart(x - 40, y);
  const two = await page.touchscreen.touchStart(x + 40, y);
  for (let k = 1; k <= 6; ++k) {
    await one.move(x - 40 - 10 * k, y);
    await two.move(x + 40 + 10 * k, y);
  }
  await one.end();
  await two.end();
  const nearer = await changed("camera.position", position);
  const far = (at) => Math.hypot(at[0] - looked[0], at[1] - looked[1]);
  assert.ok(far(nearer) < far(position), "spreading two fingers moves forwards");
  await page.setViewport({ width: 1280, height: 720 });
  await finished();
  while ((await scene()).can_undo && JSON.stringify(await value("camera.look_at")) !== JSON.stringify(before)) await undo();
});

test("latency of drags", async (context) => {
  const times = await page.evaluate(
    async (count) => {
      const canvas = document.getElementById("picture");
      const box = canvas.getBoundingClientRect();
      const send = (kind, x, y) =>
        canvas.dispatchEvent(
          new PointerEvent(kind, {
            pointerId: 1,
            clientX: box.left + x,
            clientY: box.top + y,
            button: 0,
            buttons: 1,
            bubbles: true,
            isPrimary: true,
          }),
        );
      canvas.setPointerCapture = () => {};
      const out = [];
      send("pointerdown", 200, 200);
      for (let k = 0; k < count; ++k) {
        const drawn = document.body.dataset.drawn;
        const start = performance.now();
        send("pointermove", 210 + 4 * (k % 50), 200 + (k % 7));
        while (document.body.dataset.drawn === drawn) await new Promise((resolve) => setTimeout(resolve, 1));
        out.push(performance.now() - start);
        await new Promise((resolve) => setTimeout(resolve, 10));
      }
      send("pointerup", 200, 200);
      delete canvas.setPointerCapture;
      return out.sort((a, b) => a - b);
    },
    Number(process.env.BELVEDERE_DRAGS ?? 40),
  );
  const at = (share) => Math.round(times[Math.floor(share * (times.length - 1))]);
  context.diagnostic(`from the movement to the picture: median ${at(0.5)} ms, 95 % ${at(0.95)} ms`);
  await finished();
  await undo();
});

test("a hundred drags leave nothing behind", async () => {
  const size = async () => {
    const client = await page.createCDPSession();
    await client.send("HeapProfiler.collectGarbage");
    const { usedSize } = await client.send("Runtime.getHeapUsage");
    const { nodes } = await client.send("Memory.getDOMCounters");
    return { usedSize, nodes };
  };
  const turns = async (count) => {
    for (let k = 0; k < count; ++k) await drag("#picture", k % 2 ? 60 : -60, k % 3 ? 6 : -12, 3);
    await finished();
  };
  await turns(15);
  const first = await size();
  await turns(Number(process.env.BELVEDERE_DRAGS ?? 40));
  const last = await size();
  assert.ok(last.usedSize < first.usedSize + 3e6, `${first.usedSize} bytes, then ${last.usedSize}`);
  assert.ok(last.nodes < first.nodes + 400, `${first.nodes} nodes, then ${last.nodes}`);
});

// A change as another program would ask for it, and the page that follows it.
async function ask(...changes) {
  await page.evaluate(async (asked) => fetch("api/set", { method: "POST", body: JSON.stringify({ changes: asked }) }), changes);
  await keys("u"); // draw again
  const { revision } = await scene();
  await page.waitForFunction((now) => Number(document.body.dataset.revision) === now, patience, revision);
  await finished();
}
const shown = (key) =>
  page.$eval(`[data-key='${key}'] input[type=number]`, (field) => ({
    value: field.value === "" ? null : Number(field.value),
    grey: field.closest(".row").classList.contains("is-auto"),
  }));
// The same once a panel that was opened has its values.
async function comes_to_show(key, wanted) {
  for (const end = Date.now() + 3000; Date.now() < end && (await shown(key)).value !== wanted.value; await sleep(50))
    await page.$eval(`[data-key='${key}']`, (found) => {
      for (let each = found.closest("details"); each; each = each.parentElement.closest("details")) each.open = true;
    });
  assert.deepEqual(await shown(key), wanted, key);
}
const press_auto = (key) => page.$eval(`[data-key='${key}'] .auto`, (button) => button.click());
const back_to = async (text) => {
  await page.evaluate((wanted) => document.activeElement?.blur() ?? wanted, text);
  await page.evaluate(async (wanted) => fetch("api/text", { method: "POST", body: JSON.stringify({ text: wanted }) }), text);
  await keys("u");
  const { revision } = await scene();
  await page.waitForFunction((now) => Number(document.body.dataset.revision) === now, patience, revision);
  await finished();
};

test("the sun by date and time is that of the picture, and stays when the time is switched off", { skip: no_mock }, async () => {
  const { text } = await scene();
  await panel("sun");
  await page.click("#sun-timed");
  await becomes("sun.time", `${new Date().getFullYear()}-06-21T09:00:00+02:00`);
  await finished();
  const told = (await scene()).derived;
  const of = (key) => Number(told.find((each) => each.key === key).value);
  await page.waitForFunction((wanted) => document.querySelector(".dial").getAttribute("aria-valuenow") === wanted, patience, String(Math.round(of("sun.azimuth_deg"))));
  assert.equal(await page.$eval(".arc", (arc) => arc.getAttribute("aria-valuenow")), String(Math.round(of("sun.altitude_deg"))));
  assert.ok(Math.abs((await shown("sun.azimuth_deg")).value - of("sun.azimuth_deg")) < 0.06);
  assert.ok(Math.abs((await shown("sun.altitude_deg")).value - of("sun.altitude_deg")) < 0.06);
  // Another time, switched off while its picture is being drawn.
  await slow(300);
  await page.$eval(".by-time input[type=time]", (clock) => {
    clock.value = "16:00";
    clock.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await page.$eval("#sun-timed", (input) => input.click());
  await becomes("sun.azimuth_deg", 15 * 16 + 3.47);
  await becomes("sun.altitude_deg", 16 + 11.21);
  assert.equal(await value("sun.time"), undefined);
  await slow(0);
  await back_to(text);
});

test("fields left to the program show what is in effect, and auto writes no other number", { skip: no_mock }, async () => {
  const { text } = await scene();
  await ask(
    { key: "camera.tilt_deg", remove: true },
    { key: "style.file", value: "monet" },
    { key: "air.mist", append: { kind: "valley", radius_m: 8000, position: [690000, 5247000] } },
  );
  const wanted = {
    camera: { "camera.tilt_deg": 3.25 },
    ground: { "deform.background_exaggeration": 1.6, "deform.exaggeration_base_m": 0 },
    look: { "style.scale": 1.37 },
    air: { "air.from_m": 34000, "air.mist.0.visibility_m": 500, "air.mist.0.patches": 0.35 },
    lights: { "light.regions.0.altitude_deg": 30 },
  };
  for (const [id, values] of Object.entries(wanted)) {
    await panel(id);
    await page.$$eval(`#panel-${id} details`, (found) => {
      for (const each of found) each.open = true;
    });
    await sleep(100);
    for (const [key, number] of Object.entries(values)) {
      await comes_to_show(key, { value: number, grey: true });
      await press_auto(key);
      await becomes(key, number);
      await press_auto(key);
      await changed(key, number);
    }
  }
  await back_to(text);
  await page.$$eval("details.more[open]", (found) => {
    for (const each of found) each.open = false;
  });
});

test("what was typed out of range stays with its reason beside it", async () => {
  await panel("camera");
  const row = "[data-key='camera.field_of_view_deg']";
  const { revision } = await scene();
  await page.$eval(`${row} input[type=number]`, (input) => input.select());
  await page.type(`${row} input[type=number]`, "500");
  await page.keyboard.press("Tab");
  await page.waitForSelector(`${row} .fault:not([hidden])`, patience);
  assert.equal(await text_of(`${row} .fault`), "1 … 360 °");
  assert.equal(await page.$eval(`${row} input[type=number]`, (input) => input.value), "500");
  await page.$eval(`${row} input[type=number]`, (input) => input.select());
  await page.type(`${row} input[type=number]`, "45");
  await page.waitForSelector(`${row} .fault[hidden]`, patience);
  assert.equal((await scene()).revision, revision, "nothing was asked for");
  await page.keyboard.press("Enter");
  await becomes("camera.field_of_view_deg", 45);
  await undo();
});

// The bend through points as the program makes it (terrain/deform/bend_curve.cpp): tangents by distance, monotone, added up.
function drops_of(points, distances) {
  const x = points.map((each) => each.distance_m);
  const y = points.map((each) => -Math.tan((each.inclination_deg * Math.PI) / 180));
  const run = x.slice(1).map((each, k) => each - x[k]);
  const rise = run.map((each, k) => (y[k + 1] - y[k]) / each);
  const end = (r0, r1, s0, s1) => {
    const t = ((2 * r0 + r1) * s0 - r0 * s1) / (r0 + r1);
    return t * s0 <= 0 ? 0 : s0 * s1 < 0 && Math.abs(t) > 3 * Math.abs(s0) ? 3 * s0 : t;
  };
  const tangent = x.map((_, k) => {
    if (k === 0) return end(run[0], run[1], rise[0], rise[1]);
    if (k === x.length - 1) return end(run.at(-1), run.at(-2), rise.at(-1), rise.at(-2));
    if (rise[k - 1] * rise[k] <= 0) return 0;
    const [before, behind] = [2 * run[k] + run[k - 1], run[k] + 2 * run[k - 1]];
    return (before + behind) / (before / rise[k - 1] + behind / rise[k]);
  });
  const slope = (d) => {
    if (d <= x[0]) return y[0];
    if (d >= x.at(-1)) return y.at(-1);
    const k = x.findLastIndex((each) => each <= d);
    const [t, h] = [d - x[k], run[k]];
    const [square, cube] = [(3 * rise[k] - 2 * tangent[k] - tangent[k + 1]) / h, (tangent[k] + tangent[k + 1] - 2 * rise[k]) / h ** 2];
    return y[k] + t * (tangent[k] + t * (square + t * cube));
  };
  const step = 50;
  const all = [0];
  for (let d = step; d <= 200000; d += step) all.push(all.at(-1) + step * slope(d - step / 2));
  const highest = Math.min(...all);
  return distances.map((d) => all[Math.round(d / step)] - highest);
}

test("points describe the same bend to the far end, and lead back to the parabola that was there", { skip: no_mock }, async () => {
  const { text } = await scene();
  await ask({ key: "deform.bend.far_from_m", value: 60000 }, { key: "deform.bend.far_amount_per_m", value: 0.000002 });
  const names = ["radius_m", "crest_m", "far_from_m", "far_amount_per_m"].map((name) => `deform.bend.${name}`);
  const { values } = await scene();
  const [radius, crest, from, amount] = names.map((name) => values[name]);
  await panel("ground");
  const press = (label) =>
    page.evaluate((wanted) => [...document.querySelectorAll(".bend button")].find((each) => each.textContent === wanted).click(), label);
  await press("Shape it by points");
  await changed("deform.bend.points.0.distance_m", undefined);
  const now = (await scene()).values;
  const points = [];
  for (let k = 0; now[`deform.bend.points.${k}.distance_m`] !== undefined; ++k)
    points.push({ distance_m: now[`deform.bend.points.${k}.distance_m`], inclination_deg: now[`deform.bend.points.${k}.inclination_deg`] });
  const distances = [0, 20000, 40000, 55000, 60000, 65000, 82000, 90000];
  const drops = drops_of(points, distances);
  distances.forEach((d, k) => {
    const wanted = (d - crest) ** 2 / (2 * radius) + (d > from ? amount * (d - from) ** 2 : 0);
    const highest = Math.min(...Array.from({ length: 1000 }, (_, m) => (100 * m - crest) ** 2 / (2 * radius) + (100 * m > from ? amount * (100 * m - from) ** 2 : 0)));
    assert.ok(Math.abs(drops[k] - (wanted - highest)) < 15, `${drops[k]} m at ${d} m, not ${wanted - highest} m`);
  });
  await press("Back to the parabola");
  await becomes("deform.bend.points.0.distance_m", undefined);
  assert.deepEqual(names.map((name) => values[name]), await Promise.all(names.map(value)));
  await back_to(text);
});

test("a table of names is added to the points with names", async () => {
  const file = join(await mkdtemp(join(tmpdir(), "studio-")), `names ${Date.now()}.csv`);
  await writeFile(file, "name,kind,rank,ele,lon,lat\nBettelwurf,summit,2,2726,11.5,47.34\n");
  const { text } = await scene();
  await (await page.$("#choose-files")).uploadFile(file);
  await page.waitForSelector("#files-list .buttons button", patience);
  assert.match(await text_of("#files-list"), /a table of names/);
  assert.equal(await text_of("#files-list .buttons button"), "Take its names");
  await page.click("#files-list .buttons button");
  assert.match(await changed("labels.points.0.file", undefined), /^names.*csv$/);
  await undo();
  assert.equal((await scene()).text, text);
  await finished();
});

test("previews of a scene with mist say that they lack it", { skip: no_mock }, async () => {
  const { text } = await scene();
  const said = async () => {
    await page.evaluate(() => {
      window.lacks = new Set();
      new MutationObserver(() => window.lacks.add(document.getElementById("rung").textContent)).observe(document.getElementById("rung"), { childList: true });
    });
    await slow(200);
    await keys("u");
    await finished();
    await slow(0);
    return (await page.evaluate(() => [...window.lacks])).join("; ");
  };
  assert.doesNotMatch(await said(), /mist/);
  await ask({ key: "air.mist", append: { kind: "valley", radius_m: 8000, position: [690000, 5247000] } });
  assert.match(await said(), /without [^;]*mist/);
  await back_to(text);
});

test("the page is as it was when it is loaded again: panel, kept version, folds, proposals", async () => {
  const { text } = await scene();
  await panel("air");
  await page.click("#panel-air .more > summary");
  await keys("k");
  await page.click("#propose");
  await page.waitForSelector(".proposal", { timeout: 4 * patience.timeout });
  await finished();
  const kept = () =>
    page.$eval("#kept", (canvas) => {
      const { data } = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1);
      return [...data];
    });
  const before = await kept();
  const field = await value("camera.field_of_view_deg");
  await keys("]");
  await page.focus("#picture");
  await keys("]");
  await changed("camera.field_of_view_deg", field);
  await page.reload();
  await finished();
  assert.equal(await page.evaluate(() => document.body.dataset.panel), "air");
  assert.equal(await page.$eval("#panel-air .more", (more) => more.open), true);
  await page.waitForSelector(".proposal", { timeout: 4 * patience.timeout });
  await page.click("#compare");
  await page.waitForSelector("#border:not([hidden])", patience);
  (await kept()).forEach((each, k) => assert.ok(Math.abs(each - before[k]) < 20, "the picture that was kept"));
  await page.click("#to-kept");
  await becomes("camera.field_of_view_deg", field);
  await page.click("#compare");
  await page.click("#panel-air .more > summary");
  await finished();
  await back_to(text);
});

const undo_all_of = async (key, wanted) => {
  while ((await value(key)) !== wanted) await undo();
  await finished();
};

test("the last rung has the pixels of its frame, also of another window", async () => {
  await ask({ key: "output.width", value: 3000 }, { key: "output.height", value: 1400 });
  const { text } = await scene();
  const sizes = () =>
    page.evaluate(() => [
      document.getElementById("picture").width,
      Math.round(document.getElementById("frame").getBoundingClientRect().width * window.devicePixelRatio),
    ]);
  const agree = async () => {
    await page.waitForFunction(
      () => {
        const frame = document.getElementById("frame").getBoundingClientRect().width * window.devicePixelRatio;
        return Math.abs(document.getElementById("picture").width - frame) <= 1 && document.body.dataset.working === "false";
      },
      patience,
    ).catch(() => {});
    const [canvas, frame] = await sizes();
    assert.ok(Math.abs(canvas - frame) <= 1, `${canvas} px in ${frame} px`);
  };
  await agree();
  await page.setViewport({ width: 1600, height: 1000 });
  await agree();
  const [wide] = await sizes();
  assert.ok(wide > 1100, `${wide} px`);
  await page.setViewport({ width: 1280, height: 720, deviceScaleFactor: 2 });
  await agree();
  await page.setViewport({ width: 1280, height: 720 });
  assert.equal((await scene()).text, text);
  await undo_all_of("output.width", 2400);
});
test("each panel begins with a few controls, the rest is folded", async () => {
  for (const id of ["camera", "sun", "ground", "equalizer", "air", "look", "paint", "names", "output"]) {
    await panel(id);
    await page.waitForSelector(`#panel-${id} details.more:not([open])`, patience);
    await sleep(50);
    const rows = await page.$$eval(`#panel-${id} .row`, (found) => found.filter((each) => each.checkVisibility()).map((each) => each.textContent));
    assert.ok(rows.length <= 7, `${id}: ${rows.length} rows`);
  }
  await panel("camera");
});

test("in a low window the picture has two thirds of what is beside the settings", { skip: no_mock }, async () => {
  const share = () =>
    page.evaluate(() => {
      const box = (id) => document.getElementById(id).getBoundingClientRect();
      const beside = document.querySelector("aside").getBoundingClientRect().left;
      return (box("frame").width * box("frame").height + box("status").width * box("status").height) / (beside * window.innerHeight);
    });
  assert.ok((await share()) >= 0.65, `${await share()}`);
  await page.click("#fold");
  assert.equal(await page.$eval("#dock", (dock) => dock.checkVisibility()), false);
  assert.ok((await share()) >= 0.65, `${await share()}`);
  await page.click("#fold");
});

test("on an upright tablet no label is cut", async () => {
  await page.setViewport({ width: 820, height: 1180, hasTouch: true });
  for (const id of await page.$$eval("#tabs button", (tabs) => tabs.map((each) => each.id.slice(4)))) {
    await panel(id);
    await page.$$eval(`#panel-${id} details`, (found) => {
      for (const each of found) each.open = true;
    });
    await sleep(60);
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll("aside label, aside .label, aside h3, aside button, header button, header .button")]
        .filter((each) => each.checkVisibility() && (each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().right > window.innerWidth + 1))
        .filter((each) => getComputedStyle(each).display !== "inline")
        .map((each) => `${each.textContent} (${each.scrollWidth} in ${each.clientWidth} px)`),
    );
    assert.deepEqual(cut, [], id);
    await page.$$eval(`#panel-${id} details.more`, (found) => {
      for (const each of found) each.open = false;
    });
  }
  await panel("camera");
  await page.setViewport({ width: 1280, height: 720 });
  await finished();
});

test("a file changed outside is told", { skip: Boolean(process.env.BELVEDERE_STUDIO) }, async () => {
  await page.evaluate(() => fetch("mock/outside", { method: "POST" }));
  await page.waitForSelector("#outside:not([hidden])", patience);
  await page.click("#keep-mine");
  await page.waitForSelector("#outside[hidden]", patience);
});

test("nothing was wrong on the way", () => {
  // Refused requests are shown by Chromium as errors of the network: these were asked for.
  assert.deepEqual(
    errors.filter((each) => !/status of (409|422)|ERR_ABORTED/.test(each)),
    [],
  );
});

// Changes made behind the page's back, which it then reads.
async function change_scene(changes) {
  await page.evaluate((all) => fetch("api/set", { method: "POST", body: JSON.stringify({ changes: all, step: "" }) }), changes);
  await page.focus("#picture");
  await page.keyboard.press("u");
  await finished();
}

test("names lie over the picture; one that is dragged keeps its millimetres from the mark", async () => {
  await change_scene([{ key: "labels.points", append: { file: "peaks.csv" } }]);
  const name = '#names [data-name="Birkkar"]';
  await page.waitForSelector(name, patience);
  assert.equal(await page.$eval(`${name} text`, (each) => getComputedStyle(each).fontSize), "40px", "the print's letters, not the page's");
  const { width } = await page.$eval("#names", (each) => each.getBoundingClientRect().toJSON());
  await drag(`${name} .hold`, 100, -50);
  await changed("labels.by_hand.0.dx_mm", undefined);
  const mm = (px) => (px * 2400) / width / 2;
  assert.ok(Math.abs((await value("labels.by_hand.0.dx_mm")) - mm(100)) < 0.2);
  assert.ok(Math.abs((await value("labels.by_hand.0.dy_mm")) - (mm(-50) - 5)) < 0.2, "the foot stood 10 px above the mark");
  await finished();
  assert.equal(await text_of("#name-tools b"), "Birkkar");
  await page.$eval(name, (each) => each.focus());
  const before = await value("labels.by_hand.0.dx_mm");
  await keys("Shift", "ArrowRight");
  await becomes("labels.by_hand.0.dx_mm", Math.round(10 * (before + 5)) / 10);
  await finished();
  await page.$eval(name, (each) => each.focus());
  await page.keyboard.press("Delete");
  await becomes("labels.by_hand.0.hidden", true);
  await finished();
  assert.equal(await page.$(name), null);
  for (let k = 0; k < 3; ++k) await undo();
  await finished();
  assert.equal(await value("labels.by_hand.0.dx_mm"), undefined);
  await page.keyboard.press("n");
  assert.ok(await page.$eval("#names", (each) => each.hasAttribute("hidden")));
  await page.keyboard.press("n");
  await change_scene([{ key: "labels.points.0", remove: true }]);
});

test("a lift is drawn by clicks, named, given another point and removed", async () => {
  await panel("names");
  await page.select(".drawing select", "lift");
  await page.type(".drawing input", "7");
  await page.click("#draw");
  const box = await (await page.$("#frame")).boundingBox();
  const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
  for (const [x, y, points] of [
    [0.4, 0.8, 1],
    [0.5, 0.6, 2],
    [0.5, 0.6, 0],
  ]) {
    await page.mouse.click(...at(x, y));
    await page.waitForFunction((count) => document.querySelectorAll("#drawn .point").length === count, patience, points);
  }
  await changed("features.0.source", undefined);
  const { drawn, values } = await scene();
  assert.equal(values["features.0.source"], "mock_drawn.geojson");
  assert.equal(values["labels.shapes.0.file"], "mock_drawn.geojson");
  assert.deepEqual([drawn.features.length, drawn.features[0].properties.kind, drawn.features[0].properties.name], [1, "lift", "7"]);
  assert.equal(drawn.features[0].geometry.coordinates.length, 2);
  assert.equal(await page.$eval(".drawing input", (each) => each.value), "8", "the next lift has the next number");
  await finished();
  await page.waitForSelector(".drawing .remove", patience);
  await page.click(".drawing .remove");
  await changed("features.0.source", "mock_drawn.geojson");
  assert.equal((await scene()).drawn, null);
  assert.equal(await value("labels.shapes.0.file"), undefined);
  await finished();
});

test("a trail is drawn on the map, and shown there and in the picture", { skip: no_mock }, async () => {
  await finished();
  await panel("names");
  await page.select(".drawing select", "path");
  await page.click("#draw");
  const box = await (await page.$("#map")).boundingBox();
  const points = () => page.$eval("#signs .line", (line) => line.getAttribute("d").split(/[ML]/).length - 1).catch(() => 0);
  for (const [x, y, count] of [
    [0.45, 0.4, 1],
    [0.55, 0.45, 2],
    [0.6, 0.5, 3],
    [0.6, 0.5, 3],
  ]) {
    await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
    for (const until = Date.now() + patience.timeout; (await points()) !== count && Date.now() < until; ) await new Promise((go) => setTimeout(go, 20));
    assert.equal(await points(), count);
  }
  await changed("features.0.source", undefined);
  const { drawn } = await scene();
  assert.deepEqual([drawn.features[0].properties.kind, drawn.features[0].geometry.coordinates.length], ["path", 3]);
  await undo();
  await finished();
});

test("a painting that is dropped gives its style", { skip: no_mock }, async () => {
  const file = join(await mkdtemp(join(tmpdir(), "studio-")), "cliffs.jpg");
  await writeFile(file, "a painting");
  await (await page.$("#choose-files")).uploadFile(file);
  await page.waitForFunction(() => document.querySelectorAll("#files-list .buttons button").length === 3, patience);
  assert.equal(await text_of("#files-list .buttons button:nth-child(2)"), "Take its style");
  await page.click("#files-list .buttons button:nth-child(2)");
  assert.equal(await changed("style.file", undefined), "cliffs_style.toml");
  await undo();
});

test("the critique speaks in sentences, marks its place, and mends", async () => {
  const button = await page.waitForSelector("#critique .mend", patience);
  assert.match(await text_of("#critique li.note .advice"), /The land looks flat\./);
  await button.hover();
  await page.waitForSelector("#critique-mark:not([hidden])", patience);
  const before = (await value("deform.exaggeration")) ?? 1.5;
  await button.evaluate((each) => each.click());
  await becomes("deform.exaggeration", Math.round(before * 112) / 100);
  await undo();
  assert.doesNotMatch(await text_of("#critique"), /[a-z]+\.[a-z_]+_deg|camera\./);
});
