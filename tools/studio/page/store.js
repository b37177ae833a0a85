// The scene as the program has it, and the changes on their way to it. The text of the scene is the truth; the page only ever asks for
// changes and shows what came of them.
import { api } from "./api.js";

export class Store extends EventTarget {
  constructor(schema, choices) {
    super();
    this.schema = schema;
    this.choices = choices;
    this.state = null;
    this.map = null; // the last answer of api/map
    this.queue = []; // changes not sent yet: {step, changes, done}
    this.sent = null; // those in flight
    this.busy = false;
    this.waiting = [];
    this.drawn = Promise.resolve(); // of the newest state, or of one before it that it replaces
    this.after = async () => {}; // what follows each change: its picture. The next change does not wait for it
  }

  tell(kind, detail) {
    this.dispatchEvent(new CustomEvent(kind, { detail }));
  }
  on(kind, listener) {
    this.addEventListener(kind, (event) => listener(event.detail));
  }

  // ---- reading
  // The value of a key, with the changes on their way.
  value(key) {
    for (const batch of [...this.queue].reverse().concat(this.sent ?? [])) {
      const change = batch.changes.findLast((each) => each.key === key && !each.append);
      if (change) return change.remove ? undefined : change.value;
    }
    return this.state.values[key];
  }
  // The same without the changes on their way.
  settled() {
    return Object.create(this, { queue: { value: [] }, sent: { value: null } });
  }
  // A key that holds a table can stand in `values` whole or name by name.
  table(key) {
    const whole = this.value(key);
    if (whole && typeof whole === "object") return whole;
    const names = Object.keys(this.state.values).filter((each) => each.startsWith(`${key}.`));
    return Object.fromEntries(names.map((each) => [each.slice(key.length + 1), this.value(each)]));
  }
  derived(key) {
    return this.state.derived.find((each) => each.key === key);
  }
  // A number in effect: the scene's, else what the program found for this view.
  number(key) {
    const value = this.value(key);
    if (typeof value === "number") return value;
    const otherwise = this.describe(key)?.default;
    if (typeof otherwise === "number") return otherwise;
    const found = Number.parseFloat(this.derived(key)?.value);
    return Number.isFinite(found) ? found : undefined;
  }
  given(key) {
    const value = this.value(key);
    return value !== undefined && value !== "auto" && JSON.stringify(value) !== JSON.stringify(this.describe(key)?.default);
  }
  // How many blocks [[key]] the scene has.
  count(key) {
    let blocks = 0;
    for (const each of Object.keys(this.state.values))
      if (each.startsWith(`${key}.`)) blocks = Math.max(blocks, Number.parseInt(each.slice(key.length + 1), 10) + 1 || 0);
    return blocks;
  }
  // The part of the schema that describes a key, numbers of blocks included.
  describe(key) {
    let part = this.schema.allOf?.find((each) => each.properties) ?? this.schema;
    for (const name of key.split(".")) {
      part = /^\d+$/.test(name)
        ? part?.items
        : (part?.properties?.[name] ?? part?.anyOf?.find((each) => each.properties)?.properties[name]);
      if (!part) return undefined;
    }
    return part;
  }

  // ---- changing
  // Asks for changes. Those of the same step that wait are merged: of each key the newest value wins.
  edit(changes, step = "") {
    const last = this.queue.at(-1);
    if (step && last?.step === step) {
      const replaced = new Set(changes.filter((each) => !each.append).map((each) => each.key));
      last.changes = last.changes.filter((each) => each.append || !replaced.has(each.key)).concat(changes);
    } else {
      this.queue.push({ step, changes });
    }
    this.tell("pending");
    return this.pump();
  }
  // Something else that changes the scene, in its turn: undo, a text. False if it was refused. cause: {by} steps of undo, {name}, {outside}.
  async act(request, cause = {}) {
    while (this.busy || this.queue.length > 0) await new Promise((resolve) => this.waiting.push(resolve));
    this.busy = true;
    try {
      this.take(await request(), cause);
      this.draw();
    } catch (error) {
      this.fail(error);
      return false;
    } finally {
      this.leave();
    }
    return true;
  }
  async pump() {
    if (this.busy || this.queue.length === 0) return;
    this.busy = true;
    this.sent = this.queue.shift();
    try {
      const { step } = this.sent;
      const state = await api.set(this.sent.changes, step);
      this.sent = null;
      this.take(state, { step });
      this.draw();
    } catch (error) {
      this.sent = null;
      // A line would be one of the text that was refused, which nobody sees.
      if (error.fault) error.fault = { ...error.fault, line: undefined, where: undefined };
      this.tell("state", this.state); // the controls go back to what is
      this.fail(error);
      this.tell("refused");
    } finally {
      this.leave();
    }
  }
  // When nothing is on its way and the newest picture is there.
  async settle() {
    do {
      while (this.busy || this.queue.length > 0) await new Promise((resolve) => this.waiting.push(resolve));
      await this.drawn;
    } while (this.busy || this.queue.length > 0);
  }
  draw() {
    this.drawn = this.after(this.state.revision).catch((error) => this.fail(error));
  }
  leave() {
    this.busy = false;
    this.pump();
    const waiting = this.waiting;
    this.waiting = [];
    for (const resolve of waiting) resolve();
  }
  take(state, cause = {}) {
    const before = this.state;
    // A scene with an error has a text alone.
    this.state = { ...state, values: state.values ?? {}, derived: state.derived ?? [] };
    this.tell("state", this.state);
    if (before && before.revision !== state.revision) this.tell("changed", { before, state: this.state, cause });
    this.tell("fault", state.error ?? null);
  }
  // What the program found for the picture that is drawn; the scene itself has not changed.
  async refresh() {
    const { revision, derived, notes } = await api.scene();
    if (revision !== this.state.revision) return;
    Object.assign(this.state, { derived: derived ?? [], notes });
    this.tell("state", this.state);
  }
  fail(error) {
    if (error.name === "AbortError") return;
    this.tell("fault", error.fault ?? { message: error.message });
    if (!error.fault) console.error(error);
  }
}

// Names of steps: those of one movement of the hand are one step of undo.
const session = Math.random().toString(36).slice(2, 8);
let count = 0;
export const new_step = () => `${session}-${++count}`;

// The step for key presses and wheel turns: the same while they follow each other quickly.
const running = new Map();
export function running_step(what, now = performance.now()) {
  const last = running.get(what);
  const step = last && now - last.time < 700 ? last.step : new_step();
  running.set(what, { step, time: now });
  return step;
}
