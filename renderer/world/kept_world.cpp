#include "renderer/world/kept_world.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string_view>

#include "base/cache/cache_key.h"
#include "base/memory_limit.h"
#include "renderer/world/style/scene_style.h"
#include "terrain/io/input_parts.h"

namespace belvedere {
namespace {

// All keys of some sections, as written by a scene with nothing else in it, so that none can be
// forgotten.
template <class Take>
std::string written(const Take& take) {
  Scene settings;
  take(settings);
  return write_scene(settings);
}

// A file with those that are read beside it, found without opening any but virtual rasters.
std::vector<std::string> parts_of(const std::string& path) {
  return path.ends_with(".vrt") ? raster_parts(path) : vector_parts(path);
}

// Those that a test of their keys chooses. Files may be replaced while a program runs.
template <class Takes>
void add_files(CacheKeyText& key, const LoadedScene& loaded, const Takes& takes) {
  for (const SceneInput& input : scene_inputs(loaded)) {
    if (!takes(std::string_view(input.key))) continue;
    for (const std::string& part : parts_of(input.path)) {
      std::error_code none;
      key.add("file", part)
          .add("bytes", static_cast<std::uint64_t>(std::filesystem::file_size(part, none)))
          .add("time",
               static_cast<std::int64_t>(
                   std::filesystem::last_write_time(part, none).time_since_epoch().count()));
    }
  }
}

// A section of a scene, which its files' keys begin with.
bool is_of(std::string_view key, std::initializer_list<std::string_view> sections) {
  return std::any_of(sections.begin(), sections.end(),
                     [&](std::string_view section) { return key.starts_with(section); });
}

}  // namespace

std::string dem_key(const LoadedScene& loaded) {
  CacheKeyText key;
  key.add("settings", written([&](Scene& scene) {
            scene.terrain = loaded.scene.terrain;
            scene.land_cover.sea = loaded.scene.land_cover.sea;
            scene.land_cover.sea_level_m = loaded.scene.land_cover.sea_level_m;
            scene.generalize.destripe = loaded.scene.generalize.destripe;
            scene.features_style = loaded.scene.features_style;
            scene.features = loaded.scene.features;
          }));
  key.add("preview_mcells", loaded.scene.terrain.preview_mcells)
      .add("memory", memory_budget_bytes());
  add_files(key, loaded, [](std::string_view of) { return is_of(of, {"terrain", "features"}); });
  return key.str();
}

std::string cover_key(const LoadedScene& loaded) {
  CacheKeyText key;
  key.add("settings", written([&](Scene& scene) {
            scene.seed = loaded.scene.seed;
            scene.land_cover = loaded.scene.land_cover;
            scene.season = loaded.scene.season;
            scene.climate = loaded.scene.climate;
            scene.features_style = loaded.scene.features_style;
            scene.features = loaded.scene.features;
          }));
  // Winter palettes lay snow.
  key.add("winter", named_palette(loaded).winter ? 1 : 0);
  add_files(key, loaded, [](std::string_view of) {
    return !is_of(of, {"terrain", "features", "generalize", "palette", "style", "exemplar",
                       "labels", "output", "margin"});
  });
  return key.str();
}

std::string files_key(const LoadedScene& loaded) {
  CacheKeyText key;
  add_files(key, loaded, [](std::string_view) { return true; });
  return key.str();
}

std::string camera_key(const LoadedScene& loaded, const View& view) {
  const auto& [projection, width, height, eye, azimuth_deg, pitch_deg, field_of_view_deg, shift,
               view_width_m] = view.camera;
  CacheKeyText key;
  key.add("projection", projection).add("width", width).add("height", height).add("eye", eye);
  key.add("azimuth_deg", azimuth_deg)
      .add("pitch_deg", pitch_deg)
      .add("field_of_view_deg", field_of_view_deg)
      .add("shift", shift)
      .add("view_width_m", view_width_m)
      .add("sheet_width_mm", loaded.scene.output.sheet_width_mm);
  return key.str();
}

std::string generalize_key(const LoadedScene& loaded, const View& view) {
  CacheKeyText key;
  key.add("settings", written([&](Scene& scene) { scene.generalize = loaded.scene.generalize; }))
      .add("viewer", view.viewer_xy)
      .add("foreground_to_m", view.generalize.foreground_to_m)
      .add("background_from_m", view.generalize.background_from_m);
  add_files(key, loaded, [](std::string_view of) { return is_of(of, {"generalize"}); });
  if (loaded.scene.generalize.print_detail_px > 0.0)
    key.add("camera", camera_key(loaded, view)).add("bend", deform_key(view));
  return key.str();
}

std::string masks_key(const LoadedScene& loaded) {
  const SceneGeneralize& settings = loaded.scene.generalize;
  CacheKeyText key;
  key.add("settings", written([&](Scene& scene) {
            scene.generalize.mask = settings.mask;
            scene.generalize.mask_slope_deg = settings.mask_slope_deg;
            scene.generalize.automatic_mask = settings.automatic_mask;
            scene.generalize.keep_lakes = settings.keep_lakes;
            scene.generalize.line_integral = settings.line_integral;
          }))
      .add("bands", static_cast<std::uint64_t>(settings.bands.foreground.size()));
  add_files(key, loaded, [](std::string_view of) { return is_of(of, {"generalize"}); });
  return key.str();
}

std::string deform_key(const View& view) {
  const auto& [exaggeration, bend, earth_curvature, refraction, background_exaggeration,
               foreground_to_m, background_from_m, base_m, summits, handles, exaggeration_points,
               field] = view.deform;
  const auto& [radius_m, crest_m, far_from_m, far_amount_per_m, points] = bend;
  CacheKeyText key;
  key.add("viewer", view.viewer_xy)
      .add("exaggeration", exaggeration)
      .add("earth_curvature", earth_curvature)
      .add("refraction", refraction)
      .add("background", background_exaggeration)
      .add("foreground_to_m", foreground_to_m)
      .add("background_from_m", background_from_m)
      .add("base_m", base_m);
  key.add("radius_m", radius_m)
      .add("crest_m", crest_m)
      .add("far_from_m", far_from_m)
      .add("far_amount_per_m", far_amount_per_m);
  for (const auto& [distance_m, drop_m, inclination_deg] : points)
    key.add("point", distance_m).add("drop_m", drop_m).add("inclination_deg", inclination_deg);
  for (const auto& [centre, radius, factor, base] : summits)
    key.add("summit", centre).add("radius_m", radius).add("factor", factor).add("base_m", base);
  for (const auto& [centre, move_m, rotate_deg, scale, raise_m, radius, core_m, pin] : handles)
    key.add("handle", centre)
        .add("move_m", move_m)
        .add("rotate_deg", rotate_deg)
        .add("scale", scale)
        .add("raise_m", raise_m)
        .add("radius_m", radius)
        .add("core_m", core_m)
        .add("pin", pin);
  for (const auto& [distance_m, factor] : exaggeration_points)
    key.add("exaggeration_m", distance_m).add("factor", factor);
  const auto& [length_m, reach_m, still_m, max_m, places] = field;
  if (!places.empty())
    key.add("field", length_m).add("reach_m", reach_m).add("still_m", still_m).add("max_m", max_m);
  for (const auto& [position, moved, noise] : places)
    key.add("place", position)
        .add("lateral_m", moved.lateral_m)
        .add("upward_m", moved.upward_m)
        .add("lateral_noise_m", noise.lateral_m)
        .add("upward_noise_m", noise.upward_m);
  return key.str();
}

}  // namespace belvedere
