#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene_file.h"
#include "tests/files.h"

namespace belvedere::test {

// Of a file whose second line `text` begins in.
inline Scene scene_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  return parse_scene("version = 1\n" + text, "s.toml", ".",
                     {.data_folders = {}, .settings = settings})
      .scene;
}

// The error of its reader.
inline std::string refused(const std::string& text, const std::vector<std::string>& settings = {}) {
  return message_of(ErrorKind::usage, [&] { scene_of(text, settings); });
}

}  // namespace belvedere::test
