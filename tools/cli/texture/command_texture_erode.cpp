#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/masks/erosion.h"
#include "base/text/json.h"
#include "renderer/image/image_io.h"
#include "renderer/image/png_palette.h"
#include "texture/statistical/cracks.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

struct TextureErodeOptions : RunOptions {
  std::string mask, out, report;
  std::string over;      // a picture that cracks are laid over: the mask is a crop of them
  double darkest = 0.1;  // share of that crop
  ErosionParameters erosion{.levels = 8};
  int label = -1;
  std::vector<int> keep;
};

Grid<std::uint8_t> read_labels(const TextureErodeOptions& options) {
  const Grid<std::uint16_t> grey = read_grey(options.mask);
  Grid<std::uint8_t> labels(grey.width(), grey.height());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    if (options.label >= 0 && grey[i] > 255)
      throw Error(ErrorKind::input, options.mask, fmt::format("a pixel of {}", grey[i]),
                  "numbers up to 255 with --label");
    labels[i] = static_cast<std::uint8_t>(options.label >= 0 ? grey[i] : grey[i] != 0 ? 255 : 0);
  }
  return labels;
}

// A mask by the step that eroded each pixel: white remains, grey was eroded, the darker the
// earlier.
Grid<glm::vec3> steps_picture(const Grid<std::uint8_t>& labels, std::uint8_t label,
                              const Erosion& eroded, int steps) {
  Grid<glm::vec3> out(labels.width(), labels.height(), glm::vec3(.1F, .12F, .15F));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (labels[i] != label) continue;
    const int level = eroded.level[i];
    out[i] = glm::vec3(
        level == 0 ? 1.F : .25F + .55F * static_cast<float>(level) / static_cast<float>(steps));
  }
  return out;
}

void write_report(const TextureErodeOptions& options, const Grid<std::uint8_t>& labels,
                  std::uint8_t label, const Erosion& eroded, const ReportTable& table) {
  const int steps = options.erosion.levels;
  const Grid<std::uint8_t> none(labels.width(), labels.height());
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "The mask on the left, the steps on the right, the darker the earlier; white "
                 "remains. Borders should be as ragged as those of melting snow.");
  report.picture("mask", steps_picture(labels, label, {{}, none}, steps), "before");
  report.picture("steps", steps_picture(labels, label, eroded, steps), "step by step");
  report.section("figures", "Figures");
  report.table(table);
  report.write({.title = "Eroded mask: " + file_name(options.mask),
                .lead = fmt::format("{} steps of {} pixels.", steps, options.erosion.step),
                .command = fmt::format(
                    "belvedere texture erode {} --steps {} --step-px {} --seed {} --out {}",
                    file_name(options.mask), steps, options.erosion.step, options.erosion.seed,
                    file_name(options.out))});
}

constexpr int crack_types = 24;  // grey has few

// A picture that weathers: cracks learnt from a crop, laid over it.
int run_over(const TextureErodeOptions& options) {
  TerminalProgress progress(options.quiet);
  const TextureCrop crop = read_crop(options.mask, "");
  const Grid<Rgb8> intact = read_crop(options.over, "").picture;
  const CrackModel cracks =
      learn_cracks(crop.picture, crop.states, options.darkest, {.types = crack_types}, progress);
  const int steps = options.erosion.levels;
  const std::vector<Grid<Rgb8>> series =
      lay_cracks(intact, cracks, steps, options.erosion.seed, progress);
  ReportTable table({{"file", "file"}, {"changed", "pixels changed"}});
  Json told = Json::array();
  std::string lines;
  for (int step = 1; step <= steps; ++step) {
    const Grid<Rgb8>& laid = series[static_cast<std::size_t>(step - 1)];
    std::size_t changed = 0;
    for (std::size_t i = 0; i < laid.size(); ++i) changed += laid[i] != intact[i] ? 1 : 0;
    const std::string name =
        fmt::format("{}_{:02}.png", std::filesystem::path(options.over).stem().string(), step);
    write_texture((std::filesystem::path(options.out) / name).string(), laid,
                  fmt::format("{} with cracks of {} seed {}", file_name(options.over),
                              file_name(options.mask), options.erosion.seed));
    lines += fmt::format("  {}  {} of {} pixels changed\n", name, changed, laid.size());
    table.row(name, changed);
    told.add(Json::object()
                 .add("file", Json::text(name))
                 .add("changed", Json::number(static_cast<double>(changed))));
  }
  if (!options.report.empty()) {
    Report report(options.report);
    report.section("pictures", "Pictures",
                   "The crop whose cracks are learnt, the intact picture, and the two together.");
    report.picture("crop", to_picture(crop.picture), "crop");
    report.picture("intact", to_picture(intact), "intact");
    report.picture("weathered", to_picture(series.back()), "last step");
    report.section("figures", "Figures");
    report.table(table);
    report.write(
        {.title = "Weathered picture: " + file_name(options.over),
         .lead = fmt::format("{} steps.", steps),
         .command = fmt::format("belvedere texture erode {} --over {} --darkest {} "
                                "--steps {} --seed {} --out {}",
                                file_name(options.mask), file_name(options.over), options.darkest,
                                steps, options.erosion.seed, file_name(options.out))});
  }
  progress.end();
  print_result(options,
               Json::object()
                   .add("out", Json::text(options.out))
                   .add("share", Json::number(cracks.share))
                   .add("steps", std::move(told)),
               options.out + "\n" + lines);
  return 0;
}

