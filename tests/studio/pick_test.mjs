// What a user does on the page that picks pairs of a painting, in headless Chromium, on the page of the real program:
//   npm --prefix tests/studio ci && BELVEDERE_PROGRAM=build/release/belvedere node --test tests/studio/pick_test.mjs
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtemp, readFile, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import puppeteer from "puppeteer-core";
import { pixel, position, seen, write_world } from "./pick_world.mjs";

const program_path = process.env.BELVEDERE_PROGRAM ?? "build/release/belvedere";
const patience = { timeout: Number(process.env.BELVEDERE_PATIENCE_MS ?? 30000) };
let program, browser, page, folder, address;
const errors = [];

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "pick-"));
  await write_world(folder);
  const [painting, dem, pairs] = ["painting.png", "cones.asc", "pairs.csv"].map((name) => join(folder, name));
  const words = ["exemplar", "pick", painting, dem, "--crs", "EPSG:32632", "--pairs", pairs, "--headless", "--quiet"];
  program = spawn(program_path, words, { stdio: ["ignore", "pipe", "inherit"] });
  let said = "";
  for await (const bytes of program.stdout) {
    said += bytes;
    if (said.includes("}\n")) break;
  }
  ({ address } = JSON.parse(said));
  browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  page = await browser.newPage();
  await page.setViewport({ width: 1400, height: 900 });
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.goto(address);
  await ready();
});
after(async () => {
  await browser?.close();
  program?.kill("SIGINT");
});

async function ready() {
  await page.waitForFunction(() => document.body.dataset.ready === "true", patience);
}
// The fit of the newest pairs is drawn.
async function fitted() {
  await page.waitForFunction(() => document.body.dataset.fitted === document.body.dataset.revision, patience);
}
// The table has so many rows, also in the file.
async function has(count) {
  await page.waitForFunction((wanted) => document.querySelectorAll("#rows tr").length === wanted, patience, count);
  assert.equal((await lines()).length, count);
}
const lines = async () => (await readFile(join(folder, "pairs.csv"), "utf8")).trim().split("\n").slice(1);
const text_of = (selector) => page.$eval(selector, (found) => found.textContent);
const half = (kind) => page.waitForFunction((wanted) => document.body.dataset.half === wanted, patience, kind);

// A place of the painting, or of the map, on the page.
const on_page = (pane, at) =>
  page.evaluate(
    (name, place) => {
      const views = window.picking_views;
      const shown = name === "map" ? views.to_map(place) : place;
      const [x, y] = views[name].toPage(...shown);
      const box = views[name].canvas.getBoundingClientRect();
      return [x + box.left, y + box.top];
    },
    pane,
    at,
  );
// Once the views have stopped gliding.
async function still() {
  const place = () => page.evaluate(() => ["painting", "map"].flatMap((name) => [window.picking_views[name].x, window.picking_views[name].scale]));
  for (let count = 0, before = await place(); count < 3; ) {
    await sleep(40);
    const now = await place();
    count = now.every((each, k) => Math.abs(each - before[k]) < 1e-6) ? count + 1 : 0;
    before = now;
  }
}
async function click(pane, at) {
  await still();
  await page.mouse.click(...(await on_page(pane, at)));
}
// The first summit of which the program says that.
async function first_place(is_wanted) {
  for (const each of seen) {
    const found = await page.evaluate((at) => window.picking_views.pairs.place_at(at, 300), position(each));
    if (is_wanted(found)) return each;
  }
  assert.fail("no such summit");
}
const whole = async () => {
  await still();
  await page.evaluate(() => {
    window.picking_views.painting.home();
    window.picking_views.map.home();
  });
  await sleep(50);
};
async function pick(summit, at = pixel(summit)) {
  const count = (await lines()).length;
  await whole();
  await click("map", position(summit));
  await half("place");
  await whole();
  await click("painting", at);
  await has(count + 1);
}

test("opens empty and says what to do", async () => {
  assert.match(await text_of("#empty"), /Click a summit in the painting/);
  assert.match(await text_of("#prompt"), /Click a summit/);
  assert.equal(await readFile(join(folder, "pairs.csv"), "utf8"), "x_px,y_px,lon,lat,name,sure\n");
  assert.ok(seen.length >= 16, `${seen.length} cones are in the painting`);
});

test("a click on the map takes the summit near by, and one in the painting makes the pair", async () => {
  const [east, north] = position(seen[0]);
  await click("map", [east + 150, north - 100]);
  await half("place");
  assert.match(await text_of("#prompt"), /painted/);
  await page.keyboard.press("Escape");
  await half("");
  await pick(seen[0]);
  const found = await page.evaluate(() => window.picking_views.pairs.list[0]);
  assert.deepEqual(found.position.map(Math.round), position(seen[0]).map(Math.round), "the summit's own");
  assert.ok(Math.hypot(found.pixel[0] - pixel(seen[0])[0], found.pixel[1] - pixel(seen[0])[1]) < 2);
  assert.match(await text_of("#fit-says"), /4 more until each side proposes/);
});

test("the other way round, a pixel waits for its place", async () => {
  await whole();
  await click("painting", pixel(seen[1]));
  await half("pixel");
  await click("map", position(seen[1]));
  await has(2);
});

test("from eight pairs on each is judged", async () => {
  for (const summit of seen.slice(2, 12)) await pick(summit);
  await fitted();
  assert.match(await text_of("#fit-says"), /view · .* px off at the median/);
  const off = await page.$$eval("#rows tr", (rows) => rows.map((row) => Number(row.children[3].textContent)));
  assert.equal(off.length, 12);
  assert.ok(Math.max(...off) < 4, `residuals ${off}`);
  const drawn = await page.evaluate(() => window.picking_views.pairs.terrain.lines.length);
  assert.ok(drawn > 3, "skyline and ridges");
});

