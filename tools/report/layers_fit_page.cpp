#include "tools/report/layers_fit_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <utility>

#include "terrain/layers/fit/colour_regions.h"
#include "terrain/layers/fit/fit_measures.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layers_file.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int small_map_px = 480;  // longest side of a small map

Grid<glm::vec3> picture_of(Grid<glm::vec3> rgb) {
  for (glm::vec3& colour : rgb) colour /= 255.0F;
  return rgb;
}

glm::vec3 unpacked(std::uint32_t rgb) {
  return glm::vec3(static_cast<float>(rgb >> 16U), static_cast<float>(rgb >> 8U & 255U),
                   static_cast<float>(rgb & 255U)) /
         255.0F;
}
// Each class in the average of its leaves' colours.
std::vector<glm::vec3> class_colours(const KnownGround& ground, const GroundFit& fit) {
  std::vector<glm::vec3> colours(ground.classes.size(), glm::vec3(0.0F));
  std::vector<float> cells(colours.size(), 0.0F);
  for (std::size_t j = 0; j != fit.parent.size(); ++j) {
    const auto k = static_cast<std::size_t>(fit.parent[j]);
    const auto n = static_cast<float>(fit.cells[j]);
    colours[k] += n * glm::vec3(fit.colours[j]) / 255.0F;
    cells[k] += n;
  }
  for (std::size_t k = 0; k != colours.size(); ++k)
    colours[k] = cells[k] > 0.0F ? colours[k] / cells[k] : unpacked(ground.classes[k].rgb);
  return colours;
}

Grid<glm::vec3> class_map(const Grid<float>& like, const std::vector<std::uint8_t>& labels,
                          const std::vector<glm::vec3>& colours) {
  Grid<glm::vec3> map(like.width(), like.height(), glm::vec3(0.0F));
  for (std::size_t i = 0; i != map.size(); ++i)
    if (labels[i] != no_class) map[i] = colours[labels[i]];
  return map;
}

// Number of cells with each colour of the hue–saturation plane, dark where few, in the colour of
// the class that has most of them.
Grid<glm::vec3> plane_picture(const KnownGround& ground, const std::vector<glm::vec3>& colours) {
  constexpr int side = 256;
  const Grid<glm::vec3> smooth = smooth_chroma(ground.picture->rgb);
  std::vector<std::vector<float>> counts(
      colours.size(), std::vector<float>(static_cast<std::size_t>(side) * side, 0.0F));
  for (std::size_t i = 0; i != ground.labels.size(); ++i) {
    if (ground.labels[i] == no_class) continue;
    const PlanePixel at = plane_pixel(hue_saturation_of(smooth[i]), side, side);
    counts[ground.labels[i]]
          [static_cast<std::size_t>(at.y) * side + static_cast<std::size_t>(at.x)] += 1.0F;
  }
  Grid<glm::vec3> picture(side, side, glm::vec3(0.05F));
  for (std::size_t p = 0; p != picture.size(); ++p) {
    float total = 0.0F;
    std::size_t max = 0;
    for (std::size_t k = 0; k != counts.size(); ++k) {
      total += counts[k][p];
      if (counts[k][p] > counts[max][p]) max = k;
    }
    if (total > 0.0F)
      picture[p] = colours[max] * std::min(1.0F, 0.35F + 0.1F * std::log2(1.0F + total)) + 0.05F;
  }
  return picture;
}

double value_at(const LayerSamples& function, std::size_t i) {
  return function.at_0 +
         (function.at_255 - function.at_0) * static_cast<double>(function.samples[i]) / 255.0;
}

