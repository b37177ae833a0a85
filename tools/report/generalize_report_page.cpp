#include "tools/report/generalize_report_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "terrain/generalize/generalize_report.h"
#include "terrain/generalize/mask.h"
#include "tools/report/generalize_figures.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int slices = 5;
constexpr int whole_px = 600;  // longest side of a picture of the whole terrain

// All numbers.
struct Measures {
  int bands = 0;
  std::vector<std::vector<double>> energy_before_m2, energy_after_m2;  // [slice][band]
  std::vector<AltitudeChange> change;                                  // [slice]
  std::vector<RidgeSharpness> ridges;                                  // [slice]
  Pits original, without_mask, with_mask;
  bool own_mask = false;  // with_mask uses the mask of the run, else the automatic one
};

// 1 at the southern rim, 0 at the northern: as if a reader held the map.
Grid<float> south_is_near(int width, int height) {
  Grid<float> share(width, height);
  for (int y = 0; y < height; ++y)
    std::fill_n(share.row(y), width, static_cast<float>(y + 1) / static_cast<float>(height));
  return share;
}

GeneralizeGrids with_masks(const GeneralizeGrids& grids, Grid<float> mask,
                           Grid<float> amplification_mask) {
  GeneralizeGrids out = grids;
  out.mask = std::move(mask);
  out.amplification_mask = std::move(amplification_mask);
  return out;
}

Measures measure(const GeneralizeReportInput& in, const Grid<float>& share, Progress& progress) {
  Measures m;
  m.bands = static_cast<int>(in.parameters.foreground.size());
  const glm::ivec2 size(in.before_m.width(), in.before_m.height());
  m.energy_before_m2 = band_energy(in.before_m, share, m.bands, slices);
  m.energy_after_m2 = band_energy(in.after_m, share, m.bands, slices);
  m.change = altitude_change(in.before_m, in.after_m, distance_slices(share, size, slices), slices);
  m.ridges = ridge_sharpness(in.before_m, in.after_m, in.cell_m, share, m.bands, slices);
  const Grid<std::uint8_t> feet = slope_feet(in.before_m, in.cell_m, m.bands);
  m.original = find_pits(in.before_m, in.before_m, feet, in.cell_m);
  m.own_mask = !in.grids.mask.empty() || !in.grids.amplification_mask.empty();
  const auto pits = [&](const GeneralizeGrids& grids) {
    return find_pits(in.before_m,
                     generalize(in.before_m, in.cell_m, grids, in.parameters, progress), feet,
                     in.cell_m);
  };
  m.without_mask = pits(with_masks(in.grids, {}, {}));
  m.with_mask = pits(
      m.own_mask ? in.grids
                 : with_masks(in.grids, {},
                              slope_foot_mask(in.before_m, in.cell_m, 1 << std::min(m.bands, 8))));
  return m;
}

std::string slice_name(int slice) {
  return slice == 0            ? "nearest"
         : slice == slices - 1 ? "farthest"
                               : fmt::format("{} of {}", slice + 1, slices);
}

// Remaining amplitude of a band: the square root of the ratio of energies. NaN where there was
// none.
double kept_amplitude(double before, double after) {
  return before > 0.0 ? std::sqrt(after / before) : std::nan("");
}

