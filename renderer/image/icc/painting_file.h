#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// A painting in sRGB: read_picture, upright as Exif asks, converted by lcms2 from the file's own
// profile where it has another one (Adobe RGB, Display P3, a scanner's, grey). Notes what was
// changed. A profile that moves no colour by half a step of 8 bits changes no bit. Error(input) as
// read_picture, and for a profile that is damaged or of other colours.
Grid<glm::vec3> read_painting(const std::string& path, Progress& progress,
                              Grid<float>* alpha = nullptr);

}  // namespace belvedere
