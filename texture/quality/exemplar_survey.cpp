#include "texture/quality/exemplar_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "texture/quality/quality.h"
#include "texture/quality/quality_parts.h"

namespace belvedere {
namespace {

constexpr int square = 32;                   // of the checkerboard, texels
constexpr int min_gap = 16;                  // steps of a guide
constexpr std::size_t fewest_texels = 1000;  // of a half

// The texels of one half; the rest is excluded.
template <class F>
Exemplar half_of(const Exemplar& exemplar, F&& belongs) {
  Exemplar half;
  half.name = exemplar.name;
  half.picture = exemplar.picture;
  half.guides.label = exemplar.guides.label;
  for (int y = 0; y < half.picture.height(); ++y)
    for (int x = 0; x < half.picture.width(); ++x)
      if (!belongs(x, y)) half.guides.label(x, y) = unused_label;
  return half;
}

std::array<quality::Histogram, 3> colours_of(const Exemplar& exemplar, std::uint8_t label) {
  std::array<quality::Histogram, 3> out{};
  for (std::size_t i = 0; i < exemplar.picture.size(); ++i) {
    if (exemplar.guides.label[i] != label) continue;
    for (std::size_t c = 0; c < 3; ++c) out[c][exemplar.picture[i][c]] += 1.0;
  }
  return out;
}

HalvesDistance compare_halves(const Exemplar& a, const Exemplar& b, std::uint8_t label) {
  const auto texels = [label](const Exemplar& half) {
    return static_cast<std::size_t>(
        std::count(half.guides.label.begin(), half.guides.label.end(), label));
  };
  HalvesDistance distance;
  if (texels(a) < fewest_texels || texels(b) < fewest_texels) return distance;
  distance.known = true;
  const std::vector<Grid<float>> even{Grid<float>(b.picture.width(), b.picture.height(), 1.F)};
  distance.clique = quality::clique_distances(a.picture, a.guides.label, {b}, even, label).distance;
  const auto of_a = colours_of(a, label);
  const auto of_b = colours_of(b, label);
  for (std::size_t c = 0; c < 3; ++c)
    distance.colour += quality::wasserstein(of_a[c], of_b[c]) / 3.0;
  return distance;
}

GuideTexels cover(const Guide& guide, const Grid<std::uint8_t>& labels, std::uint8_t label) {
  std::array<std::size_t, 256> counts{};
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label) ++counts[guide.values[i]];
  GuideTexels out;
  out.name = guide.name;
  out.low =
      static_cast<std::uint8_t>(std::lround(quality::quantile(counts.data(), counts.size(), 0.05)));
  out.high =
      static_cast<std::uint8_t>(std::lround(quality::quantile(counts.data(), counts.size(), 0.95)));
  int last = -1;  // last value with texels
  for (int v = 0; v < 256; ++v) {
    if (counts[static_cast<std::size_t>(v)] == 0) continue;
    if (last < 0) out.lowest = static_cast<std::uint8_t>(v);
    if (last >= 0 && v - last - 1 >= min_gap) out.gaps.push_back({last + 1, v - 1});
    out.highest = static_cast<std::uint8_t>(v);
    last = v;
  }
  return out;
}

double or_zero(double value) { return std::isnan(value) ? 0.0 : value; }

}  // namespace

ExemplarSurvey survey_exemplar(const Exemplar& exemplar) {
  check_exemplar(exemplar);
  const Grid<std::uint8_t>& labels = exemplar.guides.label;
  const Grid<std::uint8_t> borders = border_distance_squared(labels);
  const int centre = exemplar.picture.width() / 2;
  const Exemplar left = half_of(exemplar, [&](int x, int) { return x < centre; });
  const Exemplar right = half_of(exemplar, [&](int x, int) { return x >= centre; });
  const Exemplar white =
      half_of(exemplar, [](int x, int y) { return (x / square + y / square) % 2 == 0; });
  const Exemplar black =
      half_of(exemplar, [](int x, int y) { return (x / square + y / square) % 2 != 0; });

  ExemplarSurvey survey;
  survey.texels = labels.size();
  std::array<std::size_t, 256> texels{};
  std::array<std::size_t, 256> inside{};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    ++texels[labels[i]];
    if (borders[i] > quality::inside_squared) ++inside[labels[i]];
  }
  survey.excluded = texels[unused_label];
  for (std::size_t l = 0; l < unused_label; ++l) {
    if (texels[l] == 0) continue;
    const auto label = static_cast<std::uint8_t>(l);
    ClassSurvey of;
    of.label = label;
    of.texels = texels[l];
    of.inside = inside[l];
    of.sharpness = or_zero(mean_gradient(exemplar.picture, labels, borders, label));
    of.stroke_run_px = or_zero(stroke_run(exemplar.picture, labels, borders, label,
                                          stroke_tolerance(exemplar.picture, labels, label)));
    of.left_right = compare_halves(left, right, label);
    of.checkerboard = compare_halves(white, black, label);
    for (const Guide& guide : exemplar.guides.guides)
      of.guides.push_back(cover(guide, labels, label));
    survey.classes.push_back(std::move(of));
  }
  return survey;
}