// A group of bars per slice, a bar per band; below it the same in numbers.
void add_energy(Report& page, const Measures& m, bool view) {
  page.section("energy", "Detail kept by landform size and distance",
               "Each group of bars is a range of distance, each bar a band, dark the largest "
               "landforms, light the smallest. At the dashed line landforms of that size are as "
               "high as in the original, below it they are reduced, above it exaggerated.");
  std::vector<ReportColumn> columns = {{"distance", "distance"}};
  for (int b = 0; b < m.bands; ++b)
    columns.push_back({fmt::format("band_{}", b + 1),
                       fmt::format("band {}{}", b + 1,
                                   b == 0             ? " (largest)"
                                   : b == m.bands - 1 ? " (smallest)"
                                                      : ""),
                       ".0%"});
  ReportTable table(columns);
  Json groups = Json::array();
  for (std::size_t s = 0; s < slices; ++s) {
    const std::string name = slice_name(static_cast<int>(s));
    std::vector<Json> row = {Json::text(name)};
    Json values = Json::array();
    for (std::size_t b = 0; b < static_cast<std::size_t>(m.bands); ++b) {
      const double before = m.energy_before_m2[s][b];
      const double after = m.energy_after_m2[s][b];
      values.add(known(kept_amplitude(before, after)));
      row.push_back(Json::object()
                        .add("value", known(kept_amplitude(before, after)))
                        .add("before", Json::number(std::sqrt(before)))
                        .add("after", Json::number(std::sqrt(after)))
                        .add("unit", Json::text("m")));
    }
    table.add_row(std::move(row));
    groups.add(Json::object().add("name", Json::text(name)).add("values", std::move(values)));
  }
  page.add("bars", Json::object()
                       .add("title", Json::text("Detail kept by band and distance"))
                       .add("groups", std::move(groups))
                       .add("line", Json::number(1.0))
                       .add("max", Json::number(2.0)));
  page.table(table);
  page.add(
      "small",
      Json::text(
          std::string(
              "Below each percentage the root mean square height of the band, before → after. ") +
          (view ? "Distance is the foreground share of the view, in five equal steps."
                : "No view was given: the south counts as near, the north as far.")));
}

void add_ridges(Report& page, const Measures& m) {
  page.section("ridges", "Ridges kept",
               "Sharpness of the ridge lines, compared with a plain Gaussian blur that removes as "
               "much energy from the reduced bands: the farther the second column is above the "
               "third, the better break lines were preserved.");
  ReportTable table({{"distance", "distance"},
                     {"ridge_curvature_kept", "this generalization", ".0%"},
                     {"ridge_curvature_kept_by_gaussian", "Gaussian of equal energy", ".0%"},
                     {"gaussian_cells", "", "hidden"},
                     {"width", "its width"},
                     {"cells", "ridge-line cells"}});
  for (std::size_t s = 0; s < slices; ++s) {
    const RidgeSharpness& r = m.ridges[s];
    const std::string width = r.cells == 0              ? "–"
                              : r.gaussian_cells == 0.0 ? "no band reduced"
                              : r.gaussian_cells >= widest_gaussian_cells
                                  ? fmt::format("σ over {:.0f} cells", widest_gaussian_cells)
                                  : fmt::format("σ {:.2f} cells", r.gaussian_cells);
    const auto of_some = [&](double value) { return known(r.cells == 0 ? std::nan("") : value); };
    table.row(slice_name(static_cast<int>(s)), of_some(r.kept()), of_some(r.kept_by_gaussian()),
              r.gaussian_cells, width, r.cells);
  }
  page.table(table);
}

void add_pits(Report& page, const Measures& m) {
  page.section(
      "pits", "Pits",
      "Where steep slopes meet flat ground, exaggerated medium bands dig moats: hollows "
      "that would hold water, or removed ground. A good mask brings these figures back "
      "towards the original's at the foot of slopes. It does not act elsewhere: the second "
      "number of each pair says how much of the whole terrain's lies there, such as "
      "valleys that exaggeration has closed.");
  ReportTable table(
      {{"terrain", "terrain"},
       {"pits", "pits over 0.5 m"},
       {"pits_elsewhere", "away from the foot of slopes"},
       {"hollows_million_m3", "hollows, 10⁶ m³", ".3f"},
       {"hollows_elsewhere_million_m3", "away from the foot of slopes, 10⁶ m³", ".3f"},
       {"deepest_m", "deepest, m", ".1f"},
       {"lowered_million_m3", "ground removed at the foot of slopes, 10⁶ m³", ".3f"}});
  const auto pits = [&](const char* name, const Pits& p) {
    table.row(name, p.count, p.elsewhere(), p.hollows_m3 / 1e6, p.elsewhere_m3() / 1e6, p.deepest_m,
              p.lowered_m3 / 1e6);
  };
  pits("original", m.original);
  pits("these weights, no mask", m.without_mask);
  pits(m.own_mask ? "these weights, the mask of this run"
                  : "these weights, automatic mask of slope feet",
       m.with_mask);
  page.table(table);
}

