#include "renderer/scene/scene_rules.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"
#include "base/text/parse_number.h"
#include "renderer/scene/scene_table.h"
#include "renderer/trace/camera.h"
#include "terrain/cover/class_rules.h"
#include "terrain/generalize/generalize_presets.h"

namespace belvedere {
namespace {

class Rules {
 public:
  Rules(Scene& scene, const ConfigValue& root, const SceneOrigin& origin)
      : scene_(scene), root_(root), origin_(origin) {}

  // A style brings its palette, unless the scene says so.
  void style() {
    const bool in_style = !scene_.style.file.empty();
    if (in_style && written("palette") == nullptr) scene_.palette.clear();
    if (!in_style && scene_.palette.empty())
      refuse("palette", "palette is empty, and there is no style whose palette it could be",
             "a palette, or style = \"NAME\"");
  }

  void synthesis() {
    for (const auto& [pair, value] : scene_.synthesis.class_dissimilarity)
      if (!find_class_pair(pair))
        refuse(
            "synthesis.class_dissimilarity." + pair,
            fmt::format(
                "synthesis.class_dissimilarity names \"{}\", which is not a pair of classes", pair),
            "two classes separated by a slash, such as \"forest/shrub\" = 0.3");
    const double side = scene_.synthesis.neighbourhood.value_or(7.0);
    if (std::fmod(side, 2.0) != 1.0)
      refuse("synthesis.neighbourhood",
             fmt::format("synthesis.neighbourhood is {}, which is not an odd side length", side),
             "3, 5, 7, 9 or 11");
  }

  void terrain() {
    SceneTerrain& terrain = scene_.terrain;
    if (!terrain.sources.empty() && terrain.synthetic)
      refuse("terrain.synthetic", "terrain.sources and terrain.synthetic exclude each other",
             "rasters or synthetic terrain");
    if (terrain.sources.empty() && !terrain.synthetic) terrain.synthetic.emplace();
    if (terrain.synthetic && terrain.synthetic->lowest_m >= terrain.synthetic->highest_m)
      refuse("terrain.synthetic.highest_m",
             fmt::format("terrain.synthetic.highest_m ({} m) is not above lowest_m ({} m)",
                         terrain.synthetic->highest_m, terrain.synthetic->lowest_m),
             "a highest summit above the lowest valley");
    if (terrain.dem.extent) {
      const auto& [min_e, min_n, max_e, max_n] = *terrain.dem.extent;
      if (min_e >= max_e || min_n >= max_n)
        refuse("terrain.extent", "terrain.extent has no area",
               "[min E, min N, max E, max N], each min below its max");
    }
    if (terrain.dem.cell_m > 0.0 && terrain.dem.cell_m < 0.1)
      refuse("terrain.cell_m", fmt::format("terrain.cell_m is {}", terrain.dem.cell_m),
             "0 for the data's own, or 0.1 … 10000 m");
  }

  void land_cover() {
    if (!scene_.land_cover.sources.empty() && scene_.land_cover.legend.empty())
      refuse("land_cover.sources",
             "land_cover.sources needs land_cover.legend, which gives the class of each code",
             "legend = \"nlcd\", \"corine\", \"esa_worldcover\", \"fbfm40\" or a file");
    const SceneLandCover& cover = scene_.land_cover;
    if (cover.colours == "layers" && cover.layers.empty())
      refuse("land_cover.colours",
             "land_cover.colours asks for the layers' colours, but no layers are given",
             "land_cover.layers = \"NAME.layers.toml\" with it");
    const auto goes_with = [&](const std::string& colours, const std::string& key,
                               const std::string& file, const std::string& example) {
      if (cover.colours == colours && file.empty())
        refuse("land_cover.colours",
               fmt::format("land_cover.colours asks for {0} colours, but no {0} is given", colours),
               fmt::format("{} = \"{}\" with it", key, example));
      if (cover.colours != colours && !file.empty())
        refuse(key, key + " is set, but land_cover.colours does not use it",
               fmt::format("land_cover.colours = \"{}\" with it", colours));
    };
    goes_with("image", "land_cover.colour_image", cover.colour_image, "NAME.tif");
    goes_with("texture", "land_cover.texture", cover.texture, "NAME.composite");
    for (const auto& [name, value] : scene_.land_cover.settings)
      if (names_old_town(name))
        refuse("land_cover.settings." + name,
               fmt::format("towns are no longer settings of the rules: {}", name),
               "[[land_cover.towns]] with name, position = [E, N] and radius_m for each town");
    for (std::size_t i = 0; i < scene_.land_cover.towns.size(); ++i)
      require_position(fmt::format("land_cover.towns.{}", i), scene_.land_cover.towns[i].position,
                       scene_.land_cover.towns[i].position_lonlat);
  }

