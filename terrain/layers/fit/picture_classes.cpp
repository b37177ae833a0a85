#include "terrain/layers/fit/picture_classes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <string>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// Sums of a mask over blocks of factor × factor cells.
Grid<float> reduced(const Grid<std::uint8_t>& mask, int factor) {
  Grid<float> sums((mask.width() + factor - 1) / factor, (mask.height() + factor - 1) / factor,
                   0.0F);
  for (int y = 0; y != mask.height(); ++y)
    for (int x = 0; x != mask.width(); ++x)
      sums(x / factor, y / factor) += static_cast<float>(mask(x, y));
  return sums;
}

struct Match {
  int x = 0;
  int y = 0;
  double correlation = -1.0;
};

// The offset at which `moved` (its non-zero cells) correlates best with `still`, over the cells
// that both cover there, among those `allowed`. Ties take the first in a fixed order of rows.
template <class Allowed>
Match best_offset(const Grid<float>& moved, const Grid<float>& still, int x0, int x1, int y0,
                  int y1, const Allowed& allowed) {
  struct Cell {
    int x, y;
    double value;
  };
  std::vector<Cell> cells;
  double mean_still = 0.0;
  double squares_still = 0.0;
  for (int y = 0; y != moved.height(); ++y)
    for (int x = 0; x != moved.width(); ++x) {
      if (moved(x, y) > 0.0F) cells.push_back({x, y, static_cast<double>(moved(x, y))});
      mean_still += static_cast<double>(still(x, y));
      squares_still += static_cast<double>(still(x, y)) * static_cast<double>(still(x, y));
    }
  const auto count = static_cast<double>(still.size());
  mean_still /= count;
  const double variance_still = squares_still / count - mean_still * mean_still;
  std::vector<Match> best(static_cast<std::size_t>(std::max(0, y1 - y0 + 1)));
  parallel_ranges(best.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row != end; ++row) {
      const int dy = y0 + static_cast<int>(row);
      for (int dx = x0; dx <= x1; ++dx) {
        if (!allowed(dx, dy)) continue;
        double sum = 0.0;
        double squares = 0.0;
        double both = 0.0;
        for (const Cell& c : cells) {
          if (!still.contains(c.x + dx, c.y + dy)) continue;
          sum += c.value;
          squares += c.value * c.value;
          both += c.value * (static_cast<double>(still(c.x + dx, c.y + dy)) - mean_still);
        }
        const double mean = sum / count;
        const double variance = squares / count - mean * mean;
        // Clouds shifted almost entirely out of the picture match by accident.
        if (variance <= 0.0 || variance_still <= 0.0 ||
            squares < 0.3 * static_cast<double>(cells.size()))
          continue;
        const double correlation = both / count / std::sqrt(variance * variance_still);
        if (correlation > best[row].correlation) best[row] = {dx, dy, correlation};
      }
    }
  });
  Match all;
  for (const Match& m : best)
    if (m.correlation > all.correlation) all = m;
  return all;
}

Grid<std::uint8_t> dilated(const Grid<std::uint8_t>& mask, int radius) {
  Grid<float> values(mask.width(), mask.height());
  for (std::size_t i = 0; i != mask.size(); ++i) values[i] = static_cast<float>(mask[i]);
  values = window_maximum(values, radius);
  Grid<std::uint8_t> grown_mask(mask.width(), mask.height());
  for (std::size_t i = 0; i != mask.size(); ++i) grown_mask[i] = values[i] > 0.0F ? 1 : 0;
  return grown_mask;
}

// Single cells and threads are not clouds: an opening by the cell and its four neighbours.
Grid<std::uint8_t> opened(const Grid<std::uint8_t>& mask) {
  const auto cross = [](const Grid<std::uint8_t>& from, bool all) {
    Grid<std::uint8_t> to(from.width(), from.height());
    for (int y = 0; y != from.height(); ++y)
      for (int x = 0; x != from.width(); ++x) {
        const int set = from(x, y) + from.clamped(x - 1, y) + from.clamped(x + 1, y) +
                        from.clamped(x, y - 1) + from.clamped(x, y + 1);
        to(x, y) = (all ? set == 5 : set > 0) ? 1 : 0;
      }
    return to;
  };
  return cross(cross(mask, true), false);
}

// White as clouds and snow are.
bool is_white(const HueSaturation& c, const CloudParameters& parameters) {
  return (c.grey && c.value > parameters.white) ||
         (c.value > parameters.whitest && c.saturation < parameters.pale);
}

}  // namespace

