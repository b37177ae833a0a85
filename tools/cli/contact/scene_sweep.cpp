#include "tools/cli/contact/scene_sweep.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char letter : text) {
    if (quote != 0) {
      if (letter == quote) quote = 0;
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth;
    } else if (letter == ']' || letter == '}') {
      --depth;
    } else if (letter == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += letter;
  }
  return values;
}

}  // namespace

SceneSweep split_sweep(const std::vector<std::string>& settings) {
  SceneSweep sweep;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::vector<std::string> values = equals == std::string::npos
                                                ? std::vector<std::string>()
                                                : split_values(setting.substr(equals + 1));
    if (values.size() < 2) {
      sweep.settings.push_back(setting);  // invalid ones are refused with the scene
      continue;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i].empty())
        refuse("--set", fmt::format("{} with an empty value", setting), "KEY=VALUE,VALUE,…");
      if (std::count(values.begin(), values.end(), values[i]) > 1)
        refuse("--set", fmt::format("{} with {} twice", setting, values[i]), "each value once");
    }
    sweep.axes.push_back({setting.substr(0, equals), values});
  }
  if (sweep.axes.empty())
    refuse("--set", "no key with several values", "--set KEY=VALUE,VALUE,… of one key or two");
  if (sweep.axes.size() > 2)
    refuse("--set", fmt::format("{} keys with several values", sweep.axes.size()),
           "one or two: columns and rows of a sheet");
  return sweep;
}

}  // namespace belvedere::tools