int run(const TextureErodeOptions& options) {
  if (!options.over.empty()) return run_over(options);
  TerminalProgress progress(options.quiet);
  const Grid<std::uint8_t> labels = read_labels(options);
  const auto label = static_cast<std::uint8_t>(options.label >= 0 ? options.label : 255);
  std::array<bool, 256> opens{};
  opens.fill(true);
  for (const int kept : options.keep) opens[static_cast<std::size_t>(kept)] = false;
  const Erosion eroded = erode(labels, label, opens, options.erosion, progress);

  const auto standing = std::count(labels.begin(), labels.end(), label);
  if (standing == 0)
    progress.note(options.label >= 0
                      ? fmt::format("warning: no pixel has the number {}", options.label)
                      : std::string("warning: the mask marks nothing"));
  ReportTable table({{"file", "file"}, {"left", "pixels left"}, {"share", "of all", ".1%"}});
  Json told = Json::array();
  std::string lines;
  Grid<std::uint8_t> now = labels;
  for (int level = 1; level <= options.erosion.levels; ++level) {
    std::int64_t left = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (eroded.level[i] == level) now[i] = eroded.labels[i];
      left += now[i] == label ? 1 : 0;
    }
    const std::string name =
        fmt::format("{}_{:02}.png", std::filesystem::path(options.mask).stem().string(), level);
    image_io::write_grey_png((std::filesystem::path(options.out) / name).string(), now);
    lines += fmt::format("  {}  {} of {} pixels left\n", name, left, standing);
    table.row(name, left,
              static_cast<double>(left) / std::max<double>(1.0, static_cast<double>(standing)));
    told.add(Json::object()
                 .add("file", Json::text(name))
                 .add("left", Json::number(static_cast<double>(left))));
  }
  if (!options.report.empty()) write_report(options, labels, label, eroded, table);
  progress.end();
  print_result(options,
               Json::object()
                   .add("out", Json::text(options.out))
                   .add("standing", Json::number(static_cast<double>(standing)))
                   .add("steps", std::move(told)),
               options.out + "\n" + lines);
  return 0;
}

}  // namespace

Action add_texture_erode(CommandOptions& command) {
  const auto options = std::make_shared<TextureErodeOptions>();
  command
      .add_option("MASK PICTURE", options->mask, "A grey picture: pixels other than 0 are eroded")
      .required()
      .files(FileUse::input);
  command
      .add_option("--out FOLDER", options->out, "Folder of the series: MASK_01.png, MASK_02.png …")
      .required()
      .files(FileUse::folder);
  command.add_option("--steps N", options->erosion.levels, "Number of masks. Default: 8")
      .range(1, 99);
  command
      .add_option("--step-px PX", options->erosion.step,
                  "How far a straight border retreats per step, in pixels. Default: 8")
      .range(0.5, 1000.0);
  command
      .add_option("--label NUMBER", options->label,
                  "For a map of classes: the number of the class that retreats; each pixel it "
                  "leaves takes the number that reached it first")
      .range(0, 255);
  command
      .add_option("--over PICTURE", options->over,
                  "Instead: MASK is a crop of a weathered texture; its cracks are learnt and laid "
                  "over this picture, step by step more\n"
                  "of them: PICTURE_01.png, PICTURE_02.png …")
      .files(FileUse::input);
  command
      .add_option(
          "--darkest SHARE", options->darkest,
          "With --over: share of the crop that are cracks, its darkest pixels. Default: 0.1")
      .range(0.01, 0.5);
  command.add_option("--keep NUMBER", options->keep, "Numbers that do not advance, such as water")
      .range(0, 255);
  command.add_option("--seed N", options->erosion.seed, "Random seed of the borders. Default: 1");
  command
      .add_option("--report FOLDER", options->report,
                  "Writes a page with the mask beside the steps")
      .files(FileUse::folder);
  command.add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command.add_flag("--json", options->json, "Print the result as JSON");
  command.footer(
      "For melting snow or retreating forest: every mask lies within the one before. In scenes: "
      "land_cover.erode.\n"
      "\n"
      "  belvedere texture erode snow.png --steps 5 --step-px 12 --out spring\n"
      "  belvedere texture erode classes.png --label 4 --keep 1 --out clearing\n"
      "  belvedere texture erode old_wall.jpg --over new_wall.png --steps 3 --out ages");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
