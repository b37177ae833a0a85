#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/features/feature_style.h"
#include "terrain/io/features.h"

namespace belvedere {

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
