#pragma once

#include <string>
#include <vector>

namespace belvedere::tools {

// The command line as plain values, for the manual page and completion.

struct OptionDescription {
  std::vector<std::string>
      names;            // "--quiet", "-q"; an argument without a dash has its one name, "SCENE"
  std::string value;    // name of its value, "DIR" or "STYLE TARGET"; empty: it takes none
  std::string meaning;  // a sentence
  std::string range;    // "8 … 4096"; empty: no range
  std::vector<std::string> choices;  // all possible values; empty: anything
  std::string preset;                // its default value; empty: the meaning gives it
  bool positional = false;
  bool required = false;
};

struct CommandDescription {
  std::string name;         // full, as typed: "belvedere exemplar paint"
  std::string meaning;      // one line
  std::string description;  // preformatted lines, examples indented
  std::string footer;       // likewise
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;  // empty: the command has an action itself

  // The last word of the name.
  std::string word() const { return name.substr(name.rfind(' ') + 1); }
};

}  // namespace belvedere::tools
