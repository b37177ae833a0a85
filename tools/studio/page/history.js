// Undo, redo, save; and the file that another program has changed.
import { api } from "./api.js";
import { by_id } from "./dom.js";

const look_ms = 4000; // how often the program is asked whether the file was changed outside

export class History {
  constructor(store, status) {
    this.store = store;
    this.status = status;
    this.mine = null; // the text for which "keep mine" was chosen
    for (const name of ["undo", "redo", "save"]) by_id(name).addEventListener("click", () => this[name]());
    by_id("reload").addEventListener("click", () => store.act(() => api.act("reload")));
    by_id("keep-mine").addEventListener("click", () => {
      this.mine = true;
      this.show();
    });
    store.on("state", () => this.show());
    window.addEventListener("beforeunload", (event) => {
      if (!store.state.saved) event.preventDefault();
    });
    this.look();
  }

  show() {
    const { state } = this.store;
    by_id("undo").disabled = !state.can_undo;
    by_id("redo").disabled = !state.can_redo;
    by_id("save").disabled = state.saved;
    document.body.dataset.saved = String(state.saved);
    document.body.dataset.revision = String(state.revision);
    by_id("name").textContent = state.title || state.name;
    by_id("file").textContent = state.file.split("/").at(-1);
    by_id("file").title = state.file;
    document.title = `${state.saved ? "" : "• "}${state.title || state.name} – Belvedere`;
    if (!state.outside) this.mine = null;
    by_id("outside").hidden = !state.outside || this.mine !== null;
  }

  undo() {
    if (this.store.state.can_undo || this.store.busy) return this.store.act(() => api.act("undo"), { by: -1 });
  }
  redo() {
    if (this.store.state.can_redo || this.store.busy) return this.store.act(() => api.act("redo"), { by: 1 });
  }
  async save() {
    const over = this.mine ? "yes" : "no"; // over what another program wrote
    if (await this.store.act(() => api.act("save", { over }))) this.status.say("Saved.");
  }

  // Another program, or another page, may change the scene.
  look() {
    setInterval(async () => {
      if (document.hidden || this.store.busy) return;
      const before = this.store.state;
      try {
        const state = await api.scene();
        if (by_id("gone").hidden === false) by_id("gone").hidden = true;
        if (this.store.busy || this.store.state !== before) return;
        if (state.revision !== before.revision) this.store.act(async () => state, { outside: true });
        else if (state.outside !== before.outside || state.saved !== before.saved) this.store.take(state);
      } catch (error) {
        by_id("gone").hidden = error.status !== 0 && error.status !== 403;
      }
    }, look_ms);
  }
}
