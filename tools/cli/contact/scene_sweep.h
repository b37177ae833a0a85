#pragma once

#include <string>
#include <vector>

namespace belvedere::tools {

// A key of a scene with the values to try, as typed.
struct SceneAxis {
  std::string key;
  std::vector<std::string> values;
};
// The content of the --set options: keys with one value, and one or two with several.
struct SceneSweep {
  std::vector<std::string> settings;  // KEY=VALUE
  std::vector<SceneAxis> axes;        // along the columns, down the rows
};

// Values are separated by commas outside brackets and quotes: "light.azimuth_deg=300,320",
// "generalize.foreground=[1,1],[1,0]". Error(usage) where no key has several values, more than two
// have, or a value occurs twice or is empty.
SceneSweep split_sweep(const std::vector<std::string>& settings);

}  // namespace belvedere::tools
