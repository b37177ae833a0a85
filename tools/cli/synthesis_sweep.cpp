#include "tools/cli/synthesis_sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/text/markup.h"
#include "tools/options/refuse.h"
#include "tools/report/picture_text.h"
#include "tools/report/report_folder.h"
#include "tools/report/report_pictures.h"
#include "tools/report/synthesis_figures.h"

namespace belvedere::tools {
namespace {

constexpr int most_cells = 100;
constexpr int cell_px = 512;  // longest side of a result on the sheet
constexpr int sweep_gap = 12;

struct SweptParameter {
  const char* name;
  double least;
  double most;
  bool whole;
};
constexpr double largest_seed = 9007199254740992.0;  // 2^53: every whole number up to it is a double
constexpr SweptParameter parameters_swept[] = {{"seed", 0, largest_seed, true}, {"levels", 1, 8, true},
                                               {"reuse", 0, 10, false},         {"copy-cap", 16, 100000, true},
                                               {"neighbourhood", 3, 11, true},  {"surroundings", 0, 100, false}};
constexpr SweptParameter weight_swept = {"weight", 0, 100, false};

const SweptParameter* find_swept(const std::string& name, const std::vector<std::string>& guides) {
  for (const SweptParameter& swept : parameters_swept)
    if (name == swept.name) return &swept;
  return std::find(guides.begin(), guides.end(), name) != guides.end() ? &weight_swept : nullptr;
}

// Stages say which synthesis of the sweep they belong to; remarks, the same for all, come once.
class CellProgress : public Progress {
 public:
  CellProgress(Progress& whole, int cell, int cells) : whole_(whole), cell_(cell), cells_(cells) {}
  void begin(std::string_view stage, double total) override { whole_.begin(fmt::format("{} of {}: {}", cell_, cells_, stage), total); }
  void advance(double amount) override { whole_.advance(amount); }
  void note(std::string_view text) override {
    if (cell_ == 1) whole_.note(text);
  }

 private:
  Progress& whole_;
  int cell_;
  int cells_;
};

// What the sheet shows of each result: all of it, or where most borders of classes lie.
PixelRect choose_view(const Grid<std::uint8_t>& labels) {
  if (std::max(labels.width(), labels.height()) <= cell_px) return {0, 0, labels.width(), labels.height()};
  const Grid<std::uint8_t> borders = border_distance_squared(labels);
  Grid<float> score(labels.width(), labels.height());
  std::transform(borders.begin(), borders.end(), score.begin(), [](std::uint8_t d) { return d == 0 ? 1.F : 0.F; });
  return best_window(score, {}, cell_px);
}

struct Cell {
  std::vector<std::string> texts;  // a value of each axis
  std::string file;
  SynthesisQuality quality;
};

std::string summary(const SynthesisQuality& quality) {
  const auto figures = key_figures(quality);
  const auto value = [&](const std::string& key) {
    return std::find_if(figures.begin(), figures.end(), [&](const QualityFigure& f) { return f.key == key; })->value;
  };
  return fmt::format("guide {:.1f} sharp {:.2f} clique {:.3f} run {:.2f}", value("guide_error_mean"), value("sharpness"),
                     value("clique_distance"), value("stroke_run"));
}

void paste(Grid<glm::vec3>& sheet, const Grid<glm::vec3>& picture, int x0, int y0) {
  for (int y = 0; y < picture.height(); ++y) std::copy_n(picture.row(y), picture.width(), sheet.row(y0 + y) + x0);
}

// An empty sheet with the axes' values at its columns and rows, and where cells begin on it.
class Sheet {
 public:
  Sheet(const std::vector<SweepAxis>& axes, int width, int height) : cell_width_(width), cell_height_(height) {
    const auto label = [&](std::size_t axis, std::size_t i) { return axes[axis].name + "=" + axes[axis].texts[i]; };
    const std::size_t rows = axes.size() > 1 ? axes[1].values.size() : 1;
    for (std::size_t r = 0; axes.size() > 1 && r < rows; ++r) left_ = std::max(left_, sweep_gap + text_width(label(1, r), caption_scale));
    for (std::size_t c = 0; c < axes[0].values.size(); ++c)
      column_ = std::max({column_, cell_width_ + sweep_gap, text_width(label(0, c), caption_scale) + sweep_gap});
    picture_ = Grid<glm::vec3>(left_ + sweep_gap + static_cast<int>(axes[0].values.size()) * column_,
                               top_ + static_cast<int>(rows) * row_height(), glm::vec3(1.F));
    for (std::size_t c = 0; c < axes[0].values.size(); ++c)
      draw_text(picture_, x_of(static_cast<int>(c)), sweep_gap, label(0, c), glm::vec3(0.F), caption_scale);
    for (std::size_t r = 0; axes.size() > 1 && r < rows; ++r)
      draw_text(picture_, sweep_gap, y_of(static_cast<int>(r)), label(1, r), glm::vec3(0.F), caption_scale);
  }
  void add(int column, int row, const Grid<glm::vec3>& view, const std::string& words) {
    paste(picture_, view, x_of(column), y_of(row));
    // The larger letters where they fit, else the smaller.
    const int scale = text_width(words, caption_scale) <= column_ - sweep_gap ? caption_scale : 1;
    draw_text(picture_, x_of(column), y_of(row) + cell_height_ + 4, words, glm::vec3(0.25F), scale);
  }
  const Grid<glm::vec3>& picture() const { return picture_; }

