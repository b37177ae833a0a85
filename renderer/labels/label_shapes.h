#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/progress.h"
#include "renderer/labels/label_marks.h"
#include "renderer/labels/label_points.h"
#include "renderer/labels/label_style.h"

namespace belvedere {

// Something long or wide that has a name: a valley's line, a lake's shore.
struct LabelShape {
  LabelPoint point;                            // its name; the place is the middle of its parts
  bool is_area = false;                        // the first part is its outline, others are holes
  std::vector<std::vector<glm::dvec2>> parts;  // scene CRS
};

// Lines and areas of a vector file (read_map_features) with columns name, kind and rank as of read_label_points; those that say no kind are
// valleys. Several lines of one name and kind are one shape. Features without a name are left out with a note. Throws Error as
// read_map_features does, and Error(usage) for a rank that is no number of 1 … 9 and where nothing has a name.
std::vector<LabelShape> read_label_shapes(const std::string& path, const std::string& crs, const LabelStyle& style, Progress& progress);

// Where a shape is in the picture: its mark (the middle of what is seen) and the line that its name may follow, px.
struct ShapeRun {
  LabelMark mark;
  std::vector<glm::dvec2> line;  // empty: not seen
};
// Of a line its longest seen piece; of an area the middles of its sections across its longest way in the picture, where they are seen. In
// parallel; the same for any number of threads.
std::vector<ShapeRun> find_shape_runs(const DrawnGround& ground, const std::vector<LabelShape>& shapes);

// The line through an area's middle, px: for each of 48 sections across its longest way the middle of the widest piece inside. From left to
// right.
std::vector<glm::dvec2> middle_line(const std::vector<std::vector<glm::dvec2>>& rings);

// Baselines for a text of that width and type that follow a line: arcs (parabolas fitted to a stretch of the line as long as the text),
// best first: in its middle, then to either side. From left to right, nowhere steeper than 55°, turning by at most 60° in all. Where the
// line is shorter than the text, its tangents go on, by a quarter of the text at most; none where that is not enough.
// `lift_px`: how high over the line the baseline lies. `aside_px`: how far below and above that it may lie as well, where that keeps the
// name nearer to the middle; 0: nowhere else.
std::vector<std::vector<glm::dvec2>> fitted_baselines(const std::vector<glm::dvec2>& line, double width_px, double lift_px,
                                                      double aside_px = 0.0);

}  // namespace belvedere
