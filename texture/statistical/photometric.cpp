#include "texture/statistical/photometric.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "base/colour/hsv.h"
#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

constexpr std::size_t knots = 33;
constexpr std::size_t bins = 2048;
constexpr double turn_rad = 6.283185307179586;
constexpr int rounds = 24;  // of finding centres
constexpr double reach_parts =
    5.0;  // relative to the mean distance of two centres, over which regions blend
constexpr double no_limit = 1e9;  // of a map's slope

// Lightness, red–green and yellow–blue of encoded colours: enough to separate regions.
Grid<glm::vec3> opponents(const Grid<glm::vec3>& picture, double blur_px) {
  Grid<glm::vec3> out(picture.width(), picture.height());
  for (int c = 0; c < 3; ++c) {
    Grid<float> channel(picture.width(), picture.height());
    for (std::size_t i = 0; i < channel.size(); ++i) {
      const glm::vec3& rgb = picture[i];
      const float yellow = (rgb.x + rgb.y) / 2.F;
      channel[i] = c == 0 ? (2.F * rgb.x + 5.F * rgb.y + rgb.z) / 8.F
                          : 1.6F * (c == 1 ? rgb.x - rgb.y : yellow - rgb.z);
    }
    channel = gaussian_blur(channel, blur_px);
    for (std::size_t i = 0; i < channel.size(); ++i) out[i][c] = channel[i];
  }
  return out;
}

struct Regions {
  Grid<glm::vec3> seen;
  std::vector<glm::dvec3> centres;
  glm::dvec3 mean{0.0};
  double reach = 0.0;  // relative to the mean distance of two centres: softness of the transition
};

bool inside_mask(const Grid<std::uint8_t>& mask, std::size_t i) {
  return mask.empty() || mask[i] != 0;
}

// k-means starting from parts of equal size by lightness: without random numbers.
Regions find_regions(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& mask,
                     const PhotometricParameters& parameters, const char* which) {
  Regions out{opponents(picture, parameters.blur_px), {}};
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (inside_mask(mask, i)) order.push_back(i);
  const auto wanted = static_cast<std::size_t>(parameters.regions);
  if (order.size() < wanted)
    throw Error(ErrorKind::input, fmt::format("the {} of a correction", which),
                fmt::format("{} pixels count", order.size()), "more pixels than regions");
  for (const std::size_t i : order)
    out.mean += glm::dvec3(out.seen[i]) / static_cast<double>(order.size());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return out.seen[a].x < out.seen[b].x; });
  for (std::size_t k = 0; k < wanted; ++k) {
    const std::size_t begin = k * order.size() / wanted;
    const std::size_t end = (k + 1) * order.size() / wanted;
    glm::dvec3 sum(0.0);
    for (std::size_t i = begin; i < end; ++i) sum += out.seen[order[i]];
    out.centres.push_back(sum / static_cast<double>(end - begin));
  }
  for (int round = 0; round < rounds; ++round) {
    std::vector<glm::dvec3> sum(wanted, glm::dvec3(0.0));
    std::vector<double> count(wanted, 0.0);
    for (const std::size_t i : order) {
      std::size_t best = 0;
      for (std::size_t k = 1; k < wanted; ++k)
        if (glm::distance(glm::dvec3(out.seen[i]), out.centres[k]) <
            glm::distance(glm::dvec3(out.seen[i]), out.centres[best]))
          best = k;
      sum[best] += out.seen[i];
      count[best] += 1.0;
    }
    for (std::size_t k = 0; k < wanted; ++k)
      if (count[k] > 0.0) out.centres[k] = sum[k] / count[k];
  }
  double distance = 0.0;
  for (std::size_t a = 0; a < wanted; ++a)
    for (std::size_t b = a + 1; b < wanted; ++b)
      distance += glm::distance(out.centres[a], out.centres[b]);
  const double pairs = std::max(static_cast<double>(wanted * (wanted - 1)) / 2.0, 1.0);
  out.reach = std::max(distance / pairs / reach_parts, 1e-3);
  return out;
}

