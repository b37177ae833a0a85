// An hour at the desk on the real program, in minutes: a proposal, a summit, a lift with two runs, three names, a style chosen by its picture,
// the loupe, undo, save, render. The last rung has the pixels of the rendering.
//   BELVEDERE_PROGRAM=build/release/belvedere node --test tests/studio/desk_test.mjs
// BELVEDERE_SCENE names a scene and options of the command, "karwendel.toml --data ../data", which is saved: give it a copy.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { opened, patience, program_path, scene_file, skip } from "./real_program.mjs";

let page, close, errors, args;
const times = [];

before(async () => {
  if (!program_path) return;
  args = process.env.BELVEDERE_SCENE?.split(" ") ?? [await scene_file()];
  ({ page, close, errors } = await opened(args));
});
after(() => close?.());

const scene = () => page.evaluate(async () => (await fetch("api/scene")).json());
const value = async (key) => (await scene()).values[key];
// The last rung of the newest state is there.
async function finished() {
  await sleep(200);
  await page.waitForFunction(() => document.body.dataset.working === "false", patience);
}
async function becomes(read, wanted) {
  for (const end = Date.now() + patience.timeout; ; await sleep(100)) {
    const now = await read();
    if (wanted(now)) return now;
    assert.ok(Date.now() < end, `it stays ${JSON.stringify(now)}`);
  }
}
// From the begin of an action to its first picture, ms.
async function drawn(name, action) {
  const before = await page.evaluate(() => document.body.dataset.drawn);
  const start = performance.now();
  await action();
  await page.waitForFunction((count) => document.body.dataset.drawn !== count, patience, before);
  times.push(`${name} ${Math.round(performance.now() - start)} ms`);
}
async function place(x, y) {
  const box = await (await page.$("#frame")).boundingBox();
  return [box.x + x * box.width, box.y + y * box.height];
}
const ground = (x, y) =>
  page.evaluate(async ([a, b]) => (await fetch(`api/pointer?x=${a}&y=${b}`)).json(), [x, y]);

