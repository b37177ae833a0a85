#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/labels/label_style.h"
#include "terrain/io/raster.h"
#include "terrain/shape/summits.h"

namespace belvedere {

// Something with a name, as files say it.
struct LabelPoint {
  std::string name;                  // UTF-8; empty: a summit that nobody named
  int kind = 0;                      // of the style's kinds
  double rank = 5.0;                 // 1 the most important … 9
  std::optional<double> altitude_m;  // as the file has it
  glm::dvec2 place{0.0};             // scene CRS
  std::string where;                 // "peaks.csv:3"
};

inline constexpr std::size_t longest_name = 80;  // letters: a panorama has no room for more

// Letters of UTF-8.
std::size_t letters_of(const std::string& text);

// Points of a .csv as read_points() takes it, or of all layers of a file that read_map_features() takes, with the columns
//   name;
//   kind (or type, natural, place, tourism): a word that the style knows, else its first kind, and a note says which words it lacks;
//   rank, 1 … 9; else by the kind alone, 5;
//   ele (or altitude, altitude_m, elevation, height): metres.
// Points without a name, or one of more than longest_name letters, are left out with a note; all are kept where NamesAre::optional. Throws
// Error as these do, Error(usage) where there is no column of names, no name to set, or a number that is none, and Error(input) for names
// that are not UTF-8.
enum class NamesAre { needed, optional };
std::vector<LabelPoint> read_label_points(const std::string& path, const std::string& crs, const LabelStyle& style, Progress& progress,
                                          NamesAre names = NamesAre::needed);

// Summits that nobody named, as points of the kind "summit" (else the style's first): those that are none of `named` (no other summit lies
// within their climb_m). Ranks 6 … 9 by prominence.
std::vector<LabelPoint> unnamed_summits(const std::vector<Summit>& summits, const GeoTransform& transform, double cell_m,
                                        const std::vector<LabelPoint>& named, const LabelStyle& style);

}  // namespace belvedere
