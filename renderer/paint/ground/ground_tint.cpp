#include "renderer/paint/ground/ground_tint.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/trace/guidance_ground.h"

namespace belvedere {
namespace {

constexpr double open_tone =
    0.6;  // tone of level ground in the sun: here a ramp has the ground's colour
constexpr double max_change =
    2.5;  // max factor on lightness, up or down: beyond it the result is no longer a paint colour
constexpr int collar_cells =
    32;  // distance from a window's edge to where its own colours apply fully
constexpr int lightness_samples = 192;  // across and down

// Weighted sums of colours; the weight is how well each is known.
struct Mean {
  glm::vec4 sum{0.F};  // colour times weight, 0…255; weight
  void add(const GroundColour& colour, float weight) {
    weight *= static_cast<float>(colour.a) / 255.F;
    sum += weight * glm::vec4(static_cast<float>(colour.r), static_cast<float>(colour.g),
                              static_cast<float>(colour.b), 1.F);
  }
  glm::vec3 colour() const { return sum.w > 0.F ? glm::vec3(sum) / sum.w : glm::vec3(0.F); }
};

Grid<GroundColour> halved(const Grid<GroundColour>& fine) {
  Grid<GroundColour> out((fine.width() + 1) / 2, (fine.height() + 1) / 2);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      Mean mean;
      for (int k = 0; k < 4; ++k) mean.add(fine.clamped(2 * x + k % 2, 2 * y + k / 2), 0.25F);
      const glm::vec3 colour = mean.colour() + 0.5F;
      out(x, y) =
          GroundColour(static_cast<std::uint8_t>(colour.r), static_cast<std::uint8_t>(colour.g),
                       static_cast<std::uint8_t>(colour.b),
                       static_cast<std::uint8_t>(255.F * mean.sum.w + 0.5F));
    }
  });
  return out;
}

GroundTint::Ground make_ground(const TerrainModel& model, const PixelRect& part) {
  GroundTint::Ground ground{&model, part, {}};
  ground.means.push_back(model.land_cover->colours.cells);
  while (std::max(ground.means.back().width(), ground.means.back().height()) > 1)
    ground.means.push_back(halved(ground.means.back()));
  return ground;
}

// Interpolates between four values of a level; positions are in cells of the finest.
glm::vec4 sample(const Grid<GroundColour>& means, int level, glm::dvec2 cell) {
  const glm::dvec2 at = (cell + 0.5) / std::ldexp(1.0, level) - 0.5;
  const double x0 = std::floor(at.x);
  const double y0 = std::floor(at.y);
  const auto fx = static_cast<float>(at.x - x0);
  const auto fy = static_cast<float>(at.y - y0);
  const int x = static_cast<int>(std::clamp(x0, -1.0, static_cast<double>(means.width())));
  const int y = static_cast<int>(std::clamp(y0, -1.0, static_cast<double>(means.height())));
  Mean mean;
  mean.add(means.clamped(x, y), (1.F - fx) * (1.F - fy));
  mean.add(means.clamped(x + 1, y), fx * (1.F - fy));
  mean.add(means.clamped(x, y + 1), (1.F - fx) * fy);
  mean.add(means.clamped(x + 1, y + 1), fx * fy);
  return {mean.colour() / 255.F, mean.sum.w};
}

// The origin of displaced ground, which also gives its class.
glm::dvec2 origin_m(const TerrainModel& model, glm::dvec2 position_m) {
  const glm::dvec2 seen = model.dem->transform.to_cell(position_m.x, position_m.y);
  const glm::dvec2 origin = origin_of(model, seen.x, seen.y);
  return model.dem->transform.to_crs(origin.x, origin.y);
}

glm::vec4 colour_of(const GroundTint::Ground& ground, glm::dvec2 position_m, double footprint_m) {
  const TerrainModel& model = *ground.model;
  const glm::dvec2 position = origin_m(model, position_m);
  const GeoTransform& transform = model.land_cover->colours.transform;
  const glm::dvec2 cell = transform.to_cell(position.x, position.y);
  const double cells = footprint_m / std::sqrt(transform.cell_x * transform.cell_y);
  const double depth = std::clamp(exact::log2(std::max(cells, 1.0)), 0.0,
                                  static_cast<double>(ground.means.size() - 1));
  const int level = std::min(static_cast<int>(depth), static_cast<int>(ground.means.size()) - 2);
  if (level < 0) return sample(ground.means[0], 0, cell);
  const auto k = static_cast<std::size_t>(level);
  return glm::mix(sample(ground.means[k], level, cell),
                  sample(ground.means[k + 1], level + 1, cell), static_cast<float>(depth - level));
}

