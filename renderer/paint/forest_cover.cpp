#include "renderer/paint/forest_cover.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <map>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/ground/slope_walk.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

constexpr double step_units = 2.0;  // of a walk along the fall line
constexpr int steps_up = 32;        // maximum run of an avalanche
constexpr int steps_down = 12;      // with as many steps up: the length of lanes
constexpr double lane_sigma_units = 2.0;
constexpr double glade_sigma_units = 9.0;
constexpr double clump_sigma_units = 4.5;
constexpr double track_sigma_units = 3.0;
constexpr double stand_sigma_units = 20.0;
constexpr double settled_sigma_units =
    45.0;  // neighbourhoods that were cleared, and others left wooded
constexpr double frayed_sigma_units = 1.6;  // of the edges of glades and tracks
constexpr float ragged_steps =
    2.0F;  // how much farther a track reaches per deviation of that noise
constexpr double high_grass_m = 1600.0;  // above this, glades have the grass of high ground

// Noise that is fixed to the ground and still has patches of one size on the sheet: a mixture of
// the two octaves next to the requested size, with deviation 1. Caches lattice values: use one per
// thread.
class SheetSizedNoise {
 public:
  SheetSizedNoise(std::uint64_t seed, Stream stream) : seed_(seed), stream_(stream) {}
  float operator()(double x_m, double y_m, double sigma_m) {
    const double octave = exact::log2(std::max(sigma_m, 1e-3));
    const auto below = static_cast<int>(std::floor(octave));
    const double share = octave - below;
    return static_cast<float>(std::sqrt(1.0 - share)) * of(below)(x_m, y_m) +
           static_cast<float>(std::sqrt(share)) * of(below + 1)(x_m, y_m);
  }

 private:
  GroundNoise& of(int octave) {
    const auto part = static_cast<std::uint64_t>(octave + lowest_octave);
    return octaves_.try_emplace(octave, stream_seed(seed_, stream_, part), std::ldexp(1.0, octave))
        .first->second;
  }
  static constexpr int lowest_octave = 64;  // patches of 2^-64 m are the smallest
  std::uint64_t seed_;
  Stream stream_;
  std::map<int, GroundNoise> octaves_;
};

}  // namespace

