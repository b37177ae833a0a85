#pragma once

#include <ogr_api.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/io/gdal/gdal_files.h"

namespace belvedere {

// What readers of vector files share.

using VectorFeature = std::unique_ptr<void, void (*)(OGRFeatureH)>;

// Opens a file with the one driver that its ending names, because a file that looks harmless must not send GDAL to others. `endings`: those
// that the caller reads, as ".gpkg". Throws Error(usage) with `found` and `allowed` for another one; Error(input) where the file is missing
// or no such file.
Dataset open_vector_layers(const std::string& path, const std::vector<std::string_view>& endings, const std::string& found,
                           const std::string& allowed);

// WKT; empty where the layer has none.
std::string layer_crs(OGRLayerH layer, const std::string& path);

}  // namespace belvedere
