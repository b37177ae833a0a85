#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// The files below data/ and scenes/demo/ that are built into the program, so that it does not
// depend on its location: "palettes/summer.toml", "legends/nlcd.toml", "layers/life_zones.toml",
// "scenes/demo/demo.toml" … Throws Error(bug) for an unknown name.
std::string_view embedded_file(std::string_view name);
// All names in a folder, without folder and extension: embedded_names("legends") has "nlcd".
std::vector<std::string> embedded_names(std::string_view folder);

// The table that cmake/embed.cmake generates; embedded.cpp reads it.
struct EmbeddedFile {
  const char* name;
  const char* text;
};
extern const EmbeddedFile embedded_files[];
extern const unsigned embedded_file_count;

}  // namespace belvedere
