#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "base/filter.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/make_texture.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"

namespace belvedere::tools {
namespace {

struct TextureFillOptions : RunOptions {
  std::string picture, hole, model, out, report;
  std::uint64_t seed = 1;
};

// Transparent pixels take the colour of the nearest opaque one, so that their hidden colour does
// not influence the fill.
Grid<Rgb8> without_clear(const TextureCrop& scan) {
  if (scan.transparent == 0 || scan.transparent == scan.picture.size()) return scan.picture;
  const Grid<std::int32_t> nearest = nearest_marked(scan.states);
  Grid<Rgb8> out(scan.picture.width(), scan.picture.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = scan.picture[static_cast<std::size_t>(nearest[i])];
  return out;
}

// The surroundings of the hole, before and after.
void write_report(const TextureFillOptions& options, const Grid<glm::vec3>& before,
                  const Grid<glm::vec3>& after, const Grid<std::uint8_t>& hole) {
  constexpr int around_px = 64;
  PixelRect box{hole.width(), hole.height(), 0, 0};
  std::size_t pixels = 0;
  for (int y = 0; y < hole.height(); ++y)
    for (int x = 0; x < hole.width(); ++x) {
      if (hole(x, y) == 0) continue;
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
             std::max(box.y1, y + 1)};
      ++pixels;
    }
  const PixelRect all{0, 0, hole.width(), hole.height()};
  box = box.empty() ? all : intersection(grown(box, around_px), all);
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "Before on the left, after on the right, in the part that changed. Look for the "
                 "outline of the hole.");
  report.picture("before", part_of(before, box), "before");
  report.picture("after", part_of(after, box), "after");
  report.write(
      {.title = "Filled picture: " + file_name(options.picture),
       .lead = fmt::format("{} of {} pixels filled.", pixels, hole.size()),
       .command = fmt::format("belvedere texture fill {} --hole {} --model {} --seed {} --out {}",
                              file_name(options.picture), file_name(options.hole),
                              file_name(options.model), options.seed, file_name(options.out))});
}

int run(const TextureFillOptions& options) {
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const CliqueModel model = read_model(options.model);
  Grid<glm::vec3> stored;
  const TextureCrop scan = read_crop(options.picture, "", &stored);
  const Grid<Rgb8> picture = without_clear(scan);
  note_rounding(options.picture, options.out, progress);
  if (scan.transparent > 0)
    progress.note(fmt::format(
        "{} transparent pixels are ignored as surroundings, and become opaque", scan.transparent));
  const Grid<std::uint8_t> hole = read_mask_of(options.hole, options.picture, picture);
  const auto pixels = std::count(hole.begin(), hole.end(), std::uint8_t{1});
  if (pixels == 0) progress.note("warning: the mask marks nothing; the picture is unchanged");
  TextureParameters parameters;
  parameters.seed = options.seed;
  Grid<std::uint8_t> counts(picture.width(), picture.height(), 1);
  for (std::size_t i = 0; i < scan.states.size(); ++i) counts[i] = scan.states[i] != 0 ? 1 : 0;
  const Grid<glm::vec3> filled = with_changes(
      stored, picture, fill_among(picture, hole, counts, {}, model, parameters, progress));
  write_encoded_texture(options.out, filled,
                        fmt::format("{} filled from {} seed {}", file_name(options.picture),
                                    file_name(options.model), options.seed));
  if (!options.report.empty()) write_report(options, stored, filled, hole);
  progress.end();
  print_result(options,
               Json::object()
                   .add("out", Json::text(options.out))
                   .add("filled", Json::number(static_cast<double>(pixels))),
               fmt::format("{}: {} of {} pixels filled\n", options.out, pixels, picture.size()));
  return 0;
}

}  // namespace

Action add_texture_fill(CommandOptions& command) {
  const auto options = std::make_shared<TextureFillOptions>();
  command.add_option("PICTURE", options->picture, "A painting or a scan")
      .required()
      .type_name("PICTURE")
      .files(FileUse::input);
  command
      .add_option("--hole", options->hole,
                  "Mask of the pixels to fill: a grey picture of its size, 0 is kept")
      .required()
      .type_name("PICTURE")
      .files(FileUse::input);
  command
      .add_option("--model", options->model,
                  "Model of the fill, written by `belvedere texture learn`")
      .required()
      .type_name("MODEL")
      .files(FileUse::input);
  command.add_option("--out", options->out, "The picture: .png or .tif")
      .required()
      .type_name("PICTURE")
      .files(FileUse::writes);
  command.add_option("--seed", options->seed, "Random seed. Default: 1").type_name("N");
  add_run_options(command, *options);
  command
      .add_option("--report", options->report,
                  "Writes a page with the part that changed, before and after")
      .type_name("FOLDER")
      .files(FileUse::folder);
  command.footer(
      "Removes lettering, frames and figures from a scan, or lets a wood grow over a clearing. "
      "Nothing outside the mask changes;\n"
      "a .tif keeps 16 bits.\n"
      "\n"
      "  belvedere texture fill scan.tif --hole lettering.png --model meadow.model --out "
      "clean.tif");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
