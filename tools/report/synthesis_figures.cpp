#include "tools/report/synthesis_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace belvedere::tools {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

// The class's value that lies farthest from 1; values of 0 are not known.
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

Json seams_json(const SeamVisibility& seams) {
  return Json::object()
      .add("pairs", Json::number(static_cast<double>(seams.pairs)))
      .add("compared", Json::number(static_cast<double>(seams.compared)))
      .add("step", Json::number(seams.step))
      .add("visibility", Json::number(seams.visibility));
}

}  // namespace

std::vector<QualityFigure> key_figures(const SynthesisQuality& q) {
  std::vector<QualityFigure> figures = {
      {"label_agreement", "texels of the class asked for, share", "class", q.label_agreement, 1.0, 1.0},
      {"guide_error_mean", "guide off by, mean, 0–255", "guide", q.guide_error_mean, 0.0, 2.2},
      {"guide_error_95", "guide off by, 95th percentile", "guide 95 %", q.guide_error_95, 0.0, no_limit},
      {"sharpness", "sharpness against the painting, worst class", "sharpness", farthest_from_one(q, &ClassQuality::sharpness), 0.95, 1.05},
      {"clique_distance", "strokes' clique distance, worst class, 0–2", "clique", largest(q, &ClassQuality::clique_distance), 0.0, 0.08},
      {"colour_distance", "colours' distance, worst class, grey levels", "colour", largest(q, &ClassQuality::colour_distance), 0.0, 3.0},
      {"stroke_run", "length of strokes against the painting, worst class", "strokes", farthest_from_one(q, &ClassQuality::stroke_run),
       0.85, 1.15},
      {"largest_piece", "largest piece copied whole, pixels", "piece", static_cast<double>(q.largest_piece), 0.0, 250.0},
      {"most_used", "uses of the texel used most", "used", static_cast<double>(q.most_used), 0.0, 12.0},
      {"self_repeat", "self-repetition against the painting", "repetition", q.self_repeat, 0.9, 1.1},
      {"specks_inside", "specks inside classes against the painting", "specks", q.specks_inside, 0.0, 1.2},
      {"specks_border", "specks at borders against the painting", "specks, border", q.specks_border, 0.0, 1.2},
      {"coverage", "texels used at all, share", "texels", q.texels_used, 0.0, no_limit},
      {"coherence", "neighbours copied together, share", "together", q.coherence, 0.0, no_limit},
      {"across_silhouettes", "of those across silhouettes, share", "silhouettes", q.across_silhouettes, 0.0, 0.0},
      {"without_texel", "pixels without a texel", "empty", static_cast<double>(q.without_texel), 0.0, 0.0},
      {"excluded_used", "pixels that copy what is excluded", "excluded", static_cast<double>(q.excluded_used), 0.0, 0.0}};
  // Of one painting there is no seam to compare with. What eyes are content with is not known: seams inside a painting stand beside.
  if (q.exemplars > 1) {
    figures.push_back(
        {"seams_between", "seams between paintings against the paintings' neighbours", "seams", q.seams.between.visibility, 0.0, no_limit});
    figures.push_back(
        {"seams_within", "seams inside a painting against its neighbours", "seams inside", q.seams.within.visibility, 0.0, no_limit});
  }
  return figures;
}

Json quality_json(const SynthesisQuality& quality, const std::function<std::string(std::uint8_t)>& class_name) {
  Json out = Json::object();
  for (const QualityFigure& figure : key_figures(quality))
    out.add(figure.key, Json::object().add("value", Json::number(figure.value)).add("good", Json::boolean(figure.good())));
  if (quality.exemplars > 1)
    out.add("seams", Json::object().add("between", seams_json(quality.seams.between)).add("within", seams_json(quality.seams.within)));
  Json classes = Json::array();
  for (const ClassQuality& of : quality.classes) {
    classes.add(Json::object()
                    .add("label", Json::number(of.label))
                    .add("name", Json::text(class_name(of.label)))
                    .add("pixels", Json::number(static_cast<double>(of.pixels)))
                    .add("texels", Json::number(static_cast<double>(of.texels)))
                    .add("sharpness", Json::number(of.sharpness))
                    .add("stroke_run", Json::number(of.stroke_run))
                    .add("clique_distance", Json::number(of.clique_distance))
                    .add("clique_floor", Json::number(of.clique_floor))
                    .add("clique_beyond_floor", Json::number(of.clique_beyond_floor))
                    .add("colour_distance", Json::number(of.colour_distance))
                    .add("colour_floor", Json::number(of.colour_floor))
                    .add("colour_beyond_floor", Json::number(of.colour_beyond_floor)));
  }
  return out.add("classes", std::move(classes));
}

}  // namespace belvedere::tools
