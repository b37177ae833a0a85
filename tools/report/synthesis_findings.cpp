#include "tools/report/synthesis_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

// Guides of the target and of an exemplar that have a weight.
std::vector<std::string> guides_in_use(const SynthesisReportInput& in) {
  std::vector<std::string> names;
  for (const Guide& guide : in.target.guides) {
    const bool shared = std::any_of(
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
  for (std::size_t e = 0; e < in.exemplars.size(); ++e)
    if (in.exemplars[e].guides.find(name) == nullptr)  // its texels cost nothing in the maps
      matched -= static_cast<std::size_t>(
          std::count_if(in.matches.begin(), in.matches.end(),
                        [&](const Match& match) { return match.exemplar == e; }));
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

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

// The class's value farthest from 1; values of 0 are not known.
double farthest_from_one(const SynthesisQuality& quality, double ClassQuality::*value) {
  double worst = 1.0;
  for (const ClassQuality& of : quality.classes)
    if (of.*value > 0.0 && std::abs(of.*value - 1.0) > std::abs(worst - 1.0)) worst = of.*value;
  return worst;
}

double largest(const SynthesisQuality& quality, double ClassQuality::*value) {
  double worst = 0.0;
  for (const ClassQuality& of : quality.classes) worst = std::max(worst, of.*value);
  return worst;
}

}  // namespace

std::vector<QualityFigure> key_figures(const SynthesisQuality& q) {
  std::vector<QualityFigure> figures = {
      {"label_agreement", "texels of the class asked for, share", "class", q.label_agreement, 1.0,
       1.0},
      {"guide_error_mean", "guide deviation, mean, 0–255", "guide", q.guide_error_mean, 0.0, 2.2},
      {"guide_error_95", "guide deviation, 95th percentile", "guide 95 %", q.guide_error_95, 0.0,
       no_limit},
      {"sharpness", "sharpness relative to the painting, worst class", "sharpness",
       farthest_from_one(q, &ClassQuality::sharpness), 0.95, 1.05},
      {"clique_distance", "strokes' clique distance, worst class, 0–2", "clique",
       largest(q, &ClassQuality::clique_distance), 0.0, 0.08},
      {"colour_distance", "colours' distance, worst class, grey levels", "colour",
       largest(q, &ClassQuality::colour_distance), 0.0, 3.0},
      {"stroke_run", "length of strokes relative to the painting, worst class", "strokes",
       farthest_from_one(q, &ClassQuality::stroke_run), 0.85, 1.15},
      {"largest_piece", "largest piece copied whole, pixels", "piece",
       static_cast<double>(q.largest_piece), 0.0, 250.0},
      {"most_used", "uses of the most used texel", "used", static_cast<double>(q.max_used), 0.0,
       12.0},
      {"self_repeat", "self-repetition relative to the painting", "repetition", q.self_repeat, 0.9,
       1.1},
      {"specks_inside", "specks inside classes relative to the painting", "specks", q.specks_inside,
       0.0, 1.2},
      {"specks_border", "specks at borders relative to the painting", "specks, border",
       q.specks_border, 0.0, 1.2},
      {"coverage", "texels used at all, share", "texels", q.texels_used, 0.0, no_limit},
      {"coherence", "neighbours copied together, share", "together", q.coherence, 0.0, no_limit},
      {"across_silhouettes", "of those across silhouettes, share", "silhouettes",
       q.across_silhouettes, 0.0, 0.0},
      {"without_texel", "pixels without a texel", "empty", static_cast<double>(q.without_texel),
       0.0, 0.0},
      {"excluded_used", "pixels that copy excluded texels", "excluded",
       static_cast<double>(q.excluded_used), 0.0, 0.0}};
  // With one painting there is no seam to compare with. No good range is known: seams inside a
  // painting are listed for comparison.
  if (q.exemplars > 1) {
    figures.push_back({"seams_between",
                       "seams between paintings relative to the paintings' neighbours", "seams",
                       q.seams.between.visibility, 0.0, no_limit});
    figures.push_back({"seams_within", "seams inside a painting relative to its neighbours",
                       "seams inside", q.seams.within.visibility, 0.0, no_limit});
  }
  return figures;
}

ReportTable class_table(const SynthesisQuality& quality, const std::vector<ClassTexels>& supplies,
                        const std::function<std::string(std::uint8_t)>& class_name) {
  ReportTable classes(
      {{"name", "class"},
       {"pixels", "pixels"},
       {"asked", "demand", "", "including those of classes that have no texels of their own"},
       {"texels", "texels"},
       {"texels_needed", "needed"},
       {"sharpness", "sharpness", ".2f"},
       {"stroke_run", "strokes", ".2f"},
       {"clique_distance", "clique", ".3f"},
       {"clique_floor", "floor", ".3f"},
       {"clique_beyond_floor", "beyond", ".3f"},
       {"colour_distance", "colour", ".1f"},
       {"colour_floor", "floor", ".1f"},
       {"colour_beyond_floor", "beyond", ".1f"}});
  for (const ClassQuality& of : quality.classes) {
    const auto available = std::find_if(supplies.begin(), supplies.end(),
                                        [&](const ClassTexels& s) { return s.label == of.label; });
    const bool served = available != supplies.end();
    const auto ratio = [](double v, double min, double max) {
      return evaluated(v == 0.0 ? not_known : v, v == 0.0 || (v >= min && v <= max));
    };
    classes.row(
        class_name(of.label), of.pixels,
        served ? static_cast<double>(available->pixels) : not_known, of.texels,
        served ? evaluated(static_cast<double>(available->texels_needed()), available->enough())
               : known(not_known),
        ratio(of.sharpness, 0.95, 1.05), ratio(of.stroke_run, 0.85, 1.15),
        evaluated(of.clique_distance, of.clique_distance <= 0.08), of.clique_floor,
        of.clique_beyond_floor, evaluated(of.colour_distance, of.colour_distance <= 3.0),
        of.colour_floor, of.colour_beyond_floor);
  }
  return classes;
}

}  // namespace belvedere::tools
