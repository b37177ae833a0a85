#pragma once

#include <string>
#include <vector>

#include "base/config.h"

namespace belvedere {

// Where a value of a scene was written: in its file or by a --set on the command line.
struct SceneOrigin {
  std::string file;                   // name of the scene file, for messages
  std::vector<std::string> settings;  // key=value, as --set had them

  // `file:line:column`, or `--set key=value`.
  std::string where(ConfigPlace place) const;
};

// The place that marks a value as set by settings[index], and whether a place is one.
ConfigPlace place_of_setting(std::size_t index);
bool is_setting(ConfigPlace place);

// Lays every --set over the file's tables, in order: makes tables and list elements that are not there yet, and drops what the file says
// of the same question (--set sun.azimuth=90 replaces the file's sun.time). Values are checked later, with the file's.
// Error(usage) for a setting that has no key or leads nowhere.
void apply_settings(ConfigValue& root, const SceneOrigin& origin);

}  // namespace belvedere
