#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "terrain/io/dem.h"

namespace belvedere {

// A place that somebody recognizes in a painting.
struct ControlPair {
  glm::dvec2 pixel{0.0};     // x right, y down, (0, 0) the outer corner of the top-left pixel
  glm::dvec2 position{0.0};  // of the ground, in the DEM's CRS
  glm::dvec2 lonlat{0.0};    // the same as the file has it, °
  double altitude_m = 0.0;   // of the DEM there
  std::string name = {};     // may be empty
  bool sure = false;         // never taken for wrong
  int line = 0;              // of the file
};

// Fewer pairs cannot tell a view from chance.
constexpr std::size_t min_control_pairs = 8;

struct ControlPairsFormat {
  std::size_t min_pairs = min_control_pairs;
  bool other_columns = true;  // false: a column that control_pairs_text() would lose is refused
};

// The rows of a CSV file with columns x_px, y_px, lon, lat (degrees), name and optionally sure
// (1: never taken for wrong; 0 or empty). Error(usage) naming line and column for a missing column,
// text that is no number, a pixel outside the painting, a place outside the DEM or in a void that
// was filled, a pair that is there twice, and fewer than min_pairs.
std::vector<ControlPair> read_control_pairs(const std::string& path, glm::ivec2 painting_px,
                                            const Dem& dem);
// The same of the text of such a file; name: the file's, for messages.
std::vector<ControlPair> parse_control_pairs(const std::string& text, const std::string& name,
                                             glm::ivec2 painting_px, const Dem& dem,
                                             const ControlPairsFormat& format = {});
// Pairs as such a text, by their pixel and lonlat, of which no digit is lost.
std::string control_pairs_text(std::span<const ControlPair> pairs);

// A DEM whose cells are the highest of n × n, n the smallest that leaves at most so many cells: the
// skyline keeps its summits.
Dem highest_cells(const Dem& dem, std::size_t max_cells);

}  // namespace belvedere
