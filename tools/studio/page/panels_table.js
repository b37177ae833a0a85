// What stands in which panel. A row names a key of the scene (docs/scene.md); its range and meaning come from the schema, min, max and step
// here are the slider's. log: the slider goes by ratio from this value on. A group may hold an `editor` (a module of its own) or a `list`
// (blocks [[key]]). What is needed most stands in `groups`, three to six controls; the rest, in `more`, is folded. `otherwise` is the number in
// effect where a key is left out and neither the schema nor the program's own choice tells it.
import { view } from "./camera.js";
import { airs, hours, seasons } from "./looks.js";

const parallel = (store) => store.value("camera.projection") === "oblique";
const central = (store) => !parallel(store);
const curved = (store) => store.value("deform.earth_curvature") === true;
const styled = (store) => Boolean(store.value("style.file"));
const distance = { unit: "m", min: 0, max: 300000, step: 100, log: 500 };
const by_target = (store) => view(store).by_target;
const by_angles = (store) => !by_target(store);
const of_block = (name, share) => (store, block) => share * (store.number(`${block}.${name}`) ?? 0);
const by_kind = (sea, valley) => (store, block) => (store.value(`${block}.kind`) === "valley" ? valley : sea);

export const panels = [
  {
    id: "camera", label: "Camera", groups: [
      { title: "View", rows: [
        { key: "camera.projection", label: "Projection" },
        { key: "camera.field_of_view_deg", label: "Field of view", unit: "°", min: 5, max: 180, step: 0.5, when: central },
        { key: "camera.view_width_m", label: "Width of the view", ...distance, min: 500, when: parallel },
        { key: "camera.azimuth_deg", label: "Direction", unit: "°", min: 0, max: 360, step: 0.5, when: by_angles, otherwise: () => 0 },
        { key: "camera.pitch_deg", label: "Pitch", unit: "°", min: -90, max: 30, step: 0.1, when: by_angles, otherwise: () => -20 },
        { key: "camera.tilt_deg", label: "Tilt", unit: "°", min: -20, max: 20, step: 0.1, otherwise: () => 0 },
        { key: "camera.height_m", label: "Height", unit: "m", min: 0, max: 60000, step: 50, log: 200, otherwise: () => 3000 },
      ], actions: [{ label: "Look at a place in the picture…", action: "target" }] },
    ], more: [
      { title: "Viewer", rows: [
        { key: "camera.position", label: "Position", unit: "m", step: 100, get: (store) => view(store).viewer },
        { key: "camera.height_above_ground", label: "Height above ground" },
      ] },
      { title: "Target", when: by_target, rows: [
        { key: "camera.look_at", label: "Look at", unit: "m", step: 100, when: by_target, get: (store) => view(store).target },
        { key: "camera.look_at_altitude_m", label: "Target altitude", unit: "m", min: 0, max: 5000, step: 10, auto: "ground", when: by_target },
      ], actions: [{ label: "Look by angles instead", action: "angles", when: by_target }] },
    ],
  },
  {
    id: "sun", label: "Sun", groups: [
      { title: "Direction of the light", editor: "sun" },
      { title: "Hour of the day", rows: [{ key: "sun.time", label: "Hour of the day", kind: "gallery", bare: true, looks: hours, lock: true }] },
      { title: "Light and shade", rows: [
        { key: "light.sun", label: "Sunlight", min: 0, max: 2, step: 0.01 },
        { key: "light.shadow_depth", label: "Shadow depth", min: 0, max: 1, step: 0.01 },
      ] },
    ], more: [
      { title: "Light and shade", rows: [
        { key: "light.sky", label: "Sky light", min: 0, max: 1, step: 0.01 },
        { key: "light.contrast", label: "Contrast", min: 0.2, max: 3, step: 0.01 },
        { key: "light.relief", label: "Relief without sun", min: 0, max: 1, step: 0.01 },
        { key: "sun.radius_deg", label: "Soft shadows", unit: "°", min: 0, max: 10, step: 0.05 },
      ] },
    ],
  },
  {
    id: "ground", label: "Ground", groups: [
      { title: "Heights", rows: [
        { key: "deform.exaggeration", label: "Exaggeration", unit: "×", min: 0.5, max: 4, step: 0.02, otherwise: () => 1 },
      ] },
      { title: "Bend", editor: "bend" },
      { title: "Handles", list: "deform.handles" },
    ], more: [
      { title: "Heights by distance", rows: [
        {
          key: "deform.background_exaggeration", label: "Far away", unit: "×", min: 0.5, max: 4, step: 0.02, auto: "as near",
          otherwise: (store) => store.number("deform.exaggeration"),
        },
        { key: "deform.foreground_to_m", label: "Near up to", ...distance },
        { key: "deform.background_from_m", label: "Far from", ...distance },
        { key: "deform.exaggeration_base_m", label: "Fixed altitude", unit: "m", min: -500, max: 4000, step: 10, otherwise: () => 0 },
      ] },
      { title: "Summits", list: "deform.summits" },
      { title: "Earth", rows: [
        { key: "deform.earth_curvature", label: "Curvature of the Earth" },
        { key: "deform.refraction", label: "Refraction", min: 0, max: 0.5, step: 0.01, when: curved },
        { key: "deform.allow_folds", label: "Allow folds" },
      ] },
    ],
  },
  {
    id: "equalizer", label: "Equalizer", groups: [
      { title: "Bands of landforms", rows: [
        { key: "generalize.base", label: "Land as a whole", min: 0, max: 3, step: 0.05 },
      ], editor: "equalizer" },
    ], more: [
      { title: "Distances", rows: [
        { key: "generalize.foreground_to_m", label: "Near up to", ...distance },
        { key: "generalize.background_from_m", label: "Far from", ...distance },
      ] },
      { title: "Ridges and valleys", rows: [
        { key: "generalize.crest", label: "Sharpness of crests", min: 0, max: 3, step: 0.05 },
        { key: "generalize.curvature", label: "Curvature" },
        { key: "generalize.full_curvature", label: "Full ridge at", min: 0, max: 2, step: 0.01 },
        { key: "generalize.blur_cells", label: "Blur", unit: "cells", min: 0, max: 10, step: 0.1 },
        { key: "generalize.exponent", label: "Exponent", min: 0, max: 4, step: 0.05 },
        { key: "generalize.widen_valleys_m", label: "Widen valleys", unit: "m", min: 0, max: 2000, step: 10 },
      ] },
      { title: "Where", rows: [
        { key: "generalize.mask_slope_deg", label: "Slope from, to", unit: "°", step: 1, names: ["≥", "≤"] },
        { key: "generalize.print_detail_px", label: "Smallest detail", unit: "px", min: 0, max: 10, step: 0.1 },
        { key: "generalize.automatic_mask", label: "Keep the foot of slopes" },
        { key: "generalize.keep_lakes", label: "Keep lakes level" },
        { key: "generalize.line_integral", label: "Smooth along slope lines" },
        { key: "generalize.destripe", label: "Remove stripes of the data" },
      ] },
    ],
  },
  {
    id: "air", label: "Air", groups: [
      { title: "Haze and sky", rows: [
        { key: "air.haze", label: "Airs", kind: "gallery", looks: airs },
        { key: "air.haze", label: "Haze", min: 0, max: 1, step: 0.01 },
        { key: "air.from_m", label: "Begins at", ...distance },
        { key: "air.scale_m", label: "Grows over", ...distance, min: 100 },
        { key: "air.clouds", label: "Amount of clouds", min: 0, max: 2, step: 0.02 },
      ] },
      { title: "Mist", list: "air.mist" },
    ], more: [
      { title: "Haze", rows: [
        { key: "air.range_mist", label: "Between ranges", min: 0, max: 3, step: 0.02 },
        { key: "air.rim_fade_m", label: "Fade at the edge", ...distance, max: 50000 },
        { key: "air.warm_near", label: "Warm foreground", min: 0, max: 3, step: 0.02 },
        { key: "air.hue_drift", label: "Drift of hue", min: 0, max: 3, step: 0.02 },
      ] },
      { title: "Sky", rows: [{ key: "air.sky", label: "Clouds", kind: "gallery" }] },
    ],
  },
  {
    id: "look", label: "Look", groups: [
      { title: "Colours", rows: [
        { key: "palette", label: "Palette", kind: "gallery", words: (store) => store.choices.palettes },
      ] },
      { title: "Style of a painting", rows: [
        { key: "style.file", label: "Style", kind: "gallery", bare: true, words: (store) => store.choices.styles, none: "none" },
        { key: "style.palette", label: "Its colours", min: 0, max: 1, step: 0.01, when: styled },
        { key: "style.brushwork", label: "Its strokes", min: 0, max: 1, step: 0.01, when: styled },
        { key: "style.winter", label: "Winter", when: styled },
      ] },
      { title: "Season", rows: [
        { key: "season.date", label: "Seasons", kind: "gallery", bare: true, looks: seasons },
        { key: "season.date", label: "Date", hint: "10-05" },
      ] },
    ], more: [
      { title: "Style of a painting", when: styled, rows: [
        { key: "style.sky", label: "Its sky", min: 0, max: 1, step: 0.01, when: styled },
        { key: "style.contour_lines", label: "Its dark lines", min: 0, max: 1, step: 0.01, when: styled },
        { key: "style.scale", label: "Size of its strokes", unit: "×", min: 0.2, max: 8, step: 0.05, when: styled },
        { key: "style.relief", label: "Relief of the paint", min: 0, max: 3, step: 0.02, when: styled },
        { key: "style.canvas", label: "Canvas", min: 0, max: 3, step: 0.02, when: styled },
      ] },
      { title: "Ground and season", rows: [
        { key: "land_cover.rock", label: "Rock", kind: "gallery" },
        { key: "season.frozen_lakes", label: "Frozen lakes" },
      ] },
      { title: "Water", rows: [
        { key: "water.mirror", label: "Reflections" },
        { key: "water.mirror_share", label: "Strength", min: 0, max: 2, step: 0.02 },
        { key: "water.wind", label: "Wind", min: 0, max: 2, step: 0.02 },
      ] },
      { title: "Chance", rows: [{ key: "seed", label: "Seed", min: 0, max: 1000, step: 1 }] },
    ],
  },
  {
    id: "lights", label: "Lights", groups: [
      { title: "Light regions", list: "light.regions" },
      { title: "Cloud shadows", list: "light.clouds" },
    ],
  },
  {
    id: "paint", label: "Exemplars", groups: [
      { title: "Paintings", list: "exemplar" },
      { title: "Texture", rows: [
        { key: "synthesis.enabled", label: "Copy from paintings" },
        { key: "synthesis.colours", label: "Colours of" },
        { key: "synthesis.reuse", label: "Against repetition", min: 0, max: 10, step: 0.05 },
      ] },
    ], more: [
      { title: "Texture", rows: [
        { key: "synthesis.harmonize", label: "Harmonize" },
        { key: "synthesis.residual", label: "Own light and air", min: 0, max: 1, step: 0.01 },
        { key: "synthesis.surroundings", label: "Classes around", min: 0, max: 10, step: 0.05 },
      ] },
      { title: "Weights of the guides", editor: "weights" },
    ],
  },
  {
    id: "names", label: "Names", groups: [
      { title: "Names", rows: [
        { key: "labels.in_picture", label: "Names in the picture" },
        { key: "labels.summits", label: "Summits", min: 0, max: 100, step: 1 },
      ] },
      { title: "Draw on the ground", editor: "draw" },
      { title: "Points with names", list: "labels.points" },
      { title: "Tracks", list: "labels.tracks" },
      { title: "Roads, lifts, waters", list: "features" },
    ], more: [
      { title: "Names", rows: [
        { key: "labels.min_prominence_m", label: "Prominence from", unit: "m", min: 1, max: 2000, step: 10 },
        { key: "labels.style", label: "Type" },
      ] },
      { title: "Moved by hand", list: "labels.by_hand" },
      { title: "Names along shapes", list: "labels.shapes" },
      { title: "Towns", list: "land_cover.towns" },
    ],
  },
  {
    id: "output", label: "Output", groups: [
      { title: "Sheet", rows: [
        { key: "title", label: "Title" },
        { key: "output.width", label: "Width", unit: "px", min: 200, max: 20000, step: 1, log: 200 },
        { key: "output.height", label: "Height", unit: "px", min: 200, max: 10000, step: 1, log: 200 },
        { key: "output.sheet_width_mm", label: "Width in print", unit: "mm", min: 100, max: 3000, step: 1 },
      ], editor: "sheet" },
      { title: "Files", rows: [
        { key: "output.formats", label: "Formats" },
      ] },
    ], more: [
      { title: "Colours", rows: [
        { key: "output.colours", label: "Colour space" },
        { key: "output.intent", label: "Intent" },
        { key: "output.black_point", label: "Black point" },
      ] },
      { title: "Margin", rows: [
        { key: "margin.title", label: "Title" },
        { key: "margin.subtitle", label: "Subtitle" },
        { key: "margin.frame_mm", label: "Width", unit: "mm", min: 0, max: 100, step: 1 },
        { key: "margin.legend", label: "Legend" },
        { key: "margin.scale_bars", label: "Scale bars" },
        { key: "margin.directions", label: "Compass" },
        { key: "margin.sources", label: "Sources" },
      ] },
    ],
  },
];

