#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace belvedere {

// Tiles of map services hold heights as colours of 8 bits:
//   height_m = base_m + step_m · (65536 red + 256 green + blue)
struct HeightEncoding {
  double base_m = 0.0;
  double step_m = 1.0;

  float metres(std::uint8_t red, std::uint8_t green, std::uint8_t blue) const {
    return static_cast<float>(base_m + step_m * (65536.0 * red + 256.0 * green + blue));
  }
};

// "terrarium" (Mapzen's Terrain Tiles) or "mapbox" (Mapbox Terrain-RGB); nothing for other words.
inline std::optional<HeightEncoding> height_encoding(const std::string& name) {
  if (name == "terrarium") return HeightEncoding{-32768.0, 1.0 / 256.0};
  if (name == "mapbox") return HeightEncoding{-10000.0, 0.1};
  return std::nullopt;
}

// For messages: what to write where colours encode heights.
constexpr const char* encoding_advice =
    "if its colours encode heights, `encoding = \"terrarium\"` or \"mapbox\" (--encoding where "
    "there is no scene)";

}  // namespace belvedere
