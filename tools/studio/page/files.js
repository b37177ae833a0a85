// Files dropped on the page, or chosen: written beside the scene, then what to do with them by their kind.
import { api } from "./api.js";
import { by_id, element } from "./dom.js";
import { work_on } from "./painting.js";
import { new_step } from "./store.js";

const max_bytes = 2 ** 30;

// What can be done with a file of a kind: {label, changes(file)}.
const uses = {
  terrain: [
    {
      label: "Use it as the ground",
      changes: (file, store) => [...removed(store, "terrain.sources"), { key: "terrain.sources", append: { file } }],
    },
    { label: "Add it below the ground there is", changes: (file) => [{ key: "terrain.sources", append: { file } }] },
  ],
  track: [{ label: "Draw it as a track", changes: (file) => [{ key: "labels.tracks", append: { file } }] }],
  features: [
    { label: "Draw its features", changes: (file) => [{ key: "features", append: { source: file } }] },
    { label: "Take its names", changes: (file) => [{ key: "labels.points", append: { file } }] },
  ],
  names: [{ label: "Take its names", changes: (file) => [{ key: "labels.points", append: { file } }] }],
  painting: [
    { label: "Copy its paint", changes: (file) => [{ key: "exemplar", append: { picture: file } }] },
    { label: "Take its style", work: "style", changes: (file) => [{ key: "style.file", value: file }] },
    { label: "Pair its places with the map…", work: "pick" }, // leads to another page
  ],
};
const kinds = {
  terrain: "a terrain",
  track: "a track",
  features: "a file of features",
  names: "a table of names",
  painting: "a painting",
  scene: "a scene",
  other: "a file",
};

const removed = (store, key) =>
  Array.from({ length: store.count(key) }, (_, index) => ({ key: `${key}.${index}`, remove: true })).reverse();

export class Files {
  constructor(store) {
    this.store = store;
    this.dialog = by_id("files-dialog");
    const veil = by_id("drop");
    let inside = 0;
    window.addEventListener("dragenter", (event) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      ++inside;
      veil.hidden = false;
    });
    window.addEventListener("dragleave", () => {
      inside = Math.max(0, inside - 1);
      veil.hidden = inside === 0;
    });
    window.addEventListener("dragover", (event) => event.preventDefault());
    window.addEventListener("drop", (event) => {
      event.preventDefault();
      inside = 0;
      veil.hidden = true;
      this.take(Array.from(event.dataTransfer?.files ?? []));
    });
    by_id("choose-files").addEventListener("change", (event) => {
      this.take(Array.from(event.target.files));
      event.target.value = "";
    });
  }

  async take(files) {
    if (files.length === 0) return;
    const list = by_id("files-list");
    list.replaceChildren();
    if (!this.dialog.open) this.dialog.showModal();
    for (const file of files) {
      const item = element("li", {}, element("b", {}, file.name), element("span", {}, " is being read …"));
      list.append(item);
      item.replaceChildren(...(await this.one(file)));
    }
  }
  async one(file) {
    const name = element("b", {}, file.name);
    if (file.size > max_bytes)
      return [name, element("span", { class: "fault" }, " is larger than 1 GiB: put it beside the scene yourself and name it there.")];
    let found;
    try {
      found = await api.upload(file);
    } catch (error) {
      return [name, element("span", { class: "fault" }, ` ${error.message}`)];
    }
    const told =
      found.kind === "scene"
        ? ` is a scene: open it with belvedere studio ${found.file}`
        : ` is ${kinds[found.kind] ?? "a file"} and lies beside the scene as ${found.file}.`;
    const says = element("span", {}, told);
    const buttons = (uses[found.kind] ?? []).map(({ label, work, changes }) =>
      element(
        "button",
        {
          type: "button",
          click: async (event) => {
            const all = event.currentTarget.parentElement.querySelectorAll("button");
            for (const each of all) each.disabled = true;
            try {
              const file = work ? await work_on(work, found.file, (words) => (says.textContent = ` ${words}`)) : found.file;
              if (changes) this.store.edit(changes(file, this.store), new_step());
              else location.assign(file);
              this.dialog.close();
            } catch (error) {
              says.replaceChildren(element("span", { class: "fault" }, ` ${error.message}`));
              for (const each of all) each.disabled = false;
            }
          },
        },
        label,
      ),
    );
    return [name, says, element("div", { class: "buttons" }, ...buttons)];
  }
}
