#pragma once

#include <string>
#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/labels.h"

namespace belvedere {

struct DrawnGroup {
  std::string name;  // "tracks", or the kind of names
  std::vector<DrawnShape> shapes;
};

// Tracks (hidden pieces dashed, then edges, then visible pieces) and placed names with marks and
// leaders, a group for each kind, in drawing order. Leaders of all kinds come before the first
// name, so that none crosses the letters of another.
std::vector<DrawnGroup> draw_labels(const LabelSheet& sheet);

// All groups as one drawing of the picture's size.
Drawing label_drawing(const LabelSheet& sheet);

}  // namespace belvedere
