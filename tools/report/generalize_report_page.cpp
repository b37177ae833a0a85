#include "tools/report/generalize_report_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/pyramid.h"
#include "base/statistics.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/generalize_report.h"
#include "terrain/generalize/mask.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

void add_pyramid(Report& page, const Grid<float>& altitude_m, glm::dvec2 cell_m,
                 const PixelRect& around, int bands) {
  page.section("figure1", "Figure 1: decomposition of the terrain",
               "The first row is the Gaussian pyramid, from the original to its coarsest level; "
               "the second row shows the band that each step removed (grey none, bright higher, "
               "dark lower), small landforms first.");
  // A quarter of the window: the smallest landforms are one or two cells wide and must be visible.
  constexpr int side = 220;
  const int width = std::min(side, around.width());
  const int height = std::min(side, around.height());
  const PixelRect centre{around.x0 + (around.width() - width) / 2,
                         around.y0 + (around.height() - height) / 2,
                         around.x0 + (around.width() - width) / 2 + width,
                         around.y0 + (around.height() - height) / 2 + height};
  const Grid<float> cells = cut(altitude_m, centre);
  const LaplacianPyramid pyramid = make_laplacian_pyramid(cells, bands);
  const int count = static_cast<int>(pyramid.bands.size());
  const std::vector<Grid<float>> levels = make_gaussian_pyramid(cells, count + 1);
  // Scaled back to the size of the first.
  const auto enlarged = [&](Grid<float> grid, int level) {
    for (int i = level - 1; i >= 0; --i) {
      const Grid<float>& finer = levels[static_cast<std::size_t>(i)];
      grid = expand(grid, finer.width(), finer.height());
    }
    return grid;
  };
  for (int i = 0; i <= count; ++i) {
    page.picture(fmt::format("figure1_gaussian_{}", count + 1 - i),
                 relief_picture(enlarged(levels[static_cast<std::size_t>(i)], i), cell_m, side),
                 fmt::format("G{}{}", count + 1 - i, i == 0 ? ", the original" : ""));
  }
  page.next_row();
  for (int i = 0; i < count; ++i) {
    const Grid<float> band = enlarged(pyramid.bands[static_cast<std::size_t>(i)], i);
    double sum = 0.0;
    for (const float v : band) sum += static_cast<double>(v) * v;
    const double rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(band.size(), 1)));
    page.picture(fmt::format("figure1_laplacian_{}", count - i),
                 signed_picture(band, static_cast<float>(3.0 * rms)),
                 fmt::format("L{}, {:.0f}–{:.0f} m wide, ±{:.1f} m", count - i,
                             std::ldexp(cell_m.x, i), std::ldexp(cell_m.x, i + 1), rms));
  }
}

}  // namespace

FigureWindows choose_windows(const Grid<float>& altitude_m, glm::dvec2 cell_m,
                             const Grid<float>& share) {
  const Grid<std::uint8_t> lines = ridge_lines(altitude_m, cell_m);
  Grid<float> score(lines.width(), lines.height());
  std::transform(lines.begin(), lines.end(), score.begin(),
                 [](std::uint8_t v) { return static_cast<float>(v); });
  // The nearest and the farthest quarter of the cells.
  const std::vector<float> ranked(share.begin(), share.end());
  const float nearest_quarter = value_at_share(ranked, 0.75);
  const float farthest_quarter = value_at_share(ranked, 0.25);
  Grid<float> near = share;
  Grid<float> far = share;
  for (float& v : near) v = v >= nearest_quarter ? 1.F : 0.F;
  for (float& v : far) v = v <= farthest_quarter ? 1.F : 0.F;
  return {best_window(score, {}, window_px), best_window(score, near, window_px),
          best_window(score, far, window_px)};
}