namespace {

// Sums of R, G and B and of the steps of R + G + B to the right and down, and the guide.
using Features = std::array<double, 6>;

struct Block {
  const GuideStack* guides = nullptr;
  int x = 0;  // its first texel
  int y = 0;
  Features features{};
};
constexpr int block_side = 8;

// The blocks of one class.
void add_blocks(const Exemplar& exemplar, std::vector<Block>& blocks) {
  const Grid<std::uint8_t>& labels = exemplar.guides.label;
  for (int y = 0; y + block_side <= labels.height(); y += block_side)
    for (int x = 0; x + block_side <= labels.width(); x += block_side) {
      Block block{&exemplar.guides, x, y, {}};
      bool pure = labels(x, y) != unused_label;
      for (int j = 0; j < block_side && pure; ++j)
        for (int i = 0; i < block_side; ++i) {
          pure = pure && labels(x + i, y + j) == labels(x, y);
          const Rgb8& here = exemplar.picture(x + i, y + j);
          for (std::size_t c = 0; c < 3; ++c) block.features[c] += here[c];
          const int sum = quality::sum_of(here);
          block.features[3] +=
              std::abs(quality::sum_of(exemplar.picture.clamped(x + i + 1, y + j)) - sum);
          block.features[4] +=
              std::abs(quality::sum_of(exemplar.picture.clamped(x + i, y + j + 1)) - sum);
        }
      if (pure) blocks.push_back(block);
    }
}

// Sums by group, and the variation within groups.
struct Variation {
  struct Group {
    double count = 0.0;
    Features sum{}, squares{};
  };
  std::map<int, Group> groups;
  void add(int group, const Features& features) {
    Group& g = groups[group];
    g.count += 1.0;
    for (std::size_t f = 0; f < features.size(); ++f) {
      g.sum[f] += features[f];
      g.squares[f] += features[f] * features[f];
    }
  }
  // Unbiased variance of the features from … to - 1 around the means of their groups.
  double within(double count, std::size_t from, std::size_t to) const {
    double rest = 0.0;
    for (const auto& [label, g] : groups)
      for (std::size_t f = from; f < to; ++f) rest += g.squares[f] - g.sum[f] * g.sum[f] / g.count;
    return rest / std::max(1.0, count - static_cast<double>(groups.size()));
  }
};

}  // namespace

std::vector<GuideShare> explain_paint(const std::vector<Exemplar>& exemplars) {
  std::vector<Block> blocks;
  std::vector<GuideShare> shares;
  for (const Exemplar& exemplar : exemplars) {
    add_blocks(exemplar, blocks);
    for (const Guide& guide : exemplar.guides.guides)
      if (std::none_of(shares.begin(), shares.end(),
                       [&](const GuideShare& share) { return share.name == guide.name; }))
        shares.push_back({.name = guide.name});
  }
  for (GuideShare& share : shares) {
    Variation classes, values;  // by class, and by class and value
    double count = 0.0;
    for (Block& block : blocks) {
      const Grid<std::uint8_t>* guide = block.guides->find(share.name);
      if (guide == nullptr) continue;
      const int value = (*guide)(block.x + block_side / 2, block.y + block_side / 2);
      const int label = block.guides->label(block.x, block.y);
      block.features[5] = value;
      classes.add(label, block.features);
      values.add(label * 16 + value / 16, block.features);
      count += 1.0;
    }
    share.difference = 2.0 * classes.within(count, 5, 6);
    if (count <= static_cast<double>(values.groups.size())) continue;
    for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 3}, {3, 5}})
      if (const double all = classes.within(count, from, to); all > 0.0)
        share.explained = std::max(share.explained, 1.0 - values.within(count, from, to) / all);
  }
  return shares;
}

double mean_stroke_px(const std::vector<Exemplar>& exemplars) {
  double sum = 0.0;
  double texels = 0.0;
  for (const Exemplar& exemplar : exemplars) {
    const Grid<std::uint8_t>& labels = exemplar.guides.label;
    const Grid<std::uint8_t> borders = border_distance_squared(labels);
    std::array<double, 256> counts{};
    for (const std::uint8_t label : labels) counts[label] += 1.0;
    for (std::size_t l = 0; l < unused_label; ++l) {
      if (counts[l] == 0.0) continue;
      const auto label = static_cast<std::uint8_t>(l);
      const double run = stroke_run(exemplar.picture, labels, borders, label,
                                    stroke_tolerance(exemplar.picture, labels, label));
      if (std::isnan(run)) continue;
      sum += counts[l] * run;
      texels += counts[l];
    }
  }
  return texels > 0.0 ? sum / texels : 0.0;
}

std::vector<GuideFit> fit_guides(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                                 std::uint8_t label, int reach) {
  std::vector<GuideFit> fits;
  for (const Guide& guide : target.guides) {
    constexpr int nowhere = 256;
    std::array<int, 256> off{};  // from each value to the nearest texel's
    off.fill(nowhere);
    for (const Exemplar& exemplar : exemplars)
      if (const Grid<std::uint8_t>* values = exemplar.guides.find(guide.name))
        for (std::size_t i = 0; i < values->size(); ++i)
          if (exemplar.guides.label[i] == label) off[(*values)[i]] = 0;
    for (std::size_t v = 1; v < 256; ++v) off[v] = std::min(off[v], off[v - 1] + 1);
    for (std::size_t v = 255; v > 0; --v) off[v - 1] = std::min(off[v - 1], off[v] + 1);
    if (off[0] >= nowhere) continue;
    GuideFit fit{.name = guide.name};
    double pixels = 0.0, covered = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < guide.values.size(); ++i) {
      if (target.label[i] != label) continue;
      const int here = off[guide.values[i]];
      pixels += 1.0;
      covered += here <= reach ? 1.0 : 0.0;
      squares += here * here;
    }
    if (pixels > 0.0) {
      fit.covered = covered / pixels;
      fit.square = squares / pixels;
    }
    fits.push_back(fit);
  }
  return fits;
}

}  // namespace belvedere
