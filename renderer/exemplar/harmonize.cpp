#include "renderer/exemplar/harmonize.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "base/error.h"
#include "base/filter.h"
#include "base/matrix/matrix.h"
#include "base/parallel.h"
#include "renderer/image/srgb.h"
#include "texture/statistical/photometric.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr std::size_t min_texels = 32;   // fewer give no spread
constexpr double min_deviation = 0.004;  // OKLab; flatter colours are treated as having this
                                         // deviation, so that noise is not amplified
constexpr double largest_gain = 3.0;     // factor on a deviation, up or down
constexpr double border_texels = 1.5;    // sigma of the blend of maps across borders

struct Statistics {
  std::size_t count = 0;
  glm::dvec3 mean{0.0};
  glm::dmat3 covariance{0.0};
};

// lab → matrix · lab + shift
struct ColourMap {
  glm::dmat3 matrix{1.0};
  glm::dvec3 shift{0.0};
};

using LabelStatistics = std::array<Statistics, 256>;

LabelStatistics measure(const Grid<glm::dvec3>& lab, const Grid<std::uint8_t>& labels) {
  LabelStatistics statistics;
  for (std::size_t i = 0; i < lab.size(); ++i) {
    Statistics& s = statistics[labels[i]];
    ++s.count;
    s.mean += lab[i];
    s.covariance += glm::outerProduct(lab[i], lab[i]);
  }
  for (Statistics& s : statistics) {
    if (s.count == 0) continue;
    s.mean /= static_cast<double>(s.count);
    s.covariance = s.covariance / static_cast<double>(s.count) - glm::outerProduct(s.mean, s.mean);
  }
  statistics[unused_label] = {};
  return statistics;
}

Grid<glm::dvec3> to_lab(const Grid<glm::vec3>& picture) {
  Grid<glm::dvec3> lab(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) lab(x, y) = to_oklab(picture(x, y));
  });
  return lab;
}

// The target statistics of each label, and the number of paintings that contain it.
struct Goal {
  Statistics look;
  int paintings = 0;
};

std::array<Goal, 256> find_goals(const std::vector<LabelStatistics>& all,
                                 std::optional<std::size_t> reference) {
  std::array<Goal, 256> goals;
  for (std::size_t label = 0; label < unused_label; ++label) {
    Goal& goal = goals[label];
    for (const LabelStatistics& one : all) {
      const Statistics& s = one[label];
      if (s.count < min_texels) continue;
      ++goal.paintings;
      const double count = static_cast<double>(s.count);
      goal.look.count += s.count;
      goal.look.mean += count * s.mean;
      goal.look.covariance += count * s.covariance;
    }
    if (goal.look.count > 0) {
      goal.look.mean /= static_cast<double>(goal.look.count);
      goal.look.covariance = goal.look.covariance / static_cast<double>(goal.look.count);
    }
    if (reference && all[*reference][label].count >= min_texels)
      goal.look = all[*reference][label];
    else if (reference)
      goal.paintings = 0;  // no target
  }
  return goals;
}

std::array<ColourMap, 256> find_maps(const LabelStatistics& own,
                                     const std::array<Goal, 256>& goals) {
  std::array<ColourMap, 256> maps;
  glm::dvec3 shift(0.0);
  double count = 0.0;
  const auto shared = [&](std::size_t label) {
    return own[label].count >= min_texels && goals[label].paintings > 1;
  };
  for (std::size_t label = 0; label < unused_label; ++label) {
    if (!shared(label)) continue;
    const Statistics& goal = goals[label].look;
    maps[label].matrix =
        linear_transport_map(own[label].covariance, goal.covariance, min_deviation * min_deviation,
                             {1.0 / largest_gain, largest_gain});
    maps[label].shift = goal.mean - maps[label].matrix * own[label].mean;
    shift += static_cast<double>(own[label].count) * (goal.mean - own[label].mean);
    count += static_cast<double>(own[label].count);
  }
  for (std::size_t label = 0; label < unused_label; ++label)
    if (!shared(label) && count > 0.0) maps[label].shift = shift / count;
  return maps;
}

// Maps each texel by the maps of the labels around it, weighted by their shares.
Grid<glm::vec3> apply_maps(const LabelledPicture& painting, const Grid<glm::dvec3>& lab,
                           const std::array<ColourMap, 256>& maps) {
  const Grid<std::uint8_t>& labels = *painting.labels;
  Grid<glm::dvec3> sum(lab.width(), lab.height(), glm::dvec3(0.0));
  Grid<float> weight(lab.width(), lab.height(), 0.F);
  std::array<bool, 256> there{};
  for (const std::uint8_t label : labels) there[label] = true;
  for (std::size_t label = 0; label < unused_label; ++label) {
    if (!there[label]) continue;
    Grid<float> share(lab.width(), lab.height(), 0.F);
    for (std::size_t i = 0; i < share.size(); ++i) share[i] = labels[i] == label ? 1.F : 0.F;
    share = gaussian_blur(share, border_texels);
    parallel_rows(lab.height(), [&](int y) {
      for (int x = 0; x < lab.width(); ++x) {
        const std::size_t i = lab.index(x, y);
        if (!(share[i] > 0.F)) continue;
        sum[i] += static_cast<double>(share[i]) * (maps[label].matrix * lab[i] + maps[label].shift);
        weight[i] += share[i];
      }
    });
  }
  Grid<glm::vec3> out = *painting.picture;
  parallel_rows(lab.height(), [&](int y) {
    for (int x = 0; x < lab.width(); ++x) {
      const std::size_t i = lab.index(x, y);
      if (labels[i] != unused_label && weight[i] > 0.F)
        out[i] = glm::clamp(from_oklab(sum[i] / static_cast<double>(weight[i])), 0.F, 1.F);
    }
  });
  return out;
}

}  // namespace