 private:
  int row_height() const { return cell_height_ + caption_line_px + sweep_gap; }
  int x_of(int column) const { return left_ + sweep_gap + column * column_; }
  int y_of(int row) const { return top_ + row * row_height(); }

  int cell_width_;
  int cell_height_;
  int left_ = 0;
  int column_ = 0;
  int top_ = sweep_gap + caption_line_px;
  Grid<glm::vec3> picture_;
};

std::string table_of(const std::vector<SweepAxis>& axes, const std::vector<Cell>& cells) {
  std::vector<std::string> head;
  for (const SweepAxis& axis : axes) head.push_back(markup_text(axis.name));
  for (const QualityFigure& figure : key_figures(cells.front().quality))
    head.push_back(fmt::format("<span title=\"{}\">{}</span>", figure.name, figure.brief));
  std::string table = "<table>" + html_row(head, "th");
  for (const Cell& cell : cells) {
    std::vector<std::string> row;
    for (const std::string& text : cell.texts) row.push_back(markup_text(text));
    row.front() = fmt::format("<a href=\"{}.png\">{}</a>", cell.file, row.front());
    for (const QualityFigure& figure : key_figures(cell.quality)) {
      const std::string text = fmt::format("{:.4g}", figure.value);
      row.push_back(figure.good() ? text : "<b style=\"color:#b03\">" + text + "</b>");
    }
    table += html_row(row);
  }
  return table + "</table>";
}

std::string as_json(const SweepInput& in, const std::vector<Cell>& cells) {
  Json axes = Json::array();
  for (const SweepAxis& axis : in.axes) {
    Json values = Json::array();
    for (const double value : axis.values) values.add(Json::number(value));
    axes.add(Json::object().add("name", Json::text(axis.name)).add("values", std::move(values)));
  }
  Json results = Json::array();
  for (const Cell& cell : cells) {
    Json values = Json::object();
    for (std::size_t a = 0; a < in.axes.size(); ++a) values.add(in.axes[a].name, Json::raw(cell.texts[a]));
    results.add(Json::object()
                    .add("values", std::move(values))
                    .add("picture", Json::text(cell.file + ".png"))
                    .add("quality", quality_json(cell.quality, [](std::uint8_t label) { return fmt::format("class {}", label); })));
  }
  return Json::object()
             .add("title", Json::text(in.title))
             .add("command", Json::text(in.command))
             .add("axes", std::move(axes))
             .add("results", std::move(results))
             .str() +
         "\n";
}

// The guide that figures speak of: altitude where both sides have it.
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
  if (equals == std::string::npos || equals == 0) refuse(where, "has no name and values", "NAME=VALUE,VALUE,… such as reuse=0,1,4");
  SweepAxis axis{.name = text.substr(0, equals), .texts = {}, .values = {}};
  if (axis.name == "copy_cap") axis.name = "copy-cap";
  const SweptParameter* swept = find_swept(axis.name, guides);
  if (swept == nullptr) {
    std::string names;
    for (const SweptParameter& known : parameters_swept) names += std::string(names.empty() ? "" : ", ") + known.name;
    for (const std::string& guide : guides) names += ", " + guide;
    refuse(where, fmt::format("\"{}\" is nothing that can be swept", axis.name), names + (guides.empty() ? "" : " (weight)"));
  }
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    double value = 0.0;
    const auto [rest, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool number = fault == std::errc() && rest == word.data() + word.size();
    const bool even = axis.name == "neighbourhood" && std::fmod(value, 2.0) == 0.0;
    if (!number || even || !(value >= swept->least && value <= swept->most) || (swept->whole && value != std::floor(value)))
      refuse(where, fmt::format("a value \"{}\"", word),
             fmt::format("{}{} … {}",
                         axis.name == "neighbourhood" ? "odd numbers "
                         : swept->whole               ? "whole numbers "
                                                      : "",
                         swept->least, swept->most == largest_seed ? std::string("2^53") : fmt::format("{}", swept->most)));
    if (std::find(axis.values.begin(), axis.values.end(), value) != axis.values.end())
      refuse(where, fmt::format("the value {} twice", word), "each value once");
    axis.texts.push_back(word);
    axis.values.push_back(value);
    begin = end + 1;
  }
  return axis;
}

SynthesisParameters with_value(SynthesisParameters parameters, const std::string& name, double value) {
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
  if (columns * rows > static_cast<std::size_t>(most_cells))
    refuse("--sweep", fmt::format("{} syntheses", columns * rows), fmt::format("at most {}", most_cells));
  ReportFolder page(folder);
  const PixelRect view = choose_view(in.target.label);
  Sheet sheet(in.axes, view.width(), view.height());
  std::vector<const Grid<Rgb8>*> layers;
  for (const Exemplar& exemplar : in.exemplars) layers.push_back(&exemplar.picture);
  std::vector<Cell> cells;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      Cell cell{.texts = {in.axes[0].texts[c]}, .file = fmt::format("{}_{}", c + 1, r + 1), .quality = {}};
      SynthesisParameters parameters = with_value(in.parameters, in.axes[0].name, in.axes[0].values[c]);
      if (in.axes.size() > 1) {
        cell.texts.push_back(in.axes[1].texts[r]);
        parameters = with_value(parameters, in.axes[1].name, in.axes[1].values[r]);
      }
      CellProgress here(progress, static_cast<int>(cells.size()) + 1, static_cast<int>(columns * rows));
      const MatchField matches = synthesize(in.exemplars, in.target, parameters, here);
      here.begin("measuring", 0.0);
      cell.quality = measure_quality(matches, in.exemplars, in.target, {.guide = measured_guide(in)});
      const Grid<glm::vec3> picture = to_picture(replay(matches, layers, Grid<Rgb8>()));
      page.write_picture(cell.file, picture);
      sheet.add(static_cast<int>(c), static_cast<int>(r), cut(picture, view), summary(cell.quality));
      cells.push_back(std::move(cell));
    }
  }
  progress.begin("writing", 0.0);
  const bool whole = view.width() == in.target.width() && view.height() == in.target.height();
  page.begin_figure(
      "sheet", "All results",
      whole ? "Below each its key figures: how far the guide is off, sharpness, clique distance and length of strokes of the "
              "worst class."
            : fmt::format("The same {} × {} pixels of each, from {}, {}, where most borders of classes lie. Below each its key "
                          "figures: how far the guide is off, sharpness, clique distance and length of strokes of the worst class.",
                          view.width(), view.height(), view.x0, view.y0));
  page.picture("sheet", sheet.picture(), "sheet.png");
  page.end_figure();
  page.add(
      "<section id=\"figures\"><h2>Figures</h2><p>Red is outside of what eyes are content with. The first column leads to each result, "
      "whole; the others are those of a report: how far the guide is off, what is unlike the painting in the worst class, the "
      "largest piece, the texel used most, and so on.</p>");
  page.add(table_of(in.axes, cells) + "</section>");
  page.write("report.json", as_json(in, cells));
  page.write_page(in.title, "Sweep of " + in.axes[0].name + (in.axes.size() > 1 ? " and " + in.axes[1].name : ""),
                  fmt::format("{} syntheses of {} × {} pixels.", cells.size(), in.target.width(), in.target.height()), in.command);
  return static_cast<int>(cells.size());
}

}  // namespace belvedere::tools
