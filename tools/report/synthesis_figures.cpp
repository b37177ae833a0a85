#include "tools/report/synthesis_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace belvedere::tools {
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
