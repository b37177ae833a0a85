#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/progress.h"
#include "renderer/labels/label_points.h"
#include "renderer/labels/label_style.h"
#include "terrain/io/features.h"

namespace belvedere {

// A named line or area: a valley's line, a lake's shore.
struct LabelShape {
  LabelPoint point;                            // its name; its position is the centre of its parts
  bool is_area = false;                        // the first part is its outline, others are holes
  std::vector<std::vector<glm::dvec2>> parts;  // scene CRS
};

// Lines and areas of a vector file (read_map_features) with columns name, kind and rank as of
// read_label_points; those without a kind are valleys. Several lines of one name and kind are one
// shape. Features without a name are left out with a note. Throws the errors of read_map_features,
// and Error(usage) for a rank outside 1 … 9 and where nothing has a name.
std::vector<LabelShape> read_label_shapes(const VectorSource& source, const std::string& crs,
                                          const LabelStyle& style, Progress& progress);

// Position of a shape in the picture: its mark (the centre of its visible part) and the line that
// its name may follow, px.
struct ShapeRun {
  LabelMark mark;
  std::vector<glm::dvec2> line;  // empty: not visible
};
// For a line its longest visible piece; for an area the centres of its sections across its longest
// direction in the picture, where they are visible. In parallel; the same for any number of
// threads.
std::vector<ShapeRun> find_shape_runs(const LocatedGround& ground,
                                      const std::vector<LabelShape>& shapes);

// The line through an area's centre, px: for each of 48 sections across its longest direction the
// centre of the widest piece inside. From left to right.
std::vector<glm::dvec2> centreline(const std::vector<std::vector<glm::dvec2>>& rings);

// Baselines for a text of that width and type that follow a line: arcs (parabolas fitted to a part
// of the line as long as the text), best first: at its centre, then to either side. From left to
// right, nowhere steeper than 55°, turning by at most 60° in all. Where the line is shorter than
// the text, it is extended by its tangents, by a quarter of the text at most; none where that is
// not enough. `lift_px`: height of the baseline above the line. `aside_px`: further offsets below
// and above, where that keeps the name nearer to the centre; 0: none.
std::vector<std::vector<glm::dvec2>> fitted_baselines(const std::vector<glm::dvec2>& line,
                                                      double width_px, double lift_px,
                                                      double aside_px = 0.0);

}  // namespace belvedere