// A function as a line over its input's range, 0…1 from low to high; behind it the frequency of the
// class.
Json function_curve(const LayerSamples& function, const std::vector<std::size_t>& histogram,
                    glm::vec3 colour, double low, double high) {
  const auto max = static_cast<double>(
      std::max<std::size_t>(*std::max_element(histogram.begin(), histogram.end()), 1));
  const auto rounded = [](double v) { return std::round(1000.0 * v) / 1000.0; };
  std::vector<double> positions, line, area;
  for (std::size_t i = 0; i != 256; i += 2) {
    positions.push_back(rounded(layer_sample_place(static_cast<int>(i))));
    area.push_back(rounded(static_cast<double>(histogram[i] + histogram[i + 1]) / (2.0 * max)));
    line.push_back(
        rounded(std::clamp((value_at(function, i) - low) / std::max(high - low, 1e-9), 0.0, 1.0)));
  }
  return swatch(colour)
      .add("places", Json::numbers(positions))
      .add("line", Json::numbers(line))
      .add("area", Json::numbers(area));
}

void add_inputs(Report& page, const KnownGround& ground, const GroundFit& fit) {
  page.section("inputs", "Inputs",
               "The inputs of the functions, black at the low end of the range that functions "
               "cover and white at the high end.");
  for (std::size_t a = 0; a != ground.inputs.size(); ++a) {
    Grid<float> cells = ground.inputs[a];
    const LayerInput& range = fit.ranges[a];
    Grid<glm::vec3> grey(cells.width(), cells.height());
    for (std::size_t i = 0; i != cells.size(); ++i)
      grey[i] = glm::vec3(static_cast<float>(std::clamp(
          (static_cast<double>(cells[i]) - range.low) / (range.high - range.low), 0.0, 1.0)));
    page.picture(fmt::format("input_{}", range.name), reduced_picture(grey, small_map_px / 2),
                 fmt::format("{}: {:.4g} … {:.4g}", range.name, range.low, range.high));
  }
}

void add_classes(Report& page, const KnownGround& ground, const std::vector<glm::vec3>& colours) {
  page.section("classes", "Classes",
               ground.picture ? "The picture, its classification (black: cloud, shadow, masked or "
                                "too dark), and the number of cells with each colour of the "
                                "hue–saturation plane, red to the right, green upwards to the left."
                              : "The classes of the land-cover map (black: not used).");
  if (ground.picture)
    page.picture("picture", reduced_picture(picture_of(ground.picture->rgb), small_map_px),
                 "picture");
  page.picture("classes",
               reduced_picture(class_map(ground.altitude_m, ground.labels, colours), small_map_px),
               "classes");
  if (ground.picture) page.picture("plane", plane_picture(ground, colours), "hue and saturation");
}

void add_functions(Report& page, const KnownGround& ground, const GroundFit& fit,
                   const std::vector<glm::vec3>& colours) {
  page.section(
      "functions", "Functions",
      "Line: the function in the file, for each class and input. Grey: frequency of the class.");
  std::vector<ReportColumn> columns = {{"class", ""}};
  for (const LayerInput& range : fit.ranges) columns.push_back({range.name, range.name});
  ReportTable table(columns);
  const std::vector<std::vector<std::uint8_t>> samples = sample_indices(ground.inputs, fit.ranges);
  for (std::size_t rank = ground.classes.size(); rank-- != 0;) {
    const auto k = static_cast<std::size_t>(fit.classes.order[rank]);
    std::vector<Json> row = {Json::text(ground.classes[k].name)};
    double low = 0.0;
    double high = 1.0;
    if (fit.classes.model == LayerModel::additive)
      for (const LayerSamples& f : fit.classes.functions[k]) {
        low = std::min(low, f.at_0);
        high = std::max(high, f.at_255);
      }
    for (std::size_t a = 0; a != samples.size(); ++a) {
      std::vector<std::size_t> histogram(256, 0);
      for (std::size_t i = 0; i != ground.labels.size(); ++i)
        if (ground.labels[i] == k) ++histogram[samples[a][i]];
      row.push_back(function_curve(fit.classes.functions[k][a], histogram, colours[k], low, high));
    }
    table.add_row(std::move(row));
  }
  page.table(table);
}

// Functions of histograms are packed in the file, and not edited here.
void add_editor(Report& page, const LayersFitReportInput& in) {
  std::string text = surface_layers_text(in.layers);
  if (text.find("{ values = [") == std::string::npos) return;
  page.section("edit", "Draw the functions",
               "Draw over a curve, or move its points with the arrow keys; the button saves the "
               "file of layers with them. Left is the low end of the input's range, up is 1.");
  page.add(
      "functions",
      Json::object().add("file", Json::text(in.file)).add("text", Json::text(std::move(text))));
}

