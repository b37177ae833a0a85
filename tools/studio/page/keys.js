// Keys for the whole page, and the overlay that lists them. Keys of the picture itself are in hands.js.
import { by_id, element } from "./dom.js";

const on_picture = [
  ["← → ↑ ↓", "look around; finer with Alt"],
  ["Shift ← →", "move sideways"],
  ["Shift ↑ ↓  or  + −", "move forwards and back"],
  ["Page ↑ ↓", "higher, lower"],
  ["[ ]", "narrower, wider"],
  ["Enter", "what is in the middle, or take it"],
];
const by_hand = [
  ["drag", "look around"],
  ["wheel, two fingers", "move forwards and back"],
  ["Shift drag", "move sideways, up and down"],
  ["Ctrl wheel", "narrower, wider"],
  ["point, tap", "what is there"],
  ["double click a band", "back to neutral"],
];
const in_fields = [
  ["↑ ↓", "one step; ten with Shift, a tenth with Alt"],
  ["Tab", "the next control"],
];

// actions: {key: [what it does, function]}; a key may begin with "Ctrl-".
export function listen_keys(actions) {
  document.addEventListener("keydown", (event) => {
    const control = event.ctrlKey || event.metaKey;
    const typing = event.target.matches?.("textarea, input[type=text], input[type=number], input[type=date], input[type=time], select");
    const name = `${control ? "Ctrl-" : ""}${control && event.shiftKey ? "Shift-" : ""}${event.key.length === 1 ? (control ? event.key.toUpperCase() : event.key.toLowerCase()) : event.key}`;
    // A text has its own undo; single letters belong to who is typing.
    if (event.target.matches?.("textarea") && /Z|Y/.test(name) && control) return;
    if ((typing && !control) || event.altKey || document.querySelector("dialog[open]")) return;
    const action = actions[name];
    if (!action) return;
    event.preventDefault();
    action[1]();
  });
}

export function fill_help(actions) {
  const table = (title, rows) =>
    element(
      "section",
      {},
      element("h3", {}, title),
      element("dl", {}, ...rows.flatMap(([keys, what]) => [element("dt", {}, element("kbd", {}, keys)), element("dd", {}, what)])),
    );
  const pages = Object.entries(actions)
    .filter(([, [what]]) => what)
    .map(([key, [what]]) => [key.length === 1 ? key.toUpperCase() : key, what]);
  by_id("help-keys").replaceChildren(
    table("Everywhere", pages),
    table("By hand, on the picture", by_hand),
    table("By keys, on the picture", on_picture),
    table("In fields", in_fields),
  );
}
