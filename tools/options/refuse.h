#pragma once

#include <string>

#include "base/error.h"

namespace belvedere::tools {

// Refuses a command line that does not make sense.
[[noreturn]] inline void refuse(const std::string& where, const std::string& found,
                                const std::string& allowed) {
  throw Error(ErrorKind::usage, where, found, allowed);
}

}  // namespace belvedere::tools
