#include "tools/report/equalizer_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "base/filter.h"
#include "base/pyramid.h"
#include "base/text/base64.h"
#include "base/text/embedded.h"
#include "base/text/json.h"
#include "base/text/markup.h"
#include "renderer/image/output_file.h"
#include "terrain/generalize/foreground_share.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/generalize_report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int largest_side = 512;
constexpr int closeup_side = 320;

using Weights = std::vector<float>;

// The DEM as shown on the page: a level of its pyramid, or a part of it.
struct Preview {
  std::string name;
  Grid<float> altitude_m;
  glm::dvec2 cell_m;
  int skipped = 0;  // number of finest bands that this level lacks
  int bands = 0;
  glm::dvec2 viewer_cell;
  Grid<unsigned char> lakes;  // empty: none here
  Grid<float> foot_mask, slope_mask, drawn_mask;
};

std::string base64_of(const Grid<float>& values) {
  std::string bytes;
  bytes.reserve(values.size() * 4);
  for (const float v : values) {
    const auto bits = std::bit_cast<std::uint32_t>(v);  // little endian
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>((bits >> (8 * i)) & 0xffU);
  }
  return base64(bytes);
}

std::string base64_of(const Grid<unsigned char>& values) {
  return base64(std::string(values.begin(), values.end()));
}

// Cell i lies on cell 2 i, as in reduce().
Grid<unsigned char> every_other(const Grid<unsigned char>& cells) {
  Grid<unsigned char> out((cells.width() + 1) / 2, (cells.height() + 1) / 2);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = cells(2 * x, 2 * y);
  return out;
}

bool any(const Grid<unsigned char>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](unsigned char v) { return v != 0; });
}

std::vector<Preview> make_previews(const EqualizerInput& in) {
  const int bands = static_cast<int>(in.start.foreground.size());
  const auto possible = [&](const Preview& p) {
    return std::min(bands - p.skipped, max_bands(p.altitude_m.width(), p.altitude_m.height()));
  };
  std::vector<Preview> previews;
  Preview whole{"whole terrain", in.altitude_m, in.cell_m,    0, 0, in.viewer_cell, in.lakes,
                in.foot_mask,    in.slope_mask, in.drawn_mask};
  while (std::max(whole.altitude_m.width(), whole.altitude_m.height()) > largest_side) {
    for (Grid<float>* grid :
         {&whole.altitude_m, &whole.foot_mask, &whole.slope_mask, &whole.drawn_mask})
      if (!grid->empty()) *grid = reduce(*grid);
    whole.lakes = every_other(whole.lakes);
    whole.cell_m = 2.0 * whole.cell_m;
    whole.viewer_cell = 0.5 * whole.viewer_cell;  // cell i lies on cell 2 i
    ++whole.skipped;
  }
  // A DEM so large that the overview has no band left still has its close-up.
  whole.bands = std::max(0, possible(whole));
  const bool reduced = whole.skipped > 0;
  previews.push_back(std::move(whole));
  if (reduced) {
    const Grid<std::uint8_t> lines = ridge_lines(in.altitude_m, in.cell_m);
    Grid<float> score(lines.width(), lines.height());
    std::transform(lines.begin(), lines.end(), score.begin(),
                   [](std::uint8_t v) { return static_cast<float>(v); });
    const PixelRect window = best_window(score, {}, closeup_side);
    Preview part{"close-up",
                 cut(in.altitude_m, window),
                 in.cell_m,
                 0,
                 0,
                 in.viewer_cell - glm::dvec2(window.x0, window.y0),
                 cut(in.lakes, window),
                 cut(in.foot_mask, window),
                 cut(in.slope_mask, window),
                 in.drawn_mask.empty() ? Grid<float>() : cut(in.drawn_mask, window)};
    part.bands = possible(part);
    previews.push_back(std::move(part));
  }
  for (Preview& preview : previews)
    if (!any(preview.lakes)) preview.lakes = {};
  return previews;
}

Json pair(double a, double b) {
  Json out = Json::array();
  out.add(Json::number(a)).add(Json::number(b));
  return out;
}

