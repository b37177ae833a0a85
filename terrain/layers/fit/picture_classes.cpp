#include "terrain/layers/fit/picture_classes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

// The usual name of a mean colour.
std::string colour_word(const glm::dvec3& rgb) {
  const HueSaturation c = hue_saturation_of(rgb);
  const char* hue = c.grey || c.saturation < 0.08 ? (c.value > 0.75 ? "white" : "grey")
                    : c.hue_deg < 20.0            ? "red"
                    : c.hue_deg < 48.0            ? "brown"
                    : c.hue_deg < 66.0            ? "olive"
                    : c.hue_deg < 165.0           ? "green"
                    : c.hue_deg < 200.0           ? "cyan"
                    : c.hue_deg < 265.0           ? "blue"
                    : c.hue_deg < 330.0           ? "purple"
                                                  : "red";
  return c.value < 0.25 ? fmt::format("dark {}", hue) : hue;
}

// Names classes by their mean colours, numbered if two names would be equal.
std::vector<FitClass> named_by_colour(const Grid<glm::vec3>& picture,
                                      const std::vector<std::uint8_t>& labels, int classes) {
  std::vector<glm::dvec3> sums(static_cast<std::size_t>(classes), glm::dvec3(0.0));
  for (std::size_t i = 0; i != labels.size(); ++i)
    if (labels[i] != no_class) sums[labels[i]] += picture[i];
  const std::vector<std::size_t> counts = count_labels(labels, classes);
  std::vector<FitClass> named;
  for (std::size_t k = 0; k != sums.size(); ++k) {
    const std::string word =
        colour_word(sums[k] / static_cast<double>(std::max<std::size_t>(counts[k], 1)));
    std::string name = word;
    for (int n = 2;
         std::any_of(named.begin(), named.end(), [&](const FitClass& c) { return c.name == name; });
         ++n)
      name = fmt::format("{} {}", word, n);
    named.push_back({name, std::nullopt, 0x808080});
  }
  return named;
}

// Hue does not separate greys and snow; their lightness does, after correction for the sun.
std::vector<std::uint8_t> labels_by_lightness(const Grid<glm::vec3>& picture,
                                              const Grid<float>& altitude_m, double cell_m,
                                              const Grid<std::uint8_t>& use, const Clouds& clouds,
                                              int classes) {
  constexpr std::size_t max = 20'000;
  Grid<float> brightness(use.width(), use.height());
  std::vector<std::uint8_t> all(use.size());
  for (std::size_t i = 0; i != use.size(); ++i) {
    brightness[i] = (picture[i].x + picture[i].y + picture[i].z) / 3.0F;
    all[i] = use[i] != 0 ? 0 : no_class;
  }
  const PictureSun sun =
      find_sun(altitude_m, cell_m, brightness, {}, use,
               clouds.found ? std::optional<double>(clouds.sun_azimuth_deg) : std::nullopt);
  const Grid<float> light = sunlight(altitude_m, cell_m, sun);
  const Grid<glm::vec3> even = lit_evenly(picture, light, exact::sin(to_radians(sun.elevation_deg)),
                                          all, light_answers(picture, light, all, 1, use));
  for (std::size_t i = 0; i != all.size(); ++i)
    if (!(light[i] > 0.05F)) all[i] = no_class;
  const auto position_of = [&](std::size_t i) {
    const LabColour lab = lab_of_srgb(even[i]);
    return ClusterPlace{lab.l, lab.a, lab.b};
  };
  std::vector<ClusterPlace> positions;
  for (const std::uint32_t i : draw_labelled(all, max, 3)) positions.push_back(position_of(i));
  std::vector<ClusterPlace> means = cluster_means(positions, classes, {.part = 3});
  std::sort(means.begin(), means.end());  // the darkest first
  for (std::size_t i = 0; i != all.size(); ++i)
    if (all[i] != no_class) all[i] = nearest_mean(position_of(i), means);
  return all;
}

}  // namespace

