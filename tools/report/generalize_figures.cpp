#include "tools/report/generalize_figures.h"

#include <fmt/core.h>

#include <algorithm>
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

}  // namespace belvedere::tools
