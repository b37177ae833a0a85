#include <fmt/format.h>

#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/make_texture.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

struct TextureMakeOptions : RunOptions {
  std::string model, out, report;
  std::vector<int> size;
  std::vector<int> window;
  std::uint64_t seed = 1;
};

std::string asked_for(const TextureMakeOptions& options) {
  return options.size.empty() ? fmt::format("--window {}", fmt::join(options.window, ","))
                              : fmt::format("--size {}", fmt::join(options.size, "x"));
}

void write_report(const TextureMakeOptions& options, const CliqueModel& model,
                  const Grid<Rgb8>& made) {
  const std::string file = file_name(options.model);
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "Look at single dabs, then from afar: such a model gives an even texture without "
                 "accents. The page of texture learn shows the crop beside it.");
  report.picture("texture", to_picture(made), fmt::format("made with seed {}", options.seed));
  report.section("figures", "Figures");
  report.table(
      ReportTable({{"what", "model"}, {"value", ""}})
          .row("types of pairs", model.cliques.size())
          .row("begins with", describe_begin(model.seed, model.seed_px, model.polish))
          .row("learned from, pixels", fmt::format("{} × {}", model.crop_width, model.crop_height))
          .row("hash of the crop", model.crop_hash));
  report.write({.title = "Texture: " + file,
                .lead = fmt::format("{} × {} pixels from a model of {} bytes.", made.width(),
                                    made.height(), model_bytes(model)),
                .command = fmt::format("belvedere texture make {} {} --seed {} --out {}", file,
                                       asked_for(options), options.seed, file_name(options.out))});
}

int run(const TextureMakeOptions& options) {
  if (options.size.empty() == options.window.empty())
    throw Error(ErrorKind::usage, "command line",
                options.size.empty() ? "neither --size nor --window is given"
                                     : "both --size and --window are given",
                "one of them");
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const CliqueModel model = read_model(options.model);
  TextureParameters parameters;
  parameters.seed = options.seed;
  Grid<Rgb8> made;
  if (!options.size.empty()) {
    made = make_texture(model, options.size[0], options.size[1], parameters, progress);
  } else {
    const std::vector<int>& w = options.window;
    made = make_window(model, record_texture(model, parameters),
                       {w[0], w[1], w[0] + w[2], w[1] + w[3]}, parameters, progress);
  }
  write_texture(options.out, made,
                fmt::format("{} seed {}", file_name(options.model), options.seed));
  if (!options.report.empty()) write_report(options, model, made);
  progress.end();
  const Json told = Json::object()
                        .add("out", Json::text(options.out))
                        .add("width", Json::number(made.width()))
                        .add("height", Json::number(made.height()));
  print_result(options, told,
               fmt::format("{}: {}×{} pixels\n", options.out, made.width(), made.height()));
  return 0;
}

}  // namespace

Action add_texture_make(CommandOptions& command) {
  const auto options = std::make_shared<TextureMakeOptions>();
  command.add_option("MODEL MODEL", options->model, "A model written by `belvedere texture learn`")
      .required()
      .files(FileUse::input);
  command.add_option("--out PICTURE", options->out, "The picture: .png or .tif")
      .required()
      .files(FileUse::writes);
  command.add_option("--size WxH", options->size, "Width and height, in pixels")
      .list('x', 2)
      .range(1, 1 << 20);
  command
      .add_option("--window X,Y,W,H", options->window,
                  "Instead: left, top, width and height of a window of an unbounded texture. "
                  "Overlapping windows have the same pixels")
      .list(',', 4)
      .range(-(1 << 28), 1 << 28);
  command.add_option("--seed N", options->seed, "Random seed. Default: 1");
  add_run_options(command, *options);
  command
      .add_option("--report FOLDER", options->report,
                  "Writes a page with the texture and a description of its model")
      .files(FileUse::folder);
  command.footer(
      "Nothing is copied and nothing repeats, at any size.\n"
      "\n"
      "  belvedere texture make meadow.model --size 1200x800 --out meadow.png\n"
      "  belvedere texture make meadow.model --window 8192,4096,2048,2048 --out piece.tif");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