void add_paper_figures(Report& page, const GeneralizeReportInput& in, const Grid<float>& share,
                       const FigureWindows& windows, Progress& progress) {
  const Grid<float>& before = in.before_m;
  const auto relief = [&](const std::string& name, const Grid<float>& altitude_m,
                          const PixelRect& where, const std::string& caption) {
    page.picture(name, relief_picture(cut(altitude_m, where), in.cell_m, window_px), caption);
  };
  const auto filtered = [&](const GeneralizeParameters& parameters, Grid<float> where,
                            Grid<float> mask) {
    GeneralizeGrids grids;
    grids.keep = in.grids.keep;
    grids.foreground_share = std::move(where);
    grids.mask = std::move(mask);
    return generalize(before, in.cell_m, grids, parameters, progress);
  };
  add_pyramid(page, before, in.cell_m, windows.ridges,
              static_cast<int>(in.parameters.foreground.size()));

  const GeneralizeParameters figure_2 = find_generalize_preset("figure2")->bands;
  const Grid<float> amplified = filtered(figure_2, {}, {});
  page.section("figure2", "Figure 2: fine detail removed, medium forms doubled",
               "With the paper's weights 100, 100, 200, 25 and 0 % the right picture has lost its "
               "small gullies and its main ridges and "
               "valleys stand out.");
  relief("figure2_original", before, windows.ridges, "original");
  relief("figure2_filtered", amplified, windows.ridges, "filtered");

  GeneralizeParameters global;
  global.foreground = global.background = {1.F, 1.F, 0.4F, 0.1F, 0.F};
  GeneralizeParameters local = global;
  local.foreground_ridges = local.background_ridges = {0.F, 0.F, 0.7F, 1.F, 1.1F};
  local.foreground_valleys = local.background_valleys = {0.F, 0.F, 0.4F, 0.6F, 0.6F};
  page.section(
      "figure3", "Figure 3: ridges and valley lines kept by curvature",
      "At the centre, the same weights everywhere blur the ridges; on the right, additional "
      "weights along ridges and valley lines restore their edges while slopes stay smooth.");
  relief("figure3_original", before, windows.ridges, "original");
  relief("figure3_global", filtered(global, {}, {}), windows.ridges, "the same weights everywhere");
  relief("figure3_local", filtered(local, {}, {}), windows.ridges,
         "additional weights along ridges and valleys");

  const Grid<float> by_distance = filtered(find_generalize_preset("figure4")->bands, share, {});
  page.section("figure4", "Figure 4: more generalization with distance",
               "Near ground (first two) should hardly differ; far ground (last two) keeps only "
               "large forms and their ridges.");
  relief("figure4_near_original", before, windows.near, "near, original");
  relief("figure4_near_filtered", by_distance, windows.near, "near, filtered");
  relief("figure4_far_original", before, windows.far, "far, original");
  relief("figure4_far_filtered", by_distance, windows.far, "far, filtered");

  const Grid<std::uint8_t> feet =
      slope_feet(before, in.cell_m, static_cast<int>(figure_2.foreground.size()));
  Grid<float> dug(before.width(), before.height());
  for (std::size_t i = 0; i < dug.size(); ++i)
    dug[i] = feet[i] != 0 ? std::max(0.F, before[i] - amplified[i]) : 0.F;
  const PixelRect window = best_window(dug, {}, window_px);
  const Grid<float> masked = filtered(figure_2, {}, slope_mask(before, in.cell_m, SlopeRange{}));
  constexpr float full_m = 20.F;
  page.section("figure5", "Figure 5: flat ground protected by a mask",
               "Red ground was lowered and blue ground raised, fully at 20 m: red moats along the "
               "foot of slopes in the central picture should be gone on the right, where only "
               "steep ground is filtered.");
  relief("figure5_original", before, window, "original");
  page.picture(
      "figure5_everywhere",
      change_picture(cut(before, window), cut(amplified, window), in.cell_m, full_m, window_px),
      "filtered everywhere");
  page.picture(
      "figure5_masked",
      change_picture(cut(before, window), cut(masked, window), in.cell_m, full_m, window_px),
      "steep ground only");
}

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