// For each region of the source the matching one of the target: least squares of the centres
// relative to their pictures' means, over all permutations.
std::vector<std::size_t> pair_regions(const Regions& source, const Regions& target) {
  std::vector<std::size_t> order(source.centres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<std::size_t> best = order;
  double min = std::numeric_limits<double>::infinity();
  do {
    double sum = 0.0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const glm::dvec3 step =
          (source.centres[k] - source.mean) - (target.centres[order[k]] - target.mean);
      sum += glm::dot(step, step);
    }
    if (sum < min) {
      min = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

// Membership of a pixel in each region; sums to 1.
std::vector<double> shares(const Regions& regions, std::size_t i) {
  std::vector<double> out(regions.centres.size());
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < out.size(); ++k) {
    const glm::dvec3 step = glm::dvec3(regions.seen[i]) - regions.centres[k];
    out[k] = glm::dot(step, step) / (2.0 * regions.reach * regions.reach);
    nearest = std::min(nearest, out[k]);
  }
  double sum = 0.0;
  for (double& share : out) sum += share = exact::exp(nearest - share);
  for (double& share : out) share /= sum;
  return out;
}

using Histogram = std::vector<double>;

// Quantiles of values from `low` to `low` + 1, at 33 even steps.
std::array<double, knots> quantiles(const Histogram& histogram, double low) {
  std::array<double, knots> out{};
  const double all = std::accumulate(histogram.begin(), histogram.end(), 0.0);
  double before = 0.0;
  std::size_t bin = 0;
  for (std::size_t k = 0; k < knots; ++k) {
    const double wanted = all * (static_cast<double>(k) + 0.5) / knots;
    while (bin + 1 < bins && before + histogram[bin] < wanted) before += histogram[bin++];
    const double part =
        histogram[bin] > 0.0 ? std::clamp((wanted - before) / histogram[bin], 0.0, 1.0) : 0.5;
    out[k] = low + (static_cast<double>(bin) + part) / bins;
  }
  return out;
}

// Colour statistics of one region.
struct RegionColours {
  double hue = 0.0;  // mean, turns
  std::array<std::array<double, knots>, 3> quantile{};
};

std::vector<RegionColours> measure_colours(const Grid<glm::vec3>& picture, const Regions& regions,
                                           const Grid<std::uint8_t>& mask) {
  const std::size_t wanted = regions.centres.size();
  std::vector<RegionColours> out(wanted);
  std::vector<glm::dvec3> direction(wanted, glm::dvec3(0.0));
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!inside_mask(mask, i)) continue;
    const glm::dvec3 hsv = to_hsv(picture[i]);
    const exact::Turn turn = exact::turn(turn_rad * hsv.x);
    const std::vector<double> share = shares(regions, i);
    for (std::size_t k = 0; k < wanted; ++k)
      direction[k] += share[k] * hsv.y * glm::dvec3(turn.cosine, turn.sine, 0.0);
  }
  for (std::size_t k = 0; k < wanted; ++k)
    out[k].hue = exact::atan2(direction[k].y, direction[k].x) / turn_rad;
  std::vector<std::array<Histogram, 3>> histograms(wanted);
  for (auto& of_region : histograms)
    for (Histogram& histogram : of_region) histogram.assign(bins, 0.0);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!inside_mask(mask, i)) continue;
    const glm::dvec3 hsv = to_hsv(picture[i]);
    const std::vector<double> share = shares(regions, i);
    for (std::size_t k = 0; k < wanted; ++k) {
      double turned = hsv.x - out[k].hue;
      turned -= std::floor(turned + 0.5);  // -½…½ relative to the region's mean
      const std::array<double, 3> position = {turned + 0.5, hsv.y, hsv.z};
      for (std::size_t c = 0; c < 3; ++c)
        histograms[k][c][std::min(static_cast<std::size_t>(std::max(position[c], 0.0) * bins),
                                  bins - 1)] += share[k] * (c == 0 ? hsv.y : 1.0);
    }
  }
  for (std::size_t k = 0; k < wanted; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      out[k].quantile[c] = quantiles(histograms[k][c], c == 0 ? -0.5 : 0.0);
  return out;
}

