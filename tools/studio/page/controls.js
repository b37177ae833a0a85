// Controls for single keys. Each is a row: label, "auto" where the program can choose, number field with unit, slider, the way back to the
// default, and a place for the error that names its key. What a key means and may be comes from the schema.
import { clamp, element, rounded } from "./dom.js";
import { gallery_row } from "./gallery.js";
import { new_step } from "./store.js";

let ids = 0;
export const labels = new Map(); // key: the row it is changed in, {label, unit}

// What the schema says of a key in the words that a control needs.
function kind_of(store, key) {
  const part = store.describe(key);
  if (!part) return null;
  const either = part.anyOf ?? [part];
  const number = either.find((each) => each.type === "number" || each.type === "integer");
  const words = either.find((each) => each.enum)?.enum;
  const auto = number !== undefined && (words?.includes("auto") ?? false); // beside a number; else it is a word like others
  const out = {
    help: (part.description ?? "").replace(/ Unit: [^.]*\.$/, ""),
    default: part.default,
    auto,
    optional: part.default === undefined,
  };
  if (number)
    return {
      ...out,
      kind: "number",
      min: number.minimum ?? number.exclusiveMinimum,
      max: number.maximum,
      whole: number.type === "integer",
    };
  if (part.type === "boolean") return { ...out, kind: "switch" };
  if (either.some((each) => each.type === "boolean"))
    return { ...out, kind: "choice", words: [...words, true, false], default: words[0], optional: false };
  if (part.type === "array" && part.items?.enum) return { ...out, kind: "set", words: part.items.enum };
  if (part.type === "array" && (part.maxItems === 2 || Array.isArray(part.items))) return { ...out, kind: "pair" };
  if (words && !auto) return { ...out, kind: "choice", words, open: either.some((each) => each.pattern) };
  return { ...out, kind: "text" };
}

// A row for {key, label, unit, min, max, step, log, kind, words, otherwise}: min, max and step are the slider's; the number field takes all
// that the schema allows. otherwise(store, block) is what is in effect where the key is left out and the program tells nothing of it.
export function row(store, spec) {
  const about = kind_of(store, spec.key);
  if (!about) return null;
  const made = { number: number_row, switch: switch_row, choice: choice_row, pair: pair_row, set: set_row, text: text_row, gallery: gallery_row }[
    spec.kind ?? about.kind
  ](store, spec, about);
  // Looks of several keys are no control of one.
  if (!spec.looks) {
    made.element.dataset.key = spec.key;
    labels.set(spec.key, spec);
  }
  if (spec.looks ? spec.lock : !spec.set && !/\.\d+\./.test(spec.key)) made.element.append(store.locks.button(spec.key, spec.label));
  made.fault = element("p", { class: "fault", id: `fault-${++ids}`, hidden: true });
  made.element.append(made.fault);
  const shown = made.update;
  made.update = () => {
    made.element.hidden = spec.when ? !spec.when(store) : false;
    if (!made.element.hidden) shown();
  };
  made.told = (reason) => show_fault(made, reason ? { message: reason } : null);
  return made;
}

// Shows an error at a row, or takes it away.
export function show_fault(made, fault) {
  made.fault.hidden = !fault;
  made.fault.textContent = fault ? fault.message : "";
  for (const input of made.element.querySelectorAll("input, select")) {
    if (fault) {
      input.setAttribute("aria-invalid", "true");
      input.setAttribute("aria-describedby", made.fault.id);
    } else {
      input.removeAttribute("aria-invalid");
      input.removeAttribute("aria-describedby");
    }
  }
}

const set = (store, key, value, step) => store.edit([{ key, value }], step ?? new_step());

function label_of(spec, about, input) {
  return element("label", { for: input.id, title: about.help }, spec.label);
}

// The way back to the default: the key leaves the scene.
function reset_button(store, spec) {
  return element(
    "button",
    {
      type: "button",
      class: "reset",
      title: "Back to the default",
      "aria-label": `${spec.label}: back to the default`,
      click: () => store.edit([{ key: spec.key, remove: true }], new_step()),
    },
    "↺",
  );
}
function show_reset(store, spec, about, button) {
  button.hidden = about.auto || about.default === undefined || !store.given(spec.key);
}