// The cell where most layers overlap to some extent: the first of equals.
void add_trace(Report& page, const LayersFitReportInput& in) {
  const LayerProgram program = compile_layers(in.layers);
  std::vector<Grid<float>> inputs;
  for (const std::string& name : program.inputs) {
    const auto at = std::find(in.ground->input_names.begin(), in.ground->input_names.end(), name);
    if (at == in.ground->input_names.end())
      return;  // a file with more inputs than it was fitted on: nothing to trace it with
    inputs.push_back(
        in.ground->inputs[static_cast<std::size_t>(at - in.ground->input_names.begin())]);
  }
  const PixelRect all{0, 0, in.ground->altitude_m.width(), in.ground->altitude_m.height()};
  const std::vector<Grid<float>> coverage = layer_coverage(program, inputs, {}, all, 1);
  std::size_t cell = 0;
  int max = -1;
  for (std::size_t i = 0; i < in.ground->altitude_m.size(); i += 7) {
    int partly = 0;
    for (const Grid<float>& c : coverage) partly += c[i] > 0.1F && c[i] < 0.9F ? 1 : 0;
    if (partly > max) {
      max = partly;
      cell = i;
    }
  }
  page.section("trace", "One cell, layer by layer",
               fmt::format("Cell {}, {}: its colour after each layer, RGB' = (1 − C) RGB + C RGB "
                           "of the layer. C never exceeds the parent's.",
                           cell % static_cast<std::size_t>(all.x1),
                           cell / static_cast<std::size_t>(all.x1)));
  ReportTable table({{"layer", "layer"},
                     {"under", "under"},
                     {"parent_coverage", "C of the parent", ".3f"},
                     {"coverage", "C", ".3f"},
                     {"layer_colour", "its colour"},
                     {"colour", "colour so far"}});
  glm::vec3 colour = unpacked(in.layers.ground_rgb);
  table.row("ground", "", "", 1.0, swatch(colour), swatch(colour));
  for (std::size_t l = 0; l != in.layers.layers.size(); ++l) {
    const SurfaceLayer& layer = in.layers.layers[l];
    const float c = coverage[l][cell];
    if (program.paints[l]) colour = (1.0F - c) * colour + c * unpacked(layer.rgb);
    const bool child = layer.parent >= 0;
    table.row(layer.name,
              child ? in.layers.layers[static_cast<std::size_t>(layer.parent)].name : std::string(),
              child ? coverage[static_cast<std::size_t>(layer.parent)][cell] : 1.F, c,
              swatch(unpacked(layer.rgb)), swatch(colour));
  }
  page.table(table);
}

struct Judged {
  std::string model;
  std::vector<HeldOutResult> results;  // for each kind of holdout
};

HeldOutResult mean_of(const HeldOutResult& a, const HeldOutResult& b) {
  HeldOutResult mean = a;
  const auto half = [](double& x, double y) { x = 0.5 * (x + y); };
  half(mean.measures.accuracy, b.measures.accuracy);
  half(mean.measures.mean_auc, b.measures.mean_auc);
  half(mean.measures.mean_iou, b.measures.mean_iou);
  half(mean.matched.mean_iou, b.matched.mean_iou);
  half(mean.gradient_share, b.gradient_share);
  for (std::size_t i = 0; i != mean.differences.size(); ++i) {
    half(mean.differences[i].mean, b.differences[i].mean);
    half(mean.differences[i].p95, b.differences[i].p95);
  }
  return mean;
}

