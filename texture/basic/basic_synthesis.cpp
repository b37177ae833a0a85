#include "texture/basic/basic_synthesis.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <mutex>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "texture/synthesis/class_supply.h"

namespace belvedere {
namespace {

std::int32_t square(std::int32_t v) { return v * v; }
std::int32_t difference(const Rgb8& a, const Rgb8& b, std::size_t c) { return std::int32_t{a[c]} - std::int32_t{b[c]}; }
std::int32_t grey_of(const Rgb8& c) { return (c[0] + 2 * c[1] + c[2]) / 4; }

constexpr ColourDistance distances[] = {
    {"squares", "squared differences of red, green and blue",
     [](const Rgb8& a, const Rgb8& b) { return square(difference(a, b, 0)) + square(difference(a, b, 1)) + square(difference(a, b, 2)); },
     3 * 255 * 255},
    {"absolute", "differences of red, green and blue, 255 times, so that white against black is as far as in squares",
     [](const Rgb8& a, const Rgb8& b) {
       return 255 * (std::abs(difference(a, b, 0)) + std::abs(difference(a, b, 1)) + std::abs(difference(a, b, 2)));
     },
     3 * 255 * 255},
    {"grey", "squared differences of grey, three times: hue does not count",
     [](const Rgb8& a, const Rgb8& b) { return 3 * square(grey_of(a) - grey_of(b)); }, 3 * 255 * 255},
};

constexpr double most_comparisons = 1e12;
constexpr double guide_price = 6.2;  // of a squared difference, beside a mean squared difference of colour: as synth_kernel.h has them

using Shares = std::array<std::uint8_t, 256>;  // of classes in a square, in 255ths

// Shares of the labels around a place, those outside of the picture and unused ones left out.
Shares shares_around(const Grid<std::uint8_t>& labels, int x, int y, int radius) {
  std::array<std::int32_t, 256> counts{};
  std::int32_t total = 0;
  for (int j = std::max(0, y - radius); j <= std::min(labels.height() - 1, y + radius); ++j) {
    for (int i = std::max(0, x - radius); i <= std::min(labels.width() - 1, x + radius); ++i) {
      if (labels(i, j) == unused_label) continue;
      ++counts[labels(i, j)];
      ++total;
    }
  }
  Shares shares{};
  for (std::size_t k = 0; k < shares.size() && total > 0; ++k)
    shares[k] = static_cast<std::uint8_t>((510 * counts[k] + total) / (2 * total));
  return shares;
}

// What every pair of a pixel and a texel is reckoned with.
struct Search {
  const std::vector<Exemplar>& exemplars;
  const GuideStack& target;
  const BasicParameters& parameters;
  Grid<std::uint8_t> labels;                                    // the target's, with fallbacks
  std::vector<std::pair<std::size_t, double>> guides;           // of the target's stack, with their weights
  std::vector<std::vector<const Grid<std::uint8_t>*>> offered;  // by exemplar and guide
  std::vector<std::uint8_t> classes;                            // that any side has
  std::vector<std::vector<std::uint8_t>> shares;                // by exemplar: of `classes`, by texel
  std::vector<std::pair<int, int>> shape;                       // the L, steps to neighbours, the nearest first
  int radius = 0;
};

// Costs come apart where other classes cost more than all else together: first the one, then the other.
struct Cost {
  double classes = 0.0;
  double rest = 0.0;
  bool operator<(const Cost& other) const { return classes < other.classes || (classes == other.classes && rest < other.rest); }
};

std::vector<std::uint8_t> shares_of(const Search& search, const Grid<std::uint8_t>& labels, int x, int y) {
  const Shares all = shares_around(labels, x, y, search.radius);
  std::vector<std::uint8_t> shares;
  for (const std::uint8_t k : search.classes) shares.push_back(all[k]);
  return shares;
}

Search make_search(const std::vector<Exemplar>& exemplars, const GuideStack& target, const BasicParameters& parameters) {
  if (exemplars.empty()) throw Error(ErrorKind::usage, "synthesis", "no exemplar", "at least one");
  for (const Exemplar& exemplar : exemplars) check_exemplar(exemplar);
  check_guide_stack(target, "target");
  const int side = parameters.neighbourhood;
  if (side < 3 || side > 31 || side % 2 == 0)
    throw Error(ErrorKind::usage, "synthesis neighbourhood", fmt::format("{}", side), "an odd number, 3 … 31");
  if (parameters.distance.between == nullptr || !(parameters.land_cover >= 0.0))
    throw Error(ErrorKind::usage, "basic synthesis", "no distance, or a price below 0 of classes", "a distance and a price of 0 or more");
  Search search{exemplars, target, parameters, serving_labels(exemplars, target.label, parameters.fallback), {}, {}, {}, {}, {}, side / 2};
  for (std::size_t g = 0; g < target.guides.size(); ++g) {
    const std::string& name = target.guides[g].name;
    double weight = 1.0;
    for (const auto& [guide, value] : parameters.weights)
      if (guide == name) weight = value;
    const bool everywhere =
        std::all_of(exemplars.begin(), exemplars.end(), [&](const Exemplar& exemplar) { return exemplar.guides.find(name) != nullptr; });
    if (everywhere && weight > 0.0) search.guides.emplace_back(g, weight);
  }
  for (const Exemplar& exemplar : exemplars) {
    std::vector<const Grid<std::uint8_t>*>& of = search.offered.emplace_back();
    for (const auto& [g, weight] : search.guides) of.push_back(exemplar.guides.find(target.guides[g].name));
  }
  std::array<bool, 256> there{};
  for (const std::uint8_t label : search.labels) there[label] = true;
  for (const Exemplar& exemplar : exemplars)
    for (const std::uint8_t label : exemplar.guides.label) there[label] = true;
  for (std::size_t k = 0; k < unused_label; ++k)
    if (there[k]) search.classes.push_back(static_cast<std::uint8_t>(k));
  for (const Exemplar& exemplar : exemplars) {
    const Grid<std::uint8_t>& labels = exemplar.guides.label;
    std::vector<std::uint8_t>& shares = search.shares.emplace_back(labels.size() * search.classes.size());
    parallel_rows(labels.height(), [&](int y) {
      for (int x = 0; x < labels.width(); ++x) {
        const std::vector<std::uint8_t> of = shares_of(search, labels, x, y);
        std::copy(of.begin(), of.end(), shares.begin() + static_cast<std::ptrdiff_t>(labels.index(x, y) * search.classes.size()));
      }
    });
  }
  for (int dy = -search.radius; dy <= 0; ++dy)
    for (int dx = -search.radius; dx <= (dy == 0 ? -1 : search.radius); ++dx) search.shape.emplace_back(dx, dy);
  std::stable_sort(search.shape.begin(), search.shape.end(), [](const auto& a, const auto& b) {
    return a.first * a.first + a.second * a.second < b.first * b.first + b.second * b.second;
  });
  return search;
}

// What of the cost belongs to a pixel alone, reckoned once for all its candidates.
struct Asked {
  int x = 0;
  int y = 0;
  std::vector<std::uint8_t> shares;
  std::vector<std::pair<std::size_t, Rgb8>> made;  // neighbour of the shape, and its colour
};

Asked ask(const Search& search, const MatchField& field, int x, int y) {
  Asked asked{x, y, shares_of(search, search.labels, x, y), {}};
  for (std::size_t n = 0; n < search.shape.size(); ++n) {
    const auto [dx, dy] = search.shape[n];
    if (!field.contains(x + dx, y + dy)) continue;
    const Match m = field(x + dx, y + dy);
    if (m.exemplar != Match::none) asked.made.emplace_back(n, search.exemplars[m.exemplar].picture(m.x, m.y));
  }
  return asked;
}

// The cost of a texel, or any that is not below `best` where it is not.
Cost cost_of(const Search& search, const Asked& asked, const Match& texel, const Cost& best) {
  const Exemplar& exemplar = search.exemplars[texel.exemplar];
  const std::size_t index = exemplar.guides.label.index(texel.x, texel.y);
  const std::size_t count = search.classes.size();
  std::int64_t classes = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const int off = asked.shares[k] - search.shares[texel.exemplar][index * count + k];
    classes += off * off;
  }
  Cost cost;
  if (std::isinf(search.parameters.land_cover))
    cost.classes = static_cast<double>(classes);
  else
    cost.rest = search.parameters.land_cover * static_cast<double>(classes);
  const std::size_t pixel = search.labels.index(asked.x, asked.y);
  for (std::size_t g = 0; g < search.guides.size(); ++g) {
    const int off = search.target.guides[search.guides[g].first].values[pixel] - (*search.offered[texel.exemplar][g])[index];
    cost.rest += guide_price * search.guides[g].second * off * off;
  }
  if (!(cost < best) || asked.made.empty()) return cost;
  const double guides = cost.rest;
  std::int64_t sum = 0;
  for (const auto& [n, colour] : asked.made) {
    const auto [dx, dy] = search.shape[n];
    const bool inside = exemplar.picture.contains(texel.x + dx, texel.y + dy);
    sum += inside ? search.parameters.distance.between(colour, exemplar.picture(texel.x + dx, texel.y + dy))
                  : search.parameters.distance.largest;
    cost.rest = guides + static_cast<double>(sum) / static_cast<double>(asked.made.size());
    if (!(cost < best)) return cost;
  }
  return cost;
}

struct Found {
  Cost cost{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Match texel;
};

// All texels, the rows of all exemplars side by side; ties to the first.
Found search_all(const Search& search, const Asked& asked) {
  Found best;
  for (std::size_t e = 0; e < search.exemplars.size(); ++e) {
    const Grid<std::uint8_t>& labels = search.exemplars[e].guides.label;
    std::mutex joining;
    Found here;
    parallel_ranges(labels.height(), std::max(1, labels.height() / 16), [&](int begin, int end) {
      Found of_rows{best.cost, {}};
      for (int y = begin; y < end; ++y) {
        for (int x = 0; x < labels.width(); ++x) {
          if (labels(x, y) == unused_label) continue;
          const Match texel{static_cast<std::uint16_t>(e), static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
          const Cost cost = cost_of(search, asked, texel, of_rows.cost);
          if (cost < of_rows.cost) of_rows = {cost, texel};
        }
      }
      if (of_rows.texel.exemplar == Match::none) return;
      const std::scoped_lock lock(joining);
      const bool earlier = std::pair{of_rows.texel.y, of_rows.texel.x} < std::pair{here.texel.y, here.texel.x};
      if (of_rows.cost < here.cost || (!(here.cost < of_rows.cost) && earlier)) here = of_rows;
    });
    if (here.cost < best.cost) best = here;
  }
  return best;
}

// What continues the copies of neighbours, of the pixel's class.
Found search_coherent(const Search& search, const Asked& asked, const MatchField& field, std::uint8_t label) {
  Found best;
  for (const auto& [n, colour] : asked.made) {
    const auto [dx, dy] = search.shape[n];
    const Match m = field(asked.x + dx, asked.y + dy);
    const Grid<std::uint8_t>& labels = search.exemplars[m.exemplar].guides.label;
    if (!labels.contains(m.x - dx, m.y - dy) || labels(m.x - dx, m.y - dy) != label) continue;
    const Match texel{m.exemplar, static_cast<std::uint16_t>(m.x - dx), static_cast<std::uint16_t>(m.y - dy)};
    const Cost cost = cost_of(search, asked, texel, best.cost);
    if (cost < best.cost) best = {cost, texel};
  }
  return best;
}

// A texel by chance, of those of a label where there are any: where a picture begins all are as good.
Match first_texel(const Search& search, std::uint8_t label) {
  std::vector<Match> texels;
  for (std::size_t e = 0; e < search.exemplars.size(); ++e) {
    const Grid<std::uint8_t>& labels = search.exemplars[e].guides.label;
    for (int y = 0; y < labels.height(); ++y)
      for (int x = 0; x < labels.width(); ++x)
        if (labels(x, y) == label)
          texels.push_back({static_cast<std::uint16_t>(e), static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
  }
  if (texels.empty()) return {};
  return texels[random_index(static_cast<std::uint32_t>(texels.size()), stream_seed(search.parameters.seed, Stream::synthesis), 0, 0)];
}

}  // namespace

std::span<const ColourDistance> colour_distances() { return distances; }

const ColourDistance* find_colour_distance(std::string_view name) {
  const auto found =
      std::find_if(std::begin(distances), std::end(distances), [&](const ColourDistance& distance) { return distance.name == name; });
  return found == std::end(distances) ? nullptr : found;
}

MatchField synthesize_basic(const std::vector<Exemplar>& exemplars, const GuideStack& target, const BasicParameters& parameters,
                            Progress& progress) {
  const Search search = make_search(exemplars, target, parameters);
  double texels = 0.0;
  for (const Exemplar& exemplar : exemplars) texels += static_cast<double>(exemplar.picture.size());
  const double comparisons = texels * static_cast<double>(target.label.size());
  if (!parameters.coherent && comparisons > most_comparisons)
    throw Error(ErrorKind::limit, "basic synthesis", fmt::format("{:.1e} comparisons of a pixel with a texel", comparisons),
                "at most 1e12: smaller pictures, or the usual method");
  progress.begin("synthesize row by row", target.height());
  MatchField field(target.width(), target.height());
  bool begun = false;
  for (int y = 0; y < target.height(); ++y) {
    for (int x = 0; x < target.width(); ++x) {
      const std::uint8_t label = search.labels(x, y);
      if (label == unused_label) continue;
      if (!begun && search.guides.empty() && parameters.land_cover == 0.0) {
        field(x, y) = first_texel(search, label);
        begun = true;
        continue;
      }
      begun = true;
      const Asked asked = ask(search, field, x, y);
      Found found;
      if (parameters.coherent) found = search_coherent(search, asked, field, label);
      if (found.texel.exemplar == Match::none) found = search_all(search, asked);
      field(x, y) = found.texel;
    }
    progress.advance(1);
  }
  return field;
}

}  // namespace belvedere
