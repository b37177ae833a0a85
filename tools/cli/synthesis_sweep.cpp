#include "tools/cli/synthesis_sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/text/parse_number.h"
#include "tools/cli/contact/scene_sweep.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"
#include "tools/report/synthesis_findings.h"

namespace belvedere::tools {
namespace {

constexpr int max_cells = 100;
constexpr int cell_px = 512;  // longest side of a result on the sheet

struct SweptParameter {
  const char* name;
  double min;
  double max;
  bool whole;
};
constexpr double largest_seed =
    9007199254740992.0;  // 2^53: every whole number up to it is a double
constexpr SweptParameter parameters_swept[] = {
    {"seed", 0, largest_seed, true}, {"levels", 1, 8, true},
    {"reuse", 0, 10, false},         {"copy-cap", 16, 100000, true},
    {"neighbourhood", 3, 11, true},  {"surroundings", 0, 100, false}};
constexpr SweptParameter weight_swept = {"weight", 0, 100, false};

const SweptParameter* find_swept(const std::string& name, const std::vector<std::string>& guides) {
  for (const SweptParameter& swept : parameters_swept)
    if (name == swept.name) return &swept;
  return std::find(guides.begin(), guides.end(), name) != guides.end() ? &weight_swept : nullptr;
}

// The part of each result on the sheet: all of it, or where most borders of classes lie.
PixelRect choose_view(const Grid<std::uint8_t>& labels) {
  if (std::max(labels.width(), labels.height()) <= cell_px)
    return {0, 0, labels.width(), labels.height()};
  const Grid<std::uint8_t> borders = border_distance_squared(labels);
  Grid<float> score(labels.width(), labels.height());
  std::transform(borders.begin(), borders.end(), score.begin(),
                 [](std::uint8_t d) { return d == 0 ? 1.F : 0.F; });
  return best_window(score, {}, cell_px);
}

// One synthesis of the sweep.
struct SweptResult {
  std::vector<std::string> texts;  // a value of each axis
  std::string file;
  SynthesisQuality quality;
};

std::string summary(const SynthesisQuality& quality) {
  const auto figures = key_figures(quality);
  const auto value = [&](const std::string& key) {
    return std::find_if(figures.begin(), figures.end(),
                        [&](const QualityFigure& f) { return f.key == key; })
        ->value;
  };
  return fmt::format("guide {:.1f} sharp {:.2f} clique {:.3f} run {:.2f}",
                     value("guide_error_mean"), value("sharpness"), value("clique_distance"),
                     value("stroke_run"));
}

ReportTable table_of(const std::vector<SweepAxis>& axes, const std::vector<SweptResult>& results) {
  std::vector<ReportColumn> columns;
  for (const SweepAxis& axis : axes) columns.push_back({axis.name, axis.name});
  for (const QualityFigure& figure : key_figures(results.front().quality))
    columns.push_back({figure.key, figure.brief, ".4g", figure.name});
  ReportTable table(columns);
  for (const SweptResult& result : results) {
    std::vector<Json> row = {linked(result.texts.front(), result.file + ".png")};
    if (axes.size() > 1) row.push_back(Json::text(result.texts[1]));
    for (const QualityFigure& figure : key_figures(result.quality))
      row.push_back(evaluated(figure.value, figure.good()));
    table.add_row(std::move(row));
  }
  return table;
}

// Quality of each result, class by class.
Json classes_of(const std::vector<SweptResult>& results) {
  Json all = Json::object();
  for (const SweptResult& result : results)
    all.add(result.file, class_table(result.quality, {}, [](std::uint8_t label) {
                           return fmt::format("class {}", label);
                         }).rows());
  return all;
}

std::vector<std::string> names_along(const SweepAxis& axis) {
  std::vector<std::string> names;
  for (const std::string& text : axis.texts) names.push_back(axis.name + "=" + text);
  return names;
}

// The guide that the figures refer to: altitude if both sides have it.
std::string measured_guide(const SweepInput& in) {
  std::string guide;
  for (const Guide& g : in.target.guides)
    if (guide.empty() || g.name == "altitude") guide = g.name;
  return guide;
}

}  // namespace

SweepAxis parse_sweep(const std::string& text, const std::vector<std::string>& guides) {
  const std::string where = "--sweep " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse(where, "has no name and values", "NAME=VALUE,VALUE,… such as reuse=0,1,4");
  SweepAxis axis{.name = text.substr(0, equals), .texts = {}, .values = {}};
  if (axis.name == "copy_cap") axis.name = "copy-cap";
  const SweptParameter* swept = find_swept(axis.name, guides);
  if (swept == nullptr) {
    std::string names;
    for (const SweptParameter& known : parameters_swept)
      names += std::string(names.empty() ? "" : ", ") + known.name;
    for (const std::string& guide : guides) names += ", " + guide;
    refuse(where, fmt::format("\"{}\" cannot be swept", axis.name),
           names + (guides.empty() ? "" : " (weight)"));
  }
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const double value =
        parse_number<double>(word).value_or(std::numeric_limits<double>::quiet_NaN());
    const bool even = axis.name == "neighbourhood" && std::fmod(value, 2.0) == 0.0;
    if (even || !(value >= swept->min && value <= swept->max) ||
        (swept->whole && value != std::floor(value)))
      refuse(where, fmt::format("a value \"{}\"", word),
             fmt::format(
                 "{}{} … {}",
                 axis.name == "neighbourhood" ? "odd numbers "
                 : swept->whole               ? "whole numbers "
                                              : "",
                 swept->min,
                 swept->max == largest_seed ? std::string("2^53") : fmt::format("{}", swept->max)));
    if (std::find(axis.values.begin(), axis.values.end(), value) != axis.values.end())
      refuse(where, fmt::format("the value {} twice", word), "each value once");
    axis.texts.push_back(word);
    axis.values.push_back(value);
    begin = end + 1;
  }
  return axis;
}

