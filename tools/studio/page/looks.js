// What is chosen by looking and is no single word of the schema: seasons, hours, airs, presets of the equalizer. Each look is a name and
// the changes that make it.
const set = (values) => Object.entries(values).map(([key, value]) => ({ key, value }));
const away = (...keys) => keys.map((key) => ({ key, remove: true }));

export const seasons = () => [
  { name: "No date", changes: away("season.date") },
  ...Object.entries({
    "Late winter": "02-20", Spring: "04-25", "Early summer": "06-10", "High summer": "08-01",
    "Early autumn": "09-20", Autumn: "10-15", "Late autumn": "11-15", Winter: "12-31",
  }).map(([name, date]) => ({ name, changes: set({ "season.date": date }) })),
];

// By the date of the scene's sun, else that of its season.
export function hours(store) {
  const time = store.value("sun.time") ?? "";
  const season = store.value("season.date");
  const date = /^\d{4}-\d\d-\d\d/.exec(time)?.[0] ?? `${new Date().getFullYear()}-${season ?? "06-21"}`;
  const zone = /(Z|[+-]\d\d:\d\d)$/.exec(time)?.[0] ?? "+02:00";
  return [
    { name: "As painted", title: "The program places the sun, upper left of the picture", changes: away("sun.time", "sun.azimuth_deg", "sun.altitude_deg") },
    ...["06", "08", "10", "12", "14", "16", "18", "20"].map((hour) => ({
      name: `${hour}:00`,
      changes: set({ "sun.time": `${date}T${hour}:00:00${zone}` }),
    })),
  ];
}

const air = (haze, range_mist, warm_near, hue_drift) =>
  set({ "air.haze": haze, "air.range_mist": range_mist, "air.warm_near": warm_near, "air.hue_drift": hue_drift });
export const airs = () => [
  { name: "As painted", changes: away("air.haze", "air.range_mist", "air.warm_near", "air.hue_drift") },
  { name: "Crystal", changes: air(0.2, 0.2, 0.6, 0.6) },
  { name: "Clear", changes: air(0.5, 0.5, 1, 1) },
  { name: "Soft", changes: air(0.85, 1.8, 1, 1) },
  { name: "Warm", changes: air(0.8, 1, 2.2, 1.6) },
  { name: "Hazy", changes: air(1, 2.4, 1.2, 1) },
];

// A preset's weights count where the scene gives none beside it.
export const weights_of_bands = ["", "_ridges", "_valleys"].flatMap((set_) => [`generalize.foreground${set_}`, `generalize.background${set_}`]);
export const presets = (store) =>
  (store.describe("generalize.preset")?.enum ?? []).map((word) => ({
    name: word.replaceAll("_", " ") || "none",
    changes: [
      ...away(...weights_of_bands.filter((key) => store.given(key))),
      ...(word ? set({ "generalize.preset": word }) : away("generalize.preset")),
    ],
    chosen: () => (store.value("generalize.preset") ?? "") === word,
  }));
