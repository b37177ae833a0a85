#include "tools/report/generalize_report_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/json.h"
#include "terrain/generalize/generalize_report.h"
#include "terrain/generalize/mask.h"
#include "tools/report/generalize_figures.h"
#include "tools/report/json_numbers.h"
#include "tools/report/report_folder.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int slices = 5;

// Everything in numbers.
struct Measures {
  int bands = 0;
  std::vector<std::vector<double>> energy_before_m2, energy_after_m2;  // [slice][band]
  std::vector<AltitudeChange> change;                                  // [slice]
  std::vector<RidgeSharpness> ridges;                                  // [slice]
  FootPits original, without_mask, with_mask;
  bool own_mask = false;  // with_mask is by the mask of the run, else by the automatic one
};

// 1 at the southern rim, 0 at the northern: as a map lies before its reader.
Grid<float> south_is_near(int width, int height) {
  Grid<float> share(width, height);
  for (int y = 0; y < height; ++y) std::fill_n(share.row(y), width, static_cast<float>(y + 1) / static_cast<float>(height));
  return share;
}

GeneralizeGrids with_masks(const GeneralizeGrids& grids, Grid<float> mask, Grid<float> amplification_mask) {
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
  m.original = foot_pits(in.before_m, in.before_m, feet, in.cell_m);
  m.own_mask = !in.grids.mask.empty() || !in.grids.amplification_mask.empty();
  const auto pits = [&](const GeneralizeGrids& grids) {
    return foot_pits(in.before_m, generalize(in.before_m, in.cell_m, grids, in.parameters, progress), feet, in.cell_m);
  };
  m.without_mask = pits(with_masks(in.grids, {}, {}));
  m.with_mask = pits(m.own_mask ? in.grids : with_masks(in.grids, {}, slope_foot_mask(in.before_m, in.cell_m, 1 << std::min(m.bands, 8))));
  return m;
}

std::string slice_name(int slice) {
  return slice == 0 ? "nearest" : slice == slices - 1 ? "farthest" : fmt::format("{} of {}", slice + 1, slices);
}

// Amplitude that is left of a band: the root of the energies' ratio. NaN where there was none.
double kept_amplitude(double before, double after) { return before > 0.0 ? std::sqrt(after / before) : std::nan(""); }

std::string percent(double share) { return std::isfinite(share) ? fmt::format("{:.0f} %", 100.0 * share) : "–"; }

// A group of bars a slice, a bar a band; the dashed line is 100 %.
std::string energy_chart(const Measures& m) {
  constexpr int bar = 16, gap = 26, height = 160, top = 8;
  const int group = m.bands * bar + gap;
  const double full = 2.0;  // 200 % reaches the top
  std::string svg = fmt::format("<svg width=\"{}\" height=\"{}\" role=\"img\" aria-label=\"Detail kept by band and distance\">\n",
                                slices * group + gap, height + 40);
  for (int s = 0; s < slices; ++s) {
    const int x0 = gap + s * group;
    for (int b = 0; b < m.bands; ++b) {
      const auto i = static_cast<std::size_t>(s);
      const auto k = static_cast<std::size_t>(b);
      const double kept = kept_amplitude(m.energy_before_m2[i][k], m.energy_after_m2[i][k]);
      // To a tenth of a pixel, as it is written: so all bars stand on one line.
      const double shown = std::isfinite(kept) ? std::round(10.0 * std::min(kept, full) * height / full) / 10.0 : 0.0;
      svg += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"hsl(205,45%,{}%)\"/>\n", x0 + b * bar,
                         top + height - shown, bar - 2, shown, 25 + 45 * b / std::max(m.bands - 1, 1));
    }
    svg +=
        fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", x0 + m.bands * bar / 2, top + height + 18, slice_name(s));
  }
  const double one = top + height - height / full;
  svg += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\" stroke=\"#a33\" stroke-dasharray=\"5 4\"/>\n</svg>", gap / 2,
                     slices * group + gap / 2, one, one);
  return svg;
}

