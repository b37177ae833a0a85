#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/labels/label_style.h"
#include "renderer/trace/geo_map.h"
#include "terrain/io/features.h"
#include "terrain/io/raster.h"
#include "terrain/shape/valley_floor.h"

namespace belvedere {

// A named point, as files describe it.
struct LabelPoint {
  std::string name;                  // UTF-8; empty: a summit without a name
  int kind = 0;                      // of the style's kinds
  double rank = 5.0;                 // 1 the most important … 9
  std::optional<double> altitude_m;  // as the file has it
  glm::dvec2 position{0.0};          // scene CRS
  std::string where;                 // "peaks.csv:3"
  // Placed by hand: from the mark to the centre of the foot of the name, mm of the sheet, x right,
  // y down; of a name on a line its shift. Absent: placed by the program.
  std::optional<glm::dvec2> by_hand_mm = {};
};

inline constexpr std::size_t longest_name = 80;  // letters: longer names do not fit in a panorama

// Number of code points of UTF-8 text.
std::size_t letters_of(const std::string& text);

// Points of a .csv as read_points() takes it, or of all layers of a file that read_map_features()
// takes, with the columns
//   name;
//   kind (or type, natural, place, tourism): a word of the style, else its first kind, with a note
//   of the missing words; rank, 1 … 9; default by the population (1 from 100 000, 2 from 30 000, 3
//   from 10 000 …), else 5; ele (or altitude, altitude_m, elevation, height): metres; dx_mm and
//   dy_mm: by_hand_mm.
// Points without a name, or one of more than longest_name letters, are left out with a note; all
// are kept where NamesAre::optional. Throws the errors of these functions, Error(usage) where there
// is no column of names, no usable name, or a number that is invalid, and Error(input) for names
// that are not UTF-8.
enum class NamesAre { needed, optional };
std::vector<LabelPoint> read_label_points(const VectorSource& source, const std::string& crs,
                                          const LabelStyle& style, Progress& progress,
                                          NamesAre names = NamesAre::needed);

// Unnamed summits of the DEM, as points of the kind "summit" (else the style's first): those that
// are not in `named` (no other summit lies within their climb_m). Ranks 6 … 9 by prominence.
std::vector<LabelPoint> unnamed_summits(const std::vector<Summit>& summits,
                                        const GeoTransform& transform, double cell_m,
                                        const std::vector<LabelPoint>& named,
                                        const LabelStyle& style);

enum class MarkState : int { seen, hidden, outside_picture, behind_eye, outside_terrain };
std::string_view name_of(MarkState state);  // "seen", "hidden behind ground" …

// Position of a point in the picture.
struct LabelMark {
  glm::dvec2 drawn_position{
      0.0};  // scene CRS: of a summit its top as drawn; else the point's position
  double dem_altitude_m = 0.0;  // of the undeformed, ungeneralized DEM there; NaN outside it
  // x right, y down, (0, 0) the outer corner; for visible and hidden points and those outside the
  // picture. For a visible summit the upper edge as drawn: seen from high above, ground just behind
  // the top may be drawn above it.
  glm::dvec2 pixel{0.0};
  double distance_m = 0.0;  // from the eye
  MarkState state = MarkState::outside_terrain;
  std::optional<GeoPosition> in_front;  // the ground that hides it
  bool on_skyline = false;              // only sky is above it
  double width_px = 0.0;                // of a seen area: how wide it is at the mark's row
};

// Input for marks: the generalized ground, whose tops are drawn, with the map to the picture. All
// must outlive it.
struct LocatedGround {
  const Grid<float>& altitude_m;     // of the DEM
  const Grid<float>& generalized_m;  // as drawn, before it is bent
  GeoTransform transform;
  double cell_m = 1.0;
  const GeoMap& map;
};

// The top of the drawn ground that is reached from a position on it (GeoMap::drawn_position) by
// going up, always to the highest cell of those within three columns and rows; of level ones the
// first. The position itself where the top is farther away than max_m; nothing where it lies
// outside the terrain.
std::optional<glm::dvec2> climb(const LocatedGround& ground, glm::dvec2 position, double max_m);

// The mark of each point, in parallel; the same for any number of threads.
std::vector<LabelMark> find_marks(const LocatedGround& ground,
                                  const std::vector<LabelPoint>& points, const LabelStyle& style);

}  // namespace belvedere
