#include "tools/report/exemplar_report_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "texture/quality/quality.h"
#include "tools/report/picture_text.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int painting_px = 600;  // longest side of a painting on the page
constexpr int swatch_side = 96;   // texels
constexpr int swatch_times = 2;
constexpr int inside_squared = 64;  // as in quality.h

using Counts = std::array<std::size_t, 256>;

Counts count_values(const Grid<std::uint8_t>& values, const Grid<std::uint8_t>& labels,
                    std::uint8_t label) {
  Counts counts{};
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label) ++counts[values[i]];
  return counts;
}

// The purest part of a class: most texels of it inside.
Grid<glm::vec3> purest_paint(const Exemplar& exemplar, const Grid<std::uint8_t>& borders,
                             std::uint8_t label) {
  const Grid<std::uint8_t>& labels = exemplar.guides.label;
  Grid<float> score(labels.width(), labels.height(), 0.F);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label)
      score[i] =
          borders[i] > inside_squared ? 1.F : 0.01F;  // along borders where there is no inside
  return enlarged(to_picture(cut(exemplar.picture, best_window(score, {}, swatch_side))),
                  swatch_times);
}

// One row per class: how many of its texels have each value of the guide, and how many pixels of
// the target ask for it.
Json coverage_chart(const Exemplar& exemplar, const ExemplarSurvey& survey, const Guide& guide,
                    const GuideStack& asked, const ExemplarFindings& findings) {
  const Grid<std::uint8_t>* requested = asked.label.empty() ? nullptr : asked.find(guide.name);
  Json rows = Json::array();
  for (const ClassSurvey& of : survey.classes) {
    Json row = Json::object()
                   .add("name", Json::text(findings.name(of.label)))
                   .add("counts",
                        Json::numbers(count_values(guide.values, exemplar.guides.label, of.label)));
    if (requested != nullptr)
      row.add("asked", Json::numbers(count_values(*requested, asked.label, of.label)));
    rows.add(std::move(row));
  }
  Json scale = Json::array();
  for (int v = 0; v < 256; v += 32)
    scale.add(Json::array({Json::number(v), Json::text(findings.value(guide.name, v))}));
  return Json::object().add("rows", std::move(rows)).add("scale", std::move(scale));
}

}  // namespace

void write_exemplar_report(const std::string& folder, const std::vector<Exemplar>& exemplars,
                           const GuideStack& asked, const ExemplarFindings& findings,
                           const std::string& command) {
  Report page(folder);
  page.section("verdict", "Findings");
  page.listing(findings_text(findings));
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const Exemplar& exemplar = exemplars[e];
    const ExemplarSurvey& survey = findings.paintings.at(e).survey;
    const std::string number = fmt::format("{}", e + 1);
    page.section("painting_" + number, exemplar.name,
                 "The painting and its classes; texels that are never copied are near black.");
    page.picture("painting_" + number, reduced_picture(to_picture(exemplar.picture), painting_px),
                 "painting");
    page.picture("classes_" + number,
                 reduced_picture(label_picture(exemplar.guides.label), painting_px), "classes");

    page.section(
        "swatches_" + number, "Swatches",
        fmt::format(
            "For each class the {0} × {0} texels farthest from other classes, twice as large.",
            swatch_side));
    const Grid<std::uint8_t> borders = border_distance_squared(exemplar.guides.label);
    for (std::size_t c = 0; c < survey.classes.size(); ++c) {
      const ClassSurvey& of = survey.classes[c];
      if (c % 6 == 0) page.next_row();
      page.picture(fmt::format("swatch_{}_{}", number, of.label),
                   purest_paint(exemplar, borders, of.label),
                   fmt::format("{}: {}", findings.name(of.label), describe_service(of)));
    }
    for (std::size_t g = 0; g < exemplar.guides.guides.size(); ++g) {
      const Guide& guide = exemplar.guides.guides[g];
      page.section(fmt::format("coverage_{}_{}", number, g + 1), "Painted at which " + guide.name,
                   "Brighter: more texels of the class have that value. Blue below: the picture to "
                   "be made asks for it; blue under black has no texel of its own.");
      page.add("coverage", coverage_chart(exemplar, survey, guide, asked, findings));
    }
  }
  page.write(
      {.title = "Suitability of the paintings",
       .lead = fmt::format("{} painting{}.", exemplars.size(), exemplars.size() == 1 ? "" : "s"),
       .command = command,
       .data = findings_json(findings)});
}

}  // namespace belvedere::tools
