// Locked keys: proposals, copies of kept versions and choices by picture leave them as they are. The user's own hand may change them.
import { drawing, element } from "./dom.js";
import { weights_of_bands } from "./looks.js";
import { new_step } from "./store.js";

// Setting one of these takes the others out of the scene.
const rivals = [
  [["sun.time"], ["sun.azimuth_deg", "sun.altitude_deg"]],
  [["camera.look_at", "camera.look_at_lonlat"], ["camera.azimuth_deg", "camera.pitch_deg"]],
  [["camera.position"], ["camera.position_lonlat"]],
  [["camera.look_at"], ["camera.look_at_lonlat"]],
  [["generalize.preset"], weights_of_bands],
];
const moved_with = (key) => [key, ...rivals.flatMap(([a, b]) => (a.includes(key) ? b : b.includes(key) ? a : []))];

export class Locks {
  constructor(store, status, label) {
    Object.assign(this, { store, status, label });
    this.place = `locks of ${store.state.file}`;
    this.keys = new Set(JSON.parse(sessionStorage.getItem(this.place) ?? "[]"));
  }
  // The changes that no lock forbids.
  free(changes) {
    return changes.filter(({ key, append }) => append || !moved_with(key).some((each) => this.keys.has(each)));
  }
  // Makes the changes that no lock forbids, as one step, and says which keys stay. False if nothing is left to change.
  edit(changes, said = "") {
    const free = this.free(changes);
    const held = new Set(changes.filter((each) => !free.includes(each)).flatMap(({ key }) => moved_with(key).filter((each) => this.keys.has(each))));
    const stays = held.size > 0 ? `Locked, and left as it is: ${Array.from(held, (key) => this.label(key)).join(", ")}.` : "";
    const words = [free.length > 0 ? said : "", stays].filter(Boolean).join(" ");
    if (words) this.status.say(words);
    if (free.length > 0) this.store.edit(free, new_step());
    return free.length > 0;
  }
  toggle(key) {
    if (!this.keys.delete(key)) this.keys.add(key);
    sessionStorage.setItem(this.place, JSON.stringify([...this.keys]));
    this.store.tell("locks");
  }
  button(key, label) {
    const button = element(
      "button",
      { type: "button", class: "lock", "aria-label": `Lock ${label}`, title: "Lock: proposals, copies and choices by picture leave it as it is", click: () => this.toggle(key) },
      drawing("svg", { viewBox: "0 0 12 14", "aria-hidden": "true" }, drawing("path", { d: "M1 6h10v7H1zM3 6V4a3 3 0 0 1 6 0v2" })),
    );
    const show = () => button.setAttribute("aria-pressed", String(this.keys.has(key)));
    this.store.on("locks", show);
    show();
    return button;
  }
}
