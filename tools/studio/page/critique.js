// The critique in a cartographer's words: what each measure of `belvedere check` is called, what is said where it is too small or too large,
// where in the picture that is, and the change that mends it. Keys of the scene are for the text pane.
import { moved, turned, view, widened } from "./camera.js";
import { rounded } from "./dom.js";

// Parts of the picture: left, top, width, height in shares of it.
const sky = [0, 0, 1, 0.25];
const ridge = [0, 0.08, 1, 0.27];
const land = [0, 0.25, 1, 0.75];
const far = [0, 0.2, 1, 0.25];
const near = [0, 0.72, 1, 0.28];
const lower_edge = [0, 0.92, 1, 0.08];

// Changes of a little; each can be pressed again.
const look = (up) => (store) => turned(store, view(store), 0, up);
const go = (forward, up = 0) => (store) => moved(store, view(store), forward, 0, up * Math.abs(view(store).height));
const widen = (factor) => (store) => widened(store, factor);
const times = (key, factor, otherwise) => (store) => [{ key, value: rounded((store.number(key) ?? otherwise) * factor, 0.01) }];
const exaggerate = (factor) => times("deform.exaggeration", factor, 1.5);
const bend = (factor) => (store) =>
  store.value("deform.bend.radius_m") === undefined ? [] : times("deform.bend.radius_m", 1 / factor)(store).map((each) => ({ ...each, value: Math.round(each.value) }));
const haze = (factor) => (store) =>
  ["air.from_m", "air.scale_m"].filter((key) => store.number(key) > 0).map((key) => ({ key, value: Math.round(store.number(key) * factor) }));

// name: [title, part, what is said where it is too small, the change, what is said where it is too large, the change]. A change is [label, f].
const table = {
  sky: ["Sky", sky, "There is little sky above the mountains.", ["Raise the view", look(1.5)], "The sky takes much of the picture.", ["Lower the view", look(-1.5)]],
  skyline: ["Skyline", ridge, "The skyline is nearly a straight line. Look towards higher mountains.", ["Exaggerate more", exaggerate(1.12)], "The skyline falls off to one side. Aim at the centre of the mountains."],
  hump: ["Separate peaks", ridge, "", null, "The skyline is one smooth hump. Look at mountains that stand apart.", ["Narrow the view", widen(0.85)]],
  level: ["Corners", [0, 0.1, 1, 0.35], "", null, "The land falls away at a corner: the data end too near there.", ["Narrow the view", widen(0.85)]],
  main: ["Main subject", ridge, "The main mountain is hidden, at the edge or outside. It looks best a third from a side, in the upper third."],
  subject: ["Choice of subject", ridge, "The picture is about a lesser mountain of this region."],
  size: ["Size of the subject", ridge, "The main mountain is small.", ["Narrow the view", widen(0.85)], "The main mountain fills the picture.", ["Widen the view", widen(1.18)]],
  along: ["Along the canyon", land, "The view crosses the canyon. It shows more along it."],
  stands: ["Rise of the subject", ridge, "The main summit does not rise above the others.", ["Go nearer", go(0.12)]],
  forms: ["Relief", land, "The land looks flat.", ["Exaggerate more", exaggerate(1.12)], "Mountains are steeper than in painted panoramas.", ["Exaggerate less", exaggerate(0.89)]],
  ground: ["Ground in sight", land, "Mountains hide much of the ground.", ["Look from higher", go(0, 0.12)]],
  valley: ["Valley floors", land, "The floors of the valleys are hidden.", ["Look from higher", go(0, 0.12)]],
  ranges: ["Ranges", far, "No range stands in front of another. Look across the ridges.", null, "There are too many ridges to read.", ["Look from higher", go(0, 0.12)]],
  rise: ["Rise of the land", land, "The land falls away from the viewer. Look the other way."],
  angle: ["Foreground", near, "The foreground looks flat.", ["Bend it more", bend(1.15)], "The foreground looks like a map.", ["Bend it less", bend(0.87)]],
  cut: ["Lower edge", lower_edge, "", null, "The lower edge cuts through mountains. It rests best on a valley.", ["Raise the view", look(1)]],
  flat: ["Plains", land, "", null, "Much of the picture is a plain.", ["Go nearer", go(0.12)]],
  haze: ["Haze", far, "There is no haze between near and far.", ["More haze", haze(0.75)], "Haze covers too much of the land.", ["Less haze", haze(1.33)]],
  empty: ["Lower edge", lower_edge, "", null, "There are no data at the lower edge.", ["Raise the view", look(1)]],
  rim: ["End of the data", far, "", null, "The end of the data can be seen.", ["Narrow the view", widen(0.85)]],
  "rim near": ["End of the data", near, "", null, "The data end in the foreground.", ["Go nearer", go(0.12)]],
  cells: ["Cells of the data", near, "", null, "Cells of the data will show in the foreground. Take finer data, or go farther away.", ["Go back", go(-0.12)]],
};

// {title, part, says, mend: {label, changes(store)}} of an item of api/check; what the table does not know keeps the program's words.
export function in_words({ name, side, advice }) {
  const row = table[name];
  if (!row) return { title: name, part: null, says: advice, mend: null };
  const [title, part, ...sides] = row;
  const [says, mend] = side === "high" ? sides.slice(2) : sides;
  return { title, part, says: says || advice, mend: mend && { label: mend[0], changes: mend[1] } };
}
