#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/filter.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/exemplar/fill_excluded.h"
#include "texture/statistical/choose_seed.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"
#include "texture/statistical/photometric.h"
#include "texture/synthesis/exemplar.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"

namespace belvedere::tools {
namespace {

struct TextureFillOptions : RunOptions {
  std::string picture, hole, model, out, report;
  std::string crop, like;  // of planting
  bool as_it_is = false;
  std::uint64_t seed = 1;
};

constexpr double similar_share = .25;  // of the ground around, whose light a planted texture takes
constexpr int nearest_ground_px = 32;  // width of that ground, doubled until there is enough
constexpr int planted_margin_px =
    32;  // synthesized beyond the mask and cut off, as in make_texture

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

// What the three commands begin with.
struct TextureScan {
  TextureCrop crop;
  Grid<glm::vec3> stored;
  Grid<Rgb8> picture;         // opaque everywhere
  Grid<std::uint8_t> hole;    // 1: to be changed
  Grid<std::uint8_t> counts;  // 1: opaque in the file
  std::ptrdiff_t pixels = 0;  // of the hole
};

TextureScan read_scan(const TextureFillOptions& options, Progress& progress) {
  TextureScan scan;
  scan.crop = read_crop(options.picture, "", &scan.stored);
  scan.picture = without_clear(scan.crop);
  note_rounding(options.picture, options.out, progress);
  if (scan.crop.transparent > 0)
    progress.note(
        fmt::format("{} transparent pixels are ignored as surroundings, and become opaque",
                    scan.crop.transparent));
  scan.hole = read_mask_of(options.hole, options.picture, scan.picture);
  scan.counts = Grid<std::uint8_t>(scan.picture.width(), scan.picture.height(), 1);
  for (std::size_t i = 0; i < scan.crop.states.size(); ++i)
    scan.counts[i] = scan.crop.states[i] != 0 ? 1 : 0;
  scan.pixels = std::count(scan.hole.begin(), scan.hole.end(), std::uint8_t{1});
  if (scan.pixels == 0) progress.note("warning: the mask marks nothing; the picture is unchanged");
  return scan;
}

// The surroundings of the hole, before and after.
void write_report(const TextureFillOptions& options, const TextureScan& scan,
                  const Grid<glm::vec3>& after, const std::string& command) {
  constexpr int around_px = 64;
  const Grid<std::uint8_t>& hole = scan.hole;
  PixelRect box = box_of(hole);
  const PixelRect all{0, 0, hole.width(), hole.height()};
  box = box.empty() ? all : intersection(grown(box, around_px), all);
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "Before on the left, after on the right, in the part that changed. Look for the "
                 "outline of the hole.");
  report.picture("before", part_of(scan.stored, box), "before");
  report.picture("after", part_of(after, box), "after");
  report.write({.title = "Filled picture: " + file_name(options.picture),
                .lead = fmt::format("{} of {} pixels filled.", scan.pixels, hole.size()),
                .command = command});
}

// Writes the picture, the page if it is wanted, and what was done. `how`: the command's name,
// options and seed.
int finish(const TextureFillOptions& options, const TextureScan& scan,
           const Grid<glm::vec3>& filled, const std::string& how, TerminalProgress& progress) {
  write_encoded_texture(options.out, filled, fmt::format("{} {}", file_name(options.picture), how));
  if (!options.report.empty())
    write_report(options, scan, filled,
                 fmt::format("belvedere texture {} --out {}", how, file_name(options.out)));
  progress.end();
  print_result(
      options,
      Json::object()
          .add("out", Json::text(options.out))
          .add("filled", Json::number(static_cast<double>(scan.pixels))),
      fmt::format("{}: {} of {} pixels filled\n", options.out, scan.pixels, scan.picture.size()));
  return 0;
}

int run(const TextureFillOptions& options) {
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const CliqueModel model = read_model(options.model);
  const TextureScan scan = read_scan(options, progress);
  const Grid<glm::vec3> filled = with_changes(scan.stored, scan.picture,
                                              fill_among(scan.picture, scan.hole, scan.counts, {},
                                                         model, {.seed = options.seed}, progress));
  return finish(options, scan, filled,
                fmt::format("fill {} --hole {} --model {} --seed {}", file_name(options.picture),
                            file_name(options.hole), file_name(options.model), options.seed),
                progress);
}

int run_remove(const TextureFillOptions& options) {
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const TextureScan scan = read_scan(options, progress);
  const FilledPaint paint = remove_marked(scan.stored, scan.counts, scan.hole, progress);
  if (paint.left > 0)
    throw Error(ErrorKind::input, options.hole,
                fmt::format("{} of the pixels to remove have no texture around them", paint.left),
                fmt::format("a mask that leaves {0} × {0} pixels of several colours", min_crop_px));
  return finish(
      options, scan, paint.picture,
      fmt::format("remove {} --mask {}", file_name(options.picture), file_name(options.hole)),
      progress);
}

// What resembles the crop on the ground immediately around the mask: farther ground may lie in
// another light.
Grid<std::uint8_t> find_similar_ground(const TextureScan& scan, const Grid<std::uint8_t>& known,
                                       const Grid<glm::vec3>& colours, const TextureCrop& crop) {
  const int farthest = std::max(known.width(), known.height());
  Grid<std::uint8_t> near;
  for (int px = nearest_ground_px; px < 2 * farthest; px *= 2) {
    near = widened(scan.hole, px);
    for (std::size_t i = 0; i < near.size(); ++i)
      if (known[i] == 0) near[i] = 0;
    if (std::count(near.begin(), near.end(), 1) >= 2 * min_crop_px * min_crop_px) break;
  }
  return find_similar_colours(scan.stored, colours, similar_share, near, crop.states);
}

// The crop's texture in the light of what resembles it in the picture.
CliqueModel learn_planted(const TextureCrop& crop, const Grid<glm::vec3>& colours,
                          const TextureScan& scan, const Grid<std::uint8_t>& similar, bool as_it_is,
                          Progress& progress) {
  Grid<Rgb8> example = crop.picture;
  if (!as_it_is) {
    const Grid<glm::vec3> corrected =
        correct_colours(colours, scan.stored, {}, crop.states, similar);
    for (std::size_t i = 0; i < example.size(); ++i) example[i] = belvedere::to_rgb8(corrected[i]);
  }
  CliqueModel model = learn_texture(example, crop.states, {}, progress).model;
  choose_seed(model, example, crop.states, {}, progress);
  return model;
}

int run_plant(const TextureFillOptions& options) {
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  TextureScan scan = read_scan(options, progress);
  Grid<glm::vec3> colours;
  const TextureCrop crop = read_crop(options.crop, "", &colours);
  Grid<std::uint8_t> known = scan.counts;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (scan.hole[i] != 0) known[i] = 0;
  Grid<std::uint8_t> similar = options.like.empty()
                                   ? find_similar_ground(scan, known, colours, crop)
                                   : read_mask_of(options.like, options.picture, scan.picture);
  for (std::size_t i = 0; i < similar.size(); ++i)
    if (known[i] == 0) similar[i] = 0;
  const CliqueModel model = learn_planted(crop, colours, scan, similar, options.as_it_is, progress);
  // Beside what resembles it the texture joins on; other ground has no part in it and hides a
  // margin, because pixels at the end of a texture have fewer neighbours and come out wrong.
  Grid<std::uint8_t> made_in = widened(scan.hole, planted_margin_px);
  for (std::size_t i = 0; i < made_in.size(); ++i)
    if (scan.hole[i] == 0 && similar[i] != 0) made_in[i] = 0;
  Grid<Rgb8> made =
      fill_among(scan.picture, made_in, similar, {}, model, {.seed = options.seed}, progress);
  for (std::size_t i = 0; i < made.size(); ++i)
    if (scan.hole[i] == 0) made[i] = scan.picture[i];
  const Grid<glm::vec3> planted = with_changes(scan.stored, scan.picture, made);
  return finish(
      options, scan, planted,
      fmt::format("plant {} --mask {} --from {}{}{} --seed {}", file_name(options.picture),
                  file_name(options.hole), file_name(options.crop),
                  options.like.empty() ? "" : " --like " + file_name(options.like),
                  options.as_it_is ? " --as-it-is" : "", options.seed),
      progress);
}

// The options that all three have in common. `mask`: the name of the mask's option.
void add_common(CommandOptions& command, TextureFillOptions& options, const std::string& mask,
                const std::string& meaning) {
  command.add_option("PICTURE PICTURE", options.picture, "A painting or a scan")
      .required()
      .files(FileUse::input);
  command.add_option(mask + " PICTURE", options.hole, meaning).required().files(FileUse::input);
  command.add_option("--out PICTURE", options.out, "The picture: .png or .tif")
      .required()
      .files(FileUse::writes);
  add_run_options(command, options);
  command
      .add_option("--report FOLDER", options.report,
                  "Writes a page with the part that changed, before and after")
      .files(FileUse::folder);
}

}  // namespace