PictureClasses picture_classes(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m,
                               double cell_m, const Grid<std::uint8_t>& use,
                               const PictureClassParameters& parameters) {
  constexpr double min_used = 0.01;
  PictureClasses found;
  found.clouds = find_clouds(picture, cell_m, parameters.clouds);
  const Grid<glm::vec3> smooth = smooth_chroma(picture, parameters.chroma_sigma_cells);
  Grid<std::uint8_t> clear = use;
  std::vector<HueSaturation> colours(use.size());
  std::size_t used = 0;
  std::size_t greys = 0;
  for (std::size_t i = 0; i != use.size(); ++i) {
    if (found.clouds.found && (found.clouds.cloud[i] != 0 || found.clouds.shadow[i] != 0))
      clear[i] = 0;
    if (clear[i] == 0) continue;
    colours[i] = hue_saturation_of(smooth[i]);
    ++used;
    if (colours[i].grey) ++greys;
  }
  found.used_share =
      static_cast<double>(used) / static_cast<double>(std::max<std::size_t>(use.size(), 1));
  found.grey_share =
      static_cast<double>(greys) / static_cast<double>(std::max<std::size_t>(used, 1));
  if (found.used_share < min_used)
    throw Error(
        ErrorKind::input, "picture",
        fmt::format(
            "{:.1f} % of it shows ground; the rest is cloud, shadow, masked or without altitudes",
            100.0 * found.used_share),
        "a picture with at least 1 % of visible ground");
  found.labels.assign(use.size(), no_class);
  if (!parameters.regions.empty()) {
    std::vector<std::size_t> class_of;  // of each region
    for (const ColourRegion& region : parameters.regions) {
      const auto same = std::find_if(found.classes.begin(), found.classes.end(),
                                     [&](const FitClass& c) { return c.name == region.of.name; });
      class_of.push_back(static_cast<std::size_t>(same - found.classes.begin()));
      if (same == found.classes.end()) found.classes.push_back(region.of);
    }
    for (std::size_t i = 0; i != use.size(); ++i) {
      if (clear[i] == 0) continue;
      for (std::size_t r = 0; r != class_of.size() && found.labels[i] == no_class; ++r)
        if (holds(parameters.regions[r], colours[i], static_cast<double>(altitude_m[i])))
          found.labels[i] = static_cast<std::uint8_t>(class_of[r]);
    }
  } else {
    std::vector<PlanePosition> positions;
    positions.reserve(used);
    for (std::size_t i = 0; i != use.size(); ++i)
      if (clear[i] != 0) positions.push_back(hue_saturation_place(colours[i]));
    const Clusters clusters = find_clusters(positions);
    const std::vector<std::uint8_t> at = clusters_at(positions, clusters);
    found.parts = static_cast<int>(clusters.parts.size());
    const std::vector<std::size_t> counts = count_labels(at, clusters.classes);
    const std::size_t largest = *std::max_element(counts.begin(), counts.end());
    if (static_cast<double>(largest) > parameters.one_colour * static_cast<double>(used)) {
      found.lightness = true;
      found.labels = labels_by_lightness(picture, altitude_m, cell_m, clear, found.clouds,
                                         parameters.by_lightness);
    } else {
      for (std::size_t i = 0, next = 0; i != use.size(); ++i)
        if (clear[i] != 0) found.labels[i] = at[next++];
    }
    // Renumbers without gaps.
    std::array<std::uint8_t, 256> number{};
    number.fill(no_class);
    std::uint8_t classes = 0;
    for (std::uint8_t& label : found.labels) {
      if (label == no_class) continue;
      if (number[label] == no_class) number[label] = classes++;
      label = number[label];
    }
    found.classes = named_by_colour(picture, found.labels, classes);
  }
  const std::vector<std::size_t> counts =
      count_labels(found.labels, static_cast<int>(found.classes.size()));
  if (std::count_if(counts.begin(), counts.end(), [](std::size_t c) { return c > 0; }) < 2)
    throw Error(ErrorKind::input, "picture", "only one class, because its colours do not differ",
                "a picture with different colours, or regions that divide them");
  return found;
}

}  // namespace belvedere
