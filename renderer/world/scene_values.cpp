#include "renderer/world/scene_values.h"

#include <algorithm>
#include <filesystem>

#include "base/memory_limit.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

// A file with those that are read beside it, found without opening any but virtual rasters.
std::vector<std::string> parts_of(const std::string& path) {
  return path.ends_with(".vrt") ? raster_parts(path) : vector_parts(path);
}

}  // namespace

const ValueStore::Kept* ValueStore::find(const std::string& name, const std::string& key) const {
  const auto found = kept_.find(name);
  return found != kept_.end() && found->second.key == key ? &found->second : nullptr;
}

std::string ValueStore::key(const std::string& name) const {
  const auto found = kept_.find(name);
  return found == kept_.end() ? "" : found->second.key;
}

void ValueStore::forget(const std::string& name) {
  kept_.erase(name);
  const auto reads_it = [&](const auto& kept) {
    return std::any_of(kept.second.inputs.begin(), kept.second.inputs.end(),
                       [&](const ValueInput& input) { return input.name == name; });
  };
  for (auto next = std::find_if(kept_.begin(), kept_.end(), reads_it); next != kept_.end();
       next = std::find_if(kept_.begin(), kept_.end(), reads_it))
    forget(std::string(next->first));
}

std::string ValueStore::draw() const {
  const auto box = [](std::string name) {
    std::string id = name;
    std::replace(id.begin(), id.end(), ' ', '_');
    return id + '[' + name + ']';
  };
  std::string drawing = "flowchart LR\n";
  for (const auto& [name, kept] : kept_)
    for (const ValueInput& input : kept.inputs)
      drawing += "  " + box(input.name) + " --> " + box(name) + '\n';
  return drawing;
}

LoadedScene SceneValues::part_of(const Reads& reads) const {
  LoadedScene part = loaded_;
  part.scene = {};
  reads(part.scene, loaded_.scene);
  return part;
}

// Files may be replaced while a program runs.
std::string SceneValues::key_of(const LoadedScene& part, std::span<const ValueInput> inputs) {
  CacheKeyText key;
  key.add("settings", write_scene(part.scene))
      .add("preview_mcells", part.scene.terrain.preview_mcells)
      .add("memory", memory_budget_bytes());
  for (const ValueInput& input : inputs) key.add(input.name, input.key);
  for (const SceneInput& input : scene_inputs(part))
    for (const std::string& file : parts_of(input.path)) {
      std::error_code none;
      key.add("file", file)
          .add("bytes", static_cast<std::uint64_t>(std::filesystem::file_size(file, none)))
          .add("time",
               static_cast<std::int64_t>(
                   std::filesystem::last_write_time(file, none).time_since_epoch().count()));
    }
  return hash_bytes(key.str());
}

void reads_nothing(Scene& /*to*/, const Scene& /*from*/) {}

ValueInput content_of(const CameraParameters& camera) {
  const auto& [projection, width, height, eye, azimuth_deg, pitch_deg, field_of_view_deg, shift,
               view_width_m] = camera;
  CacheKeyText key;
  key.add("projection", projection).add("width", width).add("height", height).add("eye", eye);
  key.add("azimuth_deg", azimuth_deg)
      .add("pitch_deg", pitch_deg)
      .add("field_of_view_deg", field_of_view_deg)
      .add("shift", shift)
      .add("view_width_m", view_width_m);
  return {"camera", key.str()};
}

ValueInput content_of(const GeneralizeDistances& distances, glm::dvec2 viewer_xy) {
  CacheKeyText key;
  key.add("viewer", viewer_xy)
      .add("foreground_to_m", distances.foreground_to_m)
      .add("background_from_m", distances.background_from_m);
  return {"viewer", key.str()};
}

ValueInput content_of(const DeformParameters& deform, glm::dvec2 viewer_xy) {
  const auto& [exaggeration, bend, earth_curvature, refraction, background_exaggeration,
               foreground_to_m, background_from_m, base_m, summits, handles, exaggeration_points,
               field] = deform;
  const auto& [radius_m, crest_m, far_from_m, far_amount_per_m, points] = bend;
  CacheKeyText key;
  key.add("viewer", viewer_xy)
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
  return {"bend", key.str()};
}

}  // namespace belvedere
