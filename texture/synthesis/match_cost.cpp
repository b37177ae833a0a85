#include "texture/synthesis/match_cost.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "texture/synthesis/synth_kernel.h"
#include "texture/synthesis/synth_plane.h"

namespace belvedere {
namespace {

constexpr float depth_ratio =
    1.04F;  // between neighbours of one surface, as on the finest level of synthesize

void check_matches(const MatchField& matches, const std::vector<Exemplar>& exemplars) {
  for (const Exemplar& exemplar : exemplars) check_exemplar(exemplar);
  for (const Match& m : matches) {
    if (m.exemplar == Match::none) continue;
    if (m.exemplar >= exemplars.size() || !exemplars[m.exemplar].picture.contains(m.x, m.y))
      throw Error(ErrorKind::usage, "costs of a match field",
                  "a match points outside the exemplars");
  }
}

void check_size(const MatchField& matches, int width, int height) {
  if (matches.width() != width || matches.height() != height)
    throw Error(ErrorKind::usage, "costs of a match field",
                fmt::format("matches of {} × {} pixels", matches.width(), matches.height()),
                fmt::format("{} × {}, the size of the target", width, height));
}

std::uint32_t to_word(const Rgb8& colour, std::uint8_t label) {
  return colour[0] | static_cast<std::uint32_t>(colour[1]) << 8 |
         static_cast<std::uint32_t>(colour[2]) << 16 | static_cast<std::uint32_t>(label) << 24;
}

// A plane of pictures with their labels as classes: they need not be dense where nothing is counted
// by class.
synth::Plane make_plane_of(
    const std::vector<std::pair<const Grid<Rgb8>*, const Grid<std::uint8_t>*>>& pictures) {
  std::vector<std::pair<int, int>> sizes;
  sizes.reserve(pictures.size());
  for (const auto& [picture, labels] : pictures)
    sizes.emplace_back(picture->width(), picture->height());
  synth::Plane plane = synth::make_plane(sizes, 0);
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    const auto [picture, labels] = pictures[p];
    for (int y = 0; y < picture->height(); ++y)
      for (int x = 0; x < picture->width(); ++x)
        plane.words[plane.index(static_cast<int>(p), x, y)] =
            to_word((*picture)(x, y), (*labels)(x, y));
  }
  synth::pad(plane);
  return plane;
}

}  // namespace

std::vector<Grid<std::uint32_t>> texel_uses(const MatchField& matches,
                                            const std::vector<Exemplar>& exemplars) {
  check_matches(matches, exemplars);
  std::vector<Grid<std::uint32_t>> uses;
  uses.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars)
    uses.emplace_back(exemplar.picture.width(), exemplar.picture.height(), 0U);
  for (const Match& m : matches)
    if (m.exemplar != Match::none) ++uses[m.exemplar](m.x, m.y);
  return uses;
}

Grid<float> seam_cost(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                      const Grid<std::uint8_t>& labels, const Grid<float>& depth_m) {
  check_matches(matches, exemplars);
  check_size(matches, labels.width(), labels.height());
  if (!depth_m.empty()) check_size(matches, depth_m.width(), depth_m.height());
  Grid<float> out(matches.width(), matches.height(), 0.F);
  if (exemplars.empty() || matches.empty()) return out;

  std::vector<std::pair<const Grid<Rgb8>*, const Grid<std::uint8_t>*>> sources;
  std::vector<const Grid<Rgb8>*> layers;
  for (const Exemplar& exemplar : exemplars) {
    sources.emplace_back(&exemplar.picture, &exemplar.guides.label);
    layers.push_back(&exemplar.picture);
  }
  const Grid<Rgb8> picture = replay(matches, layers, Grid<Rgb8>());
  const synth::Plane source = make_plane_of(sources);
  const synth::Plane target = make_plane_of({{&picture, &labels}});
  const std::vector<std::uint8_t> links = depth_m.empty()
                                              ? std::vector<std::uint8_t>()
                                              : synth::make_links(depth_m, target, depth_ratio);
  synth::KernelView view;
  view.target = &target;
  view.exemplars = &source;
  view.links = links.empty() ? nullptr : links.data();
  parallel_rows(matches.height(), [&](int y) {
    for (int x = 0; x < matches.width(); ++x) {
      const Match& m = matches(x, y);
      if (m.exemplar == Match::none || labels(x, y) == unused_label) continue;
      out(x, y) = static_cast<float>(
          synth::patch_cost(view, target.index(0, x, y), source.index(m.exemplar, m.x, m.y)));
    }
  });
  return out;
}

Grid<std::uint8_t> guide_error(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                               const GuideStack& target, const std::string& guide) {
  check_matches(matches, exemplars);
  check_size(matches, target.width(), target.height());
  const Grid<std::uint8_t>* requested = target.find(guide);
  std::vector<const Grid<std::uint8_t>*> offered;
  offered.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars) offered.push_back(exemplar.guides.find(guide));
  if (requested == nullptr ||
      std::all_of(offered.begin(), offered.end(), [](const auto* of) { return of == nullptr; }))
    throw Error(ErrorKind::usage, "costs of a match field",
                fmt::format("guide \"{}\" is missing on one side", guide),
                "a guide of the target and of an exemplar");
  Grid<std::uint8_t> out(matches.width(), matches.height(), 0);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match& m = matches[i];
    if (m.exemplar != Match::none && offered[m.exemplar] != nullptr)
      out[i] =
          static_cast<std::uint8_t>(std::abs((*requested)[i] - (*offered[m.exemplar])(m.x, m.y)));
  }
  return out;
}

float guide_cost(std::uint8_t error, double weight) {
  return static_cast<float>(static_cast<double>(synth::price::guide) * weight * error * error);
}

}  // namespace belvedere
