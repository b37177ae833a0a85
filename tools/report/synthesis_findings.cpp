#include "tools/report/synthesis_findings.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "texture/synthesis/match_cost.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int seam_places = 3;  // worst windows of each kind
constexpr int guide_places = 1;
constexpr int reuse_places = 2;
constexpr std::size_t guides_with_places = 3;

double weight_of(const SynthesisParameters& parameters, const std::string& guide) {
  double weight = 1.0;
  for (const auto& [name, value] : parameters.weights)
    if (name == guide) weight = value;
  return weight;
}

// Guides that exemplars and target share and that have a weight.
std::vector<std::string> guides_in_use(const SynthesisReportInput& in) {
  std::vector<std::string> names;
  for (const Guide& guide : in.target.guides) {
    const bool shared = std::all_of(
        in.exemplars.begin(), in.exemplars.end(),
        [&](const Exemplar& exemplar) { return exemplar.guides.find(guide.name) != nullptr; });
    if (shared && weight_of(in.parameters, guide.name) > 0.0) names.push_back(guide.name);
  }
  return names;
}

double mean_of(const Grid<float>& values, std::size_t count) {
  return deterministic_sum(values.size(),
                           [&](std::size_t i) { return static_cast<double>(values[i]); }) /
         static_cast<double>(std::max<std::size_t>(1, count));
}

GuideFindings look_at_guide(const SynthesisReportInput& in, const std::string& name,
                            std::size_t matched) {
  GuideFindings of;
  of.name = name;
  of.weight = weight_of(in.parameters, name);
  const Grid<std::uint8_t> off = guide_error(in.matches, in.exemplars, in.target, name);
  Grid<float> errors(off.width(), off.height());
  std::copy(off.begin(), off.end(), errors.begin());
  of.error_mean = mean_of(errors, matched);
  of.error_95 = percentile(errors, 0.95);
  of.cost_mean = mean_of(guide_cost_map(in, name), matched);
  return of;
}

// A window of a picture around a point, moved inside.
PixelRect window_around(int x, int y, int side, int width, int height) {
  const int w = std::min(side, width);
  const int h = std::min(side, height);
  const int x0 = std::clamp(x - w / 2, 0, width - w);
  const int y0 = std::clamp(y - h / 2, 0, height - h);
  return {x0, y0, x0 + w, y0 + h};
}

// Where most of a window was copied from: by the offset that most of its pixels share.
void find_source(const SynthesisReportInput& in, Place& position) {
  struct Offset {
    std::size_t count = 0;
    std::int64_t x = 0, y = 0;  // sums of texel positions
  };
  std::map<std::array<int, 3>, Offset> offsets;
  for (int y = position.window.y0; y < position.window.y1; ++y) {
    for (int x = position.window.x0; x < position.window.x1; ++x) {
      const Match& m = in.matches(x, y);
      if (m.exemplar == Match::none) continue;
      Offset& offset = offsets[{m.exemplar, m.x - x, m.y - y}];
      ++offset.count;
      offset.x += m.x;
      offset.y += m.y;
    }
  }
  for (const auto& [key, offset] : offsets) {
    if (offset.count <= position.piece) continue;
    position.piece = offset.count;
    position.exemplar = static_cast<std::size_t>(key[0]);
    const Grid<Rgb8>& picture = in.exemplars[position.exemplar].picture;
    const auto count = static_cast<std::int64_t>(offset.count);
    position.source =
        window_around(static_cast<int>(offset.x / count), static_cast<int>(offset.y / count),
                      worst_place_side, picture.width(), picture.height());
  }
}

// The windows with the largest sums, one after the other, without overlap.
void add_places(const SynthesisReportInput& in, Grid<float> score, int count,
                const std::string& why, const std::string& guide, std::vector<Place>& positions) {
  const auto leave_out = [&score](const PixelRect& window) {
    double sum = 0.0;
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        sum += static_cast<double>(score(x, y));
        score(x, y) = 0.F;
      }
    }
    return sum;
  };
  for (const Place& position : positions) leave_out(position.window);
  for (int n = 0; n < count; ++n) {
    Place position;
    position.letter = std::string(1, static_cast<char>('A' + positions.size()));
    position.why = why;
    position.guide = guide;
    position.window = best_window(score, {}, worst_place_side);
    if (leave_out(position.window) <= 0.0) return;
    find_source(in, position);
    if (position.piece > 0) positions.push_back(std::move(position));
  }
}

// How often the texel of each pixel is used.
Grid<float> use_map(const MatchField& matches, const std::vector<Grid<std::uint32_t>>& uses) {
  Grid<float> out(matches.width(), matches.height(), 0.F);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match& m = matches[i];
    if (m.exemplar != Match::none) out[i] = static_cast<float>(uses[m.exemplar](m.x, m.y));
  }
  return out;
}

}  // namespace

Grid<float> guide_cost_map(const SynthesisReportInput& in, const std::string& guide) {
  const Grid<std::uint8_t> off = guide_error(in.matches, in.exemplars, in.target, guide);
  const double weight = weight_of(in.parameters, guide);
  Grid<float> out(off.width(), off.height());
  std::transform(off.begin(), off.end(), out.begin(),
                 [weight](std::uint8_t v) { return guide_cost(v, weight); });
  return out;
}

SynthesisFindings look_at_synthesis(const SynthesisReportInput& in, Progress& progress) {
  const std::vector<std::string> guides = guides_in_use(in);
  progress.begin("measuring", static_cast<double>(guides.size() + 2));
  SynthesisFindings found;
  const bool altitude = std::find(guides.begin(), guides.end(), "altitude") != guides.end();
  found.quality = measure_quality(in.matches, in.exemplars, in.target,
                                  {.guide = altitude         ? "altitude"
                                            : guides.empty() ? std::string()
                                                             : guides.front()});
  progress.advance(1.0);
  found.available = class_texels(in.exemplars, in.target.label, in.parameters.fallback);
  const std::size_t matched = in.matches.size() - found.quality.without_texel;
  found.seams = seam_cost(in.matches, in.exemplars,
                          serving_labels(in.exemplars, in.target.label, in.parameters.fallback),
                          in.target.depth_m);
  found.seam_mean = mean_of(found.seams, matched);
  for (const std::string& guide : guides) {
    found.guides.push_back(look_at_guide(in, guide, matched));
    progress.advance(1.0);
  }
  std::stable_sort(
      found.guides.begin(), found.guides.end(),
      [](const GuideFindings& a, const GuideFindings& b) { return a.cost_mean > b.cost_mean; });
  found.uses = texel_uses(in.matches, in.exemplars);
  found.use_counts = use_map(in.matches, found.uses);
  add_places(in, found.seams, seam_places, "seams", "", found.positions);
  for (std::size_t g = 0; g < std::min(guides_with_places, found.guides.size()); ++g)
    add_places(in, guide_cost_map(in, found.guides[g].name), guide_places,
               found.guides[g].name + " off", found.guides[g].name, found.positions);
  add_places(in, found.use_counts, reuse_places, "texels used often", "", found.positions);
  progress.advance(1.0);

  return found;
}

}  // namespace belvedere::tools
