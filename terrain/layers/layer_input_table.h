#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// What surface layers can know of a place. The one table is layer_input_table.cpp; layer_inputs.h computes them.
enum class LayerInputKind : std::uint8_t {
  altitude,
  slope,
  north,
  east,
  relief,  // over the mean of `reach_m` around
  valley_height,
  catchment,
  flatness,
  roughness,
  // Given by the caller (LayerClimate).
  temperature,
  rain,
  radiation,
  sky_view,
};
struct LayerInputInfo {
  std::string_view name;  // as files write it
  std::string_view unit;  // empty: a number
  std::string_view meaning;
  LayerInputKind kind;
  double reach_m = 0.0;
};
const std::vector<LayerInputInfo>& layer_input_table();
// Null for a name that is none.
const LayerInputInfo* find_layer_input(std::string_view name);
// Error(usage) with the nearest known name.
void require_layer_input(const std::string& name, const std::string& where);

}  // namespace belvedere
