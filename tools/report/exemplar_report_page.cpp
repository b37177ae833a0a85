#include "tools/report/exemplar_report_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/text/markup.h"
#include "texture/quality/quality.h"
#include "tools/report/picture_text.h"
#include "tools/report/report_folder.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int painting_px = 600;  // longest side of a painting on the page
constexpr int swatch_side = 96;   // texels
constexpr int swatch_times = 2;
constexpr int inside_squared = 64;  // as in quality.h
constexpr int step_px = 3;          // a guide's value in a chart
constexpr int row_px = 16;
constexpr int names_px = 130;

using Counts = std::array<std::size_t, 256>;

Counts count_values(const Grid<std::uint8_t>& values, const Grid<std::uint8_t>& labels, std::uint8_t label) {
  Counts counts{};
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label) ++counts[values[i]];
  return counts;
}

// Where a class lies at its purest: most texels of it inside.
Grid<glm::vec3> swatch(const Exemplar& exemplar, const Grid<std::uint8_t>& borders, std::uint8_t label) {
  const Grid<std::uint8_t>& labels = exemplar.guides.label;
  Grid<float> score(labels.width(), labels.height(), 0.F);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label) score[i] = borders[i] > inside_squared ? 1.F : 0.01F;  // along borders where there is no inside
  return enlarged(to_picture(cut(exemplar.picture, best_window(score, {}, swatch_side))), swatch_times);
}

// What white stands for: nearly the largest count, because the ends of a guide's range may gather many texels.
float common_count(const Counts& counts) {
  std::vector<std::size_t> some;
  std::copy_if(counts.begin(), counts.end(), std::back_inserter(some), [](std::size_t n) { return n > 0; });
  std::sort(some.begin(), some.end());
  return some.empty() ? 1.F : static_cast<float>(some[(some.size() - 1) * 19 / 20]);
}

void fill(Grid<glm::vec3>& picture, int x0, int y0, int width, int height, glm::vec3 colour) {
  for (int y = y0; y < y0 + height; ++y) std::fill_n(picture.row(y) + x0, width, colour);
}

// A row a class: how many of its texels have each value of the guide, black none, white most; below, in blue, where the target asks for
// values.
Grid<glm::vec3> coverage_chart(const Exemplar& exemplar, const ExemplarSurvey& survey, const Guide& guide, const GuideStack& asked,
                               const ExemplarFindings& findings) {
  const Grid<std::uint8_t>* requested = asked.label.empty() ? nullptr : asked.find(guide.name);
  const int rows = static_cast<int>(survey.classes.size());
  constexpr int pitch = row_px + 8;
  Grid<glm::vec3> chart(names_px + 256 * step_px, rows * pitch + row_px, glm::vec3(1.F));
  for (int r = 0; r < rows; ++r) {
    const std::uint8_t label = survey.classes[static_cast<std::size_t>(r)].label;
    const int y0 = r * pitch;
    draw_text(chart, 2, y0 + 4, findings.name(label), glm::vec3(0.F), 1);
    const Counts texels = count_values(guide.values, exemplar.guides.label, label);
    const Counts pixels = requested == nullptr ? Counts{} : count_values(*requested, asked.label, label);
    Grid<float> shares(256, 1);
    const float most = common_count(texels);
    // The root lets few texels be seen beside many.
    for (int v = 0; v < 256; ++v) shares(v, 0) = std::sqrt(static_cast<float>(texels[static_cast<std::size_t>(v)]) / most);
    const Grid<glm::vec3> heat = heat_picture(shares, 1.F);
    for (int v = 0; v < 256; ++v) {
      fill(chart, names_px + v * step_px, y0, step_px, row_px, heat(v, 0));
      if (pixels[static_cast<std::size_t>(v)] > 0) fill(chart, names_px + v * step_px, y0 + row_px + 1, step_px, 3, {0.1F, 0.3F, 0.9F});
    }
  }
  for (int v = 0; v < 256; v += 32) {
    const int x = names_px + v * step_px;
    fill(chart, x, rows * pitch - 3, 1, 5, glm::vec3(0.F));
    draw_text(chart, x + 2, rows * pitch + 2, findings.value(guide.name, v), glm::vec3(0.F), 1);
  }
  return chart;
}

}  // namespace

void write_exemplar_report(const std::string& folder, const std::vector<Exemplar>& exemplars, const GuideStack& asked,
                           const ExemplarFindings& findings, const std::string& command) {
  ReportFolder page(folder);
  page.add("<section id=\"verdict\"><h2>In words</h2><pre>" + markup_text(findings_text(findings)) + "</pre></section>");
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const Exemplar& exemplar = exemplars[e];
    const ExemplarSurvey& survey = findings.paintings.at(e).survey;
    const std::string number = fmt::format("{}", e + 1);
    page.begin_figure("painting_" + number, markup_text(exemplar.name),
                      "The painting and its classes; what is never a source is near black.");
    page.picture("painting_" + number, reduced_picture(to_picture(exemplar.picture), painting_px), "painting");
    page.picture("classes_" + number, reduced_picture(label_picture(exemplar.guides.label), painting_px), "classes");
    page.end_figure();

    page.begin_figure("swatches_" + number, "Its paints",
                      fmt::format("Of each class the {0} × {0} texels that lie farthest from others, twice as large.", swatch_side));
    const Grid<std::uint8_t> borders = border_distance_squared(exemplar.guides.label);
    for (std::size_t c = 0; c < survey.classes.size(); ++c) {
      const ClassSurvey& of = survey.classes[c];
      if (c > 0 && c % 6 == 0) page.next_row();
      page.picture(fmt::format("swatch_{}_{}", number, of.label), swatch(exemplar, borders, of.label),
                   fmt::format("{}: {}", markup_text(findings.name(of.label)), describe_service(of)));
    }
    page.end_figure();

    for (std::size_t g = 0; g < exemplar.guides.guides.size(); ++g) {
      const Guide& guide = exemplar.guides.guides[g];
      page.begin_figure(
          fmt::format("coverage_{}_{}", number, g + 1), "Painted at which " + markup_text(guide.name),
          "The brighter, the more texels of the class have that value. Blue below is where the picture to be made asks for it: "
          "blue under black finds no texel of its own.");
      page.picture(fmt::format("coverage_{}_{}", number, g + 1), coverage_chart(exemplar, survey, guide, asked, findings),
                   markup_text(guide.name));
      page.end_figure();
    }
  }
  page.write("report.json", findings_json(findings));
  page.write_page("What the paintings serve", "What the paintings serve",
                  fmt::format("{} painting{}.", exemplars.size(), exemplars.size() == 1 ? "" : "s"), command);
}

}  // namespace belvedere::tools
