#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"

namespace belvedere::test {

// Keeps what stages remark.
struct Notes : Progress {
  void note(std::string_view text) override { all.emplace_back(text); }
  // One a line.
  std::string text() const {
    std::string lines;
    for (const std::string& line : all) lines += line + "\n";
    return lines;
  }
  std::vector<std::string> all;
};

// Keeps the names of the stages that begin.
struct Stages : Progress {
  void begin(std::string_view stage, double) override { all.emplace_back(stage); }
  std::vector<std::string> all;
};

}  // namespace belvedere::test
