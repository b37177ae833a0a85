// Choosing by looking, history, kept versions and locks on the page of the studio, in headless Chromium against the mock server:
//   npm --prefix tests/studio ci && node --test tests/studio/looks_test.mjs
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import puppeteer from "puppeteer-core";
import { serve } from "./mock_server.mjs";

const patience = { timeout: Number(process.env.BELVEDERE_PATIENCE_MS ?? 20000) };
let server, browser, page;
const errors = [];
const asked = []; // thumbnails: {changes, width, state}

before(async () => {
  server = await serve();
  browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 720 });
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("dialog", (dialog) => dialog.accept());
  const looks = new Map();
  page.on("request", (request) => {
    if (!request.url().endsWith("api/thumbnail")) return;
    const look = { ...JSON.parse(request.postData()), open: true, beside: asked.filter((each) => each.open).length };
    looks.set(request, look);
    asked.push(look);
  });
  for (const end of ["requestfinished", "requestfailed"])
    page.on(end, (request) => {
      const look = looks.get(request);
      if (look) Object.assign(look, { open: false, end });
    });
  await page.goto(server.address);
  await finished();
});
after(async () => {
  await browser?.close();
  server?.close();
});

const scene = () => page.evaluate(async () => (await fetch("api/scene")).json());
const value = async (key) => (await scene()).values[key];
const text_of = (selector) => page.$eval(selector, (found) => found.textContent);
async function finished() {
  await sleep(150);
  await page.waitForFunction(() => document.body.dataset.working === "false", patience);
}
async function until(what, is) {
  const start = Date.now();
  while (!(await is())) {
    assert.ok(Date.now() - start < patience.timeout, what);
    await sleep(50);
  }
}
const becomes = (key, wanted) => until(`${key} becomes ${wanted}`, async () => JSON.stringify(await value(key)) === JSON.stringify(wanted));
const panel = (id) => page.click(`#tab-${id}`);
const tile = (label, name) =>
  page.evaluateHandle(
    (of, wanted) => [...document.querySelector(`[role=radiogroup][aria-label="${of}"]`).children].find((each) => each.textContent === wanted),
    label,
    name,
  );
const choose = async (label, name) => (await tile(label, name)).evaluate((found) => found.click());
const in_sight = () =>
  page.waitForFunction(
    () => {
      const room = document.getElementById("panels").getBoundingClientRect();
      const seen = [...document.querySelectorAll(".gallery button")].filter((each) => {
        const { top, bottom } = each.getBoundingClientRect();
        return each.offsetParent && bottom > room.top && top < room.bottom;
      });
      return seen.length > 0 && seen.every((each) => !each.classList.contains("old") && each.classList.contains("seen"));
    },
    patience,
  );
// A number that changes when the picture does.
const sum = (selector) =>
  page.$eval(selector, (canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let all = 0;
    for (let k = 0; k < data.length; k += 4) all = (all * 31 + data[k] + 3 * data[k + 1] + 7 * data[k + 2]) % 2147483647;
    return all;
  });
const mean = (selector) =>
  page.$eval(selector, (canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((all, each) => all + each, 0) / data.length;
  });
const key = async (name) => {
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press(name);
};
// Back to the scene as it was opened, for the next test.
const back_to = async (text) => {
  await page.keyboard.press("Escape");
  while ((await scene()).text !== text) {
    const { revision } = await scene();
    await page.click("#undo");
    await page.waitForFunction((was) => Number(document.body.dataset.revision) > was, patience, revision);
  }
  await finished();
};

test("palettes are shown as pictures of this view, one asked for at a time; returning to a panel draws none again", async () => {
  await panel("look");
  await in_sight();
  assert.ok(asked.every((each) => each.width === 240 && each.beside === 0), "one at a time, 240 px");
  const drawn = await page.$$eval("[aria-label=Palette] canvas", (all) =>
    all.map((canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.reduce((a, b) => a + b, 0)),
  );
  assert.equal(drawn.length, (await page.evaluate(async () => (await (await fetch("api/choices")).json()).palettes)).length);
  assert.ok(new Set(drawn).size === drawn.length, "every palette looks different");
  const count = asked.length;
  await panel("camera");
  await panel("look");
  await in_sight();
  await sleep(800);
  assert.equal(asked.length, count);
});

test("a picture is chosen in one step of undo; what is chosen is marked; undo draws nothing again", async () => {
  const { text } = await scene();
  const count = asked.length;
  await choose("Palette", "winter");
  await becomes("palette", "winter");
  await page.waitForFunction(() => document.querySelector("[aria-label=Palette] [aria-checked=true]").textContent === "winter", patience);
  assert.equal((await page.$$("[aria-label=Palette] [aria-checked=true]")).length, 1);
  await finished();
  await in_sight();
  assert.ok(asked.length > count, "the other choices are drawn for the new scene");
  const with_winter = asked.length;
  await page.click("#undo");
  await becomes("palette", "summer");
  await finished();
  await in_sight();
  assert.equal((await scene()).text, text);
  assert.equal(asked.length, with_winter, "the pictures of the scene before are kept");
});

test("arrow keys go through the pictures, Enter takes one", async () => {
  const { text } = await scene();
  await panel("look");
  await (await tile("Palette", "summer")).evaluate((found) => found.focus());
  assert.equal(await page.evaluate(() => document.querySelectorAll("[aria-label=Palette] [tabindex='0']").length), 1);
  await page.keyboard.press("ArrowUp");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "desert", "a row of three above");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "evening");
  assert.equal(await value("palette"), "summer", "going there changes nothing");
  await page.keyboard.press("Enter");
  await becomes("palette", "evening");
  await page.keyboard.press("End");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "winter");
  await back_to(text);
});

