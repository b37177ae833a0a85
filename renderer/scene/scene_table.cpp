#include "renderer/scene/scene_table.h"

#include <array>
#include <iterator>

namespace belvedere {
namespace {

std::vector<SceneSection> make_top_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "",
       .meaning = "Top-level keys, before the first table.",
       .keys = {
           {.name = "version",
            .field = AT(version),
            .range = {1, 1},
            .meaning = "Version of the scene format.",
            .required = true},
           {.name = "title",
            .field = AT(title),
            .meaning = "Title of the panorama; written to the files' headers."},
           {.name = "seed",
            .field = AT(seed),
            .range = {0, largest_seed},
            .meaning =
                "Random seed of strokes, clouds and noise; the terrain does not depend on it."},
           {.name = "palette",
            .field = AT(palette),
            .meaning =
                "Colours of every class by light and altitude: a built-in name or a .toml file.",
            .text = TextKind::built_in,
            .choices_from = "palettes"},
           {.name = "features_style",
            .field = AT(features_style),
            .meaning = "How the features of [[features]] are painted: a built-in name or a .toml "
                       "file; see features.md.",
            .text = TextKind::built_in,
            .choices_from = "features"},
       }});
  return sections;
}

// In the order of the reference.
constexpr std::array makers = {
    make_top_sections,       make_terrain_sections,    make_land_cover_sections,
    make_climate_sections,   make_generalize_sections, make_deform_sections,
    make_camera_sections,    make_sampling_sections,   make_light_sections,
    make_air_sections,       make_style_sections,      make_exemplar_sections,
    make_synthesis_sections, make_features_sections,   make_labels_sections,
    make_output_sections};

}  // namespace

std::vector<SceneSection> make_scene_sections() {
  std::vector<SceneSection> sections;
  for (const auto& make : makers) {
    std::vector<SceneSection> part = make();
    std::move(part.begin(), part.end(), std::back_inserter(sections));
  }
  return sections;
}

}  // namespace belvedere
