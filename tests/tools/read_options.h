#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "tools/options/options.h"

namespace belvedere::test {

// What the options that `add` gives a command hold after a line, whose words stand between blanks.
// Throws Error(usage).
template <class Options, class Add>
Options read_options(const Add& add, const std::string& line) {
  tools::CommandLine command("test", "");
  Options options;
  add(command.options(), options);
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  command.read(words);
  return options;
}

}  // namespace belvedere::test