// Without float noise: 0.7, not 0.699999988.
Json weights_json(const Weights& weights, std::size_t bands) {
  Json out = Json::array();
  for (std::size_t i = 0; i < bands; ++i)
    out.add(Json::raw(fmt::format("{}", i < weights.size() ? weights[i] : 0.F)));
  return out;
}

// Six arrays: global, ridges, valleys of the foreground, then of the background.
Json sets_json(const GeneralizeParameters& p) {
  const std::size_t bands = p.foreground.size();
  Json sets = Json::array();
  for (const Weights* weights : {&p.foreground, &p.foreground_ridges, &p.foreground_valleys,
                                 &p.background, &p.background_ridges, &p.background_valleys}) {
    sets.add(weights_json(*weights, bands));
  }
  return sets;
}

// How break lines are found.
Json break_lines_json(const GeneralizeParameters& p) {
  const bool plan = p.curvature == CurvatureForm::plan;
  return Json::object()
      .add("plan", Json::boolean(plan))
      .add("full", Json::number(p.full_curvature > 0.F ? static_cast<double>(p.full_curvature)
                                : plan                 ? 0.8
                                                       : 0.15))
      .add("blur", Json::number(p.blur_cells))
      .add("exponent", Json::number(p.exponent));
}

// A preset for another number of bands: the finest bands are aligned; what the preset leaves open
// is kept.
GeneralizeParameters fitted(GeneralizeParameters p, std::size_t bands) {
  const auto fit = [bands](Weights& weights, float otherwise) {
    Weights out(bands, weights.empty() ? 0.F : otherwise);
    const std::size_t shared = std::min(bands, weights.size());
    std::copy_n(weights.end() - static_cast<std::ptrdiff_t>(shared), shared,
                out.end() - static_cast<std::ptrdiff_t>(shared));
    weights = std::move(out);
  };
  fit(p.foreground, 1.F);
  fit(p.background, 1.F);
  for (Weights* weights :
       {&p.foreground_ridges, &p.foreground_valleys, &p.background_ridges, &p.background_valleys})
    fit(*weights, 0.F);
  return p;
}

// The coarsest bands of the sliders, which a preview holds.
GeneralizeParameters seen_in(GeneralizeParameters p, const Preview& preview) {
  for (Weights* weights : {&p.foreground, &p.background, &p.foreground_ridges,
                           &p.foreground_valleys, &p.background_ridges, &p.background_valleys}) {
    weights->resize(weights->size() - static_cast<std::size_t>(std::min(
                                          preview.skipped, static_cast<int>(weights->size()))));
  }
  return p;
}

Grid<float> share_of(const Preview& preview, glm::dvec2 distances_m) {
  Grid<float> share(preview.altitude_m.width(), preview.altitude_m.height());
  for (int y = 0; y < share.height(); ++y) {
    for (int x = 0; x < share.width(); ++x) {
      const double d = std::hypot((x - preview.viewer_cell.x) * preview.cell_m.x,
                                  (y - preview.viewer_cell.y) * preview.cell_m.y);
      share(x, y) = static_cast<float>(foreground_share(d, distances_m.x, distances_m.y));
    }
  }
  return share;
}

GeneralizeGrids grids_of(const Preview& preview, glm::dvec2 distances_m,
                         const EqualizerSwitches& on) {
  GeneralizeGrids grids;
  grids.foreground_share = share_of(preview, distances_m);
  if (on.lakes) grids.keep = preview.lakes;
  if (on.foot) grids.amplification_mask = preview.foot_mask;
  if (on.slope) grids.mask = preview.slope_mask;
  if (on.drawn) grids.mask = combine_masks(std::move(grids.mask), preview.drawn_mask);
  return grids;
}

Json switches_json(const EqualizerSwitches& on) {
  return Json::object()
      .add("lakes", Json::boolean(on.lakes))
      .add("foot", Json::boolean(on.foot))
      .add("slope", Json::boolean(on.slope))
      .add("drawn", Json::boolean(on.drawn));
}

