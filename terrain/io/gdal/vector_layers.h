#pragma once

#include <ogr_api.h>

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/io/features.h"
#include "terrain/io/gdal/gdal_files.h"

namespace belvedere {

// Shared by readers of vector files.

using VectorFeature = std::unique_ptr<void, void (*)(OGRFeatureH)>;

// Opens a file with the driver of its extension, because a harmless-looking file must not make
// GDAL open others. A GeoJSON file may also have one object a line (RFC 8142). `endings`: the
// extensions that the caller reads, as ".gpkg"; ".geojson" stands for .json, .geojsonl, .geojsons
// and .ndjson too. Throws Error(usage) with `found` and `allowed` for another one; Error(input) if
// the file is missing or of another format.
Dataset open_vector_layers(const VectorSource& source,
                           const std::vector<std::string_view>& extensions,
                           const std::string& found, const std::string& allowed);

// For messages: where a layer has no CRS.
constexpr const char* missing_crs_advice =
    "its key `crs` in the scene, such as crs = \"EPSG:32632\", or its .prj file beside a .shp";

// A field as text; empty if it is not set. Error(input) for texts that are not UTF-8: GDAL converts
// those of shapefiles whose encoding is named.
std::string field_text(OGRFeatureH feature, int column, const std::string& path,
                       const std::string& where);

// Error(input) at `where` if more than half of the positions of a layer in degrees are too large
// for degrees: metres in a GeoJSON, which is in degrees unless it says otherwise. own_crs: the
// layer's; crs: of the terrain, for the advice.
void require_degrees(const std::vector<glm::dvec2>& positions, const std::string& own_crs,
                     const std::string& crs, const VectorSource& source, const std::string& where);

// The source's, else the layer's, as WKT; empty if it has none.
std::string layer_crs(OGRLayerH layer, const VectorSource& source);

}  // namespace belvedere