SynthesisParameters with_value(SynthesisParameters parameters, const std::string& name,
                               double value) {
  if (name == "seed")
    parameters.seed = static_cast<std::uint64_t>(value);
  else if (name == "levels")
    parameters.levels = static_cast<int>(value);
  else if (name == "reuse")
    parameters.reuse = value;
  else if (name == "copy-cap")
    parameters.copy_cap = static_cast<int>(value);
  else if (name == "neighbourhood")
    parameters.neighbourhood = static_cast<int>(value);
  else if (name == "surroundings")
    parameters.surroundings = value;
  else
    parameters.weights.emplace_back(name, value);  // the last of a name counts
  return parameters;
}

int write_sweep(const std::string& folder, const SweepInput& in, Progress& progress) {
  const std::size_t columns = in.axes.at(0).values.size();
  const std::size_t rows = in.axes.size() > 1 ? in.axes[1].values.size() : 1;
  if (columns * rows > static_cast<std::size_t>(max_cells))
    refuse("--sweep", fmt::format("{} syntheses", columns * rows),
           fmt::format("at most {}", max_cells));
  Report page(folder);
  const PixelRect view = choose_view(in.target.label);
  PictureTable sheet{.columns = names_along(in.axes[0]), .rows = {}, .cells = {}, .foot = {}};
  if (in.axes.size() > 1) sheet.rows = names_along(in.axes[1]);
  sheet.cells.resize(rows);
  std::vector<const Grid<Rgb8>*> layers;
  for (const Exemplar& exemplar : in.exemplars) layers.push_back(&exemplar.picture);
  std::vector<SweptResult> results;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      SweptResult result{.texts = {in.axes[0].texts[c]},
                         .file = fmt::format("{}_{}", c + 1, r + 1),
                         .quality = {}};
      SynthesisParameters parameters =
          with_value(in.parameters, in.axes[0].name, in.axes[0].values[c]);
      if (in.axes.size() > 1) {
        result.texts.push_back(in.axes[1].texts[r]);
        parameters = with_value(parameters, in.axes[1].name, in.axes[1].values[r]);
      }
      SweepProgress here(progress, results.size() + 1, columns * rows);
      const MatchField matches = synthesize(in.exemplars, in.target, parameters, here);
      here.begin("measuring", 0.0);
      result.quality =
          measure_quality(matches, in.exemplars, in.target, {.guide = measured_guide(in)});
      const Grid<glm::vec3> picture = to_picture(replay(matches, layers, Grid<Rgb8>()));
      page.write_picture(result.file, picture);
      sheet.cells[r].push_back({cut(picture, view), summary(result.quality)});
      results.push_back(std::move(result));
    }
  }
  progress.begin("writing", 0.0);
  const bool whole = view.width() == in.target.width() && view.height() == in.target.height();
  page.section("sheet", "All results",
               (whole ? std::string()
                      : fmt::format("The same {} × {} pixels of each, from {}, {}, where most "
                                    "borders of classes lie. ",
                                    view.width(), view.height(), view.x0, view.y0)) +
                   "Below each its key figures: deviation of the guide, sharpness, clique distance "
                   "and stroke length of the worst class.");
  page.picture("sheet", draw_table(sheet), "sheet.png");
  page.section(
      "figures", "Figures",
      "Red is outside the range of good pictures. The first column links to each full result; the "
      "others are those of a report: deviation of the guide, differences from the painting in the "
      "worst class, the largest piece, the most used texel, and so on.");
  page.table(table_of(in.axes, results));
  page.write({.title = "Sweep of " + in.axes[0].name +
                       (in.axes.size() > 1 ? " and " + in.axes[1].name : ""),
              .lead = fmt::format("{}: {} syntheses of {} × {} pixels.", in.title, results.size(),
                                  in.target.width(), in.target.height()),
              .command = in.command,
              .data = classes_of(results)});
  return static_cast<int>(results.size());
}

}  // namespace belvedere::tools
