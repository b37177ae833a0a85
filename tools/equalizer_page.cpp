#include "tools/equalizer_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/base/embedded.h"
#include "renderer/base/json.h"
#include "renderer/base/pyramid.h"
#include "renderer/output_file.h"
#include "terrain/generalize_presets.h"
#include "terrain/generalize_report.h"
#include "tools/report_folder.h"
#include "tools/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int largest_side = 512;
constexpr int closeup_side = 320;

using Weights = std::vector<float>;

// The DEM as the page sees it: a level of its pyramid, or a part of it.
struct Preview {
  std::string name;
  Grid<float> altitude_m;
  glm::dvec2 cell_m;
  int skipped = 0;  // finest bands that this level no longer holds
  int bands = 0;
  glm::dvec2 viewer_cell;
};

std::string base64(const Grid<float>& values) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(values.size() * 4);
  for (const float v : values) {
    const auto bits = std::bit_cast<std::uint32_t>(v);  // little end first
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>((bits >> (8 * i)) & 0xffU);
  }
  std::string out;
  out.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = (group << 8) | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[(group >> (18 - 6 * k)) & 63U];
  }
  return out;
}

std::vector<Preview> make_previews(const EqualizerInput& in) {
  const int bands = static_cast<int>(in.start.foreground.size());
  const auto possible = [&](const Preview& p) {
    return std::min(bands - p.skipped, most_bands(p.altitude_m.width(), p.altitude_m.height()));
  };
  std::vector<Preview> previews;
  Preview whole{"whole terrain", in.altitude_m, in.cell_m, 0, 0, in.viewer_cell};
  while (std::max(whole.altitude_m.width(), whole.altitude_m.height()) > largest_side) {
    whole.altitude_m = reduce(whole.altitude_m);
    whole.cell_m = 2.0 * whole.cell_m;
    whole.viewer_cell = 0.5 * whole.viewer_cell;  // cell i lies over cell 2 i
    ++whole.skipped;
  }
  // A DEM so large that no band is left in the whole still has its close-up.
  whole.bands = std::max(0, possible(whole));
  const bool reduced = whole.skipped > 0;
  previews.push_back(std::move(whole));
  if (reduced) {
    const Grid<std::uint8_t> lines = ridge_lines(in.altitude_m, in.cell_m);
    Grid<float> score(lines.width(), lines.height());
    std::transform(lines.begin(), lines.end(), score.begin(), [](std::uint8_t v) { return static_cast<float>(v); });
    const PixelRect window = best_window(score, {}, closeup_side);
    Preview part{"close-up", cut(in.altitude_m, window), in.cell_m, 0, 0, in.viewer_cell - glm::dvec2(window.x0, window.y0)};
    part.bands = possible(part);
    previews.push_back(std::move(part));
  }
  return previews;
}

Json pair(double a, double b) {
  Json out = Json::array();
  out.add(Json::number(a)).add(Json::number(b));
  return out;
}

// Without the float's noise: 0.7, not 0.699999988.
Json weights_json(const Weights& weights, std::size_t bands) {
  Json out = Json::array();
  for (std::size_t i = 0; i < bands; ++i) out.add(Json::raw(fmt::format("{}", i < weights.size() ? weights[i] : 0.F)));
  return out;
}

// Six arrays: global, ridges, valleys of the foreground, then of the background.
Json sets_json(const GeneralizeParameters& p) {
  const std::size_t bands = p.foreground.size();
  Json sets = Json::array();
  for (const Weights* weights :
       {&p.foreground, &p.foreground_ridges, &p.foreground_valleys, &p.background, &p.background_ridges, &p.background_valleys}) {
    sets.add(weights_json(*weights, bands));
  }
  return sets;
}

// A preset for another number of bands: the finest bands stand opposite each other; what the preset does not say is kept.
GeneralizeParameters fitted(GeneralizeParameters p, std::size_t bands) {
  const auto fit = [bands](Weights& weights, float otherwise) {
    Weights out(bands, weights.empty() ? 0.F : otherwise);
    const std::size_t shared = std::min(bands, weights.size());
    std::copy_n(weights.end() - static_cast<std::ptrdiff_t>(shared), shared, out.end() - static_cast<std::ptrdiff_t>(shared));
    weights = std::move(out);
  };
  fit(p.foreground, 1.F);
  fit(p.background, 1.F);
  for (Weights* weights : {&p.foreground_ridges, &p.foreground_valleys, &p.background_ridges, &p.background_valleys}) fit(*weights, 0.F);
  return p;
}

// The coarsest bands of the sliders, which a preview holds.
GeneralizeParameters seen_in(GeneralizeParameters p, const Preview& preview) {
  for (Weights* weights :
       {&p.foreground, &p.background, &p.foreground_ridges, &p.foreground_valleys, &p.background_ridges, &p.background_valleys}) {
    weights->resize(weights->size() - static_cast<std::size_t>(std::min(preview.skipped, static_cast<int>(weights->size()))));
  }
  return p;
}