std::vector<Grid<glm::vec3>> harmonize(const std::vector<LabelledPicture>& pictures,
                                       std::optional<std::size_t> reference) {
  if (reference && *reference >= pictures.size())
    throw Error(ErrorKind::usage, "harmonize",
                fmt::format("painting {} does not exist", *reference + 1),
                fmt::format("1 … {}", pictures.size()));
  std::vector<Grid<glm::dvec3>> labs;
  std::vector<LabelStatistics> statistics;
  for (const LabelledPicture& painting : pictures) {
    if (!painting.picture->same_size(*painting.labels))
      throw Error(ErrorKind::usage, "harmonize", "a painting and its labels have different sizes",
                  "the same size");
    labs.push_back(to_lab(*painting.picture));
    statistics.push_back(measure(labs.back(), *painting.labels));
  }
  const std::array<Goal, 256> goals = find_goals(statistics, reference);
  std::vector<Grid<glm::vec3>> out;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (reference && i == *reference)
      out.push_back(*pictures[i].picture);
    else
      out.push_back(apply_maps(pictures[i], labs[i], find_maps(statistics[i], goals)));
  }
  return out;
}

std::vector<Grid<glm::vec3>> harmonize_as(const std::string& how,
                                          const std::vector<LabelledPicture>& pictures) {
  if (how == "common") return harmonize(pictures, std::nullopt);
  if (how == "first") return harmonize(pictures, 0);
  if (how != "off" && how != "regions")
    throw Error(ErrorKind::usage, "harmonize", how, "off, common, first or regions");
  std::vector<Grid<glm::vec3>> out;
  std::vector<Grid<std::uint8_t>> counts;
  bool first_counts = false;
  for (const LabelledPicture& each : pictures) {
    out.push_back(*each.picture);
    if (how == "off") continue;
    if (!each.labels->same_size(*each.picture))
      throw Error(ErrorKind::usage, "harmonize", "a painting and its labels have different sizes",
                  "the same size");
    Grid<std::uint8_t>& counted =
        counts.emplace_back(each.picture->width(), each.picture->height());
    for (std::size_t i = 0; i < counted.size(); ++i)
      counted[i] = (*each.labels)[i] != unused_label ? 1 : 0;
    const bool any =
        std::any_of(counted.begin(), counted.end(), [](std::uint8_t c) { return c != 0; });
    if (counts.size() == 1) first_counts = any;
    if (counts.size() == 1 || !any || !first_counts) continue;
    const Grid<glm::vec3> corrected =
        correct_colours(*each.picture, *pictures.front().picture, {}, counted, counts.front());
    for (std::size_t i = 0; i < counted.size(); ++i)
      if (counted[i] != 0) out.back()[i] = corrected[i];
  }
  return out;
}

double colour_distance(const LabelledPicture& a, const LabelledPicture& b, std::uint8_t label) {
  constexpr int bins = 256;
  constexpr std::array<double, 3> low = {0.0, -0.4, -0.4};
  constexpr std::array<double, 3> width = {1.0, 0.8, 0.8};
  using Histogram = std::array<std::array<double, bins>, 3>;
  const auto histogram = [&](const LabelledPicture& painting) {
    Histogram h{};
    double count = 0.0;
    for (std::size_t i = 0; i < painting.labels->size(); ++i) {
      if ((*painting.labels)[i] != label) continue;
      const glm::dvec3 lab = to_oklab((*painting.picture)[i]);
      count += 1.0;
      for (int c = 0; c < 3; ++c) {
        const auto axis = static_cast<std::size_t>(c);
        h[axis][static_cast<std::size_t>(
            std::clamp((lab[c] - low[axis]) / width[axis] * bins, 0.0, bins - 1.0))] += 1.0;
      }
    }
    for (auto& axis : h)
      for (double& bin : axis) bin /= std::max(count, 1.0);
    return count > 0.0 ? std::optional(h) : std::nullopt;
  };
  const auto of_a = histogram(a);
  const auto of_b = histogram(b);
  if (!of_a || !of_b) return 0.0;
  double distance = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double ahead = 0.0;  // how much more of a than of b is below this bin
    for (std::size_t bin = 0; bin < bins; ++bin) {
      ahead += (*of_a)[axis][bin] - (*of_b)[axis][bin];
      distance += std::abs(ahead) * width[axis] / bins / 3.0;
    }
  }
  return distance;
}

}  // namespace belvedere
