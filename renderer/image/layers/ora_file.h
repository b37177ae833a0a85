#pragma once

#include <string>

#include "renderer/image/layers/layered_sheet.h"

namespace belvedere {

// OpenRaster 0.0.5 (https://www.openraster.org): a ZIP archive of PNG with 16 bits per channel,
// stack.xml and a preview. Archives over 4 GB are ZIP64.
void write_ora(const std::string& path, const LayeredSheet& sheet, Progress& progress);

}  // namespace belvedere