Clouds find_clouds(const Grid<glm::vec3>& picture, double cell_m, const CloudParameters& parameters,
                   const Grid<float>* swir) {
  constexpr int cloud_rim = 3;
  constexpr int shadow_rim = 8;
  constexpr int coarse_size = 256;  // cells along the longer side of the grid for the full search
  const int width = picture.width();
  const int height = picture.height();
  Grid<std::uint8_t> white(width, height);
  Grid<std::uint8_t> dark(width, height);
  Grid<std::uint8_t> dim(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x != width; ++x) {
      const HueSaturation c = hue_saturation_of(picture(x, y));
      const auto green = static_cast<double>(picture(x, y).y);
      const double infrared = swir != nullptr ? static_cast<double>((*swir)(x, y)) : green;
      const bool snow = green - infrared > parameters.snow_index * (green + infrared);
      white(x, y) = is_white(c, parameters) && !snow ? 1 : 0;
      dark(x, y) = c.value < parameters.dark ? 1 : 0;
      dim(x, y) = c.value < parameters.shadow ? 1 : 0;
    }
  });
  white = opened(white);
  Clouds clouds{false, false, Grid<std::uint8_t>(width, height, 0),
                Grid<std::uint8_t>(width, height, 0)};
  const int factor = std::max(1, (std::max(width, height) + coarse_size - 1) / coarse_size);
  const double min = parameters.min_m / cell_m;
  const double max = parameters.max_m / cell_m;
  const auto within = [&](int scale) {
    return [=](int dx, int dy) {
      const double far = exact::hypot(dx, dy) * scale;
      return far >= min && far <= max;
    };
  };
  const int reach = static_cast<int>(max / factor);
  const Grid<float> white_coarse = reduced(white, factor);
  const Grid<float> dark_coarse = reduced(dark, factor);
  const Match coarse =
      best_offset(white_coarse, dark_coarse, -reach, reach, -reach, reach, within(factor));
  if (swir != nullptr) {
    clouds.found = std::any_of(white.begin(), white.end(), [](std::uint8_t w) { return w != 0; });
    clouds.cloud = dilated(white, cloud_rim);
  }
  if (coarse.correlation <= -1.0) return clouds;
  const Match fine = best_offset(reduced(white, 1), reduced(dark, 1), factor * (coarse.x - 1),
                                 factor * (coarse.x + 1), factor * (coarse.y - 1),
                                 factor * (coarse.y + 1), within(1));
  clouds.match = fine.correlation;
  clouds.shadow_x = fine.x;
  clouds.shadow_y = fine.y;
  const double towards =
      to_degrees(exact::atan2(-static_cast<double>(fine.x), static_cast<double>(fine.y)));
  clouds.sun_azimuth_deg = towards < 0.0 ? towards + 360.0 : towards;
  // Secondary peaks near the maximum are due to the size of the clouds; an equal match farther away
  // means that there is no shadow.
  const int own = coarse_size / 10;
  const auto elsewhere = [&](int dx, int dy) {
    return within(factor)(dx, dy) && exact::hypot(dx - coarse.x, dy - coarse.y) > own;
  };
  clouds.elsewhere =
      best_offset(white_coarse, dark_coarse, -reach, reach, -reach, reach, elsewhere).correlation;
  if (fine.correlation < parameters.min_match ||
      clouds.elsewhere > parameters.distinct * fine.correlation)
    return clouds;
  clouds.found = clouds.shadows = true;
  Grid<std::uint8_t> moved(width, height, 0);
  for (int y = 0; y != height; ++y)
    for (int x = 0; x != width; ++x)
      if (white(x, y) != 0 && moved.contains(x + fine.x, y + fine.y))
        moved(x + fine.x, y + fine.y) = 1;
  moved = dilated(moved, shadow_rim);
  for (std::size_t i = 0; i != moved.size(); ++i)
    clouds.shadow[i] = moved[i] != 0 && dim[i] != 0 ? 1 : 0;
  clouds.cloud = dilated(white, cloud_rim);
  return clouds;
}

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
               clouds.shadows ? std::optional<double>(clouds.sun_azimuth_deg) : std::nullopt);
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
  found.clouds = find_clouds(picture, cell_m, parameters.clouds, parameters.swir);
  const Grid<glm::vec3> smooth = smooth_chroma(picture, parameters.chroma_sigma_cells);
  Grid<std::uint8_t> clear = use;
  std::vector<HueSaturation> colours(use.size());
  std::size_t used = 0;
  std::size_t greys = 0;
  std::size_t low_whites = 0;
  for (std::size_t i = 0; i != use.size(); ++i) {
    if (found.clouds.found && (found.clouds.cloud[i] != 0 || found.clouds.shadow[i] != 0))
      clear[i] = 0;
    if (clear[i] == 0) continue;
    colours[i] = hue_saturation_of(smooth[i]);
    if (static_cast<double>(altitude_m[i]) < parameters.snow_from_m &&
        is_white(hue_saturation_of(picture[i]), parameters.clouds)) {
      clear[i] = 0;
      ++low_whites;
      continue;
    }
    ++used;
    if (!colours[i].grey) continue;
    ++greys;
    colours[i].own_hue = parameters.grey_hue_deg.has_value();
    colours[i].hue_deg = parameters.grey_hue_deg.value_or(colours[i].hue_deg);
  }
  found.low_white_share =
      static_cast<double>(low_whites) / static_cast<double>(std::max<std::size_t>(use.size(), 1));
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
