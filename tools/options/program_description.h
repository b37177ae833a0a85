#pragma once

#include <string>
#include <vector>

namespace belvedere::tools {

// The command line as plain values, for whatever is made of it besides help: manual page, completion.

struct OptionDescription {
  std::vector<std::string> names;    // "--quiet", "-q"; an argument without a dash has its one name, "SCENE"
  std::string value;                 // what stands for its value, "DIR" or "STYLE TARGET"; empty: it takes none
  std::string meaning;               // a sentence
  std::string range;                 // "8 … 4096"; empty: none is stated
  std::vector<std::string> choices;  // all that its value may be; empty: anything
  std::string preset;                // its value where it is not given; empty: the meaning says it
  bool positional = false;
  bool required = false;
};

struct CommandDescription {
  std::string name;         // whole, as typed: "belvedere exemplar paint"
  std::string meaning;      // one line
  std::string description;  // lines broken as they are shown, examples indented
  std::string footer;       // likewise
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;  // empty: the command does something itself

  // The last word of the name.
  std::string word() const { return name.substr(name.rfind(' ') + 1); }
};

}  // namespace belvedere::tools
