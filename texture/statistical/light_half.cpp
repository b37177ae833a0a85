#include "texture/statistical/light_half.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/filter.h"
#include "base/statistics.h"

namespace belvedere {

Grid<std::uint8_t> light_half(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                              LightHalf half, double blur_px) {
  const auto counts = [&](std::size_t i) {
    return states.empty() || (states[i] & pixel_counts) != 0;
  };
  Grid<float> light(crop.width(), crop.height());
  Grid<float> share(crop.width(), crop.height());
  for (std::size_t i = 0; i < crop.size(); ++i) {
    if (!counts(i)) continue;
    light[i] = static_cast<float>(2 * crop[i][0] + 5 * crop[i][1] + crop[i][2]) / 8.F;
    share[i] = 1.F;
  }
  light = gaussian_blur(light, blur_px);
  share = gaussian_blur(share, blur_px);
  std::vector<float> sorted;
  for (std::size_t i = 0; i < crop.size(); ++i) {
    if (!counts(i)) continue;
    light[i] /= share[i];
    sorted.push_back(light[i]);
  }
  Grid<std::uint8_t> out(crop.width(), crop.height());
  if (sorted.empty()) return out;
  const auto centre = middle_value(std::move(sorted));
  for (std::size_t i = 0; i < crop.size(); ++i)
    if (counts(i) && (light[i] >= centre) == (half == LightHalf::lit)) out[i] = pixel_free;
  return out;
}

}  // namespace belvedere
