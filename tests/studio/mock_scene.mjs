// The scene of the mock server: a text with one value a line, edited line by line, so that comments and order stay.
import { readFileSync } from "node:fs";

const schema_file = new URL("../../docs/scene.schema.json", import.meta.url);
export const schema = JSON.parse(readFileSync(schema_file, "utf8"));
const root = schema.allOf[0];

// The schema does not say it.
const weights = { altitude: 0.04, tone: 0.15, distance: 0.02, shadow: 0.02, slope: 0.02, fall_line_x: 0.1, fall_line_y: 0.05, flow: 0 };

// Some of the keys of which only one side can be set.
const exclusions = [
  [["camera.position"], ["camera.position_lonlat"]],
  [["camera.look_at"], ["camera.azimuth_deg", "camera.pitch_deg"]],
  [["sun.time"], ["sun.azimuth_deg", "sun.altitude_deg"]],
];

export class Fault extends Error {
  constructor(fault) {
    super(fault.message);
    this.fault = fault;
  }
}

function describe(key) {
  let part = root;
  for (const name of key.split(".")) {
    part = /^\d+$/.test(name) ? part?.items : part?.properties?.[name];
    if (!part) return undefined;
  }
  return part;
}

function defaults(part, prefix, out) {
  for (const [name, each] of Object.entries(part.properties ?? {})) {
    if (each.default !== undefined) out[prefix + name] = each.default;
    if (each.type === "object") defaults(each, `${prefix}${name}.`, out);
    if (each.anyOf?.some((one) => one.enum?.length === 1 && one.enum[0] === "auto") && each.default === undefined)
      out[prefix + name] = "auto";
  }
  return out;
}

function value_of(text, where) {
  const json = text.replace(/([{,]\s*)([a-z_]+)\s*=/g, '$1"$2":');
  try {
    return JSON.parse(json);
  } catch {
    throw new Fault({ message: `${text} is no value`, ...where });
  }
}

function without_comment(line) {
  let quoted = false;
  for (let k = 0; k < line.length; ++k) {
    if (line[k] === '"') quoted = !quoted;
    if (line[k] === "#" && !quoted) return [line.slice(0, k), line.slice(k)];
  }
  return [line, ""];
}

// {values, lines: key → line number from 0, sections: section → [first, last entry]}
export function parse(text) {
  const values = {};
  const lines = new Map();
  const sections = new Map([["", [-1, -1]]]);
  const counts = new Map();
  let section = "";
  text.split("\n").forEach((raw, index) => {
    const line = without_comment(raw)[0].trim();
    if (line === "") return;
    const at = { line: index + 1, column: 1, where: `mock.toml:${index + 1}:1` };
    const block = /^\[\[([\w.]+)\]\]$/.exec(line);
    const table = /^\[([\w.]+)\]$/.exec(line);
    if (block) {
      const count = counts.get(block[1]) ?? 0;
      counts.set(block[1], count + 1);
      section = `${block[1]}.${count}`;
    } else if (table) {
      section = table[1];
    }
    if (block || table) {
      if (!describe(section)) throw new Fault({ message: `unknown table ${section}`, ...at });
      sections.set(section, [index, index]);
      return;
    }
    const entry = /^([\w.]+)\s*=\s*(.+)$/.exec(line);
    if (!entry) throw new Fault({ message: `"${line}" is neither a table nor a key with its value`, ...at });
    const key = section ? `${section}.${entry[1]}` : entry[1];
    const value = value_of(entry[2], at);
    validate(key, value, at);
    values[key] = value;
    lines.set(key, index);
    sections.get(section)[1] = index;
  });
  for (const [these, those] of exclusions)
    for (const a of these)
      for (const b of those)
        if (values[a] !== undefined && values[b] !== undefined && values[b] !== "auto")
          throw new Fault({ message: `${a} and ${b} exclude each other`, key: b, line: lines.get(b) + 1 });
  return { values: { ...defaults(root, "", {}), "synthesis.weights": weights, ...values }, lines, sections };
}

function validate(key, value, at) {
  const part = describe(key);
  if (!part) throw new Fault({ message: `unknown key ${key}`, key, ...at });
  const number = (part.anyOf ?? [part]).find((each) => each.type === "number" || each.type === "integer");
  if (number && typeof value === "number" && (value < number.minimum || value > number.maximum))
    throw new Fault({
      message: `${key} is ${value}, allowed: ${number.minimum} … ${number.maximum}`,
      key,
      allowed: `${number.minimum} … ${number.maximum}`,
      ...at,
    });
  const words = (part.anyOf ?? [part]).find((each) => each.enum)?.enum;
  if (words && typeof value === "string" && !words.includes(value) && !part.anyOf)
    throw new Fault({ message: `${key} is "${value}", allowed: ${words.join(", ")}`, key, ...at });
}

const written = (value) =>
  value !== null && typeof value === "object" && !Array.isArray(value)
    ? `{ ${Object.entries(value)
        .map(([k, v]) => `${k} = ${written(v)}`)
        .join(", ")} }`
    : Array.isArray(value)
      ? `[${value.map(written).join(", ")}]`
      : JSON.stringify(value);

// The text after a change; like the program it drops what the new value excludes.
export function edit(text, change) {
  const { key, remove, append } = change;
  const sides = remove || append ? [] : exclusions.flatMap(([these, those]) => [[these, those], [those, these]]);
  const rivals = sides.filter(([these]) => these.includes(key)).flatMap(([, those]) => those);
  const alone = rivals.reduce((rest, rival) => edited(rest, { key: rival, remove: true }), text);
  return edited(alone, change);
}

function edited(text, { key, value, remove, append }) {
  const { lines, sections } = parse(text);
  const all = text.split("\n");
  if (append)
    return `${text.replace(/\n*$/, "\n")}\n[[${key}]]\n${Object.entries(append)
      .map(([name, each]) => `${name} = ${written(each)}`)
      .join("\n")}\n`;
  if (remove) {
    if (lines.has(key)) all.splice(lines.get(key), 1);
    else if (sections.has(key)) {
      const [first] = sections.get(key);
      const after = Math.min(...Array.from(sections.values(), ([start]) => start).filter((start) => start > first), all.length);
      all.splice(first, after - first);
    }
    return all.join("\n");
  }
  if (lines.has(key)) {
    const line = all[lines.get(key)];
    const comment = without_comment(line)[1];
    all[lines.get(key)] = `${line.slice(0, line.indexOf("=") + 1)} ${written(value)}${comment ? `  ${comment}` : ""}`;
    return all.join("\n");
  }
  const cut = key.lastIndexOf(".");
  const [section, name] = [key.slice(0, Math.max(0, cut)), key.slice(cut + 1)];
  if (sections.has(section)) {
    all.splice(sections.get(section)[1] + 1, 0, `${name} = ${written(value)}`);
    return all.join("\n");
  }
  return `${text.replace(/\n*$/, "\n")}\n[${section}]\n${name} = ${written(value)}\n`;
}
