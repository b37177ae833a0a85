#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "base/parallel.h"
#include "texture/statistical/knit.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"

namespace belvedere::tools {
namespace {

struct Options {
  std::vector<std::string> pictures;
  std::string out;
  KnitParameters knit;
  bool down = false;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

Grid<Rgb8> transposed(const Grid<Rgb8>& picture) {
  Grid<Rgb8> out(picture.height(), picture.width());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = picture(y, x);
  return out;
}

int run(const Options& options) {
  if (options.pictures.size() < 2) throw Error(ErrorKind::usage, "command line", "one picture", "two or more to join");
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const auto read = [&](const std::string& path) {
    Grid<Rgb8> picture = read_crop(path, "").picture;
    return options.down ? transposed(picture) : picture;
  };
  Grid<Rgb8> joined = read(options.pictures.front());
  Json told = Json::array();
  std::string lines;
  for (std::size_t i = 1; i < options.pictures.size(); ++i) {
    const Grid<Rgb8> next = read(options.pictures[i]);
    const int seam = joined.width();
    KnitPicture knitted = knit_textures(joined, next, options.knit, progress);
    const std::string now =
        knitted.band_px == 0 ? std::string("times the steps inside; left as it was")
                             : fmt::format("times the steps inside, {:.2f} before; {} px on either side", knitted.before, knitted.band_px);
    lines += fmt::format("  seam at {} px: {:.2f} {}\n", seam, knitted.after, now);
    told.add(Json::object()
                 .add("at_px", Json::number(seam))
                 .add("before", Json::number(knitted.before))
                 .add("knitted", Json::number(knitted.after))
                 .add("band_px", Json::number(knitted.band_px)));
    joined = std::move(knitted.picture);
  }
  if (options.down) joined = transposed(joined);
  write_texture(options.out, joined, fmt::format("{} pictures knitted, seed {}", options.pictures.size(), options.knit.seed));
  progress.end();
  if (options.json)
    print_out(Json::object().add("out", Json::text(options.out)).add("seams", std::move(told)).str() + "\n");
  else if (!options.quiet)
    print_out(fmt::format("{}: {}×{} pixels\n", options.out, joined.width(), joined.height()) + lines);
  return 0;
}

}  // namespace

Action add_texture_knit(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("PICTURE", options->pictures, "Two or more pictures of one height, from left to right")
      ->required()
      ->type_name("PICTURE");
  command.add_option("--out", options->out, "The picture: .png or .tif")->required()->type_name("PICTURE");
  command.add_flag("--down", options->down, "From top to bottom instead; of one width then");
  command
      .add_option("--band-px", options->knit.band_px,
                  "How far from a seam pixels may change. Default: as the step of the seam asks, 24 to 96")
      ->check(CLI::Range(8, 256))
      ->type_name("PX");
  command.add_option("--seed", options->knit.seed, "Another seed, another border. Default: 1")->type_name("N");
  command.add_option("--threads", options->threads, "Processor threads; 0, the default, takes all. Changes no pixel")->type_name("N");
  command.add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command.add_flag("--json", options->json, "Say what came out as JSON");
  command.footer(
      "Each picture is grown over the seam by a texture model of its own, up to a ragged border that a model of both makes anew.\n"
      "A seam that nobody sees is left as it is. Nothing farther from the seam changes.\n\n"
      "  belvedere texture knit meadow.png scree.png --out slope.png");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
