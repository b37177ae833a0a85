#include "renderer/register/painter_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "base/math_exact.h"
#include "base/matrix/matrix.h"

namespace belvedere {
namespace {

constexpr double first_step_m = 150.0;  // between the first lines that are tried …
constexpr double last_step_m = 18.0;    // … halved until it is below this
constexpr double min_gain = 0.005;      // in ln of the determinant
constexpr double clip_deviations = 3.0;
constexpr std::size_t min_samples = 300;
constexpr std::size_t min_group_samples = 20;
constexpr std::size_t air_terms = 5;  // normal, distance, ln distance
// How much paler snow is than all other open ground, and snow of winter on meadows: OKLab.
constexpr double min_snow_paleness = 0.06;
constexpr double min_snow_red = -0.02, max_snow_yellow = 0.02;  // snow is neither green nor yellow
constexpr double min_snow_contrast = 0.12;  // of its lightness to that of forest

// Classes that share a constant: painters tell them by strokes, not by colour.
namespace group {
enum Number : std::size_t { water, meadow, settlement, forest, grass, scree, rock, snow, count };
}
constexpr std::size_t groups = group::count;

std::size_t group_of(LandCoverClass id) {
  switch (id) {
    case LandCoverClass::water:
      return group::water;
    case LandCoverClass::valley_floor:
    case LandCoverClass::pasture:
      return group::meadow;
    case LandCoverClass::settlement:
      return group::settlement;
    case LandCoverClass::forest:
      return group::forest;
    case LandCoverClass::alpine_grass:
    case LandCoverClass::shrub:
      return group::grass;
    case LandCoverClass::scree:
    case LandCoverClass::sand:
      return group::scree;
    case LandCoverClass::rock:
      return group::rock;
    case LandCoverClass::snow:
    case LandCoverClass::glacier:
      return group::snow;
    case LandCoverClass::sky:
      break;
  }
  return groups;
}

using Air = std::array<double, air_terms>;

// A division of the samples into groups, and how well it explains their colours.
struct Explanation {
  std::array<std::size_t, groups> count{};
  std::array<glm::dvec3, groups> mean{};    // OKLab
  std::array<glm::dvec3, groups> colour{};  // at the mean of normals and distances
  double unexplained = 0.0;                 // ln of the determinant
  bool dark_forest = true;                  // darker than meadows
  bool pale_snow = true;  // paler than all other open ground, and not yellower than stone
};

class Colours {
 public:
  explicit Colours(std::span<const PaintSample> samples) : samples_(samples), air_(samples.size()) {
    Air mean{};
    double mean_distance = 0.0;
    const auto count = static_cast<double>(samples.size());
    for (const PaintSample& sample : samples) mean_distance += sample.distance_m / count;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const PaintSample& s = samples[i];
      air_[i] = {s.normal.x, s.normal.y, s.normal.z, s.distance_m / mean_distance,
                 exact::log(std::max(s.distance_m, 1.0))};
      for (std::size_t k = 0; k < air_terms; ++k) mean[k] += air_[i][k] / count;
    }
    for (Air& air : air_)
      for (std::size_t k = 0; k < air_terms; ++k) air[k] -= mean[k];
  }

  Explanation explain(const std::vector<LandCoverClass>& classes) const {
    std::vector<std::size_t> of;
    of.reserve(classes.size());
    for (const LandCoverClass id : classes) of.push_back(group_of(id));
    Explanation out = fit(of);
    const std::size_t open =
        out.count[group::grass] > out.count[group::meadow] ? group::grass : group::meadow;
    out.dark_forest = out.count[group::forest] == 0 || out.count[open] == 0 ||
                      out.colour[group::forest].x < out.colour[open].x;
    double pale = 0.0;     // of other open ground
    double yellow = -1.0;  // of stone
    for (const std::size_t g : {group::meadow, group::grass, group::scree, group::rock}) {
      if (out.count[g] < min_group_samples) continue;
      pale = std::max(pale, out.colour[g].x);
      if (g == group::scree || g == group::rock) yellow = std::max(yellow, out.colour[g].z);
    }
    const glm::dvec3& white = out.colour[group::snow];
    const bool yellower = yellow > -1.0 && white.z > yellow;
    out.pale_snow =
        out.count[group::snow] == 0 || (white.x >= pale + min_snow_paleness && !yellower);
    return out;
  }