test("seasons, hours, airs, skies, styles and presets are one edit each", async () => {
  const { text } = await scene();
  for (const [id, label, name, wanted] of [
    ["look", "Seasons", "Autumn", { "season.date": "10-15" }],
    ["look", "Style", "segantini", { "style.file": "segantini" }],
    ["air", "Airs", "Clear", { "air.haze": 0.5, "air.range_mist": 0.5 }],
    ["air", "Clouds", "banks", { "air.sky": "banks" }],
    ["equalizer", "Presets", "bold ridges", { "generalize.preset": "bold_ridges", "generalize.foreground": [1, 1, 1, 1, 1, 1] }],
  ]) {
    await panel(id);
    await choose(label, name);
    for (const [name_of, is] of Object.entries(wanted)) await becomes(name_of, is);
    await page.waitForFunction(
      (of, chosen) => document.querySelector(`[aria-label="${of}"] [aria-checked=true]`)?.textContent === chosen,
      patience,
      label,
      name,
    );
    await page.click("#undo");
    await until(`${name} is undone by one step`, async () => (await scene()).text === text);
  }
  await panel("sun");
  await choose("Hour of the day", "18:00");
  await until("the hour is set", async () => /T18:00:00\+02:00$/.test((await value("sun.time")) ?? ""));
  await back_to(text);
});

test("a style file of the user's own that the scene names stands among the pictures", async () => {
  const { text } = await scene();
  await page.evaluate(() =>
    fetch("api/set", { method: "POST", body: JSON.stringify({ changes: [{ key: "style.file", value: "my_dusk.toml" }], step: "" }) }),
  );
  await key("u");
  await panel("look");
  await page.waitForFunction(() => document.querySelector("[aria-label=Style] [aria-checked=true]")?.textContent === "my dusk", patience);
  await back_to(text);
});

test("the hand goes before: a change gives up the picture that is being made", async () => {
  const { text } = await scene();
  await panel("sun");
  await page.evaluate(() => fetch("mock/slow", { method: "POST", body: "700" }));
  await page.focus("#picture");
  await page.keyboard.press("ArrowRight");
  await finished();
  await until("a thumbnail is being made", () => asked.at(-1)?.open);
  const look = asked.at(-1);
  await page.keyboard.press("ArrowRight");
  await until("it is given up", () => !look.open);
  assert.equal(look.end, "requestfailed");
  const count = asked.length;
  await sleep(400);
  assert.equal(asked.length, count, "none is asked for before the last rung is there");
  await page.evaluate(() => fetch("mock/slow", { method: "POST", body: "0" }));
  await finished();
  await in_sight();
  await back_to(text);
});

