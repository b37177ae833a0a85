#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "renderer/scene/scene_schema.h"

namespace belvedere {

// Part of the table of scene keys: what its files share.

constexpr double largest_m = 1e8;  // more than the Earth's circumference
constexpr double largest_seed =
    9007199254740991.0;  // 2⁵³ - 1: what JSON and every editor hold exactly

// A row's accessor: AT(camera.pitch_deg) is the address of the value in a Scene `s`; `i` counts
// list elements.
#define AT(position) \
  [](Scene& s, [[maybe_unused]] std::size_t i) -> SceneField { return &s.position; }

// The rows of each part of a scene, in a file named after the part.
std::vector<SceneSection> make_terrain_sections();
std::vector<SceneSection> make_land_cover_sections();
std::vector<SceneSection> make_climate_sections();
std::vector<SceneSection> make_generalize_sections();
std::vector<SceneSection> make_deform_sections();
std::vector<SceneSection> make_camera_sections();  // and the sun
std::vector<SceneSection> make_sampling_sections();
std::vector<SceneSection> make_light_sections();
std::vector<SceneSection> make_air_sections();
std::vector<SceneSection> make_exemplar_sections();
std::vector<SceneSection> make_style_sections();
std::vector<SceneSection> make_synthesis_sections();
std::vector<SceneSection> make_features_sections();
std::vector<SceneSection> make_labels_sections();  // and the margin
std::vector<SceneSection> make_output_sections();

// Keys of a raster file: of heights, or of land cover. Only heights have a unit and bounds.
std::vector<SceneKey> make_source_keys(bool heights);
// Keys of a vector file besides its path.
SceneKey make_vector_crs_key(SceneField (*field)(Scene&, std::size_t),
                             std::string_view name = "crs");
SceneKey make_encoding_key(SceneField (*field)(Scene&, std::size_t),
                           std::string_view name = "encoding");

// The result of `make`. A stage's errors name its own fields; here the scene's section is put
// before them: "handles.1" of the deformation becomes "deform.handles.1".
template <class Make>
auto in_section(const std::string& section, Make&& make) {
  try {
    return std::forward<Make>(make)();
  } catch (const Error& error) {
    throw Error(error.kind(), section + "." + error.where(), error.found(), error.allowed());
  }
}

}  // namespace belvedere