  // The words are checked when the style is read: its file may be missing.
  void features() {
    for (std::size_t i = 0; i < scene_.features.size(); ++i)
      if (scene_.features[i].kind.empty() && scene_.features[i].kind_of.empty())
        refuse(fmt::format("features.{}", i), "the features have no kind",
               "kind = \"road\" or another word of the style, or kind_of = a column of such words");
  }

  void climate() {
    const std::size_t months = scene_.climate.sunshine.size();
    if (months > 1 && months != 12)
      refuse("climate.sunshine", fmt::format("climate.sunshine has {} values", months),
             "one share, or twelve: January … December");
  }

  void generalize() {
    apply_preset();
    SceneGeneralize& settings = scene_.generalize;
    const std::vector<float>& foreground = settings.bands.foreground;
    const std::vector<float>& background = settings.bands.background;
    settings.bands.curvature =
        settings.curvature == "plan" ? CurvatureForm::plan : CurvatureForm::bounded;
    if (foreground.size() != background.size())
      refuse("generalize.background",
             fmt::format("generalize.background has {} weights, generalize.foreground has {}",
                         background.size(), foreground.size()),
             "as many weights in both");
    const auto fits = [&](const char* key, const std::vector<float>& weights) {
      if (!weights.empty() && weights.size() != foreground.size())
        refuse(key,
               fmt::format("{} has {} weights, generalize.foreground has {}", key, weights.size(),
                           foreground.size()),
               "as many weights in both");
    };
    fits("generalize.foreground_ridges", settings.bands.foreground_ridges);
    fits("generalize.foreground_valleys", settings.bands.foreground_valleys);
    fits("generalize.background_ridges", settings.bands.background_ridges);
    fits("generalize.background_valleys", settings.bands.background_valleys);
    if (settings.mask_slope_deg[1] > 0.0 &&
        settings.mask_slope_deg[0] >= settings.mask_slope_deg[1])
      refuse("generalize.mask_slope_deg",
             fmt::format("generalize.mask_slope_deg goes from {}° to {}°",
                         settings.mask_slope_deg[0], settings.mask_slope_deg[1]),
             "[flatter, steeper], or [0, 0] for no mask");
    if (settings.print_detail_px > 0.0 && settings.print_detail_px < 0.5)
      refuse("generalize.print_detail_px",
             fmt::format("generalize.print_detail_px is {}", settings.print_detail_px),
             "0 for off, or 0.5 … 20");
    if (settings.bands.full_curvature > 0.F && settings.bands.full_curvature < 0.001F)
      refuse("generalize.full_curvature",
             fmt::format("generalize.full_curvature is {}", settings.bands.full_curvature),
             "0 for the usual one, or 0.001 … 10");
    if (settings.foreground_to_m && settings.background_from_m &&
        *settings.foreground_to_m >= *settings.background_from_m)
      refuse(written("generalize.background_from_m") ? "generalize.background_from_m"
                                                     : "generalize.foreground_to_m",
             fmt::format("generalize.background_from_m ({} m) is not greater than "
                         "generalize.foreground_to_m ({} m)",
                         *settings.background_from_m, *settings.foreground_to_m),
             "a background that begins beyond the foreground");
  }

