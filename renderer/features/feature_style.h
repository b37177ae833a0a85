#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/land_cover_class.h"

namespace belvedere {

// How the features of one kind are drawn.
enum class FeatureDraw : int {
  line,      // drawn on the ground: a fill between two darker edges, or dashes
  band,      // a broad soft band that tints the ground: ski runs
  cable,     // straight through the air from station to station, on pylons
  building,  // walls and a roof
  river,     // a line that becomes water in its valley
  area,      // an area that becomes a class of ground
  coast,     // a line with land to its left: the sea beyond it becomes a class of ground; areas are
             // islands
  town       // a place with houses: points with a population, or areas
};

// What features are made of.
enum class FeatureGeometry : int { line, area, point_or_area, line_or_area };

FeatureGeometry geometry_of(FeatureDraw draw);
struct FeatureKind;
// Rivers, areas, coasts and towns: they become the ground instead of being drawn on it.
bool becomes_ground(const FeatureKind& kind);
// "lines", "areas", for messages.
const char* name_of(FeatureGeometry geometry);
const char* name_of(FeatureDraw draw);

// Encoded sRGB, 0…1.
struct FeatureColours {
  glm::vec3 fill{0.95F, 0.92F, 0.82F};
  glm::vec3 casing{0.35F, 0.30F, 0.26F};
  glm::vec3 bed{0.97F, 0.98F, 1.0F};  // treated ground below: a groomed slope, a lane
};

// How the features of one kind are drawn. Lengths in mm of the sheet unless stated otherwise.
struct FeatureKind {
  std::string name;               // as in scenes and files: "road"
  std::vector<std::string> also;  // other words for it
  FeatureDraw draw = FeatureDraw::line;
  double rank = 50.0;     // larger ranks are on top, 0…100
  double width_mm = 0.6;  // of the fill in the foreground, 0…50
  double min_px = 0.8;    // min width in the picture, 0…100
  double real_m = 0.0;    // min width on the ground, 0…10000
  double shrink = 0.5;  // width is proportional to distance to the power of minus this: 0 constant
                        // … 1 true perspective
  double min_share = 0.3;   // but at least this share of width_mm, 0…1
  double casing_mm = 0.14;  // of each edge; 0: none, 0…10
  double bed_mm = 0.0;      // extent of the bed on each side; 0: none, 0…50
  double soft_mm = 0.0;     // softness of the edges of fill and bed, 0…20
  double opacity = 1.0;     // of fill and casing, 0…1
  glm::dvec2 dash_mm{0.0};  // of the fill: on and off; 0, 0: continuous, 0…100
  double hand = 0.12;       // unevenness of the brushwork, relative to its width, 0…1
  double coarsest_m =
      0.0;  // left out where 1 mm of the sheet covers more metres; 0: never, 0…100000
  double clear_mm = 0.0;  // distance kept clear of trees and houses; 0: they may stand on it, 0…50
  double height_mm = 1.2;  // of cables above the ground, and at least height_m, 0…50
  double height_m = 10.0;  // m, 0…500
  double pylon_mm = 6.0;   // from pylon to pylon; 0: none, 0…500
  FeatureColours summer;
  FeatureColours winter;                 // where not given, as in summer
  std::optional<LandCoverClass> ground;  // class that an area or a river gives the ground
  bool level = false;                    // its areas are level, as lakes are
};

struct FeatureStyle {
  std::string name;                // of the file, for messages
  std::vector<FeatureKind> kinds;  // in the order of the file

  // The kind for a word, case-insensitive; -1 if there is none.
  int find(const std::string& word) const;
  // All names, for messages.
  std::vector<std::string> names() const;
};

// A built-in style ("classic", "ski") or a .toml file. Throws Error(usage) with line and column for
// an invalid style, Error(input) if the file is missing.
FeatureStyle load_feature_style(const std::string& name_or_file);
FeatureStyle parse_feature_style(const std::string& text, const std::string& name);

}  // namespace belvedere
