#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "texture/composite/make_composite.h"
#include "texture/composite/make_label_map.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

struct CompositeMakeOptions : RunOptions {
  std::string model, labels, map, out, report;
  std::vector<int> size;
  std::vector<int> window;
  std::uint64_t seed = 1;
};

// The requested window, within the map.
PixelRect window_of(const std::vector<int>& w, const Grid<std::uint8_t>& labels) {
  const std::int64_t right = std::int64_t{w[0]} + w[2];
  const std::int64_t below = std::int64_t{w[1]} + w[3];
  if (w[0] < 0 || w[1] < 0 || w[2] < 1 || w[3] < 1 || right > labels.width() ||
      below > labels.height())
    throw Error(
        ErrorKind::usage, "--window",
        fmt::format("{} × {} pixels at {}, {}", w[2], w[3], w[0], w[1]),
        fmt::format("a part of the map of {} × {} pixels", labels.width(), labels.height()));
  return {w[0], w[1], w[0] + w[2], w[1] + w[3]};
}

// The label map beside the result, and the share of each label.
void write_report(const CompositeMakeOptions& options, const std::vector<std::string>& names,
                  const Grid<std::uint8_t>& labels, const Grid<Rgb8>& made) {
  const std::string file = file_name(options.model);
  ReportTable table({{"label", "label"}, {"pixels", "pixels"}});
  for (std::size_t k = 0; k < names.size(); ++k)
    table.row(names[k], std::count(labels.begin(), labels.end(), static_cast<std::uint8_t>(k)));
  std::string asked = options.labels.empty()
                          ? fmt::format("--size {}", fmt::join(options.size, "x"))
                          : fmt::format("--labels {}", file_name(options.labels));
  if (!options.window.empty()) asked += fmt::format(" --window {}", fmt::join(options.window, ","));
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "The label map on the left, the result on the right. Look at borders first: they "
                 "should be as ragged as in a painting.");
  report.picture("labels", label_colours(labels, names),
                 options.labels.empty() ? "synthesized labels" : "drawn labels");
  report.picture("made", to_picture(made), fmt::format("made with seed {}", options.seed));
  report.section("figures", "Figures");
  report.table(table);
  report.write({.title = "Composite texture: " + file,
                .lead = fmt::format("{} × {} pixels of {} textures.", made.width(), made.height(),
                                    names.size()),
                .command = fmt::format("belvedere composite make {} {} --seed {} --out {}", file,
                                       asked, options.seed, file_name(options.out))});
}

int run(const CompositeMakeOptions& options) {
  if (options.size.empty() == options.labels.empty())
    throw Error(ErrorKind::usage, "command line",
                options.size.empty() ? "neither --size nor --labels is given"
                                     : "both --size and --labels are given",
                "one of them: a label image has its own size");
  check_texture_name(options.out);
  if (!options.map.empty() && lower_extension(options.map) != ".png")
    throw Error(ErrorKind::usage, "--map", options.map, "a .png");
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const CompositeModel model = read_composite(options.model);
  std::vector<std::string> names;
  for (const CompositeLabel& label : model.labels) names.push_back(label.name);
  TextureParameters parameters;
  parameters.seed = options.seed;
  const Grid<std::uint8_t> labels =
      options.labels.empty() ? make_label_map(model.map, options.size[0], options.size[1],
                                              {.seed = options.seed}, progress)
                             : read_drawn_labels(options.labels, names, progress);
  const bool whole = options.window.empty();
  const PixelRect window = whole ? PixelRect{} : window_of(options.window, labels);
  const Grid<Rgb8> made =
      whole ? make_composite(model, labels, parameters, progress)
            : make_composite_window(model, record_composite(model, parameters, progress), labels,
                                    window, parameters, progress);
  write_texture(options.out, made,
                fmt::format("{} seed {}", file_name(options.model), options.seed));
  if (!options.map.empty()) write_label_picture(options.map, labels, names);
  if (!options.report.empty())
    write_report(options, names, whole ? labels : part_of(labels, window), made);
  progress.end();
  print_result(options,
               Json::object()
                   .add("out", Json::text(options.out))
                   .add("width", Json::number(made.width()))
                   .add("height", Json::number(made.height())),
               fmt::format("{}: {}×{} pixels\n", options.out, made.width(), made.height()));
  return 0;
}

}  // namespace

Action add_composite_make(CommandOptions& command) {
  const auto options = std::make_shared<CompositeMakeOptions>();
  command.add_option("COMPOSITE", options->model, "A model written by `belvedere composite learn`")
      .required()
      .type_name("COMPOSITE")
      .files(FileUse::input);
  command.add_option("--out", options->out, "The picture: .png or .tif")
      .required()
      .type_name("PICTURE")
      .files(FileUse::writes);
  command
      .add_option("--size", options->size,
                  "Width and height, in pixels; the label map is synthesized too")
      .list('x', 2)
      .range(1, 1 << 20)
      .type_name("WxH");
  command
      .add_option("--labels", options->labels,
                  "Instead: a label map, drawn in the colours (or numbers) of the crop's labels")
      .type_name("PICTURE")
      .files(FileUse::input);
  command
      .add_option("--window", options->window,
                  "Only this part of the map: column, row, width and height. Windows fit together "
                  "to the pixel, in any order; they are\n"
                  "parts of the window of the whole map, which differs slightly from a picture "
                  "without --window")
      .list(',', 4)
      .type_name("X,Y,W,H");
  command
      .add_option("--map", options->map,
                  "Also writes the labels in their colours, to be edited and passed to --labels")
      .type_name("PICTURE")
      .files(FileUse::writes);
  command.add_option("--seed", options->seed, "Random seed. Default: 1").type_name("N");
  add_run_options(command, *options);
  command.add_option("--report", options->report, "Writes a page with the labels beside the result")
      .type_name("FOLDER")
      .files(FileUse::folder);
  command.footer(
      "  belvedere composite make coast.composite --size 1600x1000 --map labels.png --out "
      "another_coast.png\n"
      "  belvedere composite make coast.composite --labels my_labels.png --out my_coast.png\n"
      "  belvedere composite make coast.composite --labels large.png --window 4096,0,2048,2048 "
      "--out piece.tif");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
