#pragma once

#include <vector>

#include "renderer/scene/scene_schema.h"

namespace belvedere {

// Part of the table of what a scene file may say: what its files share.

constexpr double largest_m = 1e8;  // farther than around the Earth

// A row's accessor: AT(camera.pitch_deg) is where the value lies in a Scene `s`; `i` counts list elements.
#define AT(place) [](Scene& s, [[maybe_unused]] std::size_t i) -> SceneField { return &s.place; }

// [generalize].
SceneSection make_generalize_section();
// [deform] and what belongs to it.
std::vector<SceneSection> make_deform_sections();

}  // namespace belvedere
