#pragma once

#include <ogr_api.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/vector_source.h"

namespace belvedere {

// Shared by readers of vector files.

using VectorFeature = std::unique_ptr<void, void (*)(OGRFeatureH)>;

// Opens a file with the one driver of its extension, because a harmless-looking file must not make
// GDAL open others. `endings`: the extensions that the caller reads, as ".gpkg". Throws
// Error(usage) with `found` and `allowed` for another one; Error(input) if the file is missing or
// of another format.
Dataset open_vector_layers(const VectorSource& source,
                           const std::vector<std::string_view>& extensions,
                           const std::string& found, const std::string& allowed);

// For messages: where a layer has no CRS.
constexpr const char* missing_crs_advice =
    "its key `crs` in the scene, such as crs = \"EPSG:32632\", or its .prj file beside a .shp";

// A field as text; empty if it is not set. Error(input) for texts of a shapefile that are not
// UTF-8: GDAL converts those whose encoding the file names.
std::string field_text(OGRFeatureH feature, int column, const std::string& path,
                       const std::string& where);

// The source's, else the layer's, as WKT; empty if it has none.
std::string layer_crs(OGRLayerH layer, const VectorSource& source);

}  // namespace belvedere
