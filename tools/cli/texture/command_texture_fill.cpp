#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "base/json.h"
#include "base/parallel.h"
#include "texture/statistical/make_texture.h"
#include "texture/statistical/model_file.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"

namespace belvedere::tools {
namespace {

struct Options {
  std::string picture, hole, model, out;
  std::uint64_t seed = 1;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

int run(const Options& options) {
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const CliqueModel model = read_model(options.model);
  const Grid<Rgb8> picture = read_crop(options.picture, "").picture;
  const Grid<std::uint8_t> hole = read_mask_of(options.hole, options.picture, picture);
  const auto pixels = std::count(hole.begin(), hole.end(), std::uint8_t{1});
  if (pixels == 0) progress.note("warning: the mask marks nothing; the picture stays as it is");
  TextureParameters parameters;
  parameters.seed = options.seed;
  write_texture(options.out, fill_texture(picture, hole, model, parameters, progress),
                fmt::format("{} filled from {} seed {}", file_name(options.picture), file_name(options.model), options.seed));
  progress.end();
  if (options.json)
    print_out(Json::object().add("out", Json::text(options.out)).add("filled", Json::number(static_cast<double>(pixels))).str() + "\n");
  else if (!options.quiet)
    print_out(fmt::format("{}: {} of {} pixels made anew\n", options.out, pixels, picture.size()));
  return 0;
}

}  // namespace

Action add_texture_fill(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("PICTURE", options->picture, "A painting or a scan, 8 bit")->required()->type_name("PICTURE");
  command.add_option("--hole", options->hole, "What is made anew: a grey picture of its size, 0 stays")->required()->type_name("PICTURE");
  command.add_option("--model", options->model, "What should stand there: what `belvedere texture learn` wrote")
      ->required()
      ->type_name("MODEL");
  command.add_option("--out", options->out, "The picture: .png or .tif")->required()->type_name("PICTURE");
  command.add_option("--seed", options->seed, "Another seed, other paint. Default: 1")->type_name("N");
  command.add_option("--threads", options->threads, "Processor threads; 0, the default, takes all. Changes no pixel")->type_name("N");
  command.add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command.add_flag("--json", options->json, "Say what came out as JSON");
  command.footer(
      "Takes lettering, frames and figures out of a scan, or lets a wood grow over a clearing. Nothing outside the mask changes.\n\n"
      "  belvedere texture fill scan.tif --hole lettering.png --model meadow.model --out clean.tif");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
