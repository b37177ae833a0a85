#pragma once

#include <string>
#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/labels.h"

namespace belvedere {

// The placed labels, and the tracks below them, as SVG 1.1, over the picture pixel by pixel: text
// as text, one group per kind, so that all can be edited in Inkscape or Illustrator. The sheet's
// size is in millimetres. `under`: path of a picture to show below, as written to the SVG; empty:
// none.
std::string labels_svg(const LabelSheet& sheet, const std::string& under = {});

// Every point, placed or not: a table for spreadsheets, positions in the scene's CRS.
std::string labels_csv(const LabelSheet& sheet);

// The same for points without labels: "seen" replaces "placed" and "no room", and two more columns
// give the ground that hides a point.
std::string places_csv(const LabelSheet& sheet);

// labels_csv as GeoJSON (RFC 7946), positions in longitude and latitude. `crs`: the scene's;
// Error(usage) where it is empty.
std::string labels_geojson(const LabelSheet& sheet, const std::string& crs);

struct DrawnGroup {
  std::string name;  // "tracks", or the kind of names
  std::vector<DrawnShape> shapes;
};

// Tracks (hidden pieces dashed, then edges, then visible pieces) and placed names with marks and
// leaders, a group for each kind, in drawing order. Leaders of all kinds come before the first
// name, so that none crosses the letters of another.
std::vector<DrawnGroup> draw_labels(const LabelSheet& sheet);

// What became of a name: "placed", "no room", "enough names around", or why it is not visible.
std::string outcome_of(const Label& label);

// The tracks, and one placed name with its mark and leader, of the same drawing.
std::vector<DrawnGroup> draw_tracks(const LabelSheet& sheet);
std::vector<DrawnShape> draw_label(const LabelSheet& sheet, const Label& label);

// All groups as one drawing of the picture's size.
Drawing label_drawing(const LabelSheet& sheet);

}  // namespace belvedere