  void deform() {
    const DeformParameters& ground = scene_.deform.ground;
    const double bend_m = scene_.deform.bend_radius_m.value_or(0.0);
    if (bend_m > 0.0 && bend_m < 1000.0)
      refuse("deform.bend.radius_m", fmt::format("deform.bend.radius_m is {}", bend_m),
             "0 for no bend, or 1000 … 1e9 m");
    if (ground.foreground_to_m >= ground.background_from_m)
      refuse(
          written("deform.background_from_m") ? "deform.background_from_m"
                                              : "deform.foreground_to_m",
          fmt::format(
              "deform.background_from_m ({} m) is not greater than deform.foreground_to_m ({} m)",
              ground.background_from_m, ground.foreground_to_m),
          "a background that begins beyond the foreground");
    for (std::size_t i = 0; i < scene_.deform.handles.size(); ++i) {
      const SceneHandle& handle = scene_.deform.handles[i];
      const std::string name = fmt::format("deform.handles.{}", i);
      require_position(name, handle.position, handle.position_lonlat);
      const double radius_m = handle.handle.radius_m;
      if (radius_m > 0.0 && handle.core_m && *handle.core_m >= radius_m)
        refuse(name + ".core_m",
               fmt::format("{}.core_m ({} m) is not less than radius_m ({} m)", name,
                           *handle.core_m, radius_m),
               "a core smaller than the radius");
    }
    for (std::size_t i = 0; i < scene_.deform.summits.size(); ++i)
      require_position(fmt::format("deform.summits.{}", i), scene_.deform.summits[i].position,
                       scene_.deform.summits[i].position_lonlat);
    for (std::size_t i = 0; i < scene_.deform.field_places.size(); ++i)
      require_position(fmt::format("deform.field.places.{}", i),
                       scene_.deform.field_places[i].position,
                       scene_.deform.field_places[i].position_lonlat);
    if (!ground.exaggeration_points.empty() && ground.background_exaggeration)
      refuse("deform.background_exaggeration",
             "deform.background_exaggeration together with deform.exaggeration_points",
             "one of the two");
    try {
      in_section("deform", [&] {
        DeformParameters exaggerated;
        exaggerated.exaggeration_points = ground.exaggeration_points;
        return Deformation(exaggerated, {0.0, 0.0});
      });
      in_section("deform.bend", [&] { return BendProfile(scene_.deform.written().bend); });
    } catch (const Error& error) {  // pointing to the line where it is written
      refuse(error.where(), error.where() + ": " + error.found(), error.allowed());
    }
  }

  void mist() {
    for (std::size_t i = 0; i < scene_.air.mist.size(); ++i) {
      const SceneMist& mist = scene_.air.mist[i];
      const std::string name = fmt::format("air.mist.{}", i);
      if (mist.kind == "sea" && !mist.to_m)
        refuse(name, name + " is a sea without an altitude", "to_m = altitude of its surface in m");
      if (mist.kind == "lee" || mist.look.radius_m > 0.0)
        require_position(name, mist.position, mist.position_lonlat);
    }
  }

  void light() {
    for (std::size_t i = 0; i < scene_.light_regions.size(); ++i) {
      const SceneLightRegion& region = scene_.light_regions[i];
      const std::string name = fmt::format("light.regions.{}", i);
      const bool circle = region.position || region.position_lonlat;
      if (!circle && region.points.empty() && region.points_lonlat.empty() && region.file.empty())
        refuse(name, name + " has no position",
               "position = [E, N] or position_lonlat with a radius_m, points, points_lonlat, or a "
               "file");
      if (circle && !region.radius_m)
        refuse(name, name + " is a circle without a radius", "radius_m = 5000");
    }
    for (std::size_t i = 0; i < scene_.light_clouds.size(); ++i)
      require_position(fmt::format("light.clouds.{}", i), scene_.light_clouds[i].position,
                       scene_.light_clouds[i].position_lonlat);
  }

  void sampling() {
    const int samples = scene_.sampling.pixel_samples;
    const int side = static_cast<int>(std::lround(std::sqrt(samples)));
    if (side * side != samples)
      refuse("sampling.pixel_samples",
             fmt::format("sampling.pixel_samples is {}, which is not a square number", samples),
             "1, 4, 9 or 16");
  }

  void camera() {
    const SceneCamera& camera = scene_.camera;
    if (camera.look_at_altitude_m && !camera.look_at && !camera.look_at_lonlat)
      refuse("camera.look_at_altitude_m", "camera.look_at_altitude_m is set without a point",
             "camera.look_at or camera.look_at_lonlat with it");
    const Projection* projection = find_projection(camera.projection);
    if (projection == nullptr || projection->widest_deg == 0.0 ||
        camera.field_of_view_deg <= projection->widest_deg)
      return;
    std::string allowed = fmt::format("1 … {}°", projection->widest_deg);
    for (const Projection& wider : projections())
      if (camera.field_of_view_deg <= wider.widest_deg)
        allowed += fmt::format(", or projection = \"{}\"", wider.name);
    refuse("camera.field_of_view_deg",
           fmt::format("camera.field_of_view_deg is {} with a {} projection",
                       camera.field_of_view_deg, camera.projection),
           allowed);
  }

