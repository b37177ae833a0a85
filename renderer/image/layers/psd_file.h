#pragma once

#include <string>

#include "renderer/image/layers/layered_sheet.h"

namespace belvedere {

// Photoshop's format with 16 bits per channel (Adobe Photoshop File Formats Specification): rows
// packed by PackBits, an sRGB profile. From 30000 pixels per side on, or where it might grow over 2
// GB, it is PSB, its large form, in a file of the same name.
void write_psd(const std::string& path, const LayeredSheet& sheet, Progress& progress);

}  // namespace belvedere