std::vector<Judged> evaluate_models(const LayersFitReportInput& in, Progress& progress) {
  const int width = in.ground->altitude_m.width();
  const int height = in.ground->altitude_m.height();
  // Squares of 64 cells; smaller ones where the ground has fewer than four per side.
  const int square = std::clamp(std::min(width, height) / 4, 8, 64);
  const std::vector<HoldOut> ways = {chessboard(width, height, square),
                                     west_and_east(width, height), north_and_south(width, height)};
  GroundFitParameters as_file = in.parameters;
  GroundFitParameters other = as_file;
  other.functions = FunctionSource::fitted;
  other.model = as_file.model == LayerModel::product ? LayerModel::additive : LayerModel::product;
  GroundFitParameters published = as_file;
  published.functions = FunctionSource::histogram;
  published.model = LayerModel::product;
  GroundFitParameters best = as_file;
  best.functions = FunctionSource::fitted;
  best.model = LayerModel::additive;
  best.forest_share = 0.65;
  std::vector<std::pair<std::string, GroundFitParameters>> models = {
      {"as in the file", as_file}, {"histograms, as published", published}};
  models.emplace_back(other.model == LayerModel::additive ? "additive" : "product", other);
  models.emplace_back("additive 0.35 and forest 0.65 (in no file)", best);
  progress.begin("evaluation on held-out ground",
                 static_cast<double>((models.size() + 1) * ways.size()));
  std::vector<Judged> evaluated(1, {"altitude bands alone", {}});
  for (const HoldOut& way : ways) {
    evaluated[0].results.push_back(judge_bands(*in.ground, way));
    progress.advance(1.0);
  }
  for (const auto& [name, parameters] : models) {
    Judged one{name, {}};
    for (const HoldOut& way : ways) {
      one.results.push_back(evaluate_held_out(*in.ground, parameters, way));
      progress.advance(1.0);
    }
    evaluated.push_back(std::move(one));
  }
  for (Judged& one : evaluated)
    one.results = {one.results[0], mean_of(one.results[1], one.results[2])};
  return evaluated;
}

ReportTable measures_table(const std::vector<Judged>& evaluated) {
  std::vector<ReportColumn> columns = {{"model", ""}};
  for (const std::string way : {"tiles", "halves"}) {
    const std::vector<ReportColumn> of = {{way + "_accuracy", way + ": accuracy", ".3f"},
                                          {way + "_auc", "AUC", ".3f"},
                                          {way + "_iou", "IoU", ".3f"},
                                          {way + "_iou_matched", "matched", ".3f"}};
    columns.insert(columns.end(), of.begin(), of.end());
  }
  ReportTable table(columns);
  for (const Judged& one : evaluated) {
    std::vector<Json> row = {Json::text(one.model)};
    for (const HeldOutResult& r : one.results)
      for (const double v :
           {r.measures.accuracy, r.measures.mean_auc, r.measures.mean_iou, r.matched.mean_iou})
        row.push_back(known(v));
    table.add_row(std::move(row));
  }
  return table;
}

ReportTable confusion_table(const KnownGround& ground, const ClassMeasures& own) {
  std::vector<ReportColumn> columns = {{"true", "true \\ most likely"}};
  for (std::size_t k = 0; k != ground.classes.size(); ++k)
    columns.push_back({fmt::format("class_{}", k + 1), ground.classes[k].name});
  columns.insert(columns.end(), {{"auc", "AUC", ".3f"}, {"iou", "IoU", ".3f"}});
  ReportTable table(columns);
  for (std::size_t k = 0; k != own.counts.size(); ++k) {
    std::vector<Json> row = {Json::text(ground.classes[k].name)};
    for (const std::size_t n : own.counts[k]) row.push_back(Json::number(static_cast<double>(n)));
    row.insert(row.end(), {known(own.auc[k]), known(own.iou[k])});
    table.add_row(std::move(row));
  }
  return table;
}