// How far a light stands from the scene's sun, where it is given by its own direction.
function turn_of(store, block) {
  const own = store.value(`${block}.azimuth_deg`);
  const sun = store.number("sun.azimuth_deg");
  if (own === undefined) return 0;
  return sun === undefined ? undefined : ((((own - sun + 180) % 360) + 360) % 360) - 180;
}

const source = [{ key: "origin", label: "Origin" }, { key: "licence", label: "Licence" }];

// Blocks: what one is called, its rows (names of keys in it), and how a new one begins. pick: a click on the picture puts it down.
export const lists = {
  "deform.handles": {
    one: "Handle", none: "No ground is moved yet.", pull: "Pull a summit…",
    rows: [
      { key: "name", label: "Name" },
      { key: "raise_m", label: "Raise", unit: "m", min: -2000, max: 2000, step: 10 },
      { key: "move_m", label: "Move", unit: "m", step: 50 },
      { key: "rotate_deg", label: "Turn", unit: "°", min: -170, max: 170, step: 1 },
      { key: "scale", label: "Scale", unit: "×", min: 0.2, max: 5, step: 0.02 },
      { key: "radius_m", label: "Radius", unit: "m", min: 0, max: 50000, step: 100, log: 200 },
      { key: "core_m", label: "Rigid within", unit: "m", min: 0, max: 50000, step: 100, log: 200, otherwise: of_block("radius_m", 0.5) },
      { key: "position", label: "Centre", unit: "m", step: 100 },
      { key: "pin", label: "Pin" },
    ],
  },
  "deform.summits": {
    one: "Summit", none: "No summit is exaggerated by itself.",
    pick: { label: "Exaggerate a summit…", hint: "Click on the summit.", template: { radius_m: 5000, factor: 1.3 } },
    rows: [
      { key: "name", label: "Name" },
      { key: "factor", label: "Factor", unit: "×", min: 0.3, max: 5, step: 0.02 },
      { key: "radius_m", label: "Radius", unit: "m", min: 10, max: 50000, step: 100, log: 200 },
      { key: "base_m", label: "From altitude", unit: "m", min: 0, max: 5000, step: 10 },
      { key: "position", label: "Position", unit: "m", step: 100 },
    ],
  },
  "light.regions": {
    one: "Light", none: "The whole land has the light of the sun.",
    pick: { label: "Put a light on a range…", hint: "Click on the range.", template: { radius_m: 5000, turn_deg: 40, blend_m: 3000 } },
    rows: [
      { key: "name", label: "Name" },
      { key: "turn_deg", label: "Turn the sun", unit: "°", min: -180, max: 180, step: 1, auto: "as scene", otherwise: turn_of },
      {
        key: "altitude_deg", label: "Its altitude", unit: "°", min: 1, max: 90, step: 0.5, auto: "as scene",
        otherwise: (store) => store.number("sun.altitude_deg"),
      },
      { key: "strength", label: "Strength", unit: "×", min: 0, max: 2, step: 0.02 },
      { key: "warmth", label: "Warmth", min: -1, max: 1, step: 0.02 },
      { key: "radius_m", label: "Radius", unit: "m", min: 100, max: 100000, step: 100, log: 200, auto: false },
      { key: "blend_m", label: "Transition", unit: "m", min: 0, max: 50000, step: 100, log: 200 },
      { key: "position", label: "Centre", unit: "m", step: 100 },
    ],
  },
  "light.clouds": {
    one: "Cloud shadow", none: "No cloud shadows.",
    pick: { label: "Put a cloud shadow…", hint: "Click where the shadow shall lie.", template: { radius_m: 2000 } },
    rows: [
      { key: "strength", label: "Strength", min: 0, max: 1, step: 0.01 },
      { key: "radius_m", label: "Radius", unit: "m", min: 100, max: 50000, step: 100, log: 200 },
      { key: "blend_m", label: "Soft edge", unit: "m", min: 0, max: 50000, step: 100, log: 200, otherwise: of_block("radius_m", 1) },
      { key: "position", label: "Centre", unit: "m", step: 100 },
    ],
  },
  "air.mist": {
    one: "Mist", none: "No mist.",
    pick: { label: "Put mist in a valley…", hint: "Click on the valley.", template: { kind: "valley", radius_m: 10000 } },
    rows: [
      { key: "kind", label: "Kind" },
      { key: "to_m", label: "Up to altitude", unit: "m", min: 0, max: 4000, step: 10, auto: false },
      { key: "height_m", label: "Height", unit: "m", min: 5, max: 1000, step: 5 },
      { key: "visibility_m", label: "Visibility", unit: "m", min: 20, max: 10000, step: 10, log: 20, otherwise: by_kind(450, 500) },
      { key: "edge_m", label: "Soft edge", unit: "m", min: 0, max: 1000, step: 5 },
      { key: "patches", label: "Gaps", min: 0, max: 1, step: 0.01, otherwise: by_kind(0, 0.35) },
      { key: "billows", label: "Billows", min: 0, max: 3, step: 0.02 },
      { key: "radius_m", label: "Radius", unit: "m", min: 0, max: 100000, step: 100, log: 500 },
      { key: "position", label: "Centre", unit: "m", step: 100 },
    ],
  },
  exemplar: {
    one: "Painting", none: "Nothing is copied. Drop a painting on the page to copy from it.", title: "picture",
    room: { label: "Pair its places with the map…", of: "picture", work: "pick" },
    rows: [
      { key: "light", label: "Serves light" },
      { key: "found_shadow", label: "Dark pixels" },
      { key: "classes_from", label: "Classes by" },
      { key: "stroke_px", label: "Size of strokes", unit: "px", min: 0.5, max: 40, step: 0.5 },
      { key: "seed", label: "Seed", min: 0, max: 1000, step: 1 },
      { key: "origin", label: "Origin" },
      { key: "licence", label: "Licence" },
    ],
  },
  "labels.by_hand": {
    one: "Name", none: "None. Drag a name in the picture.",
    rows: [
      { key: "dx_mm", label: "To the right", unit: "mm", min: -100, max: 100, step: 0.1 },
      { key: "dy_mm", label: "Down", unit: "mm", min: -100, max: 100, step: 0.1 },
      { key: "hidden", label: "Hidden" },
      { key: "rank", label: "Rank", min: 1, max: 9, step: 1 },
      { key: "kind", label: "Kind" },
    ],
  },
  "labels.points": { one: "File", none: "None. Drop a file of points on the page.", title: "file", rows: source },
  "labels.shapes": { one: "File", none: "None.", title: "file", rows: source },
  "labels.tracks": { one: "Track", none: "None. Drop a GPX file on the page.", title: "file", rows: source },
  features: {
    one: "Features", none: "None. Drop a vector file on the page.", title: "source",
    rows: [
      { key: "kind", label: "Kind" },
      { key: "where", label: "Only where", hint: "highway = 'motorway'" },
      { key: "width_mm", label: "Width in print", unit: "mm", min: 0, max: 5, step: 0.05 },
      { key: "snap_m", label: "Snap rivers", unit: "m", min: 0, max: 2000, step: 10 },
    ],
  },
  "land_cover.towns": {
    one: "Town", none: "Only towns that the land cover or the rules have.",
    pick: { label: "Put a town…", hint: "Click where the town shall be.", template: { radius_m: 800 } },
    rows: [
      { key: "name", label: "Name" },
      { key: "radius_m", label: "Radius", unit: "m", min: 50, max: 10000, step: 10, log: 50, auto: false },
      { key: "position", label: "Centre", unit: "m", step: 100 },
    ],
  },
};