void add_numbers(ReportFolder& page, const Measures& m, bool view) {
  page.add("<section id=\"energy\"><h2>Detail kept by landform size and distance</h2>");
  page.add(
      "<p>Each group of bars is a stretch of distance, each bar a band, dark the largest landforms, light the smallest: at the dashed line "
      "landforms of that size are as high as in the original, below it they are quieter, above it exaggerated.</p>");
  page.add(energy_chart(m));
  std::string table = "<table>";
  std::vector<std::string> head = {"distance"};
  for (int b = 0; b < m.bands; ++b)
    head.push_back(fmt::format("band {}{}", b + 1, b == 0 ? " (largest)" : b == m.bands - 1 ? " (smallest)" : ""));
  table += html_row(head, "th");
  for (std::size_t s = 0; s < slices; ++s) {
    std::vector<std::string> cells = {slice_name(static_cast<int>(s))};
    for (std::size_t b = 0; b < static_cast<std::size_t>(m.bands); ++b) {
      const double before = m.energy_before_m2[s][b];
      const double after = m.energy_after_m2[s][b];
      cells.push_back(fmt::format("{}<br><small>{:.3g} → {:.3g} m</small>", percent(kept_amplitude(before, after)), std::sqrt(before),
                                  std::sqrt(after)));
    }
    table += html_row(cells);
  }
  page.add(table + "</table><p><small>Below each percentage the root mean square height of the band, before → after. " +
           (view ? "Distance goes by the foreground share of the view, in five equal steps."
                 : "No view was given: the south counts as near, the north as far.") +
           "</small></p></section>");

  page.add("<section id=\"ridges\"><h2>Ridges kept</h2>");
  page.add(
      "<p>How sharp the ridge lines still are, against a plain Gaussian blur that takes as much energy from the quietened bands: the "
      "farther "
      "the second column is above the third, the better break lines were preserved.</p>");
  table = "<table>" + html_row({"distance", "this generalization", "Gaussian of equal energy", "its width", "ridge-line cells"}, "th");
  for (std::size_t s = 0; s < slices; ++s) {
    const RidgeSharpness& r = m.ridges[s];
    const std::string width = r.gaussian_cells == 0.0                     ? "no band quieter"
                              : r.gaussian_cells >= widest_gaussian_cells ? fmt::format("σ over {:.0f} cells", widest_gaussian_cells)
                                                                          : fmt::format("σ {:.2f} cells", r.gaussian_cells);
    table += r.cells == 0 ? html_row({slice_name(static_cast<int>(s)), "–", "–", "–", "0"})
                          : html_row({slice_name(static_cast<int>(s)), percent(r.kept()), percent(r.kept_by_gaussian()), width,
                                      fmt::format("{}", r.cells)});
  }
  page.add(table + "</table></section>");

  page.add("<section id=\"pits\"><h2>Pits at the foot of slopes</h2>");
  page.add(
      "<p>Where steep slopes meet flat ground, exaggerated middle bands dig moats: hollows that would hold water, or ground taken away; a "
      "good "
      "mask brings both figures back towards the original's.</p>");
  table = "<table>" + html_row({"terrain", "hollows, 10⁶ m³", "deepest, m", "ground taken away, 10⁶ m³"}, "th");
  const auto pits = [&](const char* name, const FootPits& p) {
    table += html_row(
        {name, fmt::format("{:.3f}", p.hollows_m3 / 1e6), fmt::format("{:.1f}", p.deepest_m), fmt::format("{:.3f}", p.lowered_m3 / 1e6)});
  };
  pits("original", m.original);
  pits("these weights, no mask", m.without_mask);
  pits(m.own_mask ? "these weights, the mask of this run" : "these weights, automatic mask of slope feet", m.with_mask);
  page.add(table + "</table></section>");

  page.add("<section id=\"change\"><h2>Altitude change</h2>");
  page.add("<p>How far the result lies from the original: a mean near 0 says that the land as a whole was neither raised nor lowered.</p>");
  table = "<table>" + html_row({"distance", "mean, m", "root mean square, m", "largest, m", "cells"}, "th");
  for (std::size_t s = 0; s < slices; ++s) {
    const AltitudeChange& c = m.change[s];
    table += html_row({slice_name(static_cast<int>(s)), fmt::format("{:+.2f}", c.mean_m), fmt::format("{:.2f}", c.rms_m),
                       fmt::format("{:.1f}", c.largest_m), fmt::format("{}", c.cells)});
  }
  page.add(table + "</table></section>");
}

Json pits_json(const FootPits& pits) {
  return Json::object()
      .add("hollows_m3", Json::number(pits.hollows_m3))
      .add("deepest_m", Json::number(pits.deepest_m))
      .add("lowered_m3", Json::number(pits.lowered_m3));
}

