#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// A reader that is given damaged files.
struct FuzzTarget {
  std::string_view name;
  // Folders and files of the project that hold good examples, besides tests/fuzz/NAME; separated
  // by blanks.
  std::string_view seeds;
  // May throw an Error. Anything else, or an answer after more than 10 s, is a fault of the reader.
  std::function<void(const std::string& bytes)> read;
};

const std::vector<FuzzTarget>& fuzz_targets();

}  // namespace belvedere
