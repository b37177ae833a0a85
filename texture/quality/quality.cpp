#include "texture/quality/quality.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "texture/quality/quality_parts.h"

namespace belvedere {

namespace {

using quality::Histogram;

// Mean of f over exemplars, weighted by the class's texels there; NaN values are skipped.
template <class F>
double over_exemplars(const std::vector<Exemplar>& exemplars, std::uint8_t label, F&& f) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const Grid<std::uint8_t>& labels = exemplars[e].guides.label;
    const double weight = static_cast<double>(std::count(labels.begin(), labels.end(), label));
    if (weight == 0.0) continue;
    const double value = f(e);
    if (std::isnan(value)) continue;
    sum += weight * value;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

double ratio(double output, double exemplar) {
  return std::isnan(output) || std::isnan(exemplar) || exemplar <= 0.0 ? 0.0 : output / exemplar;
}

void measure_copying(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                     const GuideStack& target, const QualityParameters& parameters,
                     SynthesisQuality& quality) {
  const Grid<std::uint8_t>* requested = target.find(parameters.guide);
  std::array<std::size_t, 256> errors{};
  std::vector<Grid<std::uint32_t>> uses;
  uses.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars)
    uses.emplace_back(exemplar.picture.width(), exemplar.picture.height(), 0U);
  std::size_t matched = 0;
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match m = matches[i];
    if (m.exemplar == Match::none) {
      ++quality.without_texel;
      continue;
    }
    const GuideStack& source = exemplars[m.exemplar].guides;
    ++matched;
    if (source.label(m.x, m.y) == target.label[i]) ++agreeing;
    if (source.label(m.x, m.y) == unused_label) ++quality.excluded_used;
    quality.max_used = std::max(quality.max_used, static_cast<int>(++uses[m.exemplar](m.x, m.y)));
    const Grid<std::uint8_t>* offered = source.find(parameters.guide);
    if (requested != nullptr && offered != nullptr)
      ++errors[static_cast<std::size_t>(std::abs((*requested)[i] - (*offered)(m.x, m.y)))];
  }
  if (matched > 0)
    quality.label_agreement = static_cast<double>(agreeing) / static_cast<double>(matched);
  std::size_t used = 0;
  std::size_t texels = 0;
  for (const Grid<std::uint32_t>& counts : uses) {
    texels += counts.size();
    used += counts.size() - static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 0U));
  }
  quality.texels_used = static_cast<double>(used) / static_cast<double>(texels);
  const std::size_t count = std::accumulate(errors.begin(), errors.end(), std::size_t{0});
  if (count > 0) {
    double sum = 0.0;
    for (std::size_t e = 0; e < errors.size(); ++e) sum += static_cast<double>(e * errors[e]);
    quality.guide_error_mean = sum / static_cast<double>(count);
    quality.guide_error_95 = quality::quantile(errors.data(), errors.size(), 0.95);
  }
}

bool one_offset(const Match& a, const Match& b, int dx, int dy) {
  return a.exemplar != Match::none && a.exemplar == b.exemplar && b.x - a.x == dx &&
         b.y - a.y == dy;
}

void measure_pieces(const MatchField& matches, const GuideStack& target, float depth_ratio,
                    SynthesisQuality& quality) {
  const std::vector<std::size_t> sizes = piece_sizes(matches);
  quality.largest_piece = sizes.empty() ? 0 : sizes.front();
  std::size_t pairs = 0, joined = 0, jumps = 0, across = 0;
  const auto look = [&](int x, int y, int dx, int dy) {
    if (!matches.contains(x + dx, y + dy)) return;
    const bool same = one_offset(matches(x, y), matches(x + dx, y + dy), dx, dy);
    ++pairs;
    joined += same ? 1 : 0;
    if (target.depth_m.empty()) return;
    const float a = target.depth_m(x, y);
    const float b = target.depth_m(x + dx, y + dy);
    if (a == b || std::max(a, b) <= depth_ratio * std::min(a, b)) return;
    ++jumps;
    across += same ? 1 : 0;
  };
  for (int y = 0; y < matches.height(); ++y) {
    for (int x = 0; x < matches.width(); ++x) {
      look(x, y, 1, 0);
      look(x, y, 0, 1);
    }
  }
  if (pairs > 0) quality.coherence = static_cast<double>(joined) / static_cast<double>(pairs);
  if (jumps > 0)
    quality.across_silhouettes = static_cast<double>(across) / static_cast<double>(jumps);
}

constexpr std::size_t guide_steps = 16;
constexpr std::size_t border_steps = 5;  // within 2, 4, 8, 15 pixels, and beyond

std::size_t border_step(std::uint8_t squared) {
  return squared <= 4 ? 0 : squared <= 16 ? 1 : squared <= 64 ? 2 : squared < 225 ? 3 : 4;
}

