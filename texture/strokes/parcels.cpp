#include "texture/strokes/parcels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr double width_on_the_ground_m = 90.0;
constexpr double narrowest_units = 8.0;  // on the sheet, before foreshortening of the valley floor
constexpr double block_widths = 7.0;
constexpr double undivided_share = 0.30;  // of the blocks: hay meadow
constexpr double strips_share = 0.45;     // of the blocks: long strips; the rest are large fields
constexpr float min_grain =
    0.12F;  // below this, nothing nearby determines the orientation of fields
constexpr double angle_step = 0.3927;  // rad, 22.5°: in a block all fields have one direction

// The block of a position, and the distance to the next block.
struct BlockPosition {
  std::int64_t i, j;
  glm::dvec2 from_centre_m;
  double border_m;
};

BlockPosition find_block(std::uint64_t seed, glm::dvec2 position, double size) {
  const auto ci = static_cast<std::int64_t>(std::floor(position.x / size));
  const auto cj = static_cast<std::int64_t>(std::floor(position.y / size));
  const std::uint64_t key = stream_seed(seed, Stream::field_blocks);
  glm::dvec2 centres[9];
  int nearest = 0;
  for (int k = 0; k < 9; ++k) {
    const std::int64_t i = ci + k % 3 - 1;
    const std::int64_t j = cj + k / 3 - 1;
    const double u = 0.12 + 0.76 * random_uniform(key, i, j, 0);
    const double v = 0.12 + 0.76 * random_uniform(key, i, j, 1);
    centres[k] = (glm::dvec2(i, j) + glm::dvec2(u, v)) * size;
    if (glm::length(position - centres[k]) < glm::length(position - centres[nearest])) nearest = k;
  }
  BlockPosition block{ci + nearest % 3 - 1, cj + nearest / 3 - 1, position - centres[nearest], 1e9};
  for (int k = 0; k < 9; ++k) {
    if (k == nearest) continue;
    const glm::dvec2 between = centres[k] - centres[nearest];
    const double length = glm::length(between);
    block.border_m =
        std::min(block.border_m, 0.5 * length - glm::dot(block.from_centre_m, between) / length);
  }
  block.border_m = std::max(0.0, block.border_m);
  return block;
}

// Parts 0…count of unit length, divided unevenly in pairs: the part, the distance from its ends,
// and its length.
struct Part {
  std::int64_t number;
  double to_end;
};
Part uneven_part(double position, std::uint64_t key, std::int64_t row) {
  const double pair = std::floor(0.5 * position);
  const auto p = static_cast<std::int64_t>(pair);
  const double cut = 2.0 * (0.32 + 0.36 * random_uniform(key, p, row));
  const double within = position - 2.0 * pair;
  const bool first = within < cut;
  return {2 * p + (first ? 0 : 1),
          first ? std::min(within, cut - within) : std::min(within - cut, 2.0 - within)};
}

Crop sow_crop(double green, double u, double v) {
  if (u < green)
    return v < 0.40   ? Crop::hay
           : v < 0.72 ? Crop::grass
           : v < 0.86 ? Crop::clover
                      : Crop::aftermath;
  return v < 0.20   ? Crop::aftermath
         : v < 0.52 ? Crop::ripe
         : v < 0.77 ? Crop::stubble
                    : Crop::ploughed;
}

// Lit meadow on the valley floor is warm and pale (summer's ramp); these factors turn it into the
// crop.
constexpr std::array<glm::vec3, crop_count> colours = {{
    {0.84F, 0.91F, 0.80F},  // hay: fresh and light
    {0.76F, 0.86F, 0.74F},  // grass
    {0.67F, 0.80F, 0.70F},  // clover: dark
    {0.93F, 0.96F, 0.84F},  // aftermath: mown, yellow-green
    {1.05F, 0.98F, 0.82F},  // ripe
    {1.05F, 1.01F, 1.10F},  // stubble: pale
    {0.86F, 0.70F, 0.76F},  // ploughed: red-brown
}};

}  // namespace

