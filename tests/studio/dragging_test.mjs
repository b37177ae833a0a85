// Somebody who drags for a long time: random changes of camera, sun, bend and equalizer on the page of the real program, their latency as a
// ratio to the program's own time for the same pictures, and the memory of the program at the begin and at the end. What the program needs,
// as a ratio to bare rays, tells `bench studio`.
//   BELVEDERE_PROGRAM=build/release/belvedere BELVEDERE_MINUTES=60 node --test tests/studio/dragging_test.mjs
// BELVEDERE_SCENE names the scene and options of the command, "scenes/karwendel.toml --data ../data"; it is not saved. Without it the ground
// is synthetic.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { opened, program_path, scene_file, skip } from "./real_program.mjs";

const minutes = Number(process.env.BELVEDERE_MINUTES ?? 5);
const mib = 1024;
let program, page, close;
const made_ms = []; // how long the program worked at each first rung

before(async () => {
  if (!program_path) return;
  ({ program, page, close } = await opened(process.env.BELVEDERE_SCENE?.split(" ") ?? [await scene_file()]));
  page.on("response", (answer) => {
    const took = answer.headers()["x-belvedere-milliseconds"];
    if (took && answer.url().includes("rung=0")) made_ms.push(Number(took));
  });
});
after(() => close?.());

// Resident memory of the program, KiB: now, and the most it ever had.
async function memory() {
  const status = await readFile(`/proc/${program.pid}/status`, "utf8");
  const line = (name) => Number(new RegExp(`${name}:\\s+(\\d+) kB`).exec(status)[1]);
  return { now: line("VmRSS"), most: line("VmHWM") };
}

// One movement of the hand: events on an element, and how long the picture of each took, ms.
const movement = (selector, events) =>
  page.evaluate(
    async (at, list) => {
      const on = document.querySelector(at);
      const box = on.getBoundingClientRect();
      on.setPointerCapture = () => {};
      const times = [];
      for (const { kind, x, y, share } of list) {
        const drawn = document.body.dataset.drawn;
        const start = performance.now();
        if (kind === "input") {
          on.value = Number(on.min) + share * (Number(on.max) - Number(on.min));
          on.dispatchEvent(new Event("input", { bubbles: true }));
        } else {
          const [clientX, clientY] = [box.left + x * box.width, box.top + y * box.height];
          on.dispatchEvent(
            new PointerEvent(kind, { pointerId: 1, clientX, clientY, button: 0, buttons: 1, bubbles: true, isPrimary: true }),
          );
          if (kind !== "pointermove") continue;
        }
        while (document.body.dataset.drawn === drawn && performance.now() - start < 3000) await new Promise((go) => setTimeout(go, 2));
        // What moves nothing, such as a slider that stays in its place, draws nothing.
        if (document.body.dataset.drawn !== drawn) times.push(performance.now() - start);
      }
      on.dispatchEvent(new Event("change", { bubbles: true }));
      delete on.setPointerCapture;
      return times;
    },
    selector,
    events,
  );

let seed = 48;
const random = (from = 0, to = 1) => from + (to - from) * ((seed = (seed * 48271) % 2147483647) / 2147483647);

// A drag of some steps from one place to another, shares of the element.
function drag([x0, y0], [x1, y1], steps) {
  const at = (k) => ({ x: x0 + ((x1 - x0) * k) / steps, y: y0 + ((y1 - y0) * k) / steps });
  const moves = Array.from({ length: steps }, (_, k) => ({ kind: "pointermove", ...at(k + 1) }));
  return [{ kind: "pointerdown", ...at(0) }, ...moves, { kind: "pointerup", ...at(steps) }];
}

const hands = {
  camera: () => movement("#picture", drag([0.5, 0.5], [0.5 + random(-0.15, 0.15), 0.5 + random(-0.03, 0.03)], 10)),
  sun: async () => {
    await page.click("#tab-sun");
    return movement(".dial", drag([0.5, 0.1], [random(0.1, 0.9), random(0.5, 0.9)], 10));
  },
  exaggeration: async () => {
    await page.click("#tab-ground");
    const start = random(0.1, 0.3);
    return movement(
      "#panel-ground input[type=range]",
      Array.from({ length: 6 }, (_, k) => ({ kind: "input", share: start + 0.02 * (k + 1) })),
    );
  },
  equalizer: async () => {
    await page.click("#tab-equalizer");
    const bands = await page.$$eval(".band input[type=range]", (all) => all.length);
    const band = Math.floor(random(0, Math.min(bands, 5)));
    await page.evaluate((index) => {
      document.querySelectorAll(".band input[type=range]").forEach((each, k) => each.classList.toggle("pulled", k === index));
    }, band);
    const start = random(0.2, 0.5);
    return movement(
      ".band input.pulled",
      Array.from({ length: 6 }, (_, k) => ({ kind: "input", share: start + 0.04 * (k + 1) })),
    );
  },
};

test(`${minutes} minutes of dragging`, { skip }, async (context) => {
  await page.click("#keep");
  const times = Object.fromEntries(Object.keys(hands).map((name) => [name, []]));
  const made = Object.fromEntries(Object.keys(hands).map((name) => [name, []]));
  const end = Date.now() + minutes * 60000;
  // Until everything that stays in memory is there: a fifth of the time.
  const settled = Date.now() + minutes * 12000;
  let first = null;
  let rounds = 0;
  while (Date.now() < end) {
    for (const name of Object.keys(hands)) {
      made_ms.length = 0;
      times[name].push(...(await hands[name]()));
      made[name].push(...made_ms);
    }
    await sleep(random(0, 1) < 0.2 ? 3000 : random(0, 300)); // the hand rests, and finer pictures begin
    if (++rounds % 6 === 0) await page.click("#to-kept");
    if (!first && Date.now() > settled) first = await memory();
  }
  await sleep(2000);
  const last = await memory();
  const at = (list, share) => Math.round(list.sort((a, b) => a - b)[Math.floor(share * (list.length - 1))]);
  for (const [name, list] of Object.entries(times)) {
    const own = at(made[name], 0.5);
    context.diagnostic(`${name}: ${list.length} pictures, median ${at(list, 0.5)} ms, 95 % ${at(list, 0.95)} ms; the program ${own} ms`);
    assert.ok(list.length > rounds, `${name} draws`);
    // A change, a request, a JPEG and its decoding besides the work, and never a second picture in the queue.
    assert.ok(at(list, 0.5) < 1.6 * own + 40, `${name}: ${at(list, 0.5)} ms for pictures of ${own} ms`);
  }
  const in_mib = (kib) => Math.round(kib / mib);
  context.diagnostic(`${rounds} rounds; resident ${in_mib(first.now)} MiB, then ${in_mib(last.now)} MiB; at most ${in_mib(last.most)} MiB`);
  // In less time not all that stays is there.
  if (minutes >= 5) assert.ok(last.now < 1.1 * first.now + 64 * mib, `${in_mib(first.now)} MiB, then ${in_mib(last.now)} MiB`);
  const fault = await page.$eval("#message", (box) => (box.hidden ? "" : box.textContent));
  assert.equal(fault, "");
});
