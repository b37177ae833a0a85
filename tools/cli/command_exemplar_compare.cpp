#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/exemplar/painting_figures.h"
#include "renderer/image/image_io.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/options/run_options.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

struct ExemplarCompareOptions : RunOptions {
  std::vector<std::string> pictures;
  std::vector<double> scales;
  std::vector<double> widths_mm;
  std::vector<std::vector<double>> parts;
  std::size_t own = 1;
};

struct Compared {
  std::string name;
  double scale = 1.0;
  int width = 0;
  int height = 0;
  PaintingFigures figures;
};

// One line of the table.
struct Line {
  const char* name;
  double unit;  // what the value is multiplied by before it is printed
  int decimals;
  std::function<double(const PaintingFigures&)> value;
};

const std::vector<Line>& lines() {
  static const std::vector<Line> all = [] {
    std::vector<Line> out = {
        {"sharpness", 1.0, 2, [](const PaintingFigures& f) { return f.sharpness; }},
        {"coarse sharpness", 1.0, 2, [](const PaintingFigures& f) { return f.coarse_sharpness; }},
        {"stroke length, px", 1.0, 1, [](const PaintingFigures& f) { return f.stroke_length_px; }},
        {"stroke width, px", 1.0, 1, [](const PaintingFigures& f) { return f.stroke_width_px; }},
        {"direction run, px", 1.0, 1, [](const PaintingFigures& f) { return f.direction_run_px; }},
        {"coherence", 1.0, 2, [](const PaintingFigures& f) { return f.coherence; }},
        {"unevenness, octaves", 1.0, 2, [](const PaintingFigures& f) { return f.unevenness; }},
        {"flat share, %", 100.0, 1, [](const PaintingFigures& f) { return f.flat_share; }},
        {"lightness, mean", 1.0, 2, [](const PaintingFigures& f) { return f.lightness_mean; }},
        {"lightness, spread", 1.0, 2, [](const PaintingFigures& f) { return f.lightness_spread; }},
        {"saturation, mean", 1.0, 2, [](const PaintingFigures& f) { return f.saturation_mean; }},
        {"saturation, spread", 1.0, 2, [](const PaintingFigures& f) { return f.saturation_spread; }},
    };
    static constexpr std::array<const char*, PaintingFigures::hue_sectors> hues = {
        "hue 0–30° red, %",      "hue 30–60° orange, %",   "hue 60–90° yellow, %", "hue 90–120° leaf, %",
        "hue 120–150° green, %", "hue 150–180° sea, %",    "hue 180–210° cyan, %", "hue 210–240° sky, %",
        "hue 240–270° blue, %",  "hue 270–300° violet, %", "hue 300–330° pink, %", "hue 330–360° rose, %"};
    for (std::size_t k = 0; k < hues.size(); ++k)
      out.push_back({hues[k], 100.0, 0, [k](const PaintingFigures& f) { return f.hue_shares[k]; }});
    return out;
  }();
  return all;
}

void check(const ExemplarCompareOptions& options) {
  const auto as_many = [&](std::size_t n, const char* option) {
    if (n != 0 && n != options.pictures.size())
      throw Error(ErrorKind::usage, "command line", fmt::format("{} is given {} times for {} pictures", option, n, options.pictures.size()),
                  "once for each picture, in their order");
  };
  as_many(options.scales.size(), "--scale");
  as_many(options.widths_mm.size(), "--mm");
  as_many(options.parts.size(), "--part");
  if (!options.scales.empty() && !options.widths_mm.empty())
    throw Error(ErrorKind::usage, "command line", "there are both --scale and --mm", "one of them");
  for (const std::vector<double>& part : options.parts)
    if (part[0] < 0.0 || part[1] < 0.0 || part[2] > 1.0 || part[3] > 1.0 || !(part[0] < part[2]) || !(part[1] < part[3]))
      throw Error(ErrorKind::usage, "--part", fmt::format("{} {} {} {} is no part of a picture", part[0], part[1], part[2], part[3]),
                  "left, top, right and bottom as shares of the picture, 0…1: 0 0.2 1 1 leaves the upper fifth out");
}

std::vector<double> scales_of(const ExemplarCompareOptions& options) {
  if (!options.scales.empty()) return options.scales;
  std::vector<double> scales(options.pictures.size(), 1.0);
  if (options.widths_mm.empty()) return scales;
  // Pixels a millimetre; all come to the coarsest's, because enlarging would add pixels and no paint.
  for (std::size_t k = 0; k < scales.size(); ++k) scales[k] = read_image_info(options.pictures[k]).width / options.widths_mm[k];
  const double coarsest = *std::min_element(scales.begin(), scales.end());
  for (double& scale : scales) scale = coarsest / scale;
  return scales;
}

Compared measure(const std::string& path, double scale, const std::vector<double>* part) {
  if (read_image_info(path).format == "openexr")
    throw Error(ErrorKind::usage, path, "holds light and not colours as they are seen", "a PNG, TIFF or JPEG, such as panorama.png");
  Grid<glm::vec3> picture = read_picture(path);
  if (part != nullptr) {
    const auto at = [](double share, int size) { return static_cast<int>(std::lround(share * size)); };
    picture = cut(picture, {at((*part)[0], picture.width()), at((*part)[1], picture.height()), at((*part)[2], picture.width()),
                            at((*part)[3], picture.height())});
  }
  picture = shrink_picture(picture, scale);
  try {
    return {file_name(path), scale, picture.width(), picture.height(), measure_painting(picture)};
  } catch (const Error& error) {
    throw Error(error.kind(), path, error.found() + (scale < 1.0 || part != nullptr ? " after scaling and cutting" : ""), error.allowed());
  }
}

