#pragma once

#include <string>
#include <utility>

#include "base/error.h"

namespace belvedere {

// The result of `make`. A stage's errors name its own fields; here the scene's section is put
// before them: "handles.1" of the deformation becomes "deform.handles.1".
template <class Make>
auto in_section(const std::string& section, Make&& make) {
  try {
    return std::forward<Make>(make)();
  } catch (const Error& error) {
    throw Error(error.kind(), section + "." + error.where(), error.found(), error.allowed());
  }
}

}  // namespace belvedere
