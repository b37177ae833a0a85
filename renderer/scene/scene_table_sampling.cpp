#include "base/instruction_set.h"
#include "renderer/scene/scene_table.h"

namespace belvedere {
namespace {

std::vector<std::string> instruction_set_choices() {
  std::vector<std::string> names = {"any"};
  names.insert(names.end(), instruction_sets().begin(), instruction_sets().end());
  return names;
}

}  // namespace

std::vector<SceneSection> make_sampling_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "sampling",
       .meaning = "Samples per pixel: quality against time.",
       .keys = {
           {.name = "pixel_samples",
            .field = AT(sampling.pixel_samples),
            .range = {1, 16},
            .meaning = "Camera rays per pixel: 1, 4, 9 or 16."},
           {.name = "shadow_rays",
            .field = AT(sampling.shadow_rays),
            .range = {1, 64},
            .meaning = "Rays to the sun's disc per pixel, for cast shadows."},
           {.name = "sky_directions",
            .field = AT(sampling.sky_directions),
            .range = {0, 256},
            .meaning =
                "Directions in which the open sky is searched, for shade in valleys; 0: off."},
           {.name = "sky_reach_m",
            .field = AT(sampling.sky_reach_m),
            .range = {1, 1e6},
            .unit = "m",
            .meaning = "Distance up to which terrain hides the sky."},
           {.name = "instruction_set",
            .field = AT(tracing.instruction_set),
            .meaning = "Vector instructions for ray tracing: auto takes the best that the machine "
                       "has; a named set makes several machines give the same picture to the last "
                       "bit. A machine that lacks it refuses.",
            .text = TextKind::choice,
            .choices = instruction_set_choices()},
       }});
  return sections;
}

}  // namespace belvedere
