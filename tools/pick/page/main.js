// Picking pairs: puts the parts of the page together.
import { get } from "./api.js";
import { by_id, element } from "./dom.js";
import { listen_keys } from "./keys.js";
import { List } from "./list.js";
import { Pairs } from "./pairs.js";
import { Picking } from "./picking.js";
import { Views } from "./views.js";

const look_ms = 4000; // how often the program is asked whether the file was changed outside

function fill_help(actions) {
  const rows = Object.entries(actions)
    .filter(([, [what]]) => what)
    .map(([key, [what]]) => [key.length === 1 ? key.toUpperCase() : key, what]);
  rows.push(["Wheel, + −, 0", "zoom, all of it"], ["Drag, ← → ↑ ↓", "move the picture"]);
  by_id("keys").replaceChildren(element("dl", {}, ...rows.flatMap(([keys, what]) => [element("dt", {}, element("kbd", {}, keys)), element("dd", {}, what)])));
}

// Another program may change the file, or this one may have ended.
function look(pairs) {
  setInterval(async () => {
    if (document.hidden) return;
    const { state } = pairs;
    try {
      const now = await get("api/pairs");
      by_id("gone").hidden = true;
      if (pairs.state === state && (now.revision !== state.revision || now.outside !== state.outside)) pairs.take(now);
    } catch (error) {
      by_id("gone").hidden = error.status !== 0 && error.status !== 403;
    }
  }, look_ms);
}

async function start() {
  const setup = await get("api/setup");
  const pairs = new Pairs(setup);
  const picking = new Picking(pairs);
  const views = new Views(pairs, picking);
  new List(pairs, (index) => views.bring(index));
  by_id("back").hidden = !setup.room;
  by_id("name").textContent = setup.painting.name;
  document.title = `${setup.painting.name} – pairs – Belvedere`;
  by_id("next").textContent = setup.next;
  pairs.on("state", () => {
    const { file } = pairs.state;
    by_id("file").textContent = file.split("/").at(-1);
    by_id("file").title = `${file}: every change is in it at once`;
  });
  pairs.on("fault", (words) => {
    by_id("fault").hidden = !words;
    by_id("fault").textContent = words ?? "";
  });

  const toggle = (id, change) => {
    const button = by_id(id);
    const turn = () => {
      const on = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(on));
      change(on);
      views.redraw();
    };
    button.addEventListener("click", turn);
    return turn;
  };
  const selected = (action) => () => pairs.selected !== null && action(pairs.selected);
  const remove = selected((index) => pairs.act("remove", { pair: index }));
  for (const name of ["undo", "redo", "reload"]) by_id(name).addEventListener("click", () => pairs.act(name));
  by_id("keep-mine").addEventListener("click", () => pairs.act("save"));
  const help = () => by_id("help-dialog").showModal();
  by_id("help").addEventListener("click", help);
  const actions = {
    "⏎": ["take the first proposal", null],
    "2, 3": ["take that proposal", null],
    g: ["take the ground under the pixel", () => picking.take_ground()],
    Escape: ["drop the half pair", () => (picking.half ? picking.drop() : pairs.select(null))],
    "Ctrl-Z": ["undo", () => pairs.act("undo")],
    "Ctrl-Shift-Z": ["redo", () => pairs.act("redo")],
    "Ctrl-Y": ["", () => pairs.act("redo")],
    Delete: ["delete the selected pair", remove],
    Backspace: ["", remove],
    s: ["the selected pair is sure, or not", selected((index) => pairs.act("change", { pair: index, sure: !pairs.list[index].sure }))],
    p: ["to the painting", () => by_id("painting").focus()],
    m: ["to the map", () => by_id("relief-map").focus()],
    t: ["skyline and ridges", toggle("show-terrain", (on) => (views.shows.terrain = on))],
    n: ["known places", toggle("show-names", (on) => (views.shows.names = on))],
    f: ["follow proposals", toggle("follow", () => {})],
    "?": ["this list", help],
  };
  for (const number of [1, 2, 3]) actions[String(number)] = ["", () => picking.take(number - 1)];
  listen_keys(actions_with_functions(actions));
  fill_help(actions);
  // A button that has the focus keeps its Enter.
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || event.target.matches?.("button, input, tr, summary") || document.querySelector("dialog[open]")) return;
    if (!picking.can_take()) return;
    event.preventDefault();
    picking.take(0);
  });

  // The program ends with its page.
  window.addEventListener("pagehide", () => navigator.sendBeacon("api/close", "{}"));

  await pairs.read();
  views.show_pairs();
  look(pairs);
  document.body.dataset.ready = "true";
  window.picking_views = views; // for whoever looks into the page: places of marks on it
}
const actions_with_functions = (actions) => Object.fromEntries(Object.entries(actions).filter(([, [, action]]) => action));

start().catch((error) => {
  by_id("fault").hidden = false;
  by_id("fault").textContent = error.message;
  console.error(error);
});
