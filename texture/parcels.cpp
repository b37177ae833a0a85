#include "texture/parcels.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/noise.h"
#include "renderer/base/random.h"

namespace belvedere {
namespace {

constexpr double width_on_the_ground_m = 90.0;
constexpr double narrowest_units = 8.0;  // on the sheet, before the valley floor is foreshortened
constexpr double longest_share = 3.2;    // of the width

}  // namespace

Parcel parcel_at(std::uint64_t seed, double east_m, double north_m, float metres_per_unit) {
  // Powers of two: neighbours at the same distance agree, and between two distances there is one clean change.
  const double wanted = std::max(1.0, narrowest_units * static_cast<double>(metres_per_unit) / width_on_the_ground_m);
  const int halvings = std::ilogb(wanted);
  const double width = width_on_the_ground_m * std::ldexp(1.0, std::ldexp(1.0, halvings) < wanted ? halvings + 1 : halvings);
  const double length = longest_share * width;
  // Rows follow no compass: they turn over some kilometres.
  const double turn = 0.9 * gaussian_noise(seed + 25, east_m, north_m, 2600.0);
  const double along = east_m - 0.35 * north_m + 0.5 * length * turn;
  const double across = north_m + 0.25 * east_m + 1.5 * width * turn;
  const double row = std::floor(across / width);
  // Strips of a row are shifted against those of the next and differ in length.
  const double shifted = along / length + random_uniform(seed + 26, static_cast<std::int64_t>(row), 0);
  const double cell = std::floor(shifted);
  const auto i = static_cast<std::int64_t>(cell);
  const auto j = static_cast<std::int64_t>(row);
  const double cut = 0.3 + 0.4 * random_uniform(seed + 27, i, j);  // each cell is halved unevenly
  const double place = shifted - cell;
  const bool first = place < cut;
  const double to_end = first ? std::min(place, cut - place) : std::min(place - cut, 1.0 - place);
  const double v = across / width - row;
  Parcel parcel;
  parcel.crop = static_cast<float>(random_uniform(seed + 24, 2 * i + (first ? 0 : 1), j) - 0.5);
  parcel.border_m = static_cast<float>(std::min(to_end * length, std::min(v, 1.0 - v) * width));
  parcel.width_m = static_cast<float>(width);
  parcel.hedged = random_uniform(seed + 28, i, j) < 0.4;
  return parcel;
}

}  // namespace belvedere