ForestCover make_forest_cover(const GuidanceBuffers& g, const WideView& wide,
                              const ForestCoverParameters& parameters, glm::ivec2 origin_px,
                              PixelRect wanted) {
  using B = GuidanceBuffers;
  require_channels(g,
                   {&B::depth_m, &B::position_m, &B::land_cover, &B::fall_line, &B::slope_deg,
                    &B::footprint_m, &B::relief_s_m, &B::relief_m_m, &B::valley_height_m},
                   "forest");
  const int width = g.width();
  const int height = g.height();
  if (wanted.empty()) wanted = {0, 0, width, height};
  const double ppu = parameters.pixels_per_unit;
  const Grid<float> noise = make_image_noise(stream_seed(parameters.seed, Stream::forest_lanes),
                                             wide.origin_px, wide.seen.width(), wide.seen.height(),
                                             ppu / wide.factor, lane_sigma_units, lane_sigma_units);
  const auto step_px = static_cast<float>(step_units * ppu);
  // Deviation of the sum of 25 samples of that noise, 2 units apart: autocorrelation exp(-1/4) for
  // neighbours, exp(-1) for the next.
  constexpr float lane_deviation = 9.2F;
  ForestCover cover{Grid<float>(width, height, 0.0F), Grid<float>(width, height, 0.0F)};
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 + row;
    SheetSizedNoise glades(parameters.seed, Stream::forest_glades);
    SheetSizedNoise clumps(parameters.seed, Stream::forest_clumps);
    SheetSizedNoise tracks(parameters.seed, Stream::forest_tracks);
    SheetSizedNoise stands(parameters.seed, Stream::forest_stands);
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      const std::size_t i = g.depth_m.index(x, y);
      if (g.land_cover[i] != Class::forest) continue;
      const double metres = static_cast<double>(g.footprint_m[i]) * ppu;
      const glm::dvec3 position = glm::dvec3(g.position_m[i]) + g.origin_m;
      const float slope = g.slope_deg[i];
      const SlopeStart start{origin_px + glm::ivec2(x, y), g.fall_line[i], g.depth_m[i]};
      const SlopeWalk up =
          walk_slope(wide, noise, start, Class::forest, {step_px, -1.0F, steps_up, steps_down});
      const SlopeWalk down =
          walk_slope(wide, noise, start, Class::forest, {step_px, 1.0F, steps_down, steps_down});
      const float clump = clumps(position.x, position.y, clump_sigma_units * metres);
      const float lane =
          (noise[wide.index(start.sheet_px.x, start.sheet_px.y)] + up.noise_sum + down.noise_sum) /
          lane_deviation;

      const float steep = smoothstep(22.0F, 38.0F, slope);
      const float resolved = glades(position.x, position.y, settled_sigma_units * metres);
      const float frayed = clumps(position.x, position.y, frayed_sigma_units * metres);
      // Glades lie on shoulders, along the valley floor and, drawn out down the fall line, on steep
      // ground; not in gullies. They are frequent where people lived and otherwise absent for
      // miles.
      const float shoulder = std::clamp(g.relief_m_m[i] / 45.0F, -0.7F, 1.0F) *
                             (1.0F - smoothstep(14.0F, 30.0F, slope));
      const float floor = (1.0F - smoothstep(40.0F, 150.0F, g.valley_height_m[i])) *
                          (1.0F - smoothstep(8.0F, 18.0F, slope));
      const float site = 0.75F * shoulder + 0.55F * floor +
                         0.30F * std::clamp(g.relief_s_m[i] / 10.0F, -1.0F, 0.4F) +
                         0.40F * lane * steep - 0.035F * std::max(slope - 20.0F, 0.0F);
      const float glade_noise = 0.72F * glades(position.x, position.y, glade_sigma_units * metres) +
                                0.40F * clump + 0.16F * frayed + 0.62F * resolved + site;
      float glade = smoothstep(1.46F, 1.60F, glade_noise);
      float thin = 0.0F;
      if (up.left_after > 0.0F && has_trait(wide.seen.land_cover[up.end], ClassTrait::open_high)) {
        // The treeline is frayed: groups of trees reach up into the open, gaps reach down.
        const float nearness = 1.0F - up.left_after / 14.0F;
        if (nearness > 0.0F) thin = nearness * std::clamp(0.62F - 0.45F * clump, 0.1F, 1.0F);
        // All pixels below one gap of the treeline belong to one track, straight down to where the
        // slope or the avalanche's force ends.
        const glm::dvec3 head = glm::dvec3(place_left(wide, start, up)) + g.origin_m;
        const float force =
            tracks(head.x, head.y, track_sigma_units * metres) + 0.02F * (slope - 28.0F);
        const float reach = 14.0F * (force - 0.75F);  // steps
        if (slope > 18.0F)
          glade = std::max(glade,
                           smoothstep(-0.5F, 1.5F, reach - up.left_after + ragged_steps * frayed));
      }
      // Whole stands differ in density; on steep ground some have lanes.
      const float stand = stands(position.x, position.y, stand_sigma_units * metres);
      const float open_stand = smoothstep(0.2F, 1.6F, stand);
      const float bare_lane =
          smoothstep(0.9F, 1.5F, -lane - 0.25F * clump) * steep * smoothstep(0.1F, 1.0F, -stand);
      const float hollow = std::clamp(-g.relief_s_m[i] / 10.0F, -1.0F, 1.0F);
      float density = 0.93F + 0.14F * hollow + 0.42F * std::clamp(clump + 0.15F, -2.2F, 0.4F);
      density = std::clamp(density, 0.16F, 1.0F) * (1.0F - 0.62F * open_stand) * (1.0F - thin) *
                (1.0F - 0.92F * bare_lane) * (1.0F - glade);
      cover.density[i] = std::clamp(density, 0.0F, 1.0F);
      cover.glade[i] = std::max(glade, 0.35F * bare_lane);
    }
  });
  return cover;
}

int forest_cover_margin_px(double pixels_per_unit) {
  return static_cast<int>(std::ceil(steps_up * step_units * pixels_per_unit)) + steps_up;
}

glm::vec3 glade_colour(const Palette& palette, double altitude_m, double light) {
  return palette_colour(palette, altitude_m > high_grass_m ? Class::alpine_grass : Class::pasture,
                        altitude_m, light - 0.06);
}

float bush_density(Class id, float wood, const Patches& p) {
  if (id == Class::alpine_grass)
    return std::clamp(0.75F * wood + 0.06F * p.n3 * (wood > 0.02F ? 1.0F : 0.0F), 0.0F, 0.35F);
  if (id == Class::shrub) return std::clamp(0.45F + 0.22F * p.n8 + 0.12F * p.n3, 0.1F, 0.85F);
  return 0.0F;
}

}  // namespace belvedere
