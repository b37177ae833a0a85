#include "renderer/style/fit/style_painting.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "base/error.h"
#include "base/masks/label_blur.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "renderer/image/srgb.h"
#include "terrain/layers/fit/clusters.h"
#include "texture/synthesis/exemplar.h"

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

namespace {

constexpr double soft_px = 0.8;
constexpr std::size_t max_texels = 200'000;  // of a list
constexpr int frame_px = 8;                  // ignored: edges of scans often show something else

void check_labels(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask) {
  if (!painting.same_size(mask))
    throw Error(
        ErrorKind::usage, "mask", fmt::format("{} × {} pixels", mask.width(), mask.height()),
        fmt::format("the size of the painting: {} × {}", painting.width(), painting.height()));
  for (const std::uint8_t label : mask)
    if (label >= land_cover_class_count && label != far_air_label && label != unused_label)
      throw Error(ErrorKind::input, "mask", fmt::format("the number {}", label),
                  fmt::format("classes 0 … {}, {} (distant haze) or {} (unused)",
                              land_cover_class_count - 1, far_air_label, unused_label));
}

// Every n-th texel with `wanted(x, y)`; n is the smallest that leaves at most `most`.
template <class F>
std::vector<glm::vec3> some_texels(const Grid<glm::vec3>& colours, std::size_t most, F wanted) {
  std::vector<glm::vec3> all;
  for (int y = 0; y < colours.height(); ++y)
    for (int x = 0; x < colours.width(); ++x)
      if (wanted(x, y)) all.push_back(colours(x, y));
  const std::size_t step = std::max<std::size_t>(1, (all.size() + most - 1) / most);
  std::vector<glm::vec3> some;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

double lightness_at(const std::vector<glm::vec3>& texels, double share) {
  std::vector<float> lightness;
  lightness.reserve(texels.size());
  for (const glm::vec3& texel : texels) lightness.push_back(texel.x);
  return static_cast<double>(value_at_share(std::move(lightness), share));
}

}  // namespace

std::vector<glm::vec3> class_texels(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    LandCoverClass id, std::size_t most) {
  const auto label = static_cast<std::uint8_t>(id);
  return some_texels(colours, most, [&](int x, int y) { return mask(x, y) == label; });
}

bool has_class(const StylePainting& painting, LandCoverClass id) {
  return std::find(painting.classes.begin(), painting.classes.end(), id) != painting.classes.end();
}

StylePainting prepare_painting(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                               const CleanMaskParameters& parameters) {
  check_labels(painting, mask);
  StylePainting out;
  out.drawn = mask;
  out.colours = Grid<glm::vec3>(painting.width(), painting.height());
  parallel_rows(painting.height(), [&](int y) {
    for (int x = 0; x < painting.width(); ++x)
      out.colours(x, y) = glm::vec3(to_oklab(painting(x, y)));
  });
  out.clean = clean_mask(out.colours, mask, parameters);
  out.soft = blur_within_classes(out.colours, mask, soft_px);
  std::array<std::size_t, 256> count{};
  for (const std::uint8_t label : out.clean) ++count[label];
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.id != LandCoverClass::sky && count[static_cast<std::size_t>(info.id)] > 0)
      out.classes.push_back(info.id);
  if (out.classes.empty())
    throw Error(
        ErrorKind::input, "mask",
        fmt::format("no class of the ground with more than {} pixels", parameters.min_texels),
        "a landscape painting and a mask of its classes");
  const int frame = std::min({frame_px, painting.width() / 4, painting.height() / 4});
  out.every = some_texels(out.colours, max_texels, [&](int x, int y) {
    return x >= frame && y >= frame && x < painting.width() - frame &&
           y < painting.height() - frame;
  });
  out.ground = some_texels(out.soft, max_texels, [&](int x, int y) {
    return mask(x, y) != unused_label &&
           mask(x, y) != static_cast<std::uint8_t>(LandCoverClass::sky);
  });
  // A4: the painting's range of lightness, slightly extended for classes that it shows in a small
  // range of light and shade.
  out.min_lightness = std::max(lightness_at(out.ground, 0.004) - 0.03, 0.12);
  out.max_lightness = std::min(std::max(lightness_at(out.every, 0.995), 0.90) + 0.01, 0.985);
  return out;
}

double chroma(const glm::dvec3& lab) { return exact::hypot(lab.y, lab.z); }

double mean_lightness(const LabRamp& ramp) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ramp.size(); ++k) sum += tone_shares[k] * ramp[k].x;
  return sum;
}

double ground_lightness(const ClassRamps& ramps) {
  double sum = 0.0;
  for (std::size_t c = 0; c < ramps.size(); ++c)
    if (area_shares[c] > 0.0) sum += area_shares[c] * mean_lightness(ramps[c]);
  return sum;
}

ToneRamp encoded_ramp(const LabRamp& ramp) {
  ToneRamp out{};
  for (std::size_t k = 0; k < ramp.size(); ++k)
    out[k] = glm::clamp(from_oklab(ramp[k]), 0.0F, 1.0F);
  return out;
}

ClassRamps palette_ramps(const Palette& palette) {
  ClassRamps ramps{};
  for (std::size_t c = 1; c < ramps.size(); ++c) {
    const std::vector<ClassPalette::Stop>& stops = palette.classes[c].stops;
    if (stops.empty()) continue;
    for (std::size_t k = 0; k < ramp_tones.size(); ++k)
      ramps[c][k] = to_oklab(stops[stops.size() / 2].ramp[k]);
  }
  return ramps;
}

std::string class_words(LandCoverClass id) {
  std::string words(class_name(id));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace belvedere