const history_names = () => page.$$eval("#history-list button", (all) => all.map((each) => each.textContent));
async function history_of_three() {
  await panel("sun");
  await page.$eval("[data-key='sun.azimuth_deg'] input[type=number]", (field) => {
    field.value = 300;
    field.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await becomes("sun.azimuth_deg", 300);
  await finished();
  await panel("look");
  await choose("Palette", "winter");
  await becomes("palette", "winter");
  await finished();
  await page.focus("#picture");
  // Two presses follow each other quickly and are one step.
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await finished();
}

test("history names each change in plain words, and goes to any of them without drawing those between", async () => {
  const { text } = await scene();
  await page.reload();
  await finished();
  await history_of_three();
  const last = await scene();
  await key("h");
  assert.deepEqual(await history_names(), ["Camera: look at", "Palette: winter", "Sun: azimuth 315° → 300°", "As opened"]);
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Camera: look at", "the state that is shown has the focus");
  const widths = await page.$$eval("#history-list canvas", (all) => all.map((canvas) => canvas.width));
  assert.deepEqual(widths, [120, 120, 120, 120]);
  const drawn = [];
  const listen = (request) => request.url().includes("api/picture?rung=0") && drawn.push(request.url());
  page.on("request", listen);
  await page.evaluate(() => document.querySelectorAll("#history-list button")[3].click());
  await until("the first state", async () => (await scene()).text === text);
  await finished();
  page.off("request", listen);
  assert.equal(drawn.length, 1, "only where it goes to is drawn");
  await page.evaluate(() => document.querySelectorAll("#history-list button")[0].click());
  await until("the last state", async () => (await scene()).text === last.text);
  assert.equal((await history_names()).length, 4);
  await back_to(text);
  // What was undone gives way to a new change.
  await choose("Palette", "desert");
  await becomes("palette", "desert");
  await key("h");
  assert.deepEqual(await history_names(), ["Palette: desert", "As opened"]);
  await back_to(text);
});

test("Revert to saved goes back to the file in one step, which undo takes back", async () => {
  const { text } = await scene();
  await choose("Palette", "desert");
  await choose("Rock", "granite");
  await becomes("land_cover.rock", "granite");
  await page.click("#history-open");
  await page.click("#revert");
  await until("the saved text", async () => (await scene()).saved);
  await page.waitForFunction(() => document.querySelector("#history-list [aria-current]").textContent === "Back to what was saved", patience);
  assert.ok(await page.$("#revert:disabled"));
  await page.keyboard.press("Escape");
  await page.click("#undo");
  await becomes("land_cover.rock", "granite");
  await back_to(text);
});

test("holding B shows what was saved, of this view; releasing returns", async () => {
  const { text } = await scene();
  await finished();
  const saved = await sum("#picture");
  await panel("look");
  await choose("Palette", "winter");
  await becomes("palette", "winter");
  await finished();
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.down("b");
  await page.waitForSelector("#before:not([hidden])", patience);
  assert.equal(await sum("#before"), saved, "the picture that was complete");
  await page.keyboard.up("b");
  await page.waitForSelector("#before[hidden]", patience);
  // Of another view it is drawn once, 1000 px wide, with the camera as it is.
  await page.focus("#picture");
  await page.keyboard.press("ArrowRight");
  await finished();
  await page.evaluate(() => document.activeElement.blur());
  for (let k = 0; k < 2; ++k) {
    await page.keyboard.down("b");
    await page.waitForSelector("#before:not([hidden])", patience);
    await page.keyboard.up("b");
  }
  const wide = asked.filter((each) => each.width === 1000);
  assert.deepEqual(
    wide.map((each) => each.changes),
    [[{ key: "palette", remove: true }]],
  );
  assert.notEqual(await sum("#before"), saved);
  await back_to(text);
});

test("up to six versions are kept, each to compare with, to return to, and to copy a panel's keys from", async () => {
  const { text } = await scene();
  await panel("look");
  await page.click("#keep");
  const first = await mean("#picture");
  await choose("Palette", "winter");
  await becomes("palette", "winter");
  await panel("air");
  await choose("Airs", "Hazy");
  await becomes("air.haze", 1);
  await finished();
  for (let k = 0; k < 6; ++k) await page.click("#keep");
  assert.match(await text_of("#said"), /6 versions are kept/);
  await page.waitForSelector("#versions:popover-open", patience);
  const names = await page.$$eval("#versions-list input", (all) => all.map((each) => each.value));
  assert.equal(names.length, 6);
  assert.match(names[1], /palette/i);
  const press = (row, label) =>
    page.evaluate(
      (k, wanted) => [...document.querySelectorAll("#versions-list li")[k].querySelectorAll("button")].find((each) => each.textContent === wanted).click(),
      row,
      label,
    );
  await press(0, "Compare");
  await page.waitForSelector("#border:not([hidden])", patience);
  assert.equal(await text_of("#kept-name"), names[0]);
  // As JPEG it is not the same bit for bit.
  assert.ok(Math.abs((await mean("#kept")) - first) < 2, "the picture of the version that is chosen");
  assert.ok(Math.abs((await mean("#picture")) - first) > 10);
  await page.click("#compare");
  await page.click("#versions-open");
  const copy = (row, id) =>
    page.evaluate(
      (k, wanted) => {
        const select = document.querySelectorAll("#versions-list li")[k].querySelector("select");
        select.value = wanted;
        select.dispatchEvent(new Event("change", { bubbles: true }));
      },
      row,
      id,
    );
  await copy(0, "look");
  await becomes("palette", "summer");
  assert.equal(await value("air.haze"), 1, "only this panel's keys");
  await page.click("#versions-open");
  await page.click("#undo");
  await becomes("palette", "winter");
  await page.click("#versions-open");
  await press(0, "Return to it");
  await until("the first version's text", async () => (await scene()).text === text);
  await press(5, "×");
  assert.equal((await page.$$("#versions-list li")).length, 5);
  await back_to(text);
});

test("a locked key is left as it is by pictures, copies and proposals, and stays locked", async () => {
  const { text } = await scene();
  await panel("look");
  const lock = "[data-key=palette] > .lock";
  await page.focus(lock);
  await page.keyboard.press("Enter");
  assert.equal(await page.$eval(lock, (button) => button.getAttribute("aria-pressed")), "true");
  await choose("Palette", "winter");
  await page.waitForFunction(() => /Locked, and left as it is: Palette/.test(document.getElementById("said").textContent), patience);
  await sleep(300);
  assert.equal((await scene()).text, text);
  await panel("camera");
  await page.$eval("[data-key='camera.position'] > .lock", (button) => button.click()); // it may be folded
  await page.click("#propose");
  await page.waitForSelector(".proposal", patience);
  const [position, target] = [await value("camera.position"), await value("camera.look_at")];
  await page.evaluate(() => document.querySelectorAll(".proposal")[1].click());
  await until("the rest of the proposal is taken", async () => JSON.stringify(await value("camera.look_at")) !== JSON.stringify(target));
  assert.deepEqual(await value("camera.position"), position);
  assert.match(await text_of("#said"), /From the west taken.*Locked, and left as it is: Position/);
  await page.reload();
  await finished();
  await panel("camera");
  assert.equal(await page.$eval("[data-key='camera.position'] > .lock", (button) => button.getAttribute("aria-pressed")), "true");
  await page.$eval("[data-key='camera.position'] > .lock", (button) => button.click()); // it may be folded
  await panel("look");
  await page.click(lock);
  await choose("Palette", "winter");
  await becomes("palette", "winter");
  await back_to(text);
});

test("changes between two states, in both directions", async () => {
  const found = await page.evaluate(async () => {
    const { differences, named, panel_of } = await import("./differences.js");
    const store = { describe: (key) => ({ "air.haze": { default: 0.85 } })[key] };
    const from = { "sun.time": "2026-06-21T09:00:00+02:00", "air.haze": 0.5, "light.regions.0.turn_deg": 40, "light.regions.1.turn_deg": 10 };
    const to = { "sun.azimuth_deg": 240, "air.haze": 0.85, "light.regions.0.turn_deg": 50 };
    return {
      there: differences(from, to, store),
      back: differences(to, from, store),
      same: differences(to, to, store),
      names: [
        named({ "air.haze": 0.5 }, { "air.haze": 0.6 }),
        named({ "light.regions.0.turn_deg": 40 }, { "light.regions.0.turn_deg": 50 }),
        named({}, { "deform.handles.0.raise_m": 40 }),
        named({}, { "deform.bend.points.0.distance_m": 40 }),
        named({ "sun.azimuth_deg": 240 }, { "sun.time": "2026-06-21T09:00:00+02:00" }),
        named({ "labels.in_picture": false }, { "labels.in_picture": true }),
        named({ a: 1 }, { a: 1 }),
      ],
      panels: ["sun.azimuth_deg", "light.regions.0.turn_deg", "light.sun", "deform.bend.radius_m", "style.file"].map((key) => panel_of(key).id),
    };
  });
  assert.deepEqual(found.there, [
    { key: "light.regions.1", remove: true },
    { key: "sun.time", remove: true },
    { key: "air.haze", remove: true },
    { key: "light.regions.0.turn_deg", value: 50 },
    { key: "sun.azimuth_deg", value: 240 },
  ]);
  assert.deepEqual(found.back.at(-1), { key: "light.regions", append: { turn_deg: 10 } });
  assert.deepEqual(found.same, []);
  assert.deepEqual(found.names, [
    "Air: haze 0.5 → 0.6",
    "Light 1: turn the sun 40° → 50°",
    "Handle added",
    "Ground: points",
    "Date and time: 2026-06-21 09:00",
    "Names in the picture: on",
    "Text",
  ]);
  assert.deepEqual(found.panels, ["sun", "lights", "sun", "ground", "look"]);
});

test("every control has a name, and nothing was wrong on the way", async () => {
  await page.click("#history-open");
  const nameless = await page.evaluate(() =>
    Array.from(document.querySelectorAll("button, input, select, textarea"))
      .filter((each) => !each.getAttribute("aria-label") && !each.labels?.length && !each.textContent.trim())
      .map((each) => each.outerHTML.slice(0, 120)),
  );
  assert.deepEqual(nameless, []);
  assert.deepEqual(
    errors.filter((each) => !/status of (409|422)|ERR_ABORTED/.test(each)),
    [],
  );
});
