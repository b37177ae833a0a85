#pragma once

#include <string>
#include <vector>

namespace belvedere::tools {

// A key of a scene that is tried in several values, as typed.
struct SceneAxis {
  std::string key;
  std::vector<std::string> values;
};
// What --set options say: keys of one value, and one or two of several.
struct SceneSweep {
  std::vector<std::string> settings;  // KEY=VALUE
  std::vector<SceneAxis> axes;        // along the columns, down the rows
};

// Values are separated by commas that stand in no brackets and no quotes: "light.azimuth_deg=300,320", "generalize.foreground=[1,1],[1,0]".
// Error(usage) where no key has several values, more than two have, or a value stands twice or is empty.
SceneSweep split_sweep(const std::vector<std::string>& settings);

}  // namespace belvedere::tools
