#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/labels/label_layout.h"
#include "renderer/labels/label_points.h"
#include "renderer/labels/label_shapes.h"
#include "renderer/labels/label_style.h"
#include "renderer/labels/text_measure.h"
#include "renderer/labels/tracks.h"
#include "renderer/trace/geo_map.h"

namespace belvedere {

// A point with its set name and position.
struct Label {
  LabelPoint point;
  LabelMark mark;
  std::string text;      // the name as set: in capitals, a number …; a summit without one has its
                         // altitude
  std::string altitude;  // beside it; mostly empty
  TextRoom room;         // of the text
  TextRoom altitude_room;
  std::string hidden_by;  // the named point nearest to the ground in front of a hidden mark, within
                          // hiding_name_m; may be empty
  double spacing = 0.0;   // between letters, of the type's size: the kind's, more where a name is
                          // spread along its shape
  bool on_dark = false;   // in the kind's light colour
  LabelSpot spot;         // placed or not; only visible points are placed
};

// From a name to its altitude, of the altitude's size: down from baseline to baseline where it
// stands under the name, else between them.
inline constexpr double altitude_lead = 1.0;
inline constexpr double altitude_gap = 0.35;

inline constexpr double hiding_name_m = 2500.0;

// The named point nearest to the ground that hides point i, within that distance; empty where there
// is none, or nothing hides it.
std::string hiding_name(const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks,
                        std::size_t i);

// A picture's labels with the style at its scale.
struct LabelSheet {
  glm::ivec2 size_px{0};
  double sheet_width_mm = 0.0;
  double px_per_mm = 1.0;  // scale of the style's lengths: that of the sheet, or larger where
                           // letters would be smaller than min_px
  LabelStyle style;
  std::vector<Label> labels;
  std::vector<Track> tracks = {};  // drawn below the names, which ignore them

  TextStyle type_of(const Label& label) const;
  TextStyle altitude_type_of(const Label& label) const;
  // The altitude stands under the name, else after it.
  bool is_stacked(const Label& label) const { return kind_of(label).position == LabelPlace::above; }
  const LabelKindStyle& kind_of(const Label& label) const {
    return style.kinds[static_cast<std::size_t>(label.point.kind)];
  }
};

// Text style of one kind at that scale, for a name of that rank.
TextStyle text_style(const LabelKindStyle& kind, double px_per_mm, double rank = 5.0);

// Error(input) naming the fonts of a style that are not installed: with others the sheet would
// differ from machine to machine.
void require_fonts(const LabelStyle& style);

// A sheet without names, with the style's scale, for a margin.
LabelSheet empty_label_sheet(LabelStyle style, glm::ivec2 size_px, double sheet_width_mm);

// The row of the picture above which there is sky, for each column; 0 where land reaches the upper
// edge. By bisection: overhanging ground in the sky is not found.
std::vector<double> find_skyline(const GeoMap& map, glm::ivec2 size_px);

// Sets and places the names of visible points. sheet_width_mm > 0. `lines`: for each point the line
// of its shape in the picture that its name follows, if it has one; fewer than points, or an empty
// one: it is a point. Those of kinds that are barriers part the names of places. Error(input) as of
// require_fonts.
LabelSheet make_labels(const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks,
                       const std::vector<double>& skyline_px, LabelStyle style, glm::ivec2 size_px,
                       double sheet_width_mm,
                       const std::vector<std::vector<glm::dvec2>>& lines = {});

// Sets names on dark ground in the light colour of their kind. `luminance`: of the whole picture,
// in a small copy of it.
void choose_inks(LabelSheet& sheet, const Grid<float>& luminance);

// The altitude as on maps: "2749 m", with a no-break space; empty if not known.
std::string altitude_text(const LabelPoint& point, const LabelMark& mark);

}  // namespace belvedere