// Computed once for all pictures, before the loop over classes.
struct Borders {
  Grid<std::uint8_t> target;
  std::vector<Grid<std::uint8_t>> exemplars;
};

// Weights of the texels of a class that give them the target's distribution of the guide and of the
// distance from borders.
void weigh_texels(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                  const Borders& borders, const std::string& guide, std::uint8_t label,
                  std::vector<Grid<float>>& weights) {
  const auto cell = [](const Grid<std::uint8_t>* values, const Grid<std::uint8_t>& distances,
                       std::size_t i) {
    return (values == nullptr ? 0U : static_cast<std::size_t>((*values)[i]) * guide_steps / 256) *
               border_steps +
           border_step(distances[i]);
  };
  bool shared = target.find(guide) != nullptr;
  for (const Exemplar& exemplar : exemplars)
    shared = shared && exemplar.guides.find(guide) != nullptr;
  std::array<double, guide_steps * border_steps> requested{};
  std::array<double, guide_steps * border_steps> offered{};
  const Grid<std::uint8_t>* values = shared ? target.find(guide) : nullptr;
  for (std::size_t i = 0; i < target.label.size(); ++i) {
    if (target.label[i] == label) ++requested[cell(values, borders.target, i)];
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t e = 0; e < exemplars.size(); ++e) {
      const GuideStack& stack = exemplars[e].guides;
      const Grid<std::uint8_t>* texel_values = shared ? stack.find(guide) : nullptr;
      for (std::size_t i = 0; i < stack.label.size(); ++i) {
        if (stack.label[i] != label) continue;
        const std::size_t at = cell(texel_values, borders.exemplars[e], i);
        if (pass == 0)
          ++offered[at];
        else
          weights[e][i] = static_cast<float>(requested[at] / offered[at]);
      }
    }
  }
}

struct ClassColours {
  std::array<Histogram, 3> output{};
  std::array<Histogram, 3> exemplars{};
  std::array<Histogram, 3> reweighted{};
};

ClassColours colours_of_class(const Grid<Rgb8>& output, const Grid<std::uint8_t>& labels,
                              const std::vector<Exemplar>& exemplars,
                              const std::vector<Grid<float>>& weights, std::uint8_t label) {
  ClassColours colours;
  for (std::size_t i = 0; i < output.size(); ++i) {
    if (labels[i] != label) continue;
    for (std::size_t c = 0; c < 3; ++c) colours.output[c][output[i][c]] += 1.0;
  }
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    for (std::size_t i = 0; i < exemplars[e].picture.size(); ++i) {
      if (exemplars[e].guides.label[i] != label) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint8_t value = exemplars[e].picture[i][c];
        colours.exemplars[c][value] += 1.0;
        colours.reweighted[c][value] += static_cast<double>(weights[e][i]);
      }
    }
  }
  return colours;
}

double colour_distance(const std::array<Histogram, 3>& a, const std::array<Histogram, 3>& b) {
  return (quality::wasserstein(a[0], b[0]) + quality::wasserstein(a[1], b[1]) +
          quality::wasserstein(a[2], b[2])) /
         3.0;
}

void measure_whole_picture(const Grid<Rgb8>& output, const std::vector<Exemplar>& exemplars,
                           const Borders& borders, const QualityParameters& parameters,
                           SynthesisQuality& quality) {
  const SpeckShares specks = speck_shares(output, borders.target);
  SpeckShares usual;
  double self = 0.0;
  double area = 0.0;
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const double weight = static_cast<double>(exemplars[e].picture.size());
    const SpeckShares here = speck_shares(exemplars[e].picture, borders.exemplars[e]);
    usual.inside += weight * here.inside;
    usual.border += weight * here.border;
    if (parameters.repeat_samples > 0)
      self += weight * self_distance(exemplars[e].picture, parameters.repeat_samples);
    area += weight;
  }
  quality.specks_inside = specks.inside / std::max(usual.inside / area, 1e-6);
  quality.specks_border = specks.border / std::max(usual.border / area, 1e-6);
  if (parameters.repeat_samples > 0)
    quality.self_repeat = ratio(self_distance(output, parameters.repeat_samples), self / area);
}

