// The weights of the guides of synthesis: one key that holds a table of numbers by name.
import { row } from "./controls.js";

const guides = ["altitude", "tone", "distance", "shadow", "slope", "fall_line_x", "fall_line_y", "flow"];
const key = "synthesis.weights";

export function weights(store) {
  const all = () => ({ ...store.describe(key)?.default, ...store.table(key) });
  return guides.map((name) =>
    row(store, {
      key: `${key}.${name}`,
      label: `${name[0].toUpperCase()}${name.slice(1).replaceAll("_", " ")}`,
      min: 0,
      max: 1,
      step: 0.01,
      auto: false,
      get: () => all()[name],
      set: (_, value) => [{ key, value: { ...all(), [name]: value } }],
    }),
  );
}