// From the source's quantiles to the target's, limited to slope `steepest`; slope 1 outside them,
// so that rare values are shifted too.
struct QuantileMap {
  std::array<double, knots> from{};
  std::array<double, knots> to{};
  double operator()(double value) const {
    if (value <= from.front()) return to.front() + (value - from.front());
    if (value >= from.back()) return to.back() + (value - from.back());
    const auto above =
        static_cast<std::size_t>(std::upper_bound(from.begin(), from.end(), value) - from.begin());
    const double width = from[above] - from[above - 1];
    const double part = width > 0.0 ? (value - from[above - 1]) / width : 0.0;
    return to[above - 1] + part * (to[above] - to[above - 1]);
  }
};

QuantileMap make_map(const std::array<double, knots>& from, const std::array<double, knots>& to,
                     double steepest) {
  QuantileMap map{from, to};
  constexpr std::size_t centre = knots / 2;
  for (std::size_t k = centre; k + 1 < knots; ++k)
    map.to[k + 1] = map.to[k] + std::min(to[k + 1] - to[k], steepest * (from[k + 1] - from[k]));
  for (std::size_t k = centre; k > 0; --k)
    map.to[k - 1] = map.to[k] - std::min(to[k] - to[k - 1], steepest * (from[k] - from[k - 1]));
  return map;
}

// Saturation of a colour whose hue is pulled towards another by so many turns: the path from a hue
// to the opposite one leads through grey.
double kept_colour(double pulled, double coloured, const PhotometricParameters& parameters) {
  const auto [from, to] = parameters.pull_fade;
  return 1.0 - coloured * std::clamp((pulled - from) / (to - from), 0.0, 1.0);
}

struct RegionMap {
  double hue_from, hue_to;
  QuantileMap hue, saturation, value;
};

}  // namespace

Grid<glm::vec3> correct_colours(const Grid<glm::vec3>& source, const Grid<glm::vec3>& target,
                                const PhotometricParameters& parameters,
                                const Grid<std::uint8_t>& source_counts,
                                const Grid<std::uint8_t>& target_counts) {
  if (parameters.regions < 1 || parameters.regions > 5)
    throw Error(ErrorKind::usage, "regions", fmt::format("{}", parameters.regions), "1 … 5");
  const Regions from = find_regions(source, source_counts, parameters, "source");
  const Regions to = find_regions(target, target_counts, parameters, "target");
  const std::vector<std::size_t> partner = pair_regions(from, to);
  const std::vector<RegionColours> own = measure_colours(source, from, source_counts);
  const std::vector<RegionColours> theirs = measure_colours(target, to, target_counts);
  std::vector<RegionMap> maps;
  for (std::size_t k = 0; k < own.size(); ++k) {
    const RegionColours& goal = theirs[partner[k]];
    maps.push_back({own[k].hue, goal.hue, make_map(own[k].quantile[0], goal.quantile[0], 1.0),
                    make_map(own[k].quantile[1], goal.quantile[1], no_limit),
                    make_map(own[k].quantile[2], goal.quantile[2], parameters.largest_value_gain)});
  }
  Grid<glm::vec3> out(source.width(), source.height());
  parallel_rows(source.height(), [&](int y) {
    for (int x = 0; x < source.width(); ++x) {
      const std::size_t i = source.index(x, y);
      const glm::dvec3 hsv = to_hsv(source[i]);
      const std::vector<double> share = shares(from, i);
      const double coloured =
          std::clamp((hsv.y / parameters.grey_saturation - parameters.grey_fade[0]) /
                         (parameters.grey_fade[1] - parameters.grey_fade[0]),
                     0.0, 1.0);
      glm::dvec3 direction(0.0);
      double saturation = 0.0;
      double value = 0.0;
      for (std::size_t k = 0; k < share.size(); ++k) {
        const RegionMap& map = maps[k];
        double turned = hsv.x - map.hue_from;
        turned -= std::floor(turned + 0.5);
        const double saturated = std::clamp(map.saturation(hsv.y), 0.0, 1.0);
        // A grey that becomes a colour loses its own hue, which was noise, in proportion to the
        // gained saturation.
        const double calmed = turned * (saturated > hsv.y ? hsv.y / saturated : 1.0);
        const double mapped = calmed + coloured * (map.hue(turned) - calmed);
        const exact::Turn turn = exact::turn(turn_rad * (map.hue_to + mapped));
        direction += share[k] * glm::dvec3(turn.cosine, turn.sine, 0.0);
        saturation +=
            share[k] * saturated * kept_colour(std::abs(turned - mapped), coloured, parameters);
        value += share[k] * std::clamp(map.value(hsv.z), 0.0, 1.0);
      }
      out[i] = glm::vec3(
          from_hsv({exact::atan2(direction.y, direction.x) / turn_rad, saturation, value}));
    }
  });
  return out;
}

