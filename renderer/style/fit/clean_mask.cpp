#include "renderer/style/fit/clean_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/land_cover_class.h"
#include "base/masks/label_blur.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/layers/fit/clusters.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

constexpr std::uint8_t sky_label = static_cast<std::uint8_t>(LandCoverClass::sky);
constexpr double hue_weight = 1.6;  // of a and b relative to L: hue separates classes better
constexpr std::size_t max_grouped = 20'000;  // max texels for clustering

ClusterPlace cluster_place(const glm::vec3& lab) {
  return {static_cast<double>(lab.x), hue_weight * static_cast<double>(lab.y),
          hue_weight * static_cast<double>(lab.z)};
}

double place_distance(const ClusterPlace& a, const ClusterPlace& b) {
  double sum = 0.0;
  for (std::size_t d = 0; d < a.size(); ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return std::sqrt(sum);
}

ClusterPlace median_place(const std::vector<ClusterPlace>& places) {
  ClusterPlace out{};
  std::vector<double> values(places.size());
  for (std::size_t d = 0; d < out.size(); ++d) {
    for (std::size_t i = 0; i < places.size(); ++i) values[i] = places[i][d];
    out[d] = middle_value(values);
  }
  return out;
}

// For snow: rock shows through the darker half.
std::vector<ClusterPlace> lighter_half(std::vector<ClusterPlace> places) {
  const double middle = median_place(places)[0];
  std::erase_if(places, [&](const ClusterPlace& place) { return place[0] < middle; });
  return places;
}

// Which groups of a class look like another class.
std::vector<bool> strange_groups(const std::vector<ClusterPlace>& groups, std::size_t own,
                                 const std::array<std::vector<ClusterPlace>, 256>& places,
                                 const std::array<ClusterPlace, 256>& medians,
                                 const CleanMaskParameters& parameters) {
  std::vector<bool> strange;
  for (const ClusterPlace& group : groups) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t other = 1; other < far_air_label; ++other)
      if (other != own && !places[other].empty() &&
          place_distance(medians[other], medians[own]) > parameters.different)
        nearest = std::min(nearest, place_distance(group, medians[other]));
    strange.push_back(nearest < parameters.nearer * place_distance(group, medians[own]));
  }
  return strange;
}

}  // namespace

Grid<glm::vec3> blur_within_classes(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    double sigma_px) {
  Grid<glm::vec3> out(colours.width(), colours.height(), glm::vec3(0.0F));
  for (int channel = 0; channel < 3; ++channel) {
    Grid<float> values(colours.width(), colours.height());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = colours[i][channel];
    values = blur_within_labels(values, mask, sigma_px);
    for (std::size_t i = 0; i < values.size(); ++i) out[i][channel] = values[i];
  }
  return out;
}

Grid<std::uint8_t> clean_mask(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& drawn,
                              const CleanMaskParameters& parameters) {
  const Grid<glm::vec3> soft = blur_within_classes(colours, drawn, parameters.blur_px);
  std::array<std::vector<ClusterPlace>, 256> places;  // of classes of the ground
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (drawn[i] != sky_label && drawn[i] < far_air_label)
      places[drawn[i]].push_back(cluster_place(soft[i]));
  std::array<ClusterPlace, 256> medians{};
  for (std::size_t k = 1; k < far_air_label; ++k) {
    if (places[k].size() <= parameters.min_texels) places[k].clear();
    if (places[k].empty()) continue;
    const bool snow = k == static_cast<std::size_t>(LandCoverClass::snow);
    medians[k] = median_place(snow ? lighter_half(places[k]) : places[k]);
  }
  std::array<std::vector<std::uint8_t>, 256> kept;  // of each texel of a class, in their order
  for (std::size_t k = 1; k < far_air_label; ++k) {
    const std::vector<ClusterPlace>& own = places[k];
    if (own.empty()) continue;
    std::vector<ClusterPlace> some;
    const std::size_t step = std::max<std::size_t>(1, own.size() / max_grouped);
    for (std::size_t i = 0; i < own.size(); i += step) some.push_back(own[i]);
    const std::vector<ClusterPlace> groups = cluster_means(some, parameters.groups);
    const std::vector<bool> strange = strange_groups(groups, k, places, medians, parameters);
    kept[k].resize(own.size());
    parallel_ranges(own.size(), std::size_t{8192}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        kept[k][i] = strange[nearest_mean(own[i], groups)] ? 0 : 1;
    });
    const auto count = std::count(kept[k].begin(), kept[k].end(), std::uint8_t{1});
    if (static_cast<double>(count) < parameters.min_kept * static_cast<double>(own.size()))
      std::fill(kept[k].begin(), kept[k].end(), std::uint8_t{1});
  }
  Grid<std::uint8_t> clean = drawn;
  std::array<std::size_t, 256> next{};
  for (std::size_t i = 0; i < clean.size(); ++i) {
    const std::uint8_t label = drawn[i];
    if (label == sky_label || label >= far_air_label) continue;
    if (kept[label].empty() || kept[label][next[label]++] == 0) clean[i] = unused_label;
  }
  return clean;
}

}  // namespace belvedere
