#include "terrain/layers/fit/picture_haze.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

// Haze of red and green over that of blue: wavelengths of .65, .56 and .45 µm.
constexpr double of_red = square(square(0.45 / 0.65));
constexpr double of_green = square(square(0.45 / 0.56));

// The share of the air that lies above an altitude.
double air_above(float altitude_m) {
  constexpr double scale_height_m = 8000.0;
  return exact::exp(-static_cast<double>(altitude_m) / scale_height_m);
}

}  // namespace

PictureHaze find_haze(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m,
                      const Grid<std::uint8_t>& use) {
  constexpr std::size_t bands = 12;
  constexpr std::size_t darkest = 50;  // one cell of so many
  std::vector<std::pair<float, std::size_t>> by_altitude;
  for (std::size_t i = 0; i != use.size(); ++i)
    if (use[i] != 0) by_altitude.emplace_back(altitude_m[i], i);
  if (by_altitude.size() < bands * darkest) return {};
  std::sort(by_altitude.begin(), by_altitude.end());
  std::vector<double> excess;  // of blue over red at sea level
  for (std::size_t band = 0; band != bands; ++band) {
    std::vector<std::pair<float, std::size_t>> cells;  // by brightness
    for (std::size_t n = by_altitude.size() * band / bands;
         n != by_altitude.size() * (band + 1) / bands; ++n) {
      const glm::vec3& rgb = picture[by_altitude[n].second];
      cells.emplace_back(rgb.x + rgb.y + rgb.z, by_altitude[n].second);
    }
    std::sort(cells.begin(), cells.end());
    cells.resize(std::max<std::size_t>(cells.size() / darkest, 1));
    double sum = 0.0;
    for (const auto& [brightness, i] : cells)
      sum += static_cast<double>(picture[i].z - picture[i].x) / air_above(altitude_m[i]);
    excess.push_back(sum / static_cast<double>(cells.size()));
  }
  const double blue = std::max(0.0, middle_value(std::move(excess))) / (1.0 - of_red);
  return {{of_red * blue, of_green * blue, blue}};
}

Grid<glm::vec3> without_haze(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m,
                             const PictureHaze& haze) {
  Grid<glm::vec3> out(picture.width(), picture.height());
  for (std::size_t i = 0; i != out.size(); ++i)
    out[i] = glm::max(glm::dvec3(picture[i]) - haze.at_sea_level * air_above(altitude_m[i]),
                      glm::dvec3(0.0));
  return out;
}

}  // namespace belvedere
