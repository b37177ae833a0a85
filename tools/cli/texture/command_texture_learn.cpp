#include <fmt/core.h>

#include <memory>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "texture/statistical/choose_seed.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"
#include "texture/statistical/photometric.h"
#include "texture/statistical/texture_figures.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int report_px = 512;
constexpr int sampled_report_px = 128;  // what a sampler makes in the time

struct TextureLearnOptions : RunOptions {
  std::string crop, mask, light, out, report, method;
  BeginOptions begin;
  LearnParameters learn;
};

// Results of a run, for all forms of output.
struct TextureFindings {
  LearnedTexture learned;
  std::vector<SeedTrial> trials;
  Grid<Rgb8> made;
  TextureFigures figures;
  TextureFigures halves;
  int copy_px = 0;
};

bool is_uneven(const TextureFindings& found) { return found.halves.held_out > uneven_halves; }

std::string warning_of(const TextureFindings& found) {
  return fmt::format(
      "warning: the crop's halves differ by {:.2f}: it is not one texture, or too small (above "
      "{:.2f})",
      found.halves.held_out, uneven_halves);
}

std::string as_text(const TextureLearnOptions& options, const TextureFindings& found) {
  const CliqueModel& model = found.learned.model;
  std::string out =
      fmt::format("{}: {} types, {} bytes, begins with {}\n", options.out, model.cliques.size(),
                  model_bytes(model), describe_begin(model.seed, model.seed_px, model.polish));
  out += fmt::format(
      "  distance to the crop  {:.3f} of its own types, {:.3f} of all others; the crop's own "
      "halves {:.3f} and {:.3f}\n",
      found.figures.selected, found.figures.held_out, found.halves.selected, found.halves.held_out);
  out += fmt::format("  beyond pairs          {:.3f}; halves {:.3f}\n", found.figures.beyond,
                     found.halves.beyond);
  out += fmt::format("  directionality        {:.3f}; halves {:.3f}\n", found.figures.drawn,
                     found.halves.drawn);
  out += fmt::format("  direction             {:.3f}; halves {:.3f}\n", found.figures.turned,
                     found.halves.turned);
  out += fmt::format("  longest exact copy    {} px\n", found.copy_px);
  return out;
}

Json as_json(const TextureLearnOptions& options, const TextureFindings& found) {
  const CliqueModel& model = found.learned.model;
  Json trials = Json::array();
  for (const SeedTrial& t : found.trials)
    trials.add(Json::object()
                   .add("seed", Json::text(name_of(t.seed)))
                   .add("px", Json::number(t.px))
                   .add("polish", Json::boolean(t.polish))
                   .add("beyond", Json::number(t.beyond))
                   .add("drawn", Json::number(t.drawn))
                   .add("turned", Json::number(t.turned)));
  return Json::object()
      .add("out", Json::text(options.out))
      .add("types", Json::number(static_cast<double>(model.cliques.size())))
      .add("bytes", Json::number(static_cast<double>(model_bytes(model))))
      .add("seed", Json::text(name_of(model.seed)))
      .add("seed_px", Json::number(model.seed_px))
      .add("polish", Json::boolean(model.polish))
      .add("figures", with_figures(Json::object(), found.figures))
      .add("halves", with_figures(Json::object(), found.halves))
      .add("longest_copy_px", Json::number(found.copy_px))
      .add("trials", std::move(trials));
}

void write_report(const TextureLearnOptions& options, const TextureCrop& crop,
                  const TextureFindings& found) {
  Report report(options.report);
  report.section(
      "pictures", "Crop and texture",
      "The crop on the left, a texture made from the model alone on the right. Look at single "
      "dabs, then from afar: such a model gives an even texture without accents.");
  report.picture("crop", to_picture(crop.picture), "the crop");
  report.picture("texture", to_picture(found.made),
                 fmt::format("made, {} × {} pixels", found.made.width(), found.made.height()));
  report.section("distances", "Distances");
  ReportTable distances({{"of", ""},
                         {"selected", "own types", ".3f"},
                         {"held_out", "all others", ".3f"},
                         {"worst", "worst", ".2f"},
                         {"beyond", "beyond pairs", ".3f"},
                         {"drawn", "directionality", ".3f"},
                         {"turned", "direction", ".3f"}});
  const auto row = [&](const char* name, const TextureFigures& f) {
    distances.row(name, f.selected, f.held_out, f.worst, f.beyond, f.drawn, f.turned);
  };
  row("texture to crop", found.figures);
  row("halves of the crop", found.halves);
  report.table(distances);
  report.section("levels", "Levels");
  ReportTable levels({{"pixels", "pixels per side"},
                      {"types", "types"},
                      {"held_out", "others, mean", ".3f"},
                      {"worst", "others, worst", ".3f"}});
  for (const LearnedLevel& level : found.learned.levels)
    levels.row(1 << level.level, level.types, level.held_out_l1, level.worst_l2);
  report.table(levels);
  if (!found.trials.empty()) {
    report.section("begins", "Initial noise");
    ReportTable trials({{"noise", "noise"},
                        {"beyond", "beyond pairs", ".3f"},
                        {"drawn", "directionality", ".3f"},
                        {"turned", "direction", ".3f"}});
    for (const SeedTrial& t : found.trials)
      trials.row(describe_begin(t.seed, t.px, t.polish), t.beyond, t.drawn, t.turned);
    report.table(trials);
  }
  if (is_uneven(found)) report.text(warning_of(found));
  report.write({.title = "Texture model: " + file_name(options.crop),
                .lead = fmt::format("A model of {} bytes.", model_bytes(found.learned.model)),
                .command = fmt::format("belvedere texture learn {} --out {}",
                                       file_name(options.crop), file_name(options.out))});
}