Action add_texture_fill(CommandOptions& command) {
  const auto options = std::make_shared<TextureFillOptions>();
  add_common(command, *options, "--hole",
             "Mask of the pixels to fill: a grey picture of its size, 0 is kept");
  command
      .add_option("--model MODEL", options->model,
                  "Model of the fill, written by `belvedere texture learn`")
      .required()
      .files(FileUse::input);
  command.add_option("--seed N", options->seed, "Random seed. Default: 1");
  command.footer(
      "Lets a wood grow over a clearing. Nothing outside the mask changes; a .tif keeps 16 bits. "
      "`belvedere texture remove` learns\n"
      "the model from the surroundings.\n"
      "\n"
      "  belvedere texture fill scan.tif --hole lettering.png --model meadow.model --out "
      "clean.tif");
  return [options] { return run(*options); };
}

Action add_texture_remove(CommandOptions& command) {
  const auto options = std::make_shared<TextureFillOptions>();
  add_common(command, *options, "--mask",
             "Mask of what is removed: a grey picture of its size, 0 is kept");
  command.footer(
      "Removes lettering, frames and figures: learns the kinds of ground around each group of "
      "marked pixels, continues their borders under\n"
      "it and fills each with its texture and tone. Nothing outside the mask changes; a .tif keeps "
      "16 bits.\n"
      "\n"
      "  belvedere texture remove scan.tif --mask lettering.png --out clean.tif");
  return [options] { return run_remove(*options); };
}