// Cells at which the page is compared with the program: a lattice over all of it, and as many cells
// affected by lakes or masks.
std::vector<std::size_t> places_to_check(const Preview& preview) {
  constexpr std::size_t across = 16;
  const Grid<float>& z = preview.altitude_m;
  const auto on_lattice = [](std::size_t i, int count) {
    return static_cast<int>(i * static_cast<std::size_t>(count - 1) / (across - 1));
  };
  std::vector<std::size_t> positions;
  for (std::size_t j = 0; j < across; ++j)
    for (std::size_t i = 0; i < across; ++i)
      positions.push_back(z.index(on_lattice(i, z.width()), on_lattice(j, z.height())));
  Grid<float> lakes(preview.lakes.width(), preview.lakes.height());
  std::transform(preview.lakes.begin(), preview.lakes.end(), lakes.begin(),
                 [](unsigned char v) { return v != 0 ? 1.F : 0.F; });
  lakes = window_maximum(lakes, 32);
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto masked = [i](const Grid<float>& mask) { return !mask.empty() && mask[i] < 0.9F; };
    if ((!lakes.empty() && lakes[i] > 0.F) || masked(preview.foot_mask) ||
        masked(preview.slope_mask) || masked(preview.drawn_mask))
      reached.push_back(i);
  }
  const std::size_t step = std::max<std::size_t>(1, reached.size() / (across * across));
  for (std::size_t i = step / 2; i < reached.size(); i += step) positions.push_back(reached[i]);
  return positions;
}

// Altitudes of the previews computed by the program, at those cells.
Json make_checks(const std::vector<Preview>& previews, const EqualizerInput& in,
                 Progress& progress) {
  const std::size_t bands = in.start.foreground.size();
  struct Setting {
    GeneralizeParameters weights;
    EqualizerSwitches on;
  };
  const bool drawn = !in.drawn_mask.empty();
  const auto preset = [bands](const char* name) {
    return fitted(find_generalize_preset(name)->bands, bands);
  };
  const std::vector<Setting> settings = {
      {fitted(in.start, bands), in.switches},
      {preset("figure2"), {.lakes = true, .foot = true, .slope = true, .drawn = drawn}},
      {preset("figure2"), {.lakes = false, .foot = false, .slope = false, .drawn = false}},
      {preset("panorama"), {.lakes = true, .foot = true, .slope = false, .drawn = false}}};
  Json checks = Json::array();
  for (std::size_t t = 0; t < previews.size(); ++t) {
    const Preview& preview = previews[t];
    if (preview.bands == 0) continue;
    const std::vector<std::size_t> positions = places_to_check(preview);
    for (const Setting& setting : settings) {
      GeneralizeParameters shown = seen_in(setting.weights, preview);
      shown.curvature = in.start.curvature;
      shown.full_curvature = in.start.full_curvature;
      shown.blur_cells = in.start.blur_cells;
      shown.exponent = in.start.exponent;
      const GeneralizeGrids grids = grids_of(preview, in.distances_m, setting.on);
      const Grid<float> out =
          generalize(preview.altitude_m, preview.cell_m, grids, shown, progress);
      Json altitudes = Json::array();
      for (const std::size_t at : positions)
        altitudes.add(pair(static_cast<double>(at), static_cast<double>(out[at])));
      checks.add(Json::object()
                     .add("terrain", Json::number(static_cast<double>(t)))
                     .add("weights", sets_json(setting.weights))
                     .add("on", switches_json(setting.on))
                     .add("altitudes", std::move(altitudes)));
    }
  }
  return checks;
}

Json terrain_json(const Preview& p, glm::dvec2 distances_m) {
  Json terrain = Json::object()
                     .add("name", Json::text(p.name))
                     .add("width", Json::number(p.altitude_m.width()))
                     .add("height", Json::number(p.altitude_m.height()))
                     .add("cell", pair(p.cell_m.x, p.cell_m.y))
                     .add("bands", Json::number(p.bands))
                     .add("skipped", Json::number(p.skipped))
                     .add("viewer", pair(p.viewer_cell.x, p.viewer_cell.y))
                     .add("distances", pair(distances_m.x, distances_m.y))
                     .add("altitude", Json::text(base64_of(p.altitude_m)))
                     .add("foot", Json::text(base64_of(p.foot_mask)))
                     .add("slope", Json::text(base64_of(p.slope_mask)));
  if (!p.drawn_mask.empty()) terrain.add("drawn", Json::text(base64_of(p.drawn_mask)));
  if (!p.lakes.empty()) terrain.add("lakes", Json::text(base64_of(p.lakes)));
  return terrain;
}