// Weight of a window's own colours at a position: 0 at its edge and outside, 1 inside.
float window_share(const GroundTint::Ground& ground, glm::dvec2 position_m) {
  const glm::dvec2 cell = ground.model->dem->transform.to_cell(position_m.x, position_m.y);
  const PixelRect& part = ground.part;
  const double inside = std::min(std::min(cell.x - part.x0, part.x1 - 1 - cell.x),
                                 std::min(cell.y - part.y0, part.y1 - 1 - cell.y));
  return static_cast<float>(smoothstep(inside / collar_cells));
}

// Factor that makes the mean lightness of the colours equal to the palette's, over evenly spread
// positions.
double mean_lightness(const TerrainModel& terrain, const Palette& palette) {
  const Raster<GroundColour>& colours = terrain.land_cover->colours;
  const int across = std::min(lightness_samples, colours.cells.width());
  const int down = std::min(lightness_samples, colours.cells.height());
  double painted = 0.0;
  double own = 0.0;
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      const int x = static_cast<int>((2LL * i + 1) * colours.cells.width() / (2LL * across));
      const int y = static_cast<int>((2LL * j + 1) * colours.cells.height() / (2LL * down));
      const GroundColour& colour = colours.cells(x, y);
      const glm::dvec2 position = colours.transform.to_crs(x, y);
      const glm::dvec2 cell = terrain.dem->transform.to_cell(position.x, position.y);
      const LandCoverClass id = terrain.land_cover->at(position.x, position.y);
      if (colour.a == 0 || id == LandCoverClass::sky || id == LandCoverClass::water) continue;
      const double altitude = terrain.dem->altitude_m.clamped(
          static_cast<int>(std::lround(cell.x)), static_cast<int>(std::lround(cell.y)));
      painted += to_oklab(palette_colour(palette, id, altitude, open_tone)).x;
      own += to_oklab(glm::vec3(colour.r, colour.g, colour.b) / 255.F).x;
    }
  return own > 0.0 ? painted / own : 1.0;
}

}  // namespace

std::shared_ptr<const GroundTint> make_ground_tint(const TerrainModel& terrain,
                                                   const Palette& palette, double share) {
  if (terrain.land_cover->colours.cells.empty() || !(share > 0.0)) return nullptr;
  GroundTint tint;
  tint.share = share;
  tint.lightness = mean_lightness(terrain, palette);
  tint.grounds.push_back(make_ground(terrain, {}));
  for (const TerrainWindow& window : terrain.windows)
    if (!window.ground.land_cover->colours.cells.empty())
      tint.grounds.push_back(make_ground(window.ground, window.part));
  return std::make_shared<const GroundTint>(std::move(tint));
}

glm::vec4 ground_colour_at(const GroundTint& tint, glm::dvec2 position_m, double footprint_m) {
  glm::vec4 colour = colour_of(tint.grounds.front(), position_m, footprint_m);
  for (std::size_t k = 1; k < tint.grounds.size(); ++k) {
    const float share = window_share(tint.grounds[k], position_m);
    if (share > 0.F)
      colour = glm::mix(colour, colour_of(tint.grounds[k], position_m, footprint_m), share);
  }
  return colour;
}

float lake_depth_at(const GroundTint& tint, glm::dvec2 position_m) {
  // The finest ground that contains the position. Where a window begins it has the depths of the
  // ground around it.
  std::size_t k = tint.grounds.size() - 1;
  while (k > 0 && !(window_share(tint.grounds[k], position_m) > 0.F)) --k;
  const TerrainModel& model = *tint.grounds[k].model;
  const glm::dvec2 origin = origin_m(model, position_m);
  return model.land_cover->relief.depth_at(origin.x, origin.y);
}

glm::vec3 TintShift::over(glm::vec3 ramp) const {
  if (!(share > 0.F)) return ramp;
  const glm::dvec3 lab = to_oklab(ramp);
  const glm::dvec2 hue =
      factor * glm::dvec2(lab.y, lab.z) + chroma * std::min(lab.x / reference_l, 1.0);
  return glm::mix(ramp, glm::clamp(from_oklab({factor * lab.x, hue.x, hue.y}), 0.F, 1.F), share);
}

