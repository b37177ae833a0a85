#pragma once

#include <string>
#include <vector>

namespace belvedere::tools {

// Commands and options that had another name in the previous version are still read. Returns the
// words of a command line with their present names; adds a note for each: what to write instead.
std::vector<std::string> with_present_names(std::vector<std::string> words,
                                            std::vector<std::string>& notes);

}  // namespace belvedere::tools