  void erosion() {
    for (const auto& [name, steps] : scene_.land_cover.erode)
      if (steps != std::floor(steps))
        refuse("land_cover.erode." + name, fmt::format("land_cover.erode has {} = {}", name, steps),
               "whole steps of 50 m");
  }

  void labels() {
    const SceneLabels& labels = scene_.labels;
    const bool none = labels.summits == 0 && labels.points.empty() && labels.shapes.empty() &&
                      labels.tracks.empty();
    if (labels.in_picture && none)
      refuse("labels.in_picture", "labels.in_picture is set, but there are no labels",
             "[[labels.points]] with a file, or labels.summits = 30");
  }

  void exemplars() {
    for (std::size_t i = 0; i < scene_.exemplars.size(); ++i) {
      const SceneExemplar& exemplar = scene_.exemplars[i];
      const std::string name = fmt::format("exemplar.{}", i);
      if (!exemplar.model.empty()) {
        for (const char* key :
             {"picture", "guidance", "classes", "classes_from", "altitude", "altitude_range_m",
              "distance", "distance_range_m", "trust", "shadow", "found_shadow", "exclude",
              "excluded", "width", "height", "seed"})
          if (written(name + "." + key))
            refuse(name + "." + key, fmt::format("{}.{} is set together with a model", name, key),
                   "a picture or a model in each block");
        // A composite's labels give the classes it paints.
        if (exemplar.serves.empty() && !exemplar.model.ends_with(".composite"))
          refuse(name + ".model", name + ".model does not state its classes",
                 "serves = [\"pasture\"]: the classes it shows");
        check_light(exemplar, name);
        continue;
      }
      for (const char* key : {"prefer", "light"})
        if (written(name + "." + key))
          refuse(name + "." + key, fmt::format("{}.{} is set without a model", name, key),
                 "model = \"….model\" with it");
      if (!exemplar.picture.empty() && exemplar.guidance.empty() && exemplar.classes.empty())
        refuse(
            name + ".picture",
            name + ".picture has neither guidance nor classes, which give the class of each pixel",
            "guidance = \"….exr\", or classes = \"….png\"");
      if (exemplar.picture.empty())
        for (const char* key :
             {"guidance", "classes", "classes_from", "altitude", "altitude_range_m", "distance",
              "distance_range_m", "trust", "shadow", "found_shadow", "exclude", "excluded",
              "serves", "stroke_px", "optional"})
          if (written(name + "." + key))
            refuse(name + "." + key, fmt::format("{}.{} is set without a picture", name, key),
                   "a picture with it");
      if (written(name + ".excluded") && exemplar.exclude.empty())
        refuse(name + ".excluded",
               fmt::format("{}.excluded is \"fill\", but no area is excluded", name),
               "exclude = \"….png\" with it");
      for (const auto& [key, file, range] :
           {std::tuple{"altitude", &exemplar.altitude, &exemplar.altitude_range_m},
            {"distance", &exemplar.distance, &exemplar.distance_range_m}}) {
        if (!file->empty() && exemplar.classes.empty())
          refuse(fmt::format("{}.{}", name, key),
                 fmt::format("{}.{} needs classes beside it", name, key), "classes = \"….png\"");
        if ((*range)[0] >= (*range)[1])
          refuse(
              fmt::format("{}.{}_range_m", name, key),
              fmt::format("{}.{}_range_m goes from {} to {}", name, key, (*range)[0], (*range)[1]),
              "[lower, upper]");
      }
    }
  }

