#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/land_cover_class.h"
#include "terrain/io/features.h"

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

// Geometry of a kind of features.
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

// One file of features and its settings in a scene.
struct FeatureSource {
  VectorSource file = {};
  std::string layer = {};  // empty: all
  std::string where = {};  // empty: all
  std::string kind =
      {};  // a word of the style; with kind_of the kind of features whose column is empty
  std::string kind_of = {};        // a column; empty: none
  double width_mm = 0.0;           // 0: the style's
  std::string width_of = {};       // a column of metres; empty: none
  std::string level_of = {};       // a column with the altitudes of lakes, m; empty: none
  std::string population_of = {};  // a column with the inhabitants of towns; empty: none
  int block = 0;                   // of the scene
  std::string key = {};            // "features.0", for messages
};

struct Feature {
  int kind = 0;    // of the style's kinds
  int source = 0;  // of the sources
  int block = 0;   // of the scene's blocks of features
  MapShape shape = MapShape::line;
  std::string where;
  std::vector<std::vector<glm::dvec2>> parts;  // as of MapFeature, in the terrain's CRS
  float width_mm = 0.F;                        // in the foreground
  float real_m = 0.F;                          // min width on the ground
  float level_m = NAN;                         // of a lake; NaN: not known
  float people = 0.F;                          // of a town; 0: not known
};

// Statistics of reading one source.
struct SourceReading {
  std::string file;
  std::size_t read = 0;
  std::size_t without_shape = 0;
  std::size_t unplaceable = 0;
  std::size_t at_zero = 0;
  std::size_t beside = 0;                      // outside the ground, where one was given
  std::size_t wrong_shape = 0;                 // points where lines are drawn, and the like
  std::size_t wrong_width = 0;                 // whose width is not a number: they get the style's
  std::size_t wrong_number = 0;                // whose altitude or population is not a number
  std::map<std::string, std::size_t> unknown;  // words that the style does not contain: left out
  glm::dvec2 low{0.0}, high{0.0};              // extent of all positions read, in the terrain's CRS
  std::size_t taken = 0;
};

struct FeatureSet {
  FeatureStyle style;
  std::vector<Feature> features;
  std::vector<SourceReading> readings;  // one per source
};

// Reads the sources in the terrain's CRS and finds the kind of each feature; features outside
// `ground` are only counted. Throws Error(usage) for a kind that the style does not contain, and
// what read_map_features throws; defects of single features are counted.
FeatureSet read_feature_set(const FeatureStyle& style, const std::vector<FeatureSource>& sources,
                            const std::string& crs, const std::optional<MapBox>& ground = {});

}  // namespace belvedere
