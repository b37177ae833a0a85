#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// A painting in sRGB: read_picture, turned upright by its Exif orientation and converted with lcms2
// from its embedded profile (Adobe RGB, Display P3, a scanner's, grey). Notes what was changed. A
// profile that equals sRGB within half an 8-bit step changes nothing. Error(input) as read_picture,
// and for a profile that is damaged or neither RGB nor grey.
Grid<glm::vec3> read_painting(const std::string& path, Progress& progress,
                              Grid<float>* alpha = nullptr);

}  // namespace belvedere