test("an hour at the desk", { skip }, async (context) => {
  await page.click("#propose");
  await page.waitForSelector(".proposal", patience);
  await drawn("proposal", () => page.$eval(".proposal", (each) => each.click()));
  await finished();

  await page.click("#tab-ground");
  await page.$eval("#pull", (each) => each.click());
  const [x, y] = await place(0.5, 0.55);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await becomes(() => value("deform.handles.0.radius_m"), (radius) => radius > 0);
  await drawn("summit", () => page.mouse.move(x, y - 25, { steps: 5 }));
  await page.mouse.up();
  assert.ok((await value("deform.handles.0.raise_m")) > 0);
  await finished();

  await page.click("#tab-names");
  const lines = [
    ["lift", "1", [0.4, 0.85], [0.47, 0.7]],
    ["run_easy", "11", [0.47, 0.7], [0.45, 0.78], [0.41, 0.86]],
    ["run_difficult", "12", [0.47, 0.71], [0.42, 0.8]],
  ];
  const on_earth = Boolean((await ground(0.5, 0.7)).lonlat); // else nothing can be drawn
  for (const [kind, name, ...points] of on_earth ? lines : []) {
    await page.select(".drawing select", kind);
    await page.$eval(".drawing input", (each) => (each.value = ""));
    await page.type(".drawing input", name);
    await page.$eval("#draw", (each) => each.click());
    for (const [index, at] of points.entries()) {
      await page.mouse.click(...(await place(...at)));
      await page.waitForFunction((count) => document.querySelectorAll("#drawn .point").length === count, patience, index + 1);
    }
    await page.mouse.click(...(await place(...points.at(-1))));
    await becomes(scene, ({ drawn: now }) => now?.features.at(-1).properties.name === name);
    await finished();
  }

  // A table of three names at places that are seen, dropped on the page.
  const peaks = [];
  for (const [index, at] of [[0.3, 0.5], [0.6, 0.55], [0.75, 0.6]].entries()) {
    const { position } = await ground(...at);
    peaks.push(`Peak ${index + 1},summit,${position.join(",")}`);
  }
  await page.evaluate(async (table) => {
    await fetch("api/files?name=desk_peaks.csv", { method: "POST", body: table });
    const changes = [{ key: "labels.points", append: { file: "desk_peaks.csv" } }];
    await fetch("api/set", { method: "POST", body: JSON.stringify({ changes, step: "" }) });
  }, `name,kind,east,north\n${peaks.join("\n")}\n`);
  await page.focus("#picture");
  await page.keyboard.press("u");
  await finished();
  for (let index = 1; index <= 3; ++index) {
    const hold = await page.waitForSelector(`#names [data-name="Peak ${index}"] .hold`, patience);
    const box = await hold.boundingBox();
    const from = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(from[0] + 20, from[1] - 15, { steps: 4 });
    await page.mouse.up();
    await becomes(() => value(`labels.by_hand.${index - 1}.name`), (name) => name === `Peak ${index}`);
    await finished();
  }

  await page.click("#tab-look");
  const tile = await page.waitForSelector('#panel-look [data-key=palette] [role=radio].seen[aria-checked="false"]', patience);
  const palette = await value("palette");
  await drawn("palette by its picture", () => tile.evaluate((each) => each.click()));
  await becomes(() => value("palette"), (now) => now !== palette);
  await finished();

  await page.focus("#picture");
  await page.keyboard.press("l");
  await page.mouse.click(...(await place(0.5, 0.6)));
  await page.waitForFunction(() => document.getElementById("loupe-picture")?.width > 100, patience);
  await sleep(3000);
  await page.keyboard.press("Escape");

  const { revision } = await scene();
  for (let k = 0; k < 5; ++k) await page.click("#undo");
  await becomes(scene, (now) => now.revision >= revision + 5);
  await finished();
  await page.click("#save");
  const saved = await becomes(scene, (now) => now.saved);
  assert.equal(saved.drawn?.features.length ?? 0, on_earth ? 3 : 0);

  await finished();
  assert.equal(await page.$eval("#message", (box) => (box.hidden ? "" : box.textContent)), "");

  // The last rung at the size of its own file, and what the command renders.
  const width = Math.min(saved.values["output.width"], 900);
  const out = mkdtempSync(join(tmpdir(), "desk-"));
  const height = Math.round((saved.values["output.height"] * width) / saved.values["output.width"]);
  execFileSync(program_path, ["render", saved.file.startsWith("/") ? saved.file : args[0], ...args.slice(1), "--set", `output.width=${width}`, "--set", `output.height=${height}`, "--set", 'output.formats=["png"]', "--out", out, "-q"]);
  const rendered = readFileSync(join(out, "panorama.png")).toString("base64");
  const different = await page.evaluate(
    async (bytes, rung_width, last) => {
      const pixels = async (blob) => {
        const bitmap = await createImageBitmap(blob);
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        context.drawImage(bitmap, 0, 0);
        return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
      };
      const live = await pixels(await (await fetch(`api/picture?rung=${last}&width=${rung_width}`)).blob());
      const binary = Uint8Array.from(atob(bytes), (each) => each.charCodeAt(0));
      const print = await pixels(new Blob([binary], { type: "image/png" }));
      return live.length === print.length ? live.reduce((count, each, index) => count + (each !== print[index] ? 1 : 0), 0) : -1;
    },
    rendered,
    width,
    (await page.evaluate(async () => (await fetch("api/rungs")).json())).length - 1,
  );
  assert.equal(different, 0, "the last rung is the rendering");
  context.diagnostic(times.join(", "));
  // 409 is how a picture says that a newer one has taken its place.
  assert.deepEqual(
    errors.filter((each) => !each.includes("409")),
    [],
  );
});
