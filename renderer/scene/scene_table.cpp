#include "renderer/scene/scene_schema.h"

#include <utility>

#include "base/instruction_set.h"
#include "renderer/image/picture_formats.h"
#include "renderer/paint/guides.h"
#include "renderer/scene/scene_table.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

constexpr double largest_seed = 9007199254740991.0;  // 2⁵³ - 1: what JSON and every editor hold exactly

std::vector<SceneKey> source_keys(bool heights) {
  // Land cover and heights name their files alike; only heights have a unit.
  const auto source = [heights](auto terrain, auto cover) { return heights ? +terrain : +cover; };
  std::vector<SceneKey> keys = {
      {.name = "file",
       .field = source(AT(terrain.sources[i].file), AT(land_cover.sources[i].file)),
       .meaning = "Raster in any common format (GeoTIFF, ESRI ASCII, HGT …).",
       .text = TextKind::file,
       .required = true},
      {.name = "band",
       .field = source(AT(terrain.sources[i].band), AT(land_cover.sources[i].band)),
       .range = {1, 65535},
       .meaning = "Band of the file, counted from 1."},
      {.name = "crs",
       .field = source(AT(terrain.sources[i].crs), AT(land_cover.sources[i].crs)),
       .meaning = "Coordinate reference system, where the file has none or a wrong one: \"EPSG:26911\".",
       .text = TextKind::crs},
      {.name = "nodata",
       .field = source(AT(terrain.sources[i].nodata), AT(land_cover.sources[i].nodata)),
       .range = {-1e38, 1e38},
       .meaning = "Value that means no data; without it what the file says."},
      {.name = "origin", .field = source(AT(terrain.sources[i].origin), AT(land_cover.sources[i].origin)), .meaning = "Who made the data."},
      {.name = "licence",
       .field = source(AT(terrain.sources[i].licence), AT(land_cover.sources[i].licence)),
       .meaning = "Under which terms it may be used."},
      {.name = "get_from",
       .field = source(AT(terrain.sources[i].get_from), AT(land_cover.sources[i].get_from)),
       .meaning = "Where to get it; shown when the file is missing."},
  };
  if (heights) {
    keys.insert(keys.begin() + 3, {.name = "unit",
                                   .field = AT(terrain.sources[i].unit),
                                   .meaning = "Unit of the heights, where the file does not say it; us-ft is the survey foot.",
                                   .text = TextKind::choice,
                                   .choices = {"", "m", "ft", "us-ft"}});
    keys.insert(keys.begin() + 5, {.name = "lowest_m",
                                   .field = AT(terrain.sources[i].lowest_m),
                                   .range = {-12000, 9000},
                                   .unit = "m",
                                   .meaning = "Lower heights are flaws of the data and count as voids."});
    keys.insert(keys.begin() + 6, {.name = "highest_m",
                                   .field = AT(terrain.sources[i].highest_m),
                                   .range = {-12000, 9000},
                                   .unit = "m",
                                   .meaning = "Higher heights are flaws of the data and count as voids."});
  }
  return keys;
}

std::vector<std::string> projection_choices() {
  std::vector<std::string> names;
  for (const Projection& projection : projections()) names.emplace_back(projection.name);
  return names;
}

std::vector<std::string> instruction_set_choices() {
  std::vector<std::string> names = {"any"};
  names.insert(names.end(), instruction_sets().begin(), instruction_sets().end());
  return names;
}

}  // namespace