function number_row(store, spec, about) {
  const min = spec.min ?? about.min;
  const max = spec.max ?? about.max;
  const step = spec.step ?? (about.whole ? 1 : 0.01);
  const id = `control-${++ids}`;
  // Distances by ratio: slider 0 … 1000 for min … max.
  const low = Math.max(min, spec.log ?? 0);
  const to_slider = (value) => (spec.log ? (value < low ? 0 : 1 + (999 * Math.log(value / low)) / Math.log(max / low)) : value);
  const from_slider = (at) => (spec.log ? (at < 1 ? min : Number((low * (max / low) ** ((at - 1) / 999)).toPrecision(3))) : at);
  const slider = element("input", {
    type: "range",
    min: spec.log ? 0 : min,
    max: spec.log ? 1000 : max,
    step: spec.log ? 1 : step,
    "aria-label": `${spec.label}, ${spec.unit ?? ""}`,
    id: `${id}-slider`,
  });
  const field = element("input", { type: "number", id, min: about.min, max: about.max, step: "any" });
  const can_auto = spec.auto !== false && (about.auto || about.optional);
  const auto = can_auto ? element("button", { type: "button", class: "auto", title: "The program chooses" }, spec.auto ?? "auto") : null;
  auto?.setAttribute("aria-label", `${spec.label}: the program chooses`);
  const reset = reset_button(store, spec);
  const block = spec.key.slice(0, spec.key.lastIndexOf("."));
  const current = () => (spec.get ? spec.get(store) : (store.number(spec.key) ?? spec.otherwise?.(store, block)));
  const change = (value, at) => (spec.set ? store.edit(spec.set(store, value), at) : set(store, spec.key, value, at));

  let moving = null;
  slider.addEventListener("input", () => {
    moving ??= new_step();
    const value = rounded(from_slider(Number(slider.value)), spec.log ? 1e-6 : step);
    field.value = value;
    change(value, moving);
  });
  slider.addEventListener("change", () => {
    moving = null;
  });
  let typing = false;
  let refused = null; // the revision at which what was typed is out of range: it stays with its reason until it or the scene is changed
  field.addEventListener("input", () => {
    typing = true;
    if (refused !== null) control.told(null);
    refused = null;
  });
  field.addEventListener("change", () => {
    typing = false;
    if (field.value.trim() === "" || !Number.isFinite(Number(field.value))) return update();
    const reason = out_of_range(Number(field.value), about, spec.unit);
    if (!reason) return change(Number(field.value), new_step());
    refused = store.state.revision;
    control.told(reason);
  });
  // Arrow keys step by what is sensible for the key: ten of them with Shift, a tenth with Alt.
  field.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
    event.preventDefault();
    const by = (event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    const size = spec.log ? 10 ** Math.floor(Math.log10(Math.max(1, Math.abs(Number(field.value)) / 10))) : step;
    moving ??= new_step();
    field.value = clamp(rounded(Number(field.value) + by * size, size * 0.1), about.min ?? -Infinity, about.max ?? Infinity);
    change(Number(field.value), moving);
  });
  field.addEventListener("blur", () => {
    moving = null;
    typing = false;
  });
  // Pressed again it keeps the number that is in effect; where none is known it is typed.
  auto?.addEventListener("click", () => {
    if (auto.getAttribute("aria-pressed") === "true") {
      const value = current();
      return value === undefined ? field.focus() : change(value, new_step());
    }
    store.edit([about.auto ? { key: spec.key, value: "auto" } : { key: spec.key, remove: true }], new_step());
  });

  function update() {
    const value = current();
    const itself = store.value(spec.key);
    const is_auto = can_auto && (itself === undefined || itself === "auto");
    if (refused !== null && refused !== store.state.revision) {
      refused = null;
      control.told(null);
    }
    // What is being typed stays.
    if (!typing && refused === null) field.value = value === undefined ? "" : rounded(value, Math.min(step, spec.log ? 0.1 : step) / 10);
    slider.value = value === undefined ? slider.min : to_slider(clamp(value, min, max));
    slider.setAttribute("aria-valuetext", `${field.value} ${spec.unit ?? ""}`);
    slider.style.setProperty("--at", `${(100 * (slider.value - slider.min)) / (slider.max - slider.min)}%`);
    auto?.setAttribute("aria-pressed", String(is_auto));
    made.classList.toggle("is-auto", is_auto);
    const why = store.derived(spec.key)?.why;
    if (auto) auto.title = why ? `The program chooses: ${why}` : "The program chooses";
    if (auto) auto.hidden = spec.by_itself?.(store) ?? false;
    show_reset(store, spec, about, reset);
  }
  const made = element(
    "div",
    { class: "row number" },
    label_of(spec, about, field),
    element("span", { class: "tools" }, auto, reset),
    element("span", { class: "value" }, field, element("span", { class: "unit" }, spec.unit ?? "")),
    slider,
  );
  const control = { element: made, update, focus: () => field.focus() };
  return control;
}

// Why a number cannot be taken: "5 … 50 km"; empty where it can.
function out_of_range(value, { min, max, whole }, unit) {
  if (!(value < min || value > max || (whole && !Number.isInteger(value)))) return "";
  const range = min === undefined ? `up to ${max}` : max === undefined || max > 1e15 ? `${min} or more` : `${min} … ${max}`;
  return `${range} ${unit ?? ""}`.trim() + (whole ? ", a whole number" : "");
}