TintShift tint_shift(const GroundTint& tint, const Palette& palette, LandCoverClass id,
                     double altitude_m, glm::dvec3 position_m, double footprint_m) {
  const glm::vec4 colour = ground_colour_at(tint, glm::dvec2(position_m), footprint_m);
  TintShift shift;
  shift.share = colour.w * static_cast<float>(tint.share);
  if (!(shift.share > 0.F)) return shift;
  const glm::dvec3 reference = to_oklab(palette_colour(palette, id, altitude_m, open_tone));
  const glm::dvec3 own = tint.lightness * to_oklab(glm::vec3(colour));
  shift.reference_l = std::max(reference.x, 0.01);
  shift.factor = std::clamp(own.x / shift.reference_l, 1.0 / max_change, max_change);
  shift.chroma = glm::dvec2(own.y, own.z) - shift.factor * glm::dvec2(reference.y, reference.z);
  return shift;
}

namespace {

constexpr double n3_sigma_m = 60.0;
constexpr double n8_sigma_m = 210.0;
constexpr double n25_sigma_m = 660.0;
constexpr double n60_sigma_m = 1800.0;

// 1 where `size_m` covers two units of the sheet or more, 0 where it covers less than 2/3.
float visible(float size_m, float metres_per_unit) { return unit(1.5F - metres_per_unit / size_m); }

// > 0 shifts towards ripe yellow, < 0 towards green.
float ripeness(LandCoverClass id, const Patches& p) {
  const ClassRipeness& by = class_info(id).hue.ripeness;
  return by.n8 * p.n8 + by.n3 * p.n3 + by.n25 * p.n25 + by.mean;
}

// Added to the ripeness of high grass.
float dryness(LandCoverClass id, float relief_s_m) {
  if (!has_trait(id, ClassTrait::bleaches)) return 0.0F;
  const float relief = std::clamp(relief_s_m / 12.0F, -1.0F, 1.0F);
  return (relief > 0.0F ? 0.16F : 0.24F) * relief;
}

}  // namespace

GroundNoises::GroundNoises(std::uint64_t seed)
    : n3(stream_seed(seed, Stream::ground_patches, 0), n3_sigma_m),
      n8(stream_seed(seed, Stream::ground_patches, 1), n8_sigma_m),
      n25(stream_seed(seed, Stream::ground_patches, 2), n25_sigma_m),
      n60(stream_seed(seed, Stream::ground_patches, 3), n60_sigma_m) {}

Patches patches_at(GroundNoises& noises, glm::dvec3 position_m, float metres_per_unit) {
  Patches p{};
  p.n3 = noises.n3(position_m.x, position_m.y) *
         visible(static_cast<float>(n3_sigma_m), metres_per_unit);
  p.n8 = noises.n8(position_m.x, position_m.y) *
         visible(static_cast<float>(n8_sigma_m), metres_per_unit);
  p.n25 = noises.n25(position_m.x, position_m.y);
  p.n60 = noises.n60(position_m.x, position_m.y);
  return p;
}

glm::vec3 grass_shift(LandCoverClass id, const Patches& patches, float relief_s_m) {
  const float shift = ripeness(id, patches) + dryness(id, relief_s_m);
  // Ripe grass is yellow, fresh grass green, not blue.
  return (shift > 0.0F ? glm::vec3(0.11F, 0.02F, -0.10F) : glm::vec3(0.10F, 0.01F, 0.02F)) * shift;
}

glm::vec3 hue_drift(LandCoverClass id, const Patches& p, const Palette& palette, float strength) {
  glm::vec3 factor(1.0F);
  if (has_trait(id, ClassTrait::drifts)) {
    const float drift = std::clamp(0.7F * p.n60 + 0.5F * p.n25, -2.0F, 2.0F) *
                        static_cast<float>(palette.ground_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.035F, 0.02F, -0.03F) * drift;
  }
  if (id == LandCoverClass::rock) {
    const float drift = std::clamp(0.6F * p.n25 + 0.4F * p.n8, -1.0F, 1.6F) *
                        static_cast<float>(palette.rock_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.042F, 0.0F, -0.045F) * drift;
  }
  if (id == LandCoverClass::forest) {
    const float drift = std::clamp(0.7F * p.n25 + 0.5F * p.n8, -1.5F, 1.5F) *
                        static_cast<float>(palette.forest_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.07F, 0.01F, -0.05F) * drift;
  }
  return factor;
}

glm::vec3 near_snow_hue(float tone, float slope_deg, float close) {
  const float lit = smoothstep(0.55F, 0.90F, tone);
  const float shade = 1.0F - smoothstep(0.25F, 0.50F, tone);
  const float steep = std::clamp((slope_deg - 26.0F) / 20.0F, -1.0F, 1.0F);
  return 1.0F + close * (lit * glm::vec3(0.008F, 0.0F, -0.022F) +
                         shade * steep * glm::vec3(0.045F, -0.02F, 0.0F));
}