 private:
  Explanation fit(const std::vector<std::size_t>& of) const {
    constexpr std::size_t unknowns = groups + air_terms;
    Matrix normal(unknowns, unknowns), right(unknowns, 3);
    Explanation out;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const std::size_t g = of[i];
      if (g == groups) continue;
      ++out.count[g];
      const Air& air = air_[i];
      const glm::dvec3& colour = samples_[i].oklab;
      out.mean[g] += colour;
      normal(g, g) += 1.0;
      for (std::size_t k = 0; k < air_terms; ++k) {
        normal(groups + k, g) += air[k];
        for (std::size_t l = 0; l <= k; ++l) normal(groups + k, groups + l) += air[k] * air[l];
        for (int c = 0; c < 3; ++c)
          right(groups + k, static_cast<std::size_t>(c)) += air[k] * colour[c];
      }
      for (int c = 0; c < 3; ++c) right(g, static_cast<std::size_t>(c)) += colour[c];
    }
    // The ridge makes unknowns that no sample determines 0.
    constexpr double ridge = 1e-9;  // of the number of samples
    for (std::size_t k = 0; k < unknowns; ++k)
      normal(k, k) += ridge * static_cast<double>(of.size());
    const std::optional<Cholesky> factors = Cholesky::of(std::move(normal));
    if (!factors) return {.unexplained = std::numeric_limits<double>::max()};
    const Matrix found = factors->solve(right);
    for (std::size_t g = 0; g < groups; ++g) {
      out.mean[g] /= static_cast<double>(std::max<std::size_t>(out.count[g], 1));
      out.colour[g] = {found(g, 0), found(g, 1), found(g, 2)};
    }
    out.unexplained = ln_determinant(remainders(of, found));
    return out;
  }

  std::vector<glm::dvec3> remainders(const std::vector<std::size_t>& of,
                                     const Matrix& found) const {
    std::vector<glm::dvec3> out;
    out.reserve(of.size());
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (of[i] == groups) continue;
      glm::dvec3 rest = samples_[i].oklab;
      for (int c = 0; c < 3; ++c) {
        const auto column = static_cast<std::size_t>(c);
        rest[c] -= found(of[i], column);
        for (std::size_t k = 0; k < air_terms; ++k)
          rest[c] -= found(groups + k, column) * air_[i][k];
      }
      out.push_back(rest);
    }
    return out;
  }

  static double ln_determinant(std::vector<glm::dvec3> rests) {
    const auto count = static_cast<double>(std::max<std::size_t>(rests.size(), 1));
    glm::dvec3 square(0.0);
    for (const glm::dvec3& rest : rests) square += rest * rest / count;
    glm::dmat3 covariance(0.0);
    for (glm::dvec3& rest : rests) {
      for (int c = 0; c < 3; ++c) {
        const double limit = clip_deviations * std::sqrt(square[c]);
        rest[c] = std::clamp(rest[c], -limit, limit);
      }
      covariance += glm::outerProduct(rest, rest) / count;
    }
    return exact::log(std::max(glm::determinant(covariance), 1e-30));
  }

  std::span<const PaintSample> samples_;
  std::vector<Air> air_;
};

// Whether meadows are snow: as pale and as colourless.
bool shows_winter(const Explanation& by_lines) {
  const std::size_t wooded = by_lines.count[group::forest];
  for (const std::size_t open : {group::meadow, group::grass}) {
    if (by_lines.count[open] < min_group_samples || wooded < min_group_samples) continue;
    const double contrast = by_lines.colour[open].x - by_lines.colour[group::forest].x;
    if (by_lines.mean[open].y < min_snow_red || by_lines.mean[open].z > max_snow_yellow ||
        contrast < min_snow_contrast)
      return false;
  }
  return by_lines.count[group::meadow] + by_lines.count[group::grass] >= min_group_samples;
}

