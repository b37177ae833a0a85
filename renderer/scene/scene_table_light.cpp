#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_light_sections() {
  std::vector<SceneSection> sections;
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
           {.name = "model",
            .field = AT(light.model),
            .meaning = "How light becomes colour: ramp takes shade and light from the palette as painters mix them; product multiplies the "
                       "ground's own colour by the light, as most relief shading does, and is there for comparison.",
            .text = TextKind::choice,
            .choices = {"ramp", "product"}},
       }});
  return sections;
}

}  // namespace belvedere