Parcel parcel_at(std::uint64_t seed, double east_m, double north_m, float metres_per_unit,
                 glm::vec2 grain) {
  // Powers of two: neighbours at the same distance agree, and between two distances there is one
  // clean change.
  const double min_factor =
      std::max(1.0, narrowest_units * static_cast<double>(metres_per_unit) / width_on_the_ground_m);
  const int halvings = std::ilogb(min_factor);
  const double width =
      width_on_the_ground_m *
      std::ldexp(1.0, std::ldexp(1.0, halvings) < min_factor ? halvings + 1 : halvings);
  // Borders of blocks are bent, like lanes.
  const double bend =
      0.5 * width *
      gaussian_noise(stream_seed(seed, Stream::field_bends), east_m, north_m, 4.0 * width);
  const BlockPosition block =
      find_block(seed, {east_m + bend, north_m - bend}, block_widths * width);
  const std::uint64_t kinds = stream_seed(seed, Stream::field_kinds);
  const auto chance = [&](std::uint64_t draw) {
    return random_uniform(kinds, block.i, block.j, draw);
  };
  const double kind = chance(0);
  const double green = 0.55 + 0.45 * chance(1);
  Parcel parcel;
  parcel.width_m = static_cast<float>(width);
  parcel.lane_m = static_cast<float>(block.border_m);
  parcel.hedged = chance(2) < 0.45;
  if (kind < undivided_share) {
    parcel.crop = chance(3) < 0.6 ? Crop::hay : chance(4) < 0.6 ? Crop::grass : Crop::aftermath;
    parcel.shade = static_cast<float>(2.0 * chance(5) - 1.0);
    parcel.border_m = parcel.lane_m;
    return parcel;
  }
  const bool strips = kind < undivided_share + strips_share;
  // Most follow the river, the road or the foot of the slope, some are perpendicular.
  double angle = 6.2832 * chance(6);
  if (glm::length(grain) > min_grain)
    angle = angle_step *
                std::round(
                    0.5 * exact::atan2(static_cast<double>(grain.y), static_cast<double>(grain.x)) /
                    angle_step) +
            0.18 * (chance(6) - 0.5);
  if (chance(7) < 0.2) angle += 1.5708;
  const exact::Turn turn = exact::turn(angle);
  const glm::dvec2 along{turn.cosine, turn.sine};
  const double length = width * (strips ? 3.0 + 2.5 * chance(8) : 2.2);
  const double breadth = width * (strips ? 0.75 + 0.35 * chance(9) : 1.6);
  const double u = glm::dot(block.from_centre_m, along) / length;
  const double v = (block.from_centre_m.y * along.x - block.from_centre_m.x * along.y) / breadth;
  const std::uint64_t borders = stream_seed(seed, Stream::field_borders);
  const auto block_key = [&](std::uint64_t draw) {
    return random_bits(borders, block.i, block.j, draw);
  };
  const Part row = uneven_part(v, block_key(0), 0);
  // Strips of a row are offset against those of the next.
  const Part cell =
      uneven_part(u + 2.0 * random_uniform(block_key(1), row.number, 0), block_key(2), row.number);
  parcel.border_m =
      static_cast<float>(std::min({block.border_m, row.to_end * breadth, cell.to_end * length}));
  const std::uint64_t crops = block_key(3);
  const auto own = [&](std::uint64_t draw) {
    return random_uniform(crops, cell.number, row.number, draw);
  };
  parcel.crop = sow_crop(green, own(0), own(1));
  parcel.shade = static_cast<float>(2.0 * own(2) - 1.0);
  return parcel;
}

float village_share(float metres_per_unit) {
  return smoothstep(0.5F, 1.F, metres_per_unit) * (1.F - smoothstep(14.F, 20.F, metres_per_unit));
}

glm::vec3 crop_colour(Crop crop) { return colours[static_cast<std::size_t>(crop)]; }

// Undivided: .6 hay, .24 grass, .16 aftermath; else sow_crop with a green share of .775 on average.
glm::vec3 mean_crop_colour() {
  constexpr std::array<float, crop_count> shares = {0.397F, 0.246F, 0.076F, 0.155F,
                                                    0.050F, 0.040F, 0.036F};
  glm::vec3 mean(0.F);
  for (std::size_t k = 0; k < crop_count; ++k) mean += shares[k] * colours[k];
  return mean;
}

}  // namespace belvedere
