// The pairs as the program has them: what the file says, and what their fit says of them. The page only asks for changes, one after the
// other, and shows what came of them.
import { get, post } from "./api.js";

export class Pairs extends EventTarget {
  constructor(setup) {
    super();
    this.setup = setup;
    this.state = { revision: 0, pairs: [], can_undo: false, can_redo: false };
    this.fit = { state: "few" }; // of the newest revision that was fitted
    this.terrain = { lines: [], hidden: [] };
    this.shown = new Map(); // number of a known place: where the painting shows it, [x, y, sigma]
    this.selected = null; // number of a pair
    this.turn = Promise.resolve();
  }
  tell(kind, detail) {
    this.dispatchEvent(new CustomEvent(kind, { detail }));
  }
  on(kind, listener) {
    this.addEventListener(kind, (event) => listener(event.detail));
  }

  get list() {
    return this.state.pairs;
  }
  // What is known of a pair; nothing while it is being fitted, or with too few of them.
  finding(index) {
    return this.fit.of === this.state.revision ? this.fit.findings?.[index] : undefined;
  }
  // "kept", "doubt", "wrong"; empty: not judged.
  standing(index) {
    const finding = this.finding(index);
    if (!finding) return "";
    return finding.wrong ? "wrong" : finding.doubted ? "doubt" : "kept";
  }
  called(index) {
    return this.list[index].name || `Pair ${index + 1}`;
  }

  // ---- changes: add, change, remove, undo, redo, reload, save. False if it was refused.
  // `pair` of the body is a number of now: what is done before may give the pair another one, or take it away.
  act(name, body = {}) {
    const meant = this.list[body.pair];
    const done = this.turn.then(async () => {
      const pair = meant && this.list.findIndex((each) => String([each.pixel, each.position]) === String([meant.pixel, meant.position]));
      if (pair === -1) return false;
      try {
        this.take(await post(`api/${name}`, meant ? { ...body, pair, revision: this.state.revision } : body));
        this.tell("fault", null);
        return true;
      } catch (error) {
        this.fail(error);
        return false;
      }
    });
    this.turn = done;
    return done;
  }
  async read() {
    this.take(await get("api/pairs"));
  }
  take(state) {
    const before = this.state;
    this.state = state;
    if (this.selected !== null && this.selected >= state.pairs.length) this.selected = null;
    this.tell("state");
    if (state.revision !== before.revision) this.refit();
  }
  select(index) {
    this.selected = index;
    this.tell("selected");
  }
  fail(error) {
    if (error.name === "AbortError" || error.status === 409) return;
    this.tell("fault", error.fault?.message ?? error.message);
    if (!error.fault) console.error(error);
  }

  // ---- the fit of the newest pairs
  async refit() {
    this.waiting?.abort();
    this.waiting = new AbortController();
    const { signal } = this.waiting;
    const { revision } = this.state;
    document.body.dataset.fitting = "true";
    try {
      const fit = await get(`api/fit?revision=${revision}`, signal);
      if (signal.aborted) return;
      this.fit = { ...fit, of: revision };
      this.shown = new Map((fit.places ?? []).map(([place, ...at]) => [place, at]));
      this.tell("fit");
      const terrain = await get(`api/terrain?revision=${revision}`, signal);
      if (signal.aborted) return;
      this.terrain = terrain;
      for (const place of terrain.hidden) this.shown.delete(place);
      this.tell("terrain");
    } catch (error) {
      if (signal.aborted || error.status === 409) return;
      this.fit = { state: "failed", message: error.fault?.message ?? error.message, of: revision };
      this.shown = new Map();
      this.terrain = { lines: [], hidden: [] };
      this.tell("fit");
      if (!error.fault) console.error(error);
    }
    if (!signal.aborted) {
      document.body.dataset.fitting = "false";
      document.body.dataset.fitted = String(revision);
    }
  }

  // ---- proposals
  async place_at([east, north], radius) {
    return get(`api/place?east=${east.toFixed(2)}&north=${north.toFixed(2)}&radius=${radius.toFixed(1)}`);
  }
  async places_at([x, y]) {
    return get(`api/places?x=${x.toFixed(1)}&y=${y.toFixed(1)}`);
  }
}
