// What differs between two states of a scene: as changes that lead from one to the other, and in plain words.
import { labels } from "./controls.js";
import { lists, panels } from "./panels_table.js";

// Labels of what the editors of panels change.
const of_editors = {
  "sun.time": "Date and time",
  "generalize.preset": "Preset",
  "generalize.foreground": "Near bands",
  "generalize.background": "Far bands",
  "synthesis.weights": "Weights of the guides",
  "camera.look_at_lonlat": "Look at",
  "camera.position_lonlat": "Position",
};
// The panel of each first part of a key: the first one that has such a key.
const homes = new Map([["sun", panels.find(({ id }) => id === "sun")]]);
for (const panel of panels)
  for (const { rows, list } of panel.groups)
    for (const key of [...(rows ?? []).map((each) => each.key), list].filter(Boolean)) {
      const head = key.split(".")[0];
      if (!homes.has(head)) homes.set(head, panel);
    }
const at_home = new Map(panels.flatMap((panel) => panel.groups.flatMap(({ rows, list }) => [...(rows ?? []).map((each) => [each.key, panel]), [list, panel]])));

const block_of = (key) => /^(.+?)\.(\d+)\.(.+)$/.exec(key)?.slice(1) ?? [];
const plain = (name) => name.replace(/_(deg|m|mm|px)$/, "").replaceAll("_", " ");
const upper = (text) => text[0].toUpperCase() + text.slice(1);
const lower = (text) => (/^[A-Z]{2}/.test(text) ? text : text[0].toLowerCase() + text.slice(1));
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export function panel_of(key) {
  const [list] = block_of(key);
  return at_home.get(key) ?? at_home.get(list ?? key) ?? homes.get(key.split(".")[0]) ?? null;
}
// {label, unit, head}: head is what the label belongs to, a panel or a block of one.
export function about(key) {
  const [list, index, name] = block_of(key);
  const spec = lists[list]?.rows.find((each) => each.key === name) ?? labels.get(key);
  const label = spec?.label ?? of_editors[key] ?? upper(plain(name ?? key.split(".").at(-1)));
  return { label, unit: spec?.unit ?? "", head: lists[list] ? `${lists[list].one} ${Number(index) + 1}` : (panel_of(key)?.label ?? "") };
}

function blocks(values, list) {
  const out = [];
  for (const [key, value] of Object.entries(values)) {
    const [of, index, name] = block_of(key);
    if (of === list) (out[index] ??= {})[name] = value;
  }
  return out;
}
const lists_in = (values) => new Set(Object.keys(values).map((key) => block_of(key)[0]).filter(Boolean));

// Changes that lead from values to others: what goes away first, then what is set, then new blocks.
export function differences(from, to, store) {
  const [away, set, added] = [[], [], []];
  const keys = new Set([...Object.keys(from), ...Object.keys(to)]);
  for (const list of new Set([...lists_in(from), ...lists_in(to)])) {
    const [had, wanted] = [blocks(from, list), blocks(to, list)];
    for (let k = had.length - 1; k >= wanted.length; --k) away.push({ key: `${list}.${k}`, remove: true });
    for (const block of wanted.slice(had.length)) {
      const told = Object.entries(block).filter(([name, value]) => !same(value, store.describe(`${list}.0.${name}`)?.default));
      added.push({ key: list, append: Object.fromEntries(told) });
    }
    for (const key of keys) if (block_of(key)[0] === list && block_of(key)[1] >= Math.min(had.length, wanted.length)) keys.delete(key);
  }
  for (const key of keys) {
    if (same(from[key], to[key])) continue;
    if (to[key] === undefined || to[key] === "auto" || same(to[key], store.describe(key)?.default)) away.push({ key, remove: true });
    else set.push({ key, value: to[key] });
  }
  return [...away, ...set, ...added];
}

function said(value, unit) {
  if (typeof value === "number") return `${Number(value.toPrecision(6))}${unit && !/^[°×%]/.test(unit) ? " " : ""}${unit}`;
  return value === undefined || value === "" ? "auto" : String(value);
}
function one(key, from, to) {
  const { label, unit, head } = about(key);
  if (typeof from === "number" || typeof to === "number") return `${head}: ${lower(label)} ${said(from, unit)} → ${said(to, unit)}`;
  if (typeof to === "boolean") return `${label}: ${to ? "on" : "off"}`;
  if (typeof to === "string" || (to === undefined && typeof from === "string"))
    return `${label}: ${key === "sun.time" && to ? to.slice(0, 16).replace("T", " ") : plain(to || "none")}`;
  return `${head}: ${lower(label)}`;
}

// What was changed between two states, in a few words with the labels of the panels.
export function named(from, to) {
  for (const list of new Set([...lists_in(from), ...lists_in(to)])) {
    const more = blocks(to, list).length - blocks(from, list).length;
    if (more === 0) continue;
    return lists[list] ? `${lists[list].one} ${more > 0 ? "added" : "removed"}` : `${panel_of(list)?.label}: ${plain(list.split(".").at(-1))}`;
  }
  let keys = [...new Set([...Object.keys(from), ...Object.keys(to)])].filter((key) => !same(from[key], to[key]));
  // What a new value has driven out is not told beside it.
  if (keys.some((key) => to[key] !== undefined)) keys = keys.filter((key) => to[key] !== undefined);
  if (keys.length === 0) return "Text";
  if (keys.length === 1) return one(keys[0], from[keys[0]], to[keys[0]]);
  const heads = new Map();
  for (const key of keys) {
    const { label, head } = about(key);
    heads.set(head, [...(heads.get(head) ?? []), lower(label)]);
  }
  if (heads.size > 3) return `${keys.length} values`;
  const few = (all) => `${all.slice(0, 3).join(", ")}${all.length > 3 ? " …" : ""}`;
  return Array.from(heads, ([head, all]) => `${head}: ${few(all)}`).join("; ");
}
