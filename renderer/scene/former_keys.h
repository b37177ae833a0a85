#pragma once

#include <string>
#include <vector>

#include "base/config.h"

namespace belvedere {

// Keys that had another name in the previous version are still read. Renames them in a parsed
// scene; a key that is present under both names keeps both and is refused later as unknown. Returns
// a note for each key: what to write instead.
std::vector<std::string> rename_former_keys(ConfigValue& root);
// The same for the "key=value" of a --set: adds its note, returns the setting with the present
// name.
std::string with_present_key(const std::string& setting, std::vector<std::string>& notes);
// The former name of a present key: "sight_m" for "air.mist.0.visibility_m"; empty where it had
// none.
std::string former_name(const std::string& key);

// Expands the short form `style = "NAME"` at the top of a parsed scene to the table `[style]` with
// `file = "NAME"`.
void spread_style(ConfigValue& root);
// The same for the "key=value" of a --set.
std::string with_style_file(const std::string& setting);

}  // namespace belvedere