ReportTable difference_table(const std::vector<Judged>& evaluated) {
  std::vector<ReportColumn> columns = {{"model", ""}};
  for (const BlockDifference& d : evaluated[1].results[0].differences) {
    const std::string cells = d.block == 1 ? "cell" : fmt::format("{} cells", d.block);
    columns.push_back({fmt::format("delta_e00_{}", d.block), cells, ".2f"});
    columns.push_back({fmt::format("delta_e00_{}_p95", d.block), "1 in 20", ".1f",
                       "exceeded by one block in twenty"});
  }
  columns.insert(columns.end(),
                 {{"halves_delta_e00_32", "halves: 32 cells", ".2f"},
                  {"halves_delta_e00_32_p95", "1 in 20", ".1f", "exceeded by one block in twenty"},
                  {"gradient_share", "gradient energy, of the picture's", ".2f"}});
  ReportTable table(columns);
  for (const Judged& one : evaluated) {
    if (one.results[0].differences.empty()) continue;
    std::vector<Json> row = {Json::text(one.model)};
    for (const BlockDifference& d : one.results[0].differences)
      row.insert(row.end(), {known(d.mean), known(d.p95)});
    const BlockDifference& halves = one.results[1].differences[2];
    row.insert(row.end(),
               {known(halves.mean), known(halves.p95), known(one.results[0].gradient_share)});
    table.add_row(std::move(row));
  }
  return table;
}

void add_evaluation(Report& page, const LayersFitReportInput& in,
                    const std::vector<Judged>& evaluated) {
  page.section("judgement", "On held-out ground",
               "Tiles: fitted on one colour of a chessboard, evaluated on the other, and vice "
               "versa; neighbouring tiles are similar, so the result is optimistic. Halves: west "
               "by east, north by south and vice versa, which is extrapolation. Accuracy: cells "
               "whose most likely class is the true one. AUC: the probability that a cell of a "
               "class gets a larger share of it than another cell. IoU: cells of both over cells "
               "of either; matched: with shares scaled so that each class covers its true area.");
  page.table(measures_table(evaluated));
  page.table(confusion_table(*in.ground, evaluated[1].results[0].measures),
             "Class by class, as in the file, tiles");
  if (in.ground->picture)
    page.table(difference_table(evaluated),
               "Colour difference ΔE00 of the means of blocks, relit by the estimated sun, and the "
               "value that one block in twenty exceeds");
}

void add_reproduction(Report& page, const LayersFitReportInput& in, const HeldOutResult& held_out,
                      const std::vector<glm::vec3>& colours) {
  const std::vector<std::uint8_t> likely = most_likely(held_out.prediction.classes);
  page.section("reproduction", "Original and reproduction",
               "Every part is painted by a fit that did not use it. Drag the slider.");
  const Grid<glm::vec3> original =
      in.ground->picture ? picture_of(in.ground->picture->rgb)
                         : class_map(in.ground->altitude_m, in.ground->labels, colours);
  const Grid<glm::vec3> made = in.ground->picture
                                   ? picture_of(held_out.prediction.expected)
                                   : class_map(in.ground->altitude_m, likely, colours);
  page.compare("original", reduced_picture(original, 2 * small_map_px), "reproduction",
               reduced_picture(made, 2 * small_map_px));
  page.section("likely", "Most likely classes", "Beside the classes they are compared with.");
  page.picture(
      "true_classes",
      reduced_picture(class_map(in.ground->altitude_m, in.ground->labels, colours), small_map_px),
      "true");
  page.picture("likely_classes",
               reduced_picture(class_map(in.ground->altitude_m, likely, colours), small_map_px),
               "most likely, held out");
}

}  // namespace

void write_layers_fit_report(const std::string& folder, const LayersFitReportInput& input,
                             Progress& progress) {
  const std::vector<Judged> evaluated = evaluate_models(input, progress);
  progress.begin("writing the report", 0.0);
  const std::vector<glm::vec3> colours = class_colours(*input.ground, *input.fit);
  Report page(folder);
  page.section("notes", "");
  page.list(input.notes);
  add_reproduction(page, input, evaluated[1].results[0], colours);
  add_evaluation(page, input, evaluated);
  add_classes(page, *input.ground, colours);
  add_functions(page, *input.ground, *input.fit, colours);
  add_editor(page, input);
  add_trace(page, input);
  add_inputs(page, *input.ground, *input.fit);
  page.write({.title = "Surface layers: " + input.title,
              .lead = "What surface layers learned, and how well they predict held-out ground.",
              .command = input.command});
}

}  // namespace belvedere::tools
