#include "renderer/style/fit/separate_classes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "base/math_exact.h"
#include "base/statistics.h"
#include "renderer/style/fit/class_ramps.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr std::array<ClassPair, 18> pairs = {{{forest, pasture, 0.13},
                                              {forest, alpine_grass, 0.13},
                                              {forest, valley_floor, 0.14},
                                              {forest, shrub, 0.07},
                                              {rock, forest, 0.14},
                                              {rock, alpine_grass, 0.085},
                                              {rock, pasture, 0.085},
                                              {rock, scree, 0.05},
                                              {scree, alpine_grass, 0.06},
                                              {snow, rock, 0.13},
                                              {snow, scree, 0.11},
                                              {snow, alpine_grass, 0.13},
                                              {water, valley_floor, 0.12},
                                              {water, pasture, 0.10},
                                              {settlement, valley_floor, 0.08},
                                              {pasture, alpine_grass, 0.03},
                                              {pasture, valley_floor, 0.03},
                                              {water, forest, 0.12}}};
constexpr std::array<std::size_t, 2> told_at = {1, 2};  // indices of ramp_tones

constexpr double strength_step = 0.05;
constexpr double strong_share = 0.93;     // quantile of chroma that counts as strong at a lightness
constexpr double over_strong = 0.2;       // share of the excess above it that is kept
constexpr double colourful_share = 0.80;  // quantile of the ground's chroma

double wanted_distance(const ClassPair& pair, std::size_t k, const ClassRamps& reference,
                       const SeparateParameters& parameters) {
  return std::min(pair.distance,
                  parameters.reference_share *
                      glm::length(reference[index_of(pair.a)][k] - reference[index_of(pair.b)][k]));
}

ClassRamps with_chroma(ClassRamps ramps, double gain) {
  for (LabRamp& ramp : ramps)
    for (glm::dvec3& colour : ramp) {
      colour.y *= gain;
      colour.z *= gain;
    }
  return ramps;
}

// Mean chroma of a typical panorama at the middle tones.
double mean_chroma(const ClassRamps& ramps) {
  double sum = 0.0;
  for (std::size_t c = 1; c < ramps.size(); ++c)
    sum += area_shares[c] * 0.5 * (chroma(ramps[c][1]) + chroma(ramps[c][2]));
  return sum;
}

// Chroma of the painting's strong colours by lightness, at the knots of the law of light.
class StrongChroma {
 public:
  explicit StrongChroma(const std::vector<glm::vec3>& every) {
    std::array<double, LightLaw::knot_count> raw{};
    for (int i = 0; i < LightLaw::knot_count; ++i) {
      std::vector<double> near;
      for (const glm::vec3& texel : every)
        if (std::abs(static_cast<double>(texel.x) - LightLaw::knot(i)) < 0.07)
          near.push_back(chroma(texel));
      raw[static_cast<std::size_t>(i)] =
          near.size() > 50 ? value_at_share(std::move(near), strong_share) : 0.02;
    }
    for (int i = 0; i < LightLaw::knot_count; ++i) {  // Gaussian of one knot, ends repeated
      double sum = 0.0;
      double weight = 0.0;
      for (int d = -4; d <= 4; ++d) {
        const double w = exact::exp(-0.5 * d * d);
        sum += w * raw[static_cast<std::size_t>(std::clamp(i + d, 0, LightLaw::knot_count - 1))];
        weight += w;
      }
      law_.hue[static_cast<std::size_t>(i)] = {sum / weight, 0.0};
    }
  }
  double at(double lightness) const { return law_.at(lightness).x; }

 private:
  LightLaw law_;
};

// One pass; returns whether anything moved.
bool give_way(ClassRamps& ramps, const ClassFlags& seen, const ClassRamps& reference,
              const SeparateParameters& parameters) {
  bool moved = false;
  for (const ClassPair& pair : pairs)
    for (const std::size_t k : told_at) {
      const std::size_t a = index_of(pair.a);
      const std::size_t b = index_of(pair.b);
      const glm::dvec3 between = ramps[a][k] - ramps[b][k];
      const double distance = glm::length(between);
      const double wanted = wanted_distance(pair, k, reference, parameters);
      if (distance >= wanted - 1e-4) continue;
      moved = true;
      const glm::dvec3 usual = reference[a][k] - reference[b][k];
      glm::dvec3 way = usual / std::max(glm::length(usual), 1e-9);
      if (distance > 0.012) way = 0.5 * way + between / distance;
      // The order of lightness is a convention of maps; hues are the painting's.
      if (std::abs(usual.x) >= 0.03) way.x = std::copysign(std::max(std::abs(way.x), 0.3), usual.x);
      way.x *= 3.0;
      way /= std::max(glm::length(way), 1e-9);
      const double share_a = seen[a] == seen[b] ? 0.5
                             : seen[a]          ? 1.0 - parameters.derived_share
                                                : parameters.derived_share;
      const double step = parameters.step * (wanted - distance);
      // The neighbouring tones move by 0.6 of it.
      for (const auto& [j, part] :
           {std::pair{k - 1, 0.6}, std::pair{k, 1.0}, std::pair{k + 1, 0.6}}) {
        ramps[a][j] += share_a * step * part * way;
        ramps[b][j] -= (1.0 - share_a) * step * part * way;
      }
    }
  return moved;
}

