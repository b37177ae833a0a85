#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere::tools {

// A picture of labels: for each pixel the index of its label in `names`, or no_label
// (texture/statistical/label_borders.h). A name is a flat colour, "#0000ff", or a number, "3", as
// in the picture.
struct LabelPicture {
  Grid<std::uint8_t> labels;
  std::vector<std::string> names;
};

// Drawn in flat colours or as numbers (renderer/image/label_image.h). Names that occur, in
// ascending order.
LabelPicture read_label_picture(const std::string& path, Progress& progress = silent_progress());

// The labels of a drawing by the names of a composite: Error(input) for a name that the composite
// lacks, by more than max_lossy_steps. Unknown pixels take the nearest label.
Grid<std::uint8_t> read_drawn_labels(const std::string& path, const std::vector<std::string>& names,
                                     Progress& progress = silent_progress());

// A PNG that reads back as these labels.
void write_label_picture(const std::string& path, const Grid<std::uint8_t>& labels,
                         const std::vector<std::string>& names);
Grid<glm::vec3> label_colours(const Grid<std::uint8_t>& labels,
                              const std::vector<std::string>& names);

}  // namespace belvedere::tools