function switch_row(store, spec, about) {
  const input = element("input", { type: "checkbox", role: "switch", id: `control-${++ids}` });
  input.addEventListener("change", () => set(store, spec.key, input.checked));
  return {
    element: element("div", { class: "row switch" }, label_of(spec, about, input), input),
    update: () => {
      input.checked = (store.value(spec.key) ?? about.default) === true;
    },
    focus: () => input.focus(),
  };
}

function choice_row(store, spec, about) {
  const input = element("select", { id: `control-${++ids}` });
  const words = spec.words?.(store) ?? about.words;
  const none = spec.none ?? (about.optional ? "none" : null);
  const said = (word) => (typeof word === "boolean" ? (word ? "yes" : "no") : word === "" ? (spec.none ?? "none") : word.replaceAll("_", " "));
  if (none !== null && !words.includes("")) input.append(element("option", { value: "" }, none));
  for (const word of words)
    input.append(element("option", { value: String(word) }, said(word)));
  input.addEventListener("change", () => {
    if (input.value === "" && about.optional && !words.includes("")) store.edit([{ key: spec.key, remove: true }], new_step());
    else set(store, spec.key, words.find((word) => String(word) === input.value) ?? input.value);
  });
  const reset = reset_button(store, spec);
  return {
    element: element("div", { class: "row choice" }, label_of(spec, about, input), element("span", { class: "tools" }, reset), input),
    update: () => {
      const value = String(store.value(spec.key) ?? about.default ?? "");
      if (!Array.from(input.options).some((option) => option.value === value)) input.append(element("option", { value }, value));
      input.value = value;
      show_reset(store, spec, about, reset);
    },
    focus: () => input.focus(),
  };
}

function pair_row(store, spec, about) {
  const names = spec.names ?? ["E", "N"];
  const step = spec.step ?? 1;
  const fields = names.map((name) =>
    element("input", { type: "number", id: `control-${++ids}`, step: "any", "aria-label": `${spec.label} ${name}` }),
  );
  const current = () => (spec.get ? spec.get(store) : store.value(spec.key));
  const send = (at) => {
    const value = fields.map((field) => Number(field.value));
    if (value.every(Number.isFinite)) set(store, spec.key, value, at);
  };
  let typing = false;
  for (const field of fields) {
    let moving = null;
    field.addEventListener("input", () => {
      typing = true;
    });
    field.addEventListener("change", () => {
      typing = false;
      send();
    });
    field.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
      event.preventDefault();
      moving ??= new_step();
      field.value = rounded(
        Number(field.value) + (event.key === "ArrowUp" ? 1 : -1) * step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1),
        step / 10,
      );
      send(moving);
    });
    field.addEventListener("blur", () => {
      moving = null;
      typing = false;
    });
  }
  const reset = reset_button(store, spec);
  return {
    element: element(
      "div",
      { class: "row pair" },
      label_of(spec, about, fields[0]),
      element("span", { class: "tools" }, reset),
      element(
        "span",
        { class: "fields" },
        ...fields.flatMap((field, k) => [element("span", { class: "unit", "aria-hidden": "true" }, names[k]), field]),
        element("span", { class: "unit" }, spec.unit ?? ""),
      ),
    ),
    update: () => {
      const value = current() ?? about.default;
      if (!typing)
        fields.forEach((field, k) => {
          field.value = value === undefined ? "" : rounded(value[k], step / 10);
        });
      show_reset(store, spec, about, reset);
    },
    focus: () => fields[0].focus(),
  };
}

function set_row(store, spec, about) {
  const boxes = about.words.map((word) => element("input", { type: "checkbox", value: word, id: `control-${++ids}` }));
  for (const box of boxes)
    box.addEventListener("change", () =>
      set(
        store,
        spec.key,
        boxes.filter((each) => each.checked).map((each) => each.value),
      ),
    );
  return {
    element: element(
      "div",
      { class: "row set", role: "group", "aria-label": spec.label },
      element("span", { class: "label", title: about.help }, spec.label),
      element("span", { class: "boxes" }, ...boxes.map((box) => element("label", {}, box, box.value))),
    ),
    update: () => {
      for (const box of boxes) box.checked = (store.value(spec.key) ?? about.default ?? []).includes(box.value);
    },
    focus: () => boxes[0].focus(),
  };
}

function text_row(store, spec, about) {
  const input = element("input", {
    type: "text",
    id: `control-${++ids}`,
    placeholder: spec.hint ?? "",
    spellcheck: "false",
    autocomplete: "off",
  });
  input.addEventListener("change", () => {
    if (input.value === "" && about.optional) store.edit([{ key: spec.key, remove: true }], new_step());
    else set(store, spec.key, input.value);
  });
  return {
    element: element("div", { class: "row text" }, label_of(spec, about, input), input),
    update: () => {
      if (document.activeElement !== input) input.value = store.value(spec.key) ?? "";
    },
    focus: () => input.focus(),
  };
}