// Limits the change of a colour's hue and chroma from `before`.
glm::dvec3 hold_hue(glm::dvec3 colour, const glm::dvec3& before, LandCoverClass id, bool seen,
                    const SeparateParameters& parameters) {
  const bool may_turn = !seen && id != LandCoverClass::rock && id != LandCoverClass::scree;
  const double turn_rad = (may_turn ? parameters.turn_derived_deg : parameters.turn_seen_deg) *
                          std::numbers::pi / 180.0;
  const double had = chroma(before);
  double now = chroma(colour);
  const double most = std::max(parameters.max_chroma * had, had + 0.010);
  if (now > most) {
    colour.y *= most / now;
    colour.z *= most / now;
    now = most;
  }
  now = std::max(now, (seen ? parameters.min_chroma : parameters.min_chroma_derived) * had);
  if (had <= 0.012) return colour;  // too grey to have a hue
  const double hue = exact::atan2(before.z, before.y);
  double turn = exact::atan2(colour.z, colour.y) - hue;
  turn -= 2.0 * std::numbers::pi * std::round(turn / (2.0 * std::numbers::pi));
  const exact::Turn at = exact::turn(hue + std::clamp(turn, -turn_rad, turn_rad));
  return {colour.x, now * at.cosine, now * at.sine};
}

}  // namespace

std::span<const ClassPair> bordering_classes() { return pairs; }

double lacking_distance(const ClassRamps& ramps, const ClassRamps& reference,
                        const SeparateParameters& parameters) {
  double sum = 0.0;
  for (const ClassPair& pair : pairs)
    for (const std::size_t k : told_at)
      sum +=
          std::max(0.0, 1.0 - glm::length(ramps[index_of(pair.a)][k] - ramps[index_of(pair.b)][k]) /
                                  std::max(wanted_distance(pair, k, reference, parameters), 1e-9));
  return sum / static_cast<double>(pairs.size() * told_at.size());
}

ClassRamps strengthen_chroma(const ClassRamps& ramps, const ClassRamps& reference,
                             const StylePainting& painting, const SeparateParameters& parameters) {
  std::vector<double> chromas;
  for (const glm::vec3& texel : painting.ground) chromas.push_back(chroma(texel));
  const double colourful = value_at_share(std::move(chromas), colourful_share);
  double gain = 1.0;
  while (gain < parameters.max_strengthening - 1e-9 &&
         lacking_distance(with_chroma(ramps, gain), reference, parameters) > parameters.lacking &&
         mean_chroma(with_chroma(ramps, gain + strength_step)) < colourful)
    gain += strength_step;
  const StrongChroma strong(painting.every);
  ClassRamps out = with_chroma(ramps, gain);
  for (LabRamp& ramp : out)
    for (glm::dvec3& colour : ramp) {
      const double c = chroma(colour);
      const double most = strong.at(colour.x);
      if (c <= most) continue;
      const double cut = (most + over_strong * (c - most)) / c;
      colour.y *= cut;
      colour.z *= cut;
    }
  return out;
}

ClassRamps separate_classes(const ClassRamps& ramps, const ClassFlags& seen,
                            const ClassRamps& reference, const SeparateParameters& parameters) {
  ClassRamps out = ramps;
  for (int pass = 0; pass < parameters.passes; ++pass) {
    const bool moved = give_way(out, seen, reference, parameters);
    for (std::size_t c = 1; c < out.size(); ++c) {
      for (std::size_t k = 0; k < out[c].size(); ++k)
        out[c][k] =
            hold_hue(out[c][k], ramps[c][k], static_cast<LandCoverClass>(c), seen[c], parameters);
      for (std::size_t k = 1; k < out[c].size(); ++k)
        out[c][k].x = std::max(out[c][k].x, out[c][k - 1].x + 0.035);
      for (glm::dvec3& colour : out[c]) colour.x = std::clamp(colour.x, 0.10, 0.985);
    }
    if (!moved) break;
  }
  return out;
}

}  // namespace belvedere