Grid<std::uint8_t> find_similar_colours(const Grid<glm::vec3>& picture, const Grid<glm::vec3>& crop,
                                        double share, const Grid<std::uint8_t>& picture_counts,
                                        const Grid<std::uint8_t>& crop_counts) {
  // One region each: its mean, and the blurred colours.
  PhotometricParameters one;
  one.regions = 1;
  const auto per_lightness = [](glm::dvec3 colour) {
    constexpr double black = 0.05;  // below this, colour is noise
    return glm::dvec2(colour.y, colour.z) / std::max(colour.x, black);
  };
  const glm::dvec2 wanted = per_lightness(find_regions(crop, crop_counts, one, "crop").mean);
  const Grid<glm::vec3> seen = find_regions(picture, picture_counts, one, "picture").seen;
  Grid<float> distance(picture.width(), picture.height());
  std::vector<float> counted;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const glm::dvec2 step = per_lightness(seen[i]) - wanted;
    distance[i] = static_cast<float>(glm::dot(step, step));
    if (inside_mask(picture_counts, i)) counted.push_back(distance[i]);
  }
  const float farthest = value_at_share(std::move(counted), share);
  Grid<std::uint8_t> out(picture.width(), picture.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = inside_mask(picture_counts, i) && distance[i] <= farthest ? 1 : 0;
  return out;
}

std::array<double, 3> colour_histogram_distance(const Grid<glm::vec3>& a,
                                                const Grid<glm::vec3>& b) {
  constexpr std::size_t count = 32;
  using Histograms = std::array<std::array<double, count>, 3>;
  const auto measure = [](const Grid<glm::vec3>& picture) {
    Histograms histograms{};
    glm::dvec3 all(0.0);
    for (const glm::vec3& rgb : picture) {
      const glm::dvec3 hsv = to_hsv(rgb);
      for (int c = 0; c < 3; ++c) {
        const double weight = c == 0 ? hsv.y : 1.0;
        histograms[static_cast<std::size_t>(c)]
                  [std::min(static_cast<std::size_t>(hsv[c] * count), count - 1)] += weight;
        all[c] += weight;
      }
    }
    for (int c = 0; c < 3; ++c)
      for (double& bin : histograms[static_cast<std::size_t>(c)]) bin /= std::max(all[c], 1e-12);
    return histograms;
  };
  const Histograms of_a = measure(a);
  const Histograms of_b = measure(b);
  std::array<double, 3> out{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t bin = 0; bin < count; ++bin) out[c] += std::abs(of_a[c][bin] - of_b[c][bin]);
  return out;
}

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
