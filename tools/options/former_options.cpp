#include "tools/options/former_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace belvedere::tools {
namespace {

struct FormerOption {
  std::vector<std::string_view> command;
  std::string_view former;
  std::string_view present;
};

// Names changed in version 0.2. A row is removed in the next version. Names without dashes are
// commands of the group.
const std::vector<FormerOption>& former_options() {
  static const std::vector<FormerOption> rows = {
      {{"texture"}, "knit", "seam"},
      {{"labels"}, "--least-prominence", "--min-prominence"},
      {{"synthesize"}, "--unlikeness", "--class-dissimilarity"},
      {{"exemplar", "segment"}, "--most", "--max-groups"},
      {{"exemplar", "segment"}, "--page", "--report"},
      {{"verify"}, "--page", "--report"},
      {{"diff"}, "--max-max", "--max-difference"},
  };
  return rows;
}

}  // namespace

std::vector<std::string> with_present_names(std::vector<std::string> words,
                                            std::vector<std::string>& notes) {
  for (const FormerOption& option : former_options()) {
    const std::size_t depth = option.command.size();
    if (words.size() <= depth ||
        !std::equal(option.command.begin(), option.command.end(), words.begin()))
      continue;
    const bool is_command = !option.former.starts_with('-');
    for (std::size_t i = depth; i < (is_command ? depth + 1 : words.size()); ++i) {
      const std::string_view word = words[i];
      const bool with_value = !is_command && word.starts_with(option.former) &&
                              word.substr(option.former.size()).starts_with('=');
      if (word != option.former && !with_value) continue;
      words[i] = std::string(option.present) + std::string(word.substr(option.former.size()));
      notes.push_back(fmt::format(
          "{1} is now called {2} (belvedere {0}); the next version will not read the former name",
          fmt::join(option.command, " "), option.former, option.present));
    }
  }
  return words;
}

}  // namespace belvedere::tools
