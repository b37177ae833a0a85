#pragma once

#include "base/text/json.h"

namespace belvedere::tools {

// An array of them.
template <class Values>
Json json_numbers(const Values& values) {
  Json out = Json::array();
  for (const auto value : values) out.add(Json::number(static_cast<double>(value)));
  return out;
}

}  // namespace belvedere::tools