int run(const TextureLearnOptions& options) {
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  TextureCrop crop = read_crop(options.crop, options.mask);
  if (!options.light.empty())
    crop.states = light_half(crop.picture, crop.states,
                             options.light == "lit" ? LightHalf::lit : LightHalf::shaded);
  if (crop.transparent > 0)
    progress.note(fmt::format("{} transparent pixels are left out", crop.transparent));
  TextureFindings found;
  const bool sampled = options.method == "paper";
  if (sampled && !options.begin.kind.empty())
    throw Error(ErrorKind::usage, "--begin", options.begin.kind,
                "none with --method paper, which begins with white noise");
  found.learned = sampled ? learn_by_sampling(crop.picture, crop.states, options.learn, progress)
                          : learn_texture(crop.picture, crop.states, options.learn, progress);
  CliqueModel& model = found.learned.model;
  if (!sampled)
    found.trials = choose_seed(model, crop.picture, crop.states, options.learn, progress);
  if (!options.begin.kind.empty()) {
    const TextureBegin begin = begin_of(options.begin);
    model.seed = begin.seed;
    model.seed_px = begin.px;
    model.polish = model.seed == TextureSeed::white;
  }
  const int made_px = sampled ? sampled_report_px : report_px;
  found.made = make_texture(model, made_px, made_px, {}, progress);
  found.figures = texture_figures(crop.picture, crop.states, found.made, model, options.learn);
  found.halves = halves_figures(crop.picture, model, options.learn);
  found.copy_px = longest_copy_px(crop.picture, found.made);
  write_text_file(options.out, model_text(model));
  if (!options.report.empty()) write_report(options, crop, found);
  if (is_uneven(found)) progress.note(warning_of(found));
  progress.end();
  print_result(options, as_json(options, found), as_text(options, found));
  return 0;
}

}  // namespace

Action add_texture_learn(CommandOptions& command) {
  const auto options = std::make_shared<TextureLearnOptions>();
  command
      .add_option("CROP PICTURE", options->crop,
                  "A piece of a painting that shows one texture, 48 pixels per side or more")
      .required()
      .files(FileUse::input);
  command.add_option("--out MODEL", options->out, "The model: a text file of about 1.5 KB")
      .required()
      .files(FileUse::writes);
  command
      .add_option("--mask PICTURE", options->mask,
                  "Mask of the texture in the crop: a grey picture of its size, 0 is left out")
      .files(FileUse::input);
  command
      .add_option("--types N", options->learn.types,
                  "Maximum number of statistics in the model, 16 to 200. Default: 40")
      .range(16, 200);
  command
      .add_option("--light HALF", options->light,
                  "Learns only the lighter half of the crop (lit) or the darker half (shaded): "
                  "faces of rock and snow are light and shade, and\n"
                  "need a model for each. Default: all of it")
      .one_of({"lit", "shaded"});
  add_begin_options(
      command, options->begin,
      "Initial noise, which determines the shape of the dabs: white, streaks (strokes along a\n"
      "direction) or discs (crowns). Default: the noise that comes closest to the crop");
  command
      .add_option("--method METHOD", options->method,
                  "flow, or paper: the published method, which samples one level pixel by pixel. "
                  "For comparison, on\n"
                  "crops up to 256 pixels per side; it takes minutes and ignores pairs farther "
                  "apart than 12 pixels. Default: flow")
      .one_of({"flow", "paper"});
  add_run_options(command, *options, "bit");
  command
      .add_option("--report FOLDER", options->report,
                  "Writes a page with the crop beside the texture, and all figures")
      .files(FileUse::folder);
  command.footer(
      "The model describes only how neighbouring pixels differ, near and far: meadow, distant "
      "forest, scree, water and sky come out\n"
      "well, rock and anything with shapes does not. Crops must contain nothing else: a house in "
      "them returns as red specks.\n"
      "\n"
      "  belvedere texture learn meadow.png --out meadow.model --report meadow_report");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
