#pragma once

#include <string>

#include "renderer/labels/labels.h"

namespace belvedere {

// The placed labels, and the tracks below them, as SVG 1.1, over the picture pixel by pixel: text as text, one group a kind, so that all
// can be changed in Inkscape or Illustrator. The sheet's size stands in millimetres. `under`: a picture's path to show beneath, as the SVG
// shall name it; empty: none.
std::string labels_svg(const LabelSheet& sheet, const std::string& under = {});

// Every point, placed or not: a table for spreadsheets, places in the scene's CRS.
std::string labels_csv(const LabelSheet& sheet);

// The same of points of which no names are set: what stands for "placed" or "no room" there is "seen" here, and the ground that hides a
// point follows in two more columns.
std::string places_csv(const LabelSheet& sheet);

// labels_csv as GeoJSON (RFC 7946), places in longitude and latitude. `crs`: the scene's; Error(usage) where it is empty.
std::string labels_geojson(const LabelSheet& sheet, const std::string& crs);

}  // namespace belvedere
