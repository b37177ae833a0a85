// The studio: puts the parts of the page together.
import { api } from "./api.js";
import { Check } from "./check.js";
import { about } from "./differences.js";
import { by_id } from "./dom.js";
import { Feedback } from "./feedback.js";
import { Files } from "./files.js";
import { Forms } from "./forms.js";
import { Thumbnails } from "./gallery.js";
import { Hands } from "./hands.js";
import { History } from "./history.js";
import { Places, Rendering } from "./jobs.js";
import { fill_help, listen_keys } from "./keys.js";
import { Ladder } from "./ladder.js";
import { Loupe } from "./loupe.js";
import { Locks } from "./locks.js";
import { Map_view } from "./map.js";
import { Names } from "./names.js";
import { Drawing } from "./draw.js";
import { recall, remember } from "./memory.js";
import { Panels } from "./panels.js";
import { panels as table } from "./panels_table.js";
import { Picture } from "./picture.js";
import { Proposals } from "./proposals.js";
import { Seen } from "./seen.js";
import { Paper } from "./sheet.js";
import { Status } from "./status.js";
import { Store } from "./store.js";
import { Text } from "./text.js";
import { Before, Steps, Versions } from "./versions.js";

const resize_rest_ms = 400; // a window rests when its size has not changed for so long

async function start() {
  const [schema, choices, state] = await Promise.all([api.schema(), api.choices(), api.scene()]);
  const store = new Store(schema, choices);
  store.take(state);
  const status = new Status(store);
  const picture = new Picture(store);
  const hands = new Hands(store, picture);
  const seen = new Seen(store, picture);
  new Forms(store, picture, seen);
  new Feedback(store, picture, seen);
  const paper = new Paper(store, picture);
  const loupe = new Loupe(store, picture);
  const ladder = new Ladder(picture, (told) => {
    status.drawn(told);
    if (told.fault) store.tell("fault", told.fault);
    if (told.halved !== undefined) store.tell("level", told.halved);
    store.tell("drawn", told);
  });
  store.thumbnails = new Thumbnails(store, ladder);
  store.locks = new Locks(store, status, (key) => about(key).label);
  new Steps(store, status, picture, ladder);
  const before = new Before(store, status, picture, ladder);
  const versions = new Versions(store, status, picture);
  const map = new Map_view(store, hands);
  const names = new Names(store);
  const drawing = new Drawing(store, hands, seen);
  const check = new Check(store);
  const panels = new Panels(store, hands, { draw: drawing.part });
  const history = new History(store, status);
  const text = new Text(store);
  const proposals = new Proposals(store, status, ladder);
  const rendering = new Rendering(store, status, () => ladder.resume(store.state.revision));
  const places = new Places(store, status);
  new Files(store);
  panels.tab("text", "Text");
  status.go = (key) => panels.go(key);
  store.on("fault", (fault) => status.fault(fault)); // after the panels, which know whose error it is

  let sized = false; // the rungs are those of the sheet's shape
  store.on("changed", ({ before, state: now }) => {
    if (["output.width", "output.height", "camera.projection"].some((key) => before.values[key] !== now.values[key])) sized = false;
  });
  store.after = async (revision) => {
    if (!sized) await ladder.read_rungs();
    sized = true;
    await ladder.start(revision);
  };
  store.on("pending", () => ladder.stop_finer());
  store.on("refused", () => ladder.resume(store.state.revision));
  ladder.drawn = (revision) => names.read(revision);
  // The view of what is seen needs what the program has found for it.
  const found = () => Promise.all([map.read(), store.refresh()]);
  ladder.rest = (signal) => Promise.all([found().then(() => seen.read()), check.read(signal)]);

  // A frame that has grown, or another window, has its own pixels: they are drawn when the hand rests.
  let resting = 0;
  const fit = () => {
    clearTimeout(resting);
    resting = setTimeout(() => sized && ladder.fit(store.state.revision).catch((error) => store.fail(error)), resize_rest_ms);
  };
  window.addEventListener("resize", fit);
  picture.fitted = () => ladder.width > 0 && picture.wanted_width() > ladder.width && fit();

  const alone = () => document.body.classList.toggle("alone");
  by_id("alone").addEventListener("click", alone);
  const fold = (folded) => {
    document.body.classList.toggle("folded", folded);
    by_id("fold").setAttribute("aria-expanded", String(!folded));
    remember("folded", folded);
  };
  by_id("fold").addEventListener("click", () => fold(!document.body.classList.contains("folded")));
  fold(recall("folded") ?? false);
  const guides = () => by_id("guides").toggleAttribute("hidden");
  by_id("show-guides").addEventListener("click", guides);
  const help = () => by_id("help-dialog").showModal();
  by_id("help").addEventListener("click", help);

  const actions = {
    "Ctrl-Z": ["undo", () => history.undo()],
    "Ctrl-Shift-Z": ["redo", () => history.redo()],
    "Ctrl-Y": ["", () => history.redo()],
    "Ctrl-S": ["save", () => history.save()],
    p: ["to the picture", () => picture.canvas.focus()],
    m: ["to the map", () => by_id("signs").querySelector(".viewer")?.focus()],
    k: ["keep this version", () => versions.keep()],
    c: ["compare with the kept version", () => versions.compare()],
    b: ["while it is held: what was saved", () => before.show()],
    h: ["history of changes", () => by_id("history").togglePopover()],
    f: ["the picture alone, and back", alone],
    d: ["map, critique and proposals, folded and open", () => by_id("fold").click()],
    g: ["guides: thirds, and an eighth of sky", guides],
    n: ["names on the picture", () => names.show(!names.on)],
    s: ["the sheet around the picture", () => paper.show(!paper.on)],
    l: ["1 : 1 loupe: a piece as it is printed", () => loupe.toggle()],
    t: [
      "text of the scene",
      () => {
        panels.show("text");
        text.area.focus();
      },
    ],
    r: ["render", () => rendering.open()],
    o: ["another place", () => places.open()],
    u: ["draw again", () => store.act(() => api.scene(), { outside: true })],
    v: ["propose views", () => proposals.read()],
    "?": ["this list", help],
  };
  table.forEach(({ id }, index) => {
    actions[String((index + 1) % 10)] = [
      "",
      () => {
        panels.show(id);
        by_id(`tab-${id}`).focus();
      },
    ];
  });
  listen_keys(actions);
  fill_help({ ...actions, "1 … 9, 0": ["panels", null], Esc: ["leave what is open", null] });
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || document.querySelector("dialog[open]")) return;
    hands.give_up();
    document.body.classList.remove("alone");
  });

  // The program ends with its page.
  window.addEventListener("pagehide", () => navigator.sendBeacon("api/close", "{}"));

  const panel = recall("panel");
  panels.show(by_id(`tab-${panel}`) ? panel : "camera");
  store.on("panel", (id) => remember("panel", id));
  await versions.restore();
  await store.act(async () => state);
  await store.drawn;
  document.body.dataset.ready = "true";
  proposals.restore();
}

start().catch((error) => {
  by_id("message").hidden = false;
  by_id("message").textContent = error.message;
  console.error(error);
});