 private:
  // A class that one model paints in light only needs another model for shade.
  void check_light(const SceneExemplar& exemplar, const std::string& name) const {
    if (exemplar.light == "any") return;
    if (exemplar.model.ends_with(".composite"))
      refuse(name + ".light",
             fmt::format("{}.light is \"{}\" for a composite, whose labels are classes", name,
                         exemplar.light),
             "models of single textures, lit and shaded");
    for (const LandCoverClass id : exemplar.serves) {
      const bool whole = std::any_of(
          scene_.exemplars.begin(), scene_.exemplars.end(), [&](const SceneExemplar& other) {
            return !other.model.empty() && other.light != exemplar.light &&
                   std::find(other.serves.begin(), other.serves.end(), id) != other.serves.end();
          });
      if (!whole)
        refuse(name + ".light",
               fmt::format("{}.light is \"{}\", but no other block paints the rest of {}", name,
                           exemplar.light, class_name(id)),
               "another block with a model that serves it");
    }
  }

  // Keys that the file lacks come from the preset it names.
  void apply_preset() {
    SceneGeneralize& settings = scene_.generalize;
    const GeneralizePreset* preset = find_generalize_preset(settings.preset);
    const auto set = [&](const char* key, const std::vector<float>& weights) {
      return written(key) == nullptr ? std::vector<float>() : weights;
    };
    const WrittenWeights weights{
        .foreground = set("generalize.foreground", settings.bands.foreground),
        .foreground_ridges = set("generalize.foreground_ridges", settings.bands.foreground_ridges),
        .foreground_valleys =
            set("generalize.foreground_valleys", settings.bands.foreground_valleys),
        .background = set("generalize.background", settings.bands.background),
        .background_ridges = set("generalize.background_ridges", settings.bands.background_ridges),
        .background_valleys =
            set("generalize.background_valleys", settings.bands.background_valleys)};
    choose_weights(settings.bands, weights, preset);
    if (preset == nullptr) return;
    if (written("generalize.automatic_mask") == nullptr)
      settings.automatic_mask = preset->automatic_mask;
    if (preset->slope_mask && written("generalize.mask_slope_deg") == nullptr)
      settings.mask_slope_deg = {preset->slope_mask->original_to_deg,
                                 preset->slope_mask->generalized_from_deg};
  }

  // The value at a dotted path, where numbers are list indices; null where it is not set.
  const ConfigValue* written(std::string_view path) const {
    const ConfigValue* node = &root_;
    while (node != nullptr && !path.empty()) {
      const std::size_t dot = path.find('.');
      const std::string_view part = path.substr(0, dot);
      path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
      if (const auto* table = std::get_if<ConfigTable>(&node->value)) {
        node = find(*table, part);
      } else if (const auto* array = std::get_if<ConfigArray>(&node->value)) {
        const std::size_t index = parse_number<std::size_t>(part).value_or(array->size());
        node = index < array->size() ? &(*array)[index] : nullptr;
      } else {
        node = nullptr;
      }
    }
    return node;
  }

  void require_position(const std::string& name, const std::optional<glm::dvec2>& position,
                        const std::optional<glm::dvec2>& lonlat) const {
    if (!position && !lonlat)
      refuse(name, name + " has no position", "position = [E, N], or position_lonlat");
  }

  [[noreturn]] void refuse(const std::string& path, const std::string& found,
                           const std::string& allowed) const {
    const ConfigValue* value = written(path);
    throw Error(ErrorKind::usage,
                origin_.where(value == nullptr ? root_.position : value->position), found, allowed);
  }

  Scene& scene_;
  const ConfigValue& root_;
  const SceneOrigin& origin_;
};

}  // namespace

std::optional<std::pair<LandCoverClass, LandCoverClass>> find_class_pair(std::string_view names) {
  const std::size_t stroke = names.find('/');
  if (stroke == std::string_view::npos) return std::nullopt;
  const std::optional<LandCoverClass> a = find_class(names.substr(0, stroke));
  const std::optional<LandCoverClass> b = find_class(names.substr(stroke + 1));
  if (!a || !b || *a == *b) return std::nullopt;
  return std::pair{*a, *b};
}

void apply_scene_rules(Scene& scene, const ConfigValue& root, const SceneOrigin& origin) {
  Rules rules(scene, root, origin);
  rules.terrain();
  rules.land_cover();
  rules.climate();
  rules.generalize();
  rules.deform();
  rules.mist();
  rules.light();
  rules.sampling();
  rules.camera();
  rules.exemplars();
  rules.erosion();
  rules.labels();
  rules.style();
  rules.synthesis();
  rules.features();
}

}  // namespace belvedere