test("a summit of the map proposes where it is painted; undo takes it back from the file", async () => {
  await whole();
  await click("map", position(seen[12]));
  await half("place");
  const offer = await page.evaluate(() => window.picking_views.picking.half.offers[0]);
  const [x, y] = pixel(seen[12]);
  assert.ok(Math.hypot(offer.pixel[0] - x, offer.pixel[1] - y) < 6, `${offer.pixel}, painted at ${[x, y]}`);
  await page.keyboard.press("Enter");
  await has(13);
  await fitted();
  const row = await page.$eval("#rows tr[aria-selected=true]", (found) => found.textContent);
  assert.match(row, /fits/);
  const before = await lines();
  await page.keyboard.down("Control");
  await page.keyboard.press("z");
  await page.keyboard.up("Control");
  await has(12);
  assert.deepEqual(await lines(), before.slice(0, 12));
  await page.click("#redo");
  await has(13);
  assert.deepEqual(await lines(), before);
});

test("a painted pixel proposes the summit that it shows", async () => {
  await fitted();
  await whole();
  const summit = await first_place((found) => found.seen && found.pair === null);
  const [x, y] = pixel(summit);
  await click("painting", [x + 2, y + 2]);
  await half("pixel");
  await page.waitForSelector("#offers button.first", patience);
  await page.click("#offers button.first");
  await has(14);
  const found = await page.evaluate(() => window.picking_views.pairs.list[13]);
  assert.deepEqual(found.position.map(Math.round), position(summit).map(Math.round));
});

test("a wrong pair is thrown out, in the report's words; sure keeps it; it is deleted", async () => {
  const summit = await first_place((found) => found.pair === null);
  await pick(summit, [pixel(summit)[0] > 600 ? 300 : 900, 300]);
  await fitted();
  const first = () => page.$eval("#rows tr", (row) => row.textContent);
  assert.match(await first(), /thrown out/);
  await page.click("#rows tr input[type=checkbox]");
  await page.waitForFunction(() => window.picking_views.pairs.list.at(-1).sure, patience);
  await fitted();
  assert.match((await lines()).at(-1), /,1$/);
  assert.match(await page.$eval("#rows", (rows) => rows.textContent), /but sure: kept/);
  await page.click(`#rows tr[data-index="14"] .remove`);
  await has(14);
});

test("a ring is dragged, a name is typed, and all of it is there when the page is loaded again", async () => {
  await fitted();
  await whole();
  const from = await on_page("painting", (await page.evaluate(() => window.picking_views.pairs.list[2])).pixel);
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0] + 20, from[1], { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction(() => window.picking_views.pairs.state.can_undo && window.picking_views.pairs.selected === 2, patience);
  const moved = await page.evaluate(() => [window.picking_views.pairs.list[2].pixel[0], window.picking_views.painting.scale]);
  assert.ok(Math.abs(moved[0] - pixel(seen[2])[0] - 20 / moved[1]) < 4 / moved[1]);
  await fitted();
  await page.focus('#rows tr[data-index="2"] input[type=text]');
  await page.keyboard.type("Großer Kegel");
  await page.keyboard.press("Tab");
  await page.waitForFunction(() => window.picking_views.pairs.list[2].name === "Großer Kegel", patience);
  assert.match((await lines())[2], /Großer Kegel/);
  await page.reload();
  await ready();
  await fitted();
  await has(14);
  assert.equal(await page.$eval('#rows tr[data-index="2"] input[type=text]', (found) => found.value), "Großer Kegel");
});

test("a handle of moved ground is dragged: its centre becomes a sure pair", async () => {
  await fitted();
  await whole();
  const [east, north] = position(seen[4]);
  const centre = [east + 900, north + 700];
  const at = [620, 330];
  await page.evaluate(
    (position, pixel) => {
      const { pairs } = window.picking_views;
      pairs.terrain = { ...pairs.terrain, handles: [{ position, moved: [position[0] + 400, position[1]], radius_m: 3000, core_m: 1200, turn_deg: 30, pixel }] };
      window.picking_views.redraw();
    },
    centre,
    at,
  );
  const count = (await lines()).length;
  const from = await on_page("painting", at);
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0] + 15, from[1] + 10, { steps: 5 });
  await page.mouse.up();
  await has(count + 1);
  const pair = await page.evaluate(() => window.picking_views.pairs.list.at(-1));
  const scale = await page.evaluate(() => window.picking_views.painting.scale);
  assert.ok(pair.sure);
  assert.deepEqual(pair.position.map(Math.round), centre.map(Math.round));
  assert.ok(Math.hypot(pair.pixel[0] - at[0] - 15 / scale, pair.pixel[1] - at[1] - 10 / scale) < 1);
  await page.click("#undo");
  await has(count);
});

test("a table that another program changed is not written over", async () => {
  const before = await readFile(join(folder, "pairs.csv"), "utf8");
  await writeFile(join(folder, "pairs.csv"), before.split("\n").slice(0, 10).join("\n") + "\n");
  await page.click("#undo");
  await page.waitForSelector("#fault:not([hidden])", patience);
  assert.match(await text_of("#fault"), /another program changed the file/);
  await page.waitForSelector("#outside:not([hidden])", patience);
  await page.click("#reload");
  await has(9);
});

test("nothing went wrong on the page", () => {
  // What the program refuses is an error of the console too.
  assert.deepEqual(errors.filter((each) => !/status of 4(09|22)/.test(each)), []);
});
