#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/image/output_file.h"
#include "texture/statistical/knit.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/options/run_options.h"
#include "tools/report/report.h"

namespace belvedere::tools {
namespace {

struct TextureKnitOptions : RunOptions {
  std::vector<std::string> pictures;
  std::string out, report;
  KnitParameters knit;
  bool down = false;
};

template <class Pixel>
Grid<Pixel> transposed(const Grid<Pixel>& picture) {
  Grid<Pixel> out(picture.height(), picture.width());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = picture(y, x);
  return out;
}

// A picture as it is compared, in 8 bits, and with all the bits of its file.
struct Cloth {
  Grid<Rgb8> picture;
  Grid<glm::vec3> stored;
};

Cloth read_cloth(const TextureKnitOptions& options, const std::string& path) {
  Cloth cloth;
  TextureCrop crop = read_crop(path, "", &cloth.stored);
  if (crop.transparent > 0)
    throw Error(ErrorKind::input, path, fmt::format("has {} transparent pixels", crop.transparent),
                "opaque pictures; `belvedere texture fill` paints over what is missing");
  cloth.picture = std::move(crop.picture);
  if (!options.down) return cloth;
  return {transposed(cloth.picture), transposed(cloth.stored)};
}

void write_report(const TextureKnitOptions& options, const Grid<glm::vec3>& cut, const Grid<glm::vec3>& knitted, const ReportTable& table) {
  std::string files;
  for (const std::string& picture : options.pictures) files += " " + file_name(picture);
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "First as they are, side by side, then knitted. Look for the line, then for a band that is busier than both sides. The "
                 "figures are steps of colour across the seam over those inside: 1 is as any other column.");
  report.picture("cut", cut, "side by side");
  report.next_row();
  report.picture("knitted", knitted, "knitted");
  report.section("figures", "Figures");
  report.table(table);
  report.write({.title = "Knitted pictures: " + file_name(options.out),
                .lead = fmt::format("{} pictures, {} × {} pixels.", options.pictures.size(), knitted.width(), knitted.height()),
                .command = fmt::format("belvedere texture knit{}{}{} --seed {} --out {}", files, options.down ? " --down" : "",
                                       options.knit.band_px == 0 ? "" : fmt::format(" --band-px {}", options.knit.band_px),
                                       options.knit.seed, file_name(options.out))});
}

int run(const TextureKnitOptions& options) {
  if (options.pictures.size() < 2) throw Error(ErrorKind::usage, "command line", "one picture", "two or more to join");
  check_texture_name(options.out);
  check_not_read(options.out, "--out", options.pictures);
  if (!options.report.empty()) check_output_folder(options.report);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  Cloth joined = read_cloth(options, options.pictures.front());
  for (const std::string& picture : options.pictures) note_rounding(picture, options.out, progress);
  Grid<glm::vec3> cut = joined.stored;
  ReportTable table({{"at_px", "seam at, px"}, {"before", "before", ".2f"}, {"knitted", "after", ".2f"}, {"band_px", "band, px"}});
  Json told = Json::array();
  std::string lines;
  for (std::size_t i = 1; i < options.pictures.size(); ++i) {
    const Cloth next = read_cloth(options, options.pictures[i]);
    const int seam = joined.picture.width();
    KnitPicture knitted = knit_textures(joined.picture, next.picture, options.knit, progress);
    const std::string now =
        knitted.band_px == 0 ? std::string("times the steps inside; left as it was")
                             : fmt::format("times the steps inside, {:.2f} before; {} px on either side", knitted.before, knitted.band_px);
    lines += fmt::format("  seam at {} px: {:.2f} {}\n", seam, knitted.after, now);
    told.add(Json::object()
                 .add("at_px", Json::number(seam))
                 .add("before", Json::number(knitted.before))
                 .add("knitted", Json::number(knitted.after))
                 .add("band_px", Json::number(knitted.band_px)));
    table.row(seam, knitted.before, knitted.after, knitted.band_px == 0 ? Json::text("left as it was") : Json::number(knitted.band_px));
    joined.stored = with_changes(side_by_side(joined.stored, next.stored), side_by_side(joined.picture, next.picture), knitted.picture);
    joined.picture = std::move(knitted.picture);
    if (!options.report.empty()) cut = side_by_side(cut, next.stored);
  }
  if (options.down) {
    joined.stored = transposed(joined.stored);
    cut = transposed(cut);
  }
  write_encoded_texture(options.out, joined.stored,
                        fmt::format("{} pictures knitted, seed {}", options.pictures.size(), options.knit.seed));
  if (!options.report.empty()) write_report(options, cut, joined.stored, table);
  progress.end();
  print_result(options, Json::object().add("out", Json::text(options.out)).add("seams", std::move(told)),
               fmt::format("{}: {}×{} pixels\n", options.out, joined.stored.width(), joined.stored.height()) + lines);
  return 0;
}

}  // namespace

Action add_texture_knit(CommandOptions& command) {
  const auto options = std::make_shared<TextureKnitOptions>();
  command.add_option("PICTURE", options->pictures, "Two or more pictures of one height, from left to right")
      .required()
      .type_name("PICTURE");
  command.add_option("--out", options->out, "The picture: .png or .tif").required().type_name("PICTURE");
  command.add_flag("--down", options->down, "From top to bottom instead; of one width then");
  command
      .add_option("--band-px", options->knit.band_px,
                  "How far from a seam pixels may change. Default: as the step of the seam asks, 24 to 96")
      .range(8, 256)
      .type_name("PX");
  command.add_option("--seed", options->knit.seed, "Another seed, another border. Default: 1").type_name("N");
  add_run_options(command, *options);
  command.add_option("--report", options->report, "A page with the pictures side by side and knitted, and how plain the seams are")
      .type_name("FOLDER");
  command.footer(
      "Each picture is grown over the seam by a texture model of its own, up to a ragged border that a model of both makes anew.\n"
      "A seam that nobody sees is left as it is. Nothing farther from the seam changes.\n\n"
      "  belvedere texture knit meadow.png scree.png --out slope.png");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