Grid<float> share_of(const Preview& preview, glm::dvec2 distances_m) {
  Grid<float> share(preview.altitude_m.width(), preview.altitude_m.height());
  for (int y = 0; y < share.height(); ++y) {
    for (int x = 0; x < share.width(); ++x) {
      const double d = std::hypot((x - preview.viewer_cell.x) * preview.cell_m.x, (y - preview.viewer_cell.y) * preview.cell_m.y);
      const double t = std::clamp((d - distances_m.x) / (distances_m.y - distances_m.x), 0.0, 1.0);
      share(x, y) = static_cast<float>(1.0 - t * t * (3.0 - 2.0 * t));
    }
  }
  return share;
}

// Altitudes that the program makes of the previews, at a few places on a lattice.
Json make_checks(const std::vector<Preview>& previews, const EqualizerInput& in, Progress& progress) {
  const std::size_t bands = in.start.foreground.size();
  std::vector<GeneralizeParameters> settings;
  settings.push_back(in.start);
  for (const char* name : {"figure2", "panorama"}) settings.push_back(fitted(find_generalize_preset(name)->bands, bands));
  Json checks = Json::array();
  for (std::size_t t = 0; t < previews.size(); ++t) {
    const Preview& preview = previews[t];
    if (preview.bands == 0) continue;
    GeneralizeGrids grids;
    grids.foreground_share = share_of(preview, in.distances_m);
    for (const GeneralizeParameters& setting : settings) {
      const GeneralizeParameters whole = fitted(setting, bands);
      GeneralizeParameters plain = seen_in(whole, preview);
      plain.curvature = CurvatureForm::bounded;
      plain.full_curvature = 0.F;
      plain.blur_cells = plain.exponent = 1.F;
      const Grid<float> out = generalize(preview.altitude_m, preview.cell_m, grids, plain, progress);
      Json altitudes = Json::array();
      constexpr int across = 16;
      for (int j = 0; j < across; ++j) {
        for (int i = 0; i < across; ++i) {
          const std::size_t at = out.index(i * (out.width() - 1) / (across - 1), j * (out.height() - 1) / (across - 1));
          altitudes.add(pair(static_cast<double>(at), static_cast<double>(out[at])));
        }
      }
      checks.add(Json::object()
                     .add("terrain", Json::number(static_cast<double>(t)))
                     .add("weights", sets_json(whole))
                     .add("altitudes", std::move(altitudes)));
    }
  }
  return checks;
}

std::string script_data(const EqualizerInput& in, Progress& progress) {
  const std::size_t bands = in.start.foreground.size();
  const std::vector<Preview> previews = make_previews(in);
  Json terrains = Json::array();
  for (const Preview& p : previews) {
    terrains.add(Json::object()
                     .add("name", Json::text(p.name))
                     .add("width", Json::number(p.altitude_m.width()))
                     .add("height", Json::number(p.altitude_m.height()))
                     .add("cell", pair(p.cell_m.x, p.cell_m.y))
                     .add("bands", Json::number(p.bands))
                     .add("skipped", Json::number(p.skipped))
                     .add("viewer", pair(p.viewer_cell.x, p.viewer_cell.y))
                     .add("distances", pair(in.distances_m.x, in.distances_m.y))
                     .add("altitude", Json::text(base64(p.altitude_m))));
  }
  Json presets = Json::array();
  GeneralizeParameters unchanged;
  unchanged.foreground = unchanged.background = Weights(bands, 1.F);
  presets.add(Json::object().add("name", Json::text("unchanged")).add("weights", sets_json(unchanged)));
  for (const GeneralizePreset& preset : generalize_presets())
    presets.add(Json::object().add("name", Json::text(preset.name)).add("weights", sets_json(fitted(preset.bands, bands))));
  std::string text = Json::object()
                         .add("input", Json::text(in.title))
                         .add("bands", Json::number(static_cast<double>(bands)))
                         .add("viewer", Json::text(in.viewer_options))
                         .add("weights", sets_json(in.start))
                         .add("presets", std::move(presets))
                         .add("terrains", std::move(terrains))
                         .add("checks", make_checks(previews, in, progress))
                         .str();
  // A file name must not end the script.
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 2)) text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace

void write_equalizer_page(const std::string& path, const EqualizerInput& input, Progress& progress) {
  progress.begin("equalizer page", 0.0);
  const std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Equalizer: "
      "{0}</title>\n<style>\n{1}</style></head>\n<body>\n"
      "<h1>Equalizer for {0}</h1>\n<p>Each slider is a band of landforms, the largest on the left: 1 keeps it, 0 takes it off, more "
      "exaggerates it. "
      "Ridges and valleys add to the weight along break lines. The preview follows the sliders.</p>\n<p id=\"verdict\"></p>\n"
      "<main><div><canvas id=\"preview\"></canvas><p id=\"unseen\"></p><div id=\"views\"></div></div>\n<div><div id=\"presets\"></div>\n"
      "<div id=\"foreground\" class=\"sets\"></div><div id=\"background\" class=\"sets\"></div>\n<p>The same for the whole DEM, lakes "
      "kept:</p>\n"
      "<pre id=\"command\"></pre><button id=\"copy\">Copy</button></div></main>\n<script>\nconst equalizer = "
      "{2};\n</script>\n<script>\n{3}</script>\n"
      "</body></html>\n",
      html_escaped(input.title), embedded_file("equalizer/equalizer.css"), script_data(input, progress),
      embedded_file("equalizer/equalizer.js"));
  OutputFile file(path);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) file.fail("writing failed");
  file.commit();
}

}  // namespace belvedere::tools
