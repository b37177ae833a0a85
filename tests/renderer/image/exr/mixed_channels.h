#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/random.h"
#include "renderer/image/image_io.h"
#include "tests/grids.h"

namespace belvedere::test {

// An OpenEXR file of two parts with channels of all types.
inline const std::vector<PartSpec> mixed_parts = {
    {"float", {{"Z", ChannelType::float32}, {"tone.V", ChannelType::half}}},
    {"class", {{"landcover.id", ChannelType::uint32}}},
};

inline float z_value(int x, int y) {
  return y == 3 ? std::numeric_limits<float>::infinity()
                : static_cast<float>(1000.0 + x * 0.125 + y * 3.7);
}
inline float tone_value(int x, int y) { return static_cast<float>(random_uniform(5, x, y)); }
// Bits of signalling NaNs among them: an id may have any.
inline std::uint32_t id_value(int x, int y) {
  return x == 2 ? 0x7f800001u + static_cast<std::uint32_t>(y)
                : static_cast<std::uint32_t>(x * 100000 + y);
}

inline void write_mixed(const std::string& path, int width, int height,
                        int step = ExrWriter::band_rows) {
  ExrWriter writer(path, width, height, mixed_parts,
                   {{"camera", "perspective"}, {"scene", "a = 1\nb = \"é\"\n"}});
  for (int y0 = 0; y0 < height; y0 += step) {
    const int rows = std::min(step, height - y0);
    std::vector<float> values, ids;
    for (const auto [x, y] : test::cells({0, y0, width, y0 + rows})) {
      values.push_back(z_value(x, y));
      values.push_back(tone_value(x, y));
      ids.push_back(std::bit_cast<float>(id_value(x, y)));
    }
    writer.write_rows(1, y0, rows, ids);  // parts in any order
    writer.write_rows(0, y0, rows, values);
  }
  writer.finish();
}

}  // namespace belvedere::test
