#pragma once

#include <string>
#include <vector>

namespace belvedere {

// All files that a raster is read from, itself first: what lies beside it (.prj, .tfw, .hdr, .aux.xml …), and for a VRT the files it names
// with what lies beside them. Each once, in the order of the alphabet. An address has only itself. Opens them as raster_io.h does.
std::vector<std::string> raster_parts(const std::string& path);

}  // namespace belvedere