std::string as_json(const GeneralizeReportInput& in, const Measures& m) {
  Json distances = Json::array();
  for (std::size_t s = 0; s < slices; ++s) {
    const AltitudeChange& c = m.change[s];
    const RidgeSharpness& r = m.ridges[s];
    distances.add(Json::object()
                      .add("cells", Json::number(static_cast<double>(c.cells)))
                      .add("band_energy_before_m2", json_numbers(m.energy_before_m2[s]))
                      .add("band_energy_after_m2", json_numbers(m.energy_after_m2[s]))
                      .add("change_mean_m", Json::number(c.mean_m))
                      .add("change_rms_m", Json::number(c.rms_m))
                      .add("change_largest_m", Json::number(c.largest_m))
                      .add("ridge_cells", Json::number(static_cast<double>(r.cells)))
                      .add("ridge_curvature_kept", Json::number(r.kept()))
                      .add("ridge_curvature_kept_by_gaussian", Json::number(r.kept_by_gaussian()))
                      .add("gaussian_cells", Json::number(r.gaussian_cells)));
  }
  return Json::object()
             .add("title", Json::text(in.title))
             .add("command", Json::text(in.command))
             .add("width", Json::number(in.before_m.width()))
             .add("height", Json::number(in.before_m.height()))
             .add("cell_m", Json::array({Json::number(in.cell_m.x), Json::number(in.cell_m.y)}))
             .add("bands", Json::number(m.bands))
             .add("distances_near_to_far", std::move(distances))
             .add("pits_at_slope_feet", Json::object()
                                            .add("original", pits_json(m.original))
                                            .add("without_mask", pits_json(m.without_mask))
                                            .add(m.own_mask ? "with_mask" : "with_automatic_mask", pits_json(m.with_mask)))
             .str() +
         "\n";
}

}  // namespace

void write_generalize_report(const std::string& folder, const GeneralizeReportInput& input, Progress& progress) {
  const bool view = !input.grids.foreground_share.empty();
  const Grid<float> share = view ? input.grids.foreground_share : south_is_near(input.before_m.width(), input.before_m.height());
  progress.begin("measuring", 0.0);
  const Measures measures = measure(input, share, progress);
  const FigureWindows windows = choose_windows(input.before_m, input.cell_m, share);

  ReportFolder page(folder);
  ReliefPainter paint(page, input.cell_m);
  double squares = 0.0;
  double cells = 0.0;
  for (const AltitudeChange& c : measures.change) {
    squares += c.rms_m * c.rms_m * static_cast<double>(c.cells);
    cells += static_cast<double>(c.cells);
  }
  const double rms_m = std::sqrt(squares / std::max(cells, 1.0));
  const float full_m = static_cast<float>(std::max(3.0 * rms_m, 0.1));
  page.begin_figure("overview", "The whole terrain",
                    fmt::format("In the last picture red ground was lowered and blue ground raised, fully at {:.1f} m.", full_m));
  paint.whole("overview_original", input.before_m, "original");
  paint.whole("overview_result", input.after_m, "generalized");
  page.picture("overview_change", change_picture(input.before_m, input.after_m, input.cell_m, full_m, ReliefPainter::whole_px), "change");
  page.end_figure();
  page.begin_figure("closeup", "Cell by cell", "The roughest part near and far, as it was and as it is now: here fine detail can be seen.");
  paint.window("closeup_near_original", input.before_m, windows.near, "near, original");
  paint.window("closeup_near_result", input.after_m, windows.near, "near, generalized");
  paint.window("closeup_far_original", input.before_m, windows.far, "far, original");
  paint.window("closeup_far_result", input.after_m, windows.far, "far, generalized");
  page.end_figure();
  add_numbers(page, measures, view);
  page.add(
      "<h2>The method on this terrain</h2><p>Figures 1 to 5 of Jenny, Jenny &amp; Hurni 2011, made from this terrain whatever the settings "
      "above: figures 2 and 5 with the paper's weights, 3 and 4, for which it gives none, with ours.</p>");
  add_paper_figures(page, input, share, windows, progress);

  page.write("report.json", as_json(input, measures));
  page.write_page(
      input.title, "Generalization of " + input.title,
      fmt::format("{} × {} cells of {:.4g} × {:.4g} m.", input.before_m.width(), input.before_m.height(), input.cell_m.x, input.cell_m.y),
      input.command);
}

}  // namespace belvedere::tools