// Switches with their text on the command line.
Json switches_of_page(const EqualizerInput& in) {
  Json switches = Json::array();
  const auto add = [&switches](const char* name, std::string_view label, bool on,
                               std::string_view on_option, std::string_view off_option) {
    switches.add(Json::object()
                     .add("name", Json::text(name))
                     .add("label", Json::text(label))
                     .add("on", Json::boolean(on))
                     .add("on_option", Json::text(on_option))
                     .add("off_option", Json::text(off_option)));
  };
  const SlopeRange& range = in.slope_range;
  add("lakes", "Lakes keep their level", in.switches.lakes, "", " --change-lakes");
  add("foot", "No exaggeration on flat ground at the foot of slopes", in.switches.foot,
      " --automatic-mask", "");
  add("slope",
      fmt::format("Ground flatter than {}° is unchanged, ground steeper than {}° is generalized",
                  range.original_to_deg, range.generalized_from_deg),
      in.switches.slope,
      fmt::format(" --mask-slope={},{}", range.original_to_deg, range.generalized_from_deg), "");
  if (!in.drawn_mask.empty()) {
    add("drawn", fmt::format("The mask {} applies", in.drawn_name), in.switches.drawn,
        fmt::format(" --mask={}", in.drawn_name), "");
  }
  return switches;
}

std::string script_data(const EqualizerInput& in, Progress& progress) {
  const std::size_t bands = in.start.foreground.size();
  const std::vector<Preview> previews = make_previews(in);
  Json terrains = Json::array();
  for (const Preview& p : previews) terrains.add(terrain_json(p, in.distances_m));
  Json presets = Json::array();
  GeneralizeParameters unchanged;
  unchanged.foreground = unchanged.background = Weights(bands, 1.F);
  const auto add_preset = [&](std::string_view name, const GeneralizeParameters& weights, bool foot,
                              bool slope) {
    presets.add(Json::object()
                    .add("name", Json::text(name))
                    .add("weights", sets_json(weights))
                    .add("foot", Json::boolean(foot))
                    .add("slope", Json::boolean(slope)));
  };
  add_preset("unchanged", unchanged, false, false);
  for (const GeneralizePreset& preset : generalize_presets())
    add_preset(preset.name, fitted(preset.bands, bands), preset.automatic_mask,
               preset.slope_mask.has_value());
  return script_json(Json::object()
                         .add("input", Json::text(in.title))
                         .add("bands", Json::number(static_cast<double>(bands)))
                         .add("viewer", Json::text(in.viewer_options))
                         .add("others", Json::text(in.other_options))
                         .add("lines", break_lines_json(in.start))
                         .add("weights", sets_json(in.start))
                         .add("presets", std::move(presets))
                         .add("switches", switches_of_page(in))
                         .add("terrains", std::move(terrains))
                         .add("checks", make_checks(previews, in, progress))
                         .str());
}

}  // namespace

void write_equalizer_page(const std::string& path, const EqualizerInput& input,
                          Progress& progress) {
  progress.begin("equalizer page", 0.0);
  const std::string text =
      filled_page(embedded_file("equalizer/index.html"),
                  {{"title", markup_text(input.title)},
                   {"css", std::string(embedded_file("equalizer/equalizer.css"))},
                   {"data", script_data(input, progress)},
                   {"generalize", std::string(embedded_file("equalizer/generalize.js"))},
                   {"lakes", std::string(embedded_file("equalizer/lakes.js"))},
                   {"page", std::string(embedded_file("equalizer/equalizer.js"))}});
  write_text_file(path, text);
}

}  // namespace belvedere::tools
