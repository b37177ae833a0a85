#pragma once

#include <string>
#include <vector>

#include "base/config.h"
#include "tests/paths.h"

namespace belvedere::test {

struct PublishedLine {
  std::string position;
  double latitude_deg;
  double longitude_deg;
  double altitude_m;
};

// "treelines" of published_lines.toml.
inline std::vector<PublishedLine> published_lines(const std::string& kind) {
  const std::string name = source_folder() + "/tests/terrain/climate/published_lines.toml";
  const ConfigValue document = read_config(name);
  std::vector<PublishedLine> lines;
  for (const ConfigValue& value : as_array(*find(as_table(document, name), kind), name)) {
    const ConfigArray& row = as_array(value, name);
    lines.push_back({as_string(row.at(0), name), as_number(row.at(1), name),
                     as_number(row.at(2), name), as_number(row.at(3), name)});
  }
  return lines;
}

}  // namespace belvedere::test