void add_change(Report& page, const Measures& m) {
  page.section("change", "Altitude change",
               "Difference of the result from the original: a mean near 0 means that the land as a "
               "whole was neither raised nor lowered.");
  ReportTable table({{"distance", "distance"},
                     {"change_mean_m", "mean, m", "+.2f"},
                     {"change_rms_m", "root mean square, m", ".2f"},
                     {"change_largest_m", "largest, m", ".1f"},
                     {"cells", "cells"}});
  for (std::size_t s = 0; s < slices; ++s) {
    const AltitudeChange& c = m.change[s];
    table.row(slice_name(static_cast<int>(s)), c.mean_m, c.rms_m, c.largest_m, c.cells);
  }
  page.table(table);
}

}  // namespace

void write_generalize_report(const std::string& folder, const GeneralizeReportInput& input,
                             Progress& progress) {
  const bool view = !input.grids.foreground_share.empty();
  const Grid<float> share = view ? input.grids.foreground_share
                                 : south_is_near(input.before_m.width(), input.before_m.height());
  progress.begin("measuring", 0.0);
  const Measures measures = measure(input, share, progress);
  const FigureWindows windows = choose_windows(input.before_m, input.cell_m, share);

  Report page(folder);
  double squares = 0.0;
  double cells = 0.0;
  for (const AltitudeChange& c : measures.change) {
    squares += c.rms_m * c.rms_m * static_cast<double>(c.cells);
    cells += static_cast<double>(c.cells);
  }
  const double rms_m = std::sqrt(squares / std::max(cells, 1.0));
  const float full_m = static_cast<float>(std::max(3.0 * rms_m, 0.1));
  const auto relief = [&](const std::string& name, const Grid<float>& altitude_m,
                          const std::string& caption) {
    page.picture(name, relief_picture(altitude_m, input.cell_m, whole_px), caption);
  };
  page.section(
      "overview", "The whole terrain",
      fmt::format(
          "In the last picture red ground was lowered and blue ground raised, fully at {:.1f} m.",
          full_m));
  relief("overview_original", input.before_m, "original");
  relief("overview_result", input.after_m, "generalized");
  page.picture("overview_change",
               change_picture(input.before_m, input.after_m, input.cell_m, full_m, whole_px),
               "change");
  page.section("closeup", "Cell by cell",
               "The roughest part near and far, before and after, to show fine detail.");
  relief("closeup_near_original", cut(input.before_m, windows.near), "near, original");
  relief("closeup_near_result", cut(input.after_m, windows.near), "near, generalized");
  relief("closeup_far_original", cut(input.before_m, windows.far), "far, original");
  relief("closeup_far_result", cut(input.after_m, windows.far), "far, generalized");
  add_energy(page, measures, view);
  add_ridges(page, measures);
  add_pits(page, measures);
  add_change(page, measures);
  page.section("method", "The method on this terrain",
               "Figures 1 to 5 of Jenny, Jenny & Hurni 2011, made from this terrain independent of "
               "the settings above: figures 2 and 5 with the paper's weights, 3 and 4, for which "
               "it gives none, with ours.");
  add_paper_figures(page, input, share, windows, progress);

  page.write({.title = "Generalization of " + input.title,
              .lead = fmt::format("{} × {} cells of {:.4g} × {:.4g} m.", input.before_m.width(),
                                  input.before_m.height(), input.cell_m.x, input.cell_m.y),
              .command = input.command,
              .data = Json::object()
                          .add("width", Json::number(input.before_m.width()))
                          .add("height", Json::number(input.before_m.height()))
                          .add("cell_m", Json::numbers(std::array{input.cell_m.x, input.cell_m.y}))
                          .add("bands", Json::number(measures.bands))});
}

}  // namespace belvedere::tools