ClassQuality measure_class(const Grid<Rgb8>& output, const std::vector<Exemplar>& exemplars,
                           const GuideStack& target, const Borders& borders,
                           const std::vector<Grid<float>>& weights, std::uint8_t label) {
  ClassQuality of;
  of.label = label;
  of.sharpness = ratio(mean_gradient(output, target.label, borders.target, label),
                       over_exemplars(exemplars, label, [&](std::size_t e) {
                         return mean_gradient(exemplars[e].picture, exemplars[e].guides.label,
                                              borders.exemplars[e], label);
                       }));
  const int tolerance =
      static_cast<int>(std::lround(over_exemplars(exemplars, label, [&](std::size_t e) {
        return static_cast<double>(
            stroke_tolerance(exemplars[e].picture, exemplars[e].guides.label, label));
      })));
  of.stroke_run = ratio(stroke_run(output, target.label, borders.target, label, tolerance),
                        over_exemplars(exemplars, label, [&](std::size_t e) {
                          return stroke_run(exemplars[e].picture, exemplars[e].guides.label,
                                            borders.exemplars[e], label, tolerance);
                        }));
  const quality::CliqueDistances cliques =
      quality::clique_distances(output, target.label, exemplars, weights, label);
  of.clique_distance = cliques.distance;
  of.clique_floor = cliques.floor;
  of.clique_beyond_floor = cliques.beyond_floor;
  const ClassColours colours = colours_of_class(output, target.label, exemplars, weights, label);
  of.colour_distance = colour_distance(colours.output, colours.exemplars);
  of.colour_floor = colour_distance(colours.reweighted, colours.exemplars);
  of.colour_beyond_floor = colour_distance(colours.output, colours.reweighted);
  return of;
}

}  // namespace

std::vector<std::size_t> piece_sizes(const MatchField& matches) {
  std::vector<std::size_t> sizes;
  Grid<std::uint8_t> seen(matches.width(), matches.height(), 0);
  std::vector<std::pair<int, int>> open;
  for (int y = 0; y < matches.height(); ++y) {
    for (int x = 0; x < matches.width(); ++x) {
      if (seen(x, y) || matches(x, y).exemplar == Match::none) continue;
      open.assign(1, {x, y});
      seen(x, y) = 1;
      std::size_t size = 0;
      while (!open.empty()) {
        const auto [ax, ay] = open.back();
        open.pop_back();
        ++size;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!matches.contains(ax + dx, ay + dy) || seen(ax + dx, ay + dy)) continue;
          if (!one_offset(matches(ax, ay), matches(ax + dx, ay + dy), dx, dy)) continue;
          seen(ax + dx, ay + dy) = 1;
          open.emplace_back(ax + dx, ay + dy);
        }
      }
      sizes.push_back(size);
    }
  }
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

SynthesisQuality measure_quality(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                                 const GuideStack& target, const QualityParameters& parameters) {
  if (exemplars.empty())
    throw Error(ErrorKind::usage, "quality of a synthesis", "there is no exemplar", "at least one");
  for (const Exemplar& exemplar : exemplars) check_exemplar(exemplar);
  check_guide_stack(target, "target");
  if (!matches.same_size(target.label)) {
    throw Error(ErrorKind::usage, "quality of a synthesis",
                fmt::format("matches of {} × {} pixels", matches.width(), matches.height()),
                fmt::format("{} × {}, the size of the target", target.width(), target.height()));
  }
  std::vector<const Grid<Rgb8>*> layers;
  layers.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars) layers.push_back(&exemplar.picture);
  const Grid<Rgb8> output = replay(matches, layers, Grid<Rgb8>());

  SynthesisQuality quality;
  measure_copying(matches, exemplars, target, parameters, quality);
  measure_pieces(matches, target, parameters.depth_ratio, quality);
  quality.exemplars = exemplars.size();
  quality.seams = seam_visibility(matches, exemplars, target.depth_m, parameters.depth_ratio);

  Borders borders{border_distance_squared(target.label), {}};
  for (const Exemplar& exemplar : exemplars)
    borders.exemplars.push_back(border_distance_squared(exemplar.guides.label));
  measure_whole_picture(output, exemplars, borders, parameters, quality);

  std::vector<Grid<float>> weights;
  weights.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars)
    weights.emplace_back(exemplar.picture.width(), exemplar.picture.height(), 0.0F);
  std::array<std::size_t, 256> pixels{};
  std::array<std::size_t, 256> texels{};
  for (const std::uint8_t label : target.label) ++pixels[label];
  for (const Exemplar& exemplar : exemplars) {
    for (const std::uint8_t label : exemplar.guides.label) ++texels[label];
  }
  for (std::size_t l = 0; l < unused_label; ++l) {
    if (pixels[l] == 0 || texels[l] == 0) continue;
    const std::uint8_t label = static_cast<std::uint8_t>(l);
    weigh_texels(exemplars, target, borders, parameters.guide, label, weights);
    quality.classes.push_back(measure_class(output, exemplars, target, borders, weights, label));
    quality.classes.back().pixels = pixels[l];
    quality.classes.back().texels = texels[l];
  }
  return quality;
}

}  // namespace belvedere