Action add_texture_plant(CommandOptions& command) {
  const auto options = std::make_shared<TextureFillOptions>();
  add_common(command, *options, "--mask",
             "Mask of what is planted: a grey picture of its size, 0 is kept");
  command
      .add_option("--from PICTURE", options->crop,
                  "A crop of the texture, from another picture or another light, 48 pixels per "
                  "side or more")
      .required()
      .files(FileUse::input);
  command
      .add_option("--like PICTURE", options->like,
                  "Mask of the part of PICTURE whose colours the texture takes, and joins. "
                  "Default: the quarter of the ground around\n"
                  "the mask that is nearest in colour to the crop, in whatever light")
      .files(FileUse::input);
  command.add_flag("--as-it-is", options->as_it_is, "Keeps the crop's own colours");
  command.add_option("--seed N", options->seed, "Random seed. Default: 1");
  command.footer(
      "Plants a wood, a meadow, a scree: learns the crop in the light of the picture (see "
      "`belvedere texture correct`) and fills the\n"
      "mask with it. Nothing outside the mask changes; a .tif keeps 16 bits.\n"
      "\n"
      "  belvedere texture plant slope.tif --mask clearing.png --from cedars.jpg --out wood.tif");
  return [options] { return run_plant(*options); };
}

}  // namespace belvedere::tools