// Tries lines and keeps the best.
class Search {
 public:
  Search(const Colours& colours, ClassesOfLines classes_of)
      : colours_(colours), classes_of_(classes_of) {
    best_ = explain(lines_).unexplained;
  }

  const PainterLines& lines() const { return lines_; }
  double unexplained() const { return best_; }
  Explanation explain(const PainterLines& lines) const {
    return colours_.explain(classes_of_(lines));
  }

  void take(const Search& other) {
    lines_ = other.lines_;
    best_ = other.best_;
  }

  // The best of a line's altitudes, if it gains enough.
  void scan(double PainterLines::*line, double min_m, double max_m) {
    const double before = best_;
    const double usual = lines_.*line;
    double found_m = usual;
    for (double at = min_m; at <= max_m; at += first_step_m)
      if (gains(line, at)) found_m = at;
    lines_.*line = found_m;
    if (before - best_ >= min_gain) return;
    lines_.*line = usual;
    best_ = before;
  }

  // Searches around the present position, in steps of half the length each time.
  void refine(double PainterLines::*line) {
    if (lines_.*line <= 0.0) return;
    for (double step = first_step_m / 2.0; step >= last_step_m; step /= 2.0)
      for (const double to : {lines_.*line - step, lines_.*line + step})
        if (gains(line, to)) {
          lines_.*line = to;
          break;
        }
  }

 private:
  bool gains(double PainterLines::*line, double at) {
    PainterLines tried = lines_;
    tried.*line = at;
    const Explanation found = explain(tried);
    const bool plausible = line == &PainterLines::treeline_m ? found.dark_forest : found.pale_snow;
    if (!plausible || !(found.unexplained < best_)) return false;
    best_ = found.unexplained;
    return true;
  }

  const Colours& colours_;
  ClassesOfLines classes_of_;
  PainterLines lines_;
  double best_ = std::numeric_limits<double>::max();
};

}  // namespace

PainterLines find_painter_lines(std::span<const PaintSample> samples, double min_m, double max_m,
                                ClassesOfLines classes_of) {
  if (samples.size() < min_samples) return {};
  const Colours colours(samples);
  Search search(colours, classes_of);
  search.scan(&PainterLines::treeline_m, min_m, max_m);
  const Search without_snow = search;
  search.scan(&PainterLines::snowline_m, min_m, max_m);
  search.refine(&PainterLines::snowline_m);  // or ice would mend the last step
  // Glaciers reach below the snow line on flat ground; either line may pass for both.
  Search ice_first = without_snow;
  search.scan(&PainterLines::ice_line_m, min_m, max_m);
  ice_first.scan(&PainterLines::ice_line_m, min_m, max_m);
  if (ice_first.lines().ice_line_m > 0.0) {
    ice_first.scan(&PainterLines::snowline_m, min_m, max_m);
    if (ice_first.unexplained() < search.unexplained() - min_gain) search.take(ice_first);
  }
  // Snow that was taken for other ground may have pulled at the first line.
  if (search.lines().snowline_m > 0.0) search.scan(&PainterLines::treeline_m, min_m, max_m);
  search.refine(&PainterLines::treeline_m);
  search.refine(&PainterLines::snowline_m);
  search.refine(&PainterLines::ice_line_m);
  PainterLines out = search.lines();
  const PainterLines snowed{out.treeline_m, 0.0, true, 0.0};
  const Explanation by_lines = search.explain(out);
  if (shows_winter(by_lines) &&
      search.explain(snowed).unexplained < by_lines.unexplained + min_gain)
    out = snowed;
  out.treeline_m = std::round(out.treeline_m);
  out.snowline_m = std::round(out.snowline_m);
  out.ice_line_m = std::round(out.ice_line_m);
  return out;
}

}  // namespace belvedere