namespace {

using Class = LandCoverClass;

// Factors on the ramps of grass (encoded sRGB), which are a warm yellow-green.
constexpr glm::vec3 lush_hue{0.82F, 0.95F, 0.79F};
constexpr glm::vec3 dry_hue{1.06F, 0.99F, 0.93F};
constexpr glm::vec3 high_hue{0.935F, 0.915F, 0.81F};

constexpr float sunny_gain =
    2.0F;  // a slope of 30° on the smoothed, exaggerated ground counts fully

// How strongly moisture and dryness affect a class: fields have their own hues, heath is always
// dry.
float reach(Class id) {
  if (id == Class::shrub) return 0.55F;
  if (has_trait(id, ClassTrait::bleaches)) return 1.0F;
  return id == Class::valley_floor ? 0.7F : 0.0F;
}

}  // namespace

MeadowPosition meadow_position(const GuidanceBuffers& g, std::size_t i, double treeline_m,
                               float sunny_side) {
  MeadowPosition position;
  position.slope_deg = g.slope_deg[i];
  position.sunny = std::clamp(-sunny_gain * sunny_side * g.normal_smooth[i].y, -1.0F, 1.0F);
  position.relief_s_m = g.relief_s_m[i];
  position.relief_m_m = g.relief_m_m[i];
  position.valley_height_m = g.valley_height_m[i];
  position.above_treeline_m = g.altitude_m[i] - static_cast<float>(treeline_m);
  return position;
}

MeadowMix meadow_mix(Class id, const MeadowPosition& position, const Patches& patches) {
  const float reached = reach(id);
  if (!(reached > 0.0F)) return {};
  // Hollows and the feet of slopes are wet, shoulders and ridges dry; noise shifts whole patches of
  // some hundred metres. A valley floor is all hollow: only small forms count there.
  const float broad =
      id == Class::valley_floor ? 0.0F : std::clamp(position.relief_m_m / 40.0F, -1.0F, 1.0F);
  const float hollow = -0.45F * broad - 0.30F * std::clamp(position.relief_s_m / 9.0F, -1.0F, 1.0F);
  const float chance = 0.24F * patches.n25 + 0.20F * patches.n60 + 0.10F * patches.n8;
  const float moisture = hollow - 0.55F * position.sunny + chance;
  const float turf = smoothstep(
      -150.0F, 450.0F, position.above_treeline_m + 110.0F * patches.n25 + 60.0F * patches.n8);
  MeadowMix mix;
  mix.lush = reached * smoothstep(0.02F, 0.70F, moisture) * (1.0F - 0.25F * turf);
  mix.dry = reached * smoothstep(0.02F, 0.75F, -moisture) * (1.0F - 0.45F * turf);
  if (id == Class::alpine_grass || id == Class::pasture) mix.high = turf;
  if (id == Class::pasture)
    mix.mown = (1.0F - smoothstep(9.0F, 17.0F, position.slope_deg)) *
               (1.0F - smoothstep(70.0F, 170.0F, position.valley_height_m + 35.0F * patches.n25)) *
               (1.0F - smoothstep(-650.0F, -350.0F, position.above_treeline_m));
  return mix;
}

glm::vec3 meadow_hue(const MeadowMix& mix, float strength) {
  glm::vec3 factor = glm::mix(glm::vec3(1.0F), high_hue, mix.high);
  factor *= glm::mix(glm::vec3(1.0F), lush_hue, mix.lush);
  factor *= glm::mix(glm::vec3(1.0F), dry_hue, mix.dry);
  return glm::max(1.0F + (factor - 1.0F) * strength, glm::vec3(0.3F));
}

ForestTurn forest_turn(float relief_s_m, float relief_m_m, float light, const Patches& patches,
                       float strength) {
  const float centre = std::clamp(relief_m_m / 45.0F, -1.0F, 1.0F);
  const float small = std::clamp(relief_s_m / 9.0F, -1.0F, 1.0F);
  const float rib = std::clamp(0.60F * centre + 0.45F * small + 0.12F * patches.n25, -1.0F, 1.0F);
  ForestTurn turn;
  turn.tone = 0.11F * rib * strength *
              (rib < 0.0F ? 0.15F + 0.85F * smoothstep(0.08F, 0.45F, light) : 1.0F);
  const glm::vec3 hue =
      rib > 0.0F ? glm::vec3(0.055F, 0.030F, -0.055F) : glm::vec3(0.09F, 0.05F, -0.03F);
  turn.factor = 1.0F + hue * (rib * strength);
  return turn;
}

}  // namespace belvedere