std::vector<SceneSection> make_scene_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "",
       .meaning = "These stand on top of the file, before the first table.",
       .keys = {
           {.name = "version", .field = AT(version), .range = {1, 1}, .meaning = "Version of the scene format.", .required = true},
           {.name = "title", .field = AT(title), .meaning = "What the panorama shows; goes into the files' headers."},
           {.name = "seed",
            .field = AT(seed),
            .range = {0, largest_seed},
            .meaning = "Another number gives another hand: other strokes, clouds and noise, same terrain."},
           {.name = "palette",
            .field = AT(palette),
            .meaning = "Colours of every class by light and altitude: a built-in name or a .toml file.",
            .text = TextKind::built_in,
            .choices_from = "palettes"},
       }});
  sections.push_back(
      {.name = "terrain",
       .meaning = "Where the heights come from: rasters, or a made-up terrain. With neither, a made-up one.",
       .keys = {
           {.name = "crs",
            .field = AT(terrain.crs),
            .meaning = "Metric coordinate reference system of the scene, such as \"EPSG:32632\"; without it that of the first source, or "
                       "its UTM zone.",
            .text = TextKind::crs},
           {.name = "cell_m",
            .field = AT(terrain.cell_m),
            .range = {0, 10000},
            .unit = "m",
            .meaning = "Size of a cell; 0 takes the finest source's."},
           {.name = "extent",
            .field = AT(terrain.extent),
            .range = {-largest_m, largest_m},
            .unit = "m",
            .meaning = "The part to use, [min E, min N, max E, max N] in the scene's CRS; without it all there is."},
           {.name = "max_void_share",
            .field = AT(terrain.max_void_share),
            .range = {0, 1},
            .meaning = "Holes in the data are filled; if they are more than this share of the area, it is an error instead."},
       }});
  sections.push_back(
      {.name = "terrain.sources",
       .kind = SectionKind::list,
       .meaning = "One block for each elevation raster. Where several overlap, the first one wins and the others fill its holes.",
       .keys = source_keys(true),
       .count = [](const Scene& s) { return s.terrain.sources.size(); },
       .resize = [](Scene& s, std::size_t n) { s.terrain.sources.resize(n); }});
  sections.push_back(
      {.name = "terrain.synthetic",
       .kind = SectionKind::optional,
       .meaning = "A made-up alpine terrain, cut by rivers and glaciers, in metric coordinates of its own.",
       .keys =
           {
               {.name = "width",
                .field = AT(terrain.synthetic->width),
                .range = {16, 16384},
                .unit = "cells",
                .meaning = "From west to east."},
               {.name = "height",
                .field = AT(terrain.synthetic->height),
                .range = {16, 16384},
                .unit = "cells",
                .meaning = "From north to south."},
               {.name = "cell_m", .field = AT(terrain.synthetic->cell_m), .range = {1, 1000}, .unit = "m", .meaning = "Size of a cell."},
               {.name = "lowest_m",
                .field = AT(terrain.synthetic->lowest_m),
                .range = {-500, 8000},
                .unit = "m",
                .meaning = "Altitude of the lowest valley."},
               {.name = "highest_m",
                .field = AT(terrain.synthetic->highest_m),
                .range = {-400, 9000},
                .unit = "m",
                .meaning = "Altitude of the highest summit."},
               {.name = "seed",
                .field = AT(terrain.synthetic->seed),
                .range = {0, largest_seed},
                .meaning = "Another number gives other mountains."},
           },
       .count = [](const Scene& s) { return s.terrain.synthetic ? std::size_t{1} : std::size_t{0}; },
       .resize =
           [](Scene& s, std::size_t n) {
             if (n > 0)
               s.terrain.synthetic.emplace();
             else
               s.terrain.synthetic.reset();
           }});
  sections.push_back(
      {.name = "land_cover",
       .meaning = "What the ground is: from rasters with a legend, or, where there are none, by rules from the terrain itself.",
       .keys = {
           {.name = "refine",
            .field = AT(land_cover.refine),
            .meaning = "What a raster does not tell apart: glacier = \"rock\" makes glacier of what the raster calls rock where the rules "
                       "see a glacier."},
           {.name = "legend",
            .field = AT(land_cover.legend),
            .meaning = "What the raster's codes mean: a built-in legend or a .toml or .csv file. Needed where there is a source.",
            .text = TextKind::built_in,
            .choices_from = "legends"},
           {.name = "rules",
            .field = AT(land_cover.rules),
            .meaning =
                "Rules that tell the classes from altitude, slope and exposure where there is no source: a built-in name or a .toml file.",
            .text = TextKind::built_in,
            .choices_from = "layers"},
           {.name = "unknown",
            .field = AT(land_cover.unknown),
            .meaning = "Class of codes that the legend lacks; without it they are an error."},
           {.name = "nodata",
            .field = AT(land_cover.nodata),
            .meaning = "Class where the raster has nothing; without it that of the nearest known cell."},
           {.name = "smallest_patch_m2",
            .field = AT(land_cover.patches.smallest_m2),
            .range = {0, 1e10},
            .unit = "m²",
            .meaning = "Smaller patches of a class go to what lies around them; 0 leaves them. `belvedere check` says what became of each "
                       "class."},
           {.name = "keep_patches",
            .field = AT(land_cover.patches.keep),
            .meaning =
                "Classes whose small patches matter: they stay, and grow by up to three cells until they are large enough to be seen."},
           {.name = "settings",
            .field = AT(land_cover.settings),
            .range = {-1e9, 1e9},
            .meaning = "Parameters of the rules by name, such as the altitude of the treeline; the rules' file lists them."},
       }});
  sections.push_back({.name = "land_cover.sources",
                      .kind = SectionKind::list,
                      .meaning = "One block for each land-cover raster. Where several overlap, the first one wins.",
                      .keys = source_keys(false),
                      .count = [](const Scene& s) { return s.land_cover.sources.size(); },
                      .resize = [](Scene& s, std::size_t n) { s.land_cover.sources.resize(n); }});
  sections.push_back(make_generalize_section());
  for (SceneSection& section : make_deform_sections()) sections.push_back(std::move(section));
  sections.push_back({.name = "camera",
                      .meaning = "Where the viewer stands and where the view goes.",
                      .keys = {
                          {.name = "projection",
                           .field = AT(camera.projection),
                           .meaning = "Kind of perspective; see below.",
                           .text = TextKind::choice,
                           .choices = projection_choices()},
                          {.name = "position",
                           .field = AT(camera.position),
                           .range = {-largest_m, largest_m},
                           .unit = "m",
                           .meaning = "Viewpoint, [E, N] in the scene's CRS."},
                          {.name = "position_lonlat",
                           .field = AT(camera.position_lonlat),
                           .unit = "°",
                           .meaning = "Viewpoint, [longitude, latitude]; instead of position.",
                           .lonlat = true},
                          {.name = "height_m",
                           .field = AT(camera.height_m),
                           .range = {-1000, 1e6},
                           .unit = "m",
                           .meaning = "Height of the viewpoint above sea level, not exaggerated."},
                          {.name = "height_above_ground",
                           .field = AT(camera.height_above_ground),
                           .meaning = "Counts the height from the ground under the viewpoint instead of from sea level."},
                          {.name = "look_at",
                           .field = AT(camera.look_at),
                           .range = {-largest_m, largest_m},
                           .unit = "m",
                           .meaning = "Point in the middle of the picture, [E, N] in the scene's CRS; instead of azimuth and pitch."},
                          {.name = "look_at_lonlat",
                           .field = AT(camera.look_at_lonlat),
                           .unit = "°",
                           .meaning = "The same as [longitude, latitude].",
                           .lonlat = true},
                          {.name = "look_at_altitude_m",
                           .field = AT(camera.look_at_altitude_m),
                           .range = {-12000, 1e5},
                           .unit = "m",
                           .meaning = "Altitude of that point; without it, it lies on the ground."},
                          {.name = "azimuth_deg",
                           .field = AT(camera.azimuth_deg),
                           .range = {-360, 360},
                           .unit = "°",
                           .meaning = "Direction of view, clockwise from north: 180 looks south."},
                          {.name = "pitch_deg",
                           .field = AT(camera.pitch_deg),
                           .range = {-90, 90},
                           .unit = "°",
                           .meaning = "Direction of view against the horizontal: -90 straight down."},
                          {.name = "tilt_deg",
                           .field = AT(camera.tilt_deg),
                           .range = {-45, 45},
                           .unit = "°",
                           .meaning = "Added to the pitch, with look_at as well: more than 0 raises the view and shows more sky."},
                          {.name = "field_of_view_deg",
                           .field = AT(camera.field_of_view_deg),
                           .range = {1, 360},
                           .unit = "°",
                           .meaning = "Width of the view; how wide a projection goes stands below."},
                          {.name = "view_width_m",
                           .field = AT(camera.view_width_m),
                           .range = {1, 1e7},
                           .unit = "m",
                           .meaning = "Width of the view on the ground, for parallel projections."},
                      }});
  sections.push_back({.name = "sun",
                      .meaning = "The sun, by direction or by date and time.",
                      .keys = {
                          {.name = "azimuth_deg",
                           .field = AT(sun.azimuth_deg),
                           .range = {-360, 360},
                           .unit = "°",
                           .meaning = "Where the light comes from, clockwise from north: 315 is the northwest."},
                          {.name = "altitude_deg",
                           .field = AT(sun.altitude_deg),
                           .range = {-90, 90},
                           .unit = "°",
                           .meaning = "Height above the horizon; below 0 only the sky lights the land."},
                          {.name = "time",
                           .field = AT(sun.time),
                           .meaning = "Date and time with zone, \"2024-06-21T17:30:00+02:00\"; instead of azimuth and altitude.",
                           .text = TextKind::time},
                          {.name = "radius_deg",
                           .field = AT(sun.radius_deg),
                           .range = {0, 10},
                           .unit = "°",
                           .meaning = "Radius of the sun's disc: larger gives softer edges of cast shadows (the true sun has 0.27)."},
                      }});
  sections.push_back({.name = "sampling",
                      .meaning = "How much is computed for each pixel: quality against time.",
                      .keys = {
                          {.name = "pixel_samples",
                           .field = AT(sampling.pixel_samples),
                           .range = {1, 16},
                           .meaning = "Lines of sight through each pixel: 1, 4, 9 or 16."},
                          {.name = "shadow_rays",
                           .field = AT(sampling.shadow_rays),
                           .range = {1, 64},
                           .meaning = "Rays to the sun's disc from each pixel, for cast shadows."},
                          {.name = "sky_directions",
                           .field = AT(sampling.sky_directions),
                           .range = {0, 256},
                           .meaning = "Directions in which the open sky is sought, for shade in valleys; 0 leaves it out."},
                          {.name = "sky_reach_m",
                           .field = AT(sampling.sky_reach_m),
                           .range = {1, 1e6},
                           .unit = "m",
                           .meaning = "How far terrain hides the sky."},
                          {.name = "instruction_set",
                           .field = AT(sampling.instruction_set),
                           .meaning = "Vector instructions that rays are traced with: the best a machine has, or one kind, where several "
                                      "machines shall give the same picture to the last bit. A machine that lacks it refuses.",
                           .text = TextKind::choice,
                           .choices = instruction_set_choices()},
                      }});
  sections.push_back(
      {.name = "light",
       .meaning = "How light becomes tone, from which the palette's colours are taken.",
       .keys = {
           {.name = "sun", .field = AT(light.sun), .range = {0, 2}, .meaning = "Strength of sunlight."},
           {.name = "sky", .field = AT(light.sky), .range = {0, 2}, .meaning = "Strength of light from the sky."},
           {.name = "relief",
            .field = AT(light.relief),
            .range = {0, 1},
            .meaning = "How much heights are lighter and hollows darker, whatever the sun does."},
           {.name = "shadow_depth",
            .field = AT(light.shadow_depth),
            .range = {0, 1},
            .meaning = "How much of the sunlight a cast shadow takes away."},
           {.name = "contrast", .field = AT(light.contrast), .range = {0.2, 3}, .meaning = "Contrast between light and shade."},
       }});
  sections.push_back(
      {.name = "air",
       .meaning = "What distance does to colour.",
       .keys = {
           {.name = "haze", .field = AT(air.haze), .range = {0, 1}, .meaning = "Greatest share of haze at the horizon."},
           {.name = "from_m", .field = AT(air.from_m), .range = {0, 1e7}, .unit = "m", .meaning = "Distance at which haze begins."},
           {.name = "scale_m",
            .field = AT(air.scale_m),
            .range = {0, 1e7, true},
            .unit = "m",
            .meaning = "Distance over which it thickens to two thirds."},
           {.name = "range_mist", .field = AT(air.range_mist), .range = {0, 3}, .meaning = "Mist between ranges that sets them apart."},
           {.name = "warm_near", .field = AT(air.warm_near), .range = {0, 3}, .meaning = "Warmth of the foreground's colours."},
           {.name = "hue_drift",
            .field = AT(air.hue_drift),
            .range = {0, 3},
            .meaning = "Slow change of hue across fields, forest and rock."},
           {.name = "rim_fade_m",
            .field = AT(air.rim_fade_m),
            .range = {0, 1e6},
            .meaning =
                "Over this distance the terrain stands ever deeper in haze towards its end, mountains as blue silhouettes, so that it "
                "does not end in a cliff; 0 is off."},
           {.name = "clouds", .field = AT(air.clouds), .range = {0, 2}, .meaning = "How many clouds; 0 is a clear sky."},
       }});
  sections.push_back(
      {.name = "exemplar",
       .kind = SectionKind::list,
       .meaning = "One block for each painting whose hand is taken over: a picture with its classes, or one the program paints itself. "
                  "Without a block the program paints one.",
       .keys =
           {
               {.name = "picture",
                .field = AT(exemplars[i].picture),
                .meaning = "The painting or scan; without it the program paints one on a made-up terrain.",
                .text = TextKind::file},
               {.name = "guidance",
                .field = AT(exemplars[i].guidance),
                .meaning = "guidance.exr of the picture, registered to the pixel; or classes and altitude instead.",
                .text = TextKind::file},
               {.name = "classes",
                .field = AT(exemplars[i].classes),
                .meaning = "Grey image of the picture's size with the number of each pixel's class; 255 is never copied from.",
                .text = TextKind::file},
               {.name = "altitude",
                .field = AT(exemplars[i].altitude),
                .meaning = "Grey image of the picture's size: altitude from black to white.",
                .text = TextKind::file},
               {.name = "altitude_range_m",
                .field = AT(exemplars[i].altitude_range_m),
                .range = {-12000, 1e5},
                .unit = "m",
                .meaning = "What black and white mean in it."},
               {.name = "shadow",
                .field = AT(exemplars[i].shadow),
                .meaning = "Grey image of the picture's size: black where it shows cast shadow, white where the sun shines.",
                .text = TextKind::file},
               {.name = "found_shadow",
                .field = AT(exemplars[i].found_shadow),
                .meaning =
                    "What becomes of places that are dark and cool for their class, where no image or guidance tells the shadow: they "
                    "serve shaded ground, are never copied from, or count as any other.",
                .text = TextKind::choice,
                .choices = {"guide", "exclude", "ignore"}},
               {.name = "exclude",
                .field = AT(exemplars[i].exclude),
                .meaning = "Grey image of the picture's size: what is not black is never copied from (lettering, frames, figures).",
                .text = TextKind::file},
               {.name = "serves",
                .field = AT(exemplars[i].serves),
                .meaning = "Classes it may be copied for: [\"rock\", \"snow\"]; without it every class it shows."},
               {.name = "stroke_px",
                .field = AT(exemplars[i].stroke_px),
                .range = {0.5, 100},
                .unit = "px",
                .meaning = "Where the painting's light must be told from the painting itself: what is larger than this is light, what is "
                           "smaller a stroke."},
               {.name = "origin", .field = AT(exemplars[i].origin), .meaning = "Who painted it, and when."},
               {.name = "licence", .field = AT(exemplars[i].licence), .meaning = "Under which terms it may be used."},
               {.name = "get_from", .field = AT(exemplars[i].get_from), .meaning = "Where to get it; shown when a file is missing."},
               {.name = "optional",
                .field = AT(exemplars[i].optional),
                .meaning = "Where a file is missing, the exemplar is left out with a note instead of an error."},
               {.name = "width",
                .field = AT(exemplars[i].width),
                .range = {64, 16384},
                .unit = "px",
                .meaning = "Width of one that the program paints."},
               {.name = "height",
                .field = AT(exemplars[i].height),
                .range = {64, 16384},
                .unit = "px",
                .meaning = "Height of one that the program paints."},
               {.name = "seed",
                .field = AT(exemplars[i].seed),
                .range = {0, largest_seed},
                .meaning = "Another number gives another made-up terrain and other strokes."},
           },
       .count = [](const Scene& s) { return s.exemplars.size(); },
       .resize = [](Scene& s, std::size_t n) { s.exemplars.resize(n); }});
  sections.push_back(
      {.name = "synthesis",
       .meaning = "How the painting's texture is laid over the land.",
       .keys = {
           {.name = "enabled", .field = AT(synthesis.enabled), .meaning = "false paints everything as strokes, without exemplars."},
           {.name = "colours",
            .field = AT(synthesis.colours),
            .meaning = "Whose colours the picture has: the scene's palette, or the paintings' own, by class and light, with their sky.",
            .text = TextKind::choice,
            .choices = {"palette", "painting"}},
           {.name = "harmonize",
            .field = AT(synthesis.harmonize),
            .meaning =
                "Colours of several paintings, class by class, before they are used: as they are, brought to a common mean and spread, "
                "or to those of the first painting.",
            .text = TextKind::choice,
            .choices = {"off", "common", "first"}},
           {.name = "residual",
            .field = AT(synthesis.residual),
            .range = {0, 1},
            .meaning = "How far the scene's own light and air correct the texture: 0 is the painting's colour as it is."},
           {.name = "weights",
            .field = AT(synthesis.weights),
            .range = {0, 100},
            .meaning = "How strongly each guide steers, by name; a guide not named keeps the strength given here, 0 switches it off.",
            .choices = guide_names()},
           {.name = "fallback",
            .field = AT(synthesis.fallback),
            .meaning = "Class to copy from for a class that no exemplar has: shrub = \"forest\"."},
           {.name = "reuse", .field = AT(synthesis.reuse), .range = {0, 10}, .meaning = "How hard repetition is avoided."},
           {.name = "copy_cap",
            .field = AT(synthesis.copy_cap),
            .range = {16, 100000},
            .unit = "px",
            .meaning = "Largest piece of the painting that may be copied whole, in pixels of area."},
           {.name = "levels",
            .field = AT(synthesis.levels),
            .range = {1, 8},
            .meaning = "Steps from coarse to fine; more carries larger patterns over."},
       }});
  sections.push_back(
      {.name = "output",
       .meaning = "The sheet.",
       .keys = {
           {.name = "width", .field = AT(output.width), .range = {16, 65535}, .unit = "px", .meaning = "Width of the picture."},
           {.name = "height", .field = AT(output.height), .range = {16, 65535}, .unit = "px", .meaning = "Height of the picture."},
           {.name = "sheet_width_mm",
            .field = AT(output.sheet_width_mm),
            .range = {10, 20000},
            .unit = "mm",
            .meaning = "Width in print; strokes and trees are sized for it, and the resolution in dpi follows."},
           {.name = "formats",
            .field = AT(output.formats),
            .meaning = "What the picture is written as, by the endings of its files; see below.",
            .choices = picture_endings()},
           {.name = "profile",
            .field = AT(output.profile),
            .meaning = "ICC file of the printer that the TIFF is converted to; without it sRGB.",
            .text = TextKind::file},
           {.name = "ocio_config",
            .field = AT(output.ocio_config),
            .meaning = "OpenColorIO config to use instead of the program's own.",
            .text = TextKind::file},
       }});
  return sections;
}
}  // namespace belvedere
