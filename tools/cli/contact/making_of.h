#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/run.h"
#include "renderer/scene/scene_file.h"

namespace belvedere::tools {

// A stage of a scene's picture, the whole sheet seen from the same viewpoint.
struct MakingStep {
  std::string file;         // file name without extension
  std::string caption;      // for people
  Grid<glm::vec3> picture;  // encoded sRGB
};
// The ground as measured, generalized, and raised and bent, as relief; land cover; light; base
// colours; the ground copied from paintings (only where the scene copies); and the picture, the
// same as rendering makes. Takes memory for the whole sheet.
std::vector<MakingStep> make_making_of(const LoadedScene& loaded, const Run& run);

// The generalized ground from the scene's viewpoint, as relief: undeformed; bent and exaggerated by
// distance; and with summits, handles and field too, if the scene has any.
std::vector<MakingStep> make_deformation_steps(const LoadedScene& loaded, const Run& run);

// The steps in their order with their captions, so many side by side (≥ 1), none with a side longer
// than `step_px`.
Grid<glm::vec3> draw_making_of(const std::vector<MakingStep>& steps, int step_px,
                               std::size_t columns = 2);

// Land cover in the colours of the class table; pixels without a class, such as sky, are pale grey.
glm::vec3 class_colour(std::uint8_t label);
inline const glm::vec3 no_class_colour(0.93F);

}  // namespace belvedere::tools
