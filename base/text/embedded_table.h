#pragma once

namespace belvedere {

// The table that cmake/embed.cmake generates; embedded.cpp reads it.
struct EmbeddedFile {
  const char* name;
  const char* text;
};
extern const EmbeddedFile embedded_files[];
extern const unsigned embedded_file_count;

}  // namespace belvedere