// Which of the first `own` pictures lie below or above all the others: "1 2 below". Differences that rounding hides do not count.
std::string verdict(const Line& line, const std::vector<Compared>& all, std::size_t own) {
  if (own >= all.size()) return {};
  const auto value = [&](std::size_t k) { return line.value(all[k].figures); };
  double low = value(own);
  double high = low;
  for (std::size_t k = own; k < all.size(); ++k) {
    low = std::min(low, value(k));
    high = std::max(high, value(k));
  }
  const double rounding = 0.5 * std::pow(10.0, -line.decimals) / line.unit;
  std::string below;
  std::string above;
  for (std::size_t k = 0; k < own; ++k) {
    if (value(k) < low - rounding) below += fmt::format(" {}", k + 1);
    if (value(k) > high + rounding) above += fmt::format(" {}", k + 1);
  }
  return (below.empty() ? "" : below + " below") + (above.empty() ? "" : above + " above");
}

std::string as_text(const std::vector<Compared>& all, std::size_t own) {
  std::string out;
  for (std::size_t k = 0; k < all.size(); ++k)
    out += fmt::format("{:>2}  {} ({} × {}{})\n", k + 1, all[k].name, all[k].width, all[k].height,
                       all[k].scale < 1.0 ? fmt::format(", scaled by {:.3g}", all[k].scale) : "");
  out += fmt::format("\n{:<22}", "");
  for (std::size_t k = 0; k < all.size(); ++k) out += fmt::format("{:>8}", k + 1);
  out += own < all.size() && all.size() > 2 ? "   outside of the others\n" : "\n";
  for (const Line& line : lines()) {
    out += fmt::format("{:<22}", line.name);
    for (const Compared& one : all) out += fmt::format("{:>8.{}f}", line.unit * line.value(one.figures), line.decimals);
    const std::string outside = all.size() > 2 ? verdict(line, all, own) : std::string();
    out += outside.empty() ? "\n" : "  " + outside + "\n";
  }
  return out;
}

std::string as_json(const std::vector<Compared>& all) {
  Json pictures = Json::array();
  for (const Compared& one : all) {
    const PaintingFigures& f = one.figures;
    Json hues = Json::array();
    for (const double share : f.hue_shares) hues.add(Json::number(share));
    pictures.add(Json::object()
                     .add("picture", Json::text(one.name))
                     .add("scale", Json::number(one.scale))
                     .add("width", Json::number(one.width))
                     .add("height", Json::number(one.height))
                     .add("sharpness", Json::number(f.sharpness))
                     .add("coarse_sharpness", Json::number(f.coarse_sharpness))
                     .add("stroke_length_px", Json::number(f.stroke_length_px))
                     .add("stroke_width_px", Json::number(f.stroke_width_px))
                     .add("direction_run_px", Json::number(f.direction_run_px))
                     .add("coherence", Json::number(f.coherence))
                     .add("unevenness", Json::number(f.unevenness))
                     .add("flat_share", Json::number(f.flat_share))
                     .add("lightness_mean", Json::number(f.lightness_mean))
                     .add("lightness_spread", Json::number(f.lightness_spread))
                     .add("saturation_mean", Json::number(f.saturation_mean))
                     .add("saturation_spread", Json::number(f.saturation_spread))
                     .add("hue_shares", std::move(hues)));
  }
  return Json::object().add("pictures", std::move(pictures)).str() + "\n";
}

int run(const ExemplarCompareOptions& options) {
  check(options);
  const ThreadLimit threads(options.threads);
  const std::vector<double> scales = scales_of(options);
  TerminalProgress progress(options.quiet);
  progress.begin("measuring", static_cast<double>(options.pictures.size()));
  std::vector<Compared> all;
  for (std::size_t k = 0; k < options.pictures.size(); ++k) {
    all.push_back(measure(options.pictures[k], scales[k], options.parts.empty() ? nullptr : &options.parts[k]));
    progress.advance(1.0);
  }
  progress.end();
  print_out(options.json ? as_json(all) : as_text(all, options.own));
  return 0;
}

}  // namespace

Action add_exemplar_compare(CommandOptions& command) {
  const auto options = std::make_shared<ExemplarCompareOptions>();
  command
      .add_option("PICTURE", options->pictures, "Pictures, PNG, TIFF or JPEG: the one in question first, then paintings to compare it with")
      .required();
  command.add_option("--scale", options->scales, "Makes pictures smaller before they are measured, 0…1: once for each, in their order")
      .type_name("X")
      .repeated()
      .range(0.001, 1.0);
  command
      .add_option("--mm", options->widths_mm,
                  "Widths of the originals: all pictures are brought to the pixels a millimetre of the coarsest")
      .type_name("MM")
      .repeated()
      .range(1.0, 1e6);
  command.add_option("--part", options->parts, "Left, top, right, bottom, 0…1, of what is measured: once for each picture, in their order")
      .type_name("L T R B")
      .words(4)
      .repeated();
  command.add_option("--own", options->own, "How many of the pictures, from the first on, are in question; 1 by default")
      .type_name("N")
      .range(1, 1000);
  add_run_options(command, *options, "figure");
  command.footer(
      "Sharpness: 0 soft, 1 hard edges, 1.6 to 2 detail of every size as in paintings, to 4 grain; whatever the\n"
      "contrast. Stroke length and width, and how far a direction holds: in pixels, so bring pictures to strokes\n"
      "of one size. Coherence: 0 every way, 1 combed. Unevenness: how contrast differs from place to place.\n"
      "The last column says which of those in question lie outside of all the others.\n\n"
      "  belvedere exemplar compare out/panorama.png bruegel.png segantini.jpg\n"
      "  belvedere exemplar compare sheet/painting.png rubens.jpg --mm 1024 --mm 2290");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
