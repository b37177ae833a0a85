#include <fmt/core.h>

#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/image/output_file.h"
#include "texture/statistical/choose_seed.h"
#include "texture/statistical/learn_by_sampling.h"
#include "texture/statistical/light_half.h"
#include "texture/statistical/make_texture.h"
#include "texture/statistical/model_file.h"
#include "texture/statistical/texture_figures.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/begin_options.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/options/run_options.h"
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

// What a run found, for all ways to tell it.
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
  return fmt::format("warning: the crop's halves are as far apart as {:.2f}: it is not one texture, or too small (over {:.2f})",
                     found.halves.held_out, uneven_halves);
}

std::string as_text(const TextureLearnOptions& options, const TextureFindings& found) {
  const CliqueModel& model = found.learned.model;
  std::string out = fmt::format("{}: {} types, {} bytes, begins with {}\n", options.out, model.cliques.size(), model_bytes(model),
                                describe_begin(model.seed, model.seed_px, model.polish));
  out +=
      fmt::format("  distance to the crop  {:.3f} of the types it holds, {:.3f} of all others; the crop's own halves {:.3f} and {:.3f}\n",
                  found.figures.selected, found.figures.held_out, found.halves.selected, found.halves.held_out);
  out += fmt::format("  beyond pairs          {:.3f}; halves {:.3f}\n", found.figures.beyond, found.halves.beyond);
  out += fmt::format("  drawn one way         {:.3f}; halves {:.3f}\n", found.figures.drawn, found.halves.drawn);
  out += fmt::format("  which way             {:.3f}; halves {:.3f}\n", found.figures.turned, found.halves.turned);
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

void write_report(const TextureLearnOptions& options, const TextureCrop& crop, const TextureFindings& found) {
  Report report(options.report);
  report.section("pictures", "Crop and texture",
                 "Left the crop, right what is made from the model alone. Look at single dabs, then from afar: an even busyness without "
                 "accents is what such a model gives.");
  report.picture("crop", to_picture(crop.picture), "the crop");
  report.picture("texture", to_picture(found.made), fmt::format("made, {} × {} pixels", found.made.width(), found.made.height()));
  report.section("distances", "Distances");
  ReportTable distances({{"of", ""},
                         {"selected", "types it holds", ".3f"},
                         {"held_out", "all others", ".3f"},
                         {"worst", "worst", ".2f"},
                         {"beyond", "beyond pairs", ".3f"},
                         {"drawn", "drawn one way", ".3f"},
                         {"turned", "which way", ".3f"}});
  const auto row = [&](const char* name, const TextureFigures& f) {
    distances.row(name, f.selected, f.held_out, f.worst, f.beyond, f.drawn, f.turned);
  };
  row("texture to crop", found.figures);
  row("halves of the crop", found.halves);
  report.table(distances);
  report.section("levels", "Levels");
  ReportTable levels(
      {{"pixels", "pixels a side"}, {"types", "types"}, {"held_out", "others, mean", ".3f"}, {"worst", "others, worst", ".3f"}});
  for (const LearnedLevel& level : found.learned.levels) levels.row(1 << level.level, level.types, level.held_out_l1, level.worst_l2);
  report.table(levels);
  if (!found.trials.empty()) {
    report.section("begins", "How it begins");
    ReportTable trials(
        {{"noise", "noise"}, {"beyond", "beyond pairs", ".3f"}, {"drawn", "drawn one way", ".3f"}, {"turned", "which way", ".3f"}});
    for (const SeedTrial& t : found.trials) trials.row(describe_begin(t.seed, t.px, t.polish), t.beyond, t.drawn, t.turned);
    report.table(trials);
  }
  if (is_uneven(found)) report.text(warning_of(found));
  report.write({.title = "Texture model: " + file_name(options.crop),
                .lead = fmt::format("A model of {} bytes.", model_bytes(found.learned.model)),
                .command = fmt::format("belvedere texture learn {} --out {}", file_name(options.crop), file_name(options.out))});
}

int run(const TextureLearnOptions& options) {
  check_place(options.out);
  check_not_read(options.out, "--out", {options.crop, options.mask});
  if (!options.report.empty()) check_output_folder(options.report);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  TextureCrop crop = read_crop(options.crop, options.mask);
  if (!options.light.empty())
    crop.states = light_half(crop.picture, crop.states, options.light == "lit" ? LightHalf::lit : LightHalf::shaded);
  if (crop.transparent > 0) progress.note(fmt::format("{} transparent pixels are left out", crop.transparent));
  TextureFindings found;
  const bool sampled = options.method == "paper";
  if (sampled && !options.begin.kind.empty())
    throw Error(ErrorKind::usage, "--begin", options.begin.kind, "nothing with --method paper, which begins with white noise");
  found.learned = sampled ? learn_by_sampling(crop.picture, crop.states, options.learn, progress)
                          : learn_texture(crop.picture, crop.states, options.learn, progress);
  CliqueModel& model = found.learned.model;
  if (!sampled) found.trials = choose_seed(model, crop.picture, crop.states, options.learn, progress);
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
  command.add_option("CROP", options->crop, "A piece of a painting that shows one texture, 48 pixels a side or more")
      .required()
      .type_name("PICTURE");
  command.add_option("--out", options->out, "The model: a text of some 1500 letters").required().type_name("MODEL");
  command.add_option("--mask", options->mask, "What of the crop is that texture: a grey picture of its size, 0 is left out")
      .type_name("PICTURE");
  command.add_option("--types", options->learn.types, "How many statistics the model holds at most, 16 to 200. Default: 40")
      .range(16, 200)
      .type_name("N");
  command
      .add_option("--light", options->light,
                  "Learn only what of the crop lies in the light (lit) or in the shade (shaded), its lighter or its darker\n"
                  "half: rock and snow faces are light and shade, and want a model for each. Default: all of it")
      .one_of({"lit", "shaded"})
      .type_name("HALF");
  add_begin_options(command, options->begin,
                    "The noise it begins with, which decides the shape of its dabs: white, streaks (strokes along a\n"
                    "direction) or discs (crowns). Default: what comes nearest to the crop");
  command
      .add_option("--method", options->method,
                  "flow, or paper: the published method, which samples one level pixel by pixel. To compare with, on\n"
                  "crops up to 256 pixels a side; it takes minutes and knows nothing farther than 12 pixels. Default: flow")
      .one_of({"flow", "paper"})
      .type_name("METHOD");
  add_run_options(command, *options, "bit");
  command.add_option("--report", options->report, "A page with crop beside texture, and all figures").type_name("FOLDER");
  command.footer(
      "The model says how neighbouring pixels differ, near and far, and nothing more: meadow, forest from afar, scree, water and sky come "
      "out\n"
      "well, rock and whatever has form does not. Cut crops that hold nothing else: a house in them comes back as red specks.\n\n"
      "  belvedere texture learn meadow.png --out meadow.model --report meadow_report");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
