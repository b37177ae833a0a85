#include <fmt/core.h>

#include <memory>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "texture/statistical/texture_seam.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"

namespace belvedere::tools {
namespace {

struct TextureSeamOptions : RunOptions {
  std::vector<std::string> pictures;
  std::string out, report;
  SeamParameters seams;
  bool down = false;
};

template <class Pixel>
Grid<Pixel> transposed(const Grid<Pixel>& picture) {
  Grid<Pixel> out(picture.height(), picture.width());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = picture(y, x);
  return out;
}

// A picture in 8 bits, as it is compared, and with the full depth of its file.
struct Cloth {
  Grid<Rgb8> picture;
  Grid<glm::vec3> stored;
};

Cloth read_cloth(const TextureSeamOptions& options, const std::string& path) {
  Cloth cloth;
  TextureCrop crop = read_crop(path, "", &cloth.stored);
  if (crop.transparent > 0)
    throw Error(ErrorKind::input, path, fmt::format("has {} transparent pixels", crop.transparent),
                "opaque pictures; `belvedere texture fill` fills missing parts");
  cloth.picture = std::move(crop.picture);
  if (!options.down) return cloth;
  return {transposed(cloth.picture), transposed(cloth.stored)};
}

void write_report(const TextureSeamOptions& options, const Grid<glm::vec3>& cut,
                  const Grid<glm::vec3>& with_seam, const ReportTable& table) {
  std::string files;
  for (const std::string& picture : options.pictures) files += " " + file_name(picture);
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "First the pictures side by side, then with synthesized seams. Look for the line, "
                 "then for a band that is busier than both sides. The figures are steps of colour "
                 "across the seam relative to those inside: 1 is like any other column.");
  report.picture("cut", cut, "side by side");
  report.next_row();
  report.picture("after", with_seam, "joined");
  report.section("figures", "Figures");
  report.table(table);
  report.write(
      {.title = "Joined pictures: " + file_name(options.out),
       .lead = fmt::format("{} pictures, {} × {} pixels.", options.pictures.size(),
                           with_seam.width(), with_seam.height()),
       .command = fmt::format(
           "belvedere texture seam{}{}{} --seed {} --out {}", files, options.down ? " --down" : "",
           options.seams.band_px == 0 ? "" : fmt::format(" --band-px {}", options.seams.band_px),
           options.seams.seed, file_name(options.out))});
}

int run(const TextureSeamOptions& options) {
  if (options.pictures.size() < 2)
    throw Error(ErrorKind::usage, "command line", "one picture", "two or more to join");
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  Cloth joined = read_cloth(options, options.pictures.front());
  for (const std::string& picture : options.pictures) note_rounding(picture, options.out, progress);
  Grid<glm::vec3> cut = joined.stored;
  ReportTable table({{"at_px", "seam at, px"},
                     {"before", "before", ".2f"},
                     {"after", "after", ".2f"},
                     {"band_px", "band, px"}});
  Json told = Json::array();
  std::string lines;
  for (std::size_t i = 1; i < options.pictures.size(); ++i) {
    const Cloth next = read_cloth(options, options.pictures[i]);
    const int seam = joined.picture.width();
    SeamInput with_seam =
        synthesize_texture_seam(joined.picture, next.picture, options.seams, progress);
    const std::string now =
        with_seam.band_px == 0
            ? std::string("times the steps inside; left as it was")
            : fmt::format("times the steps inside, {:.2f} before; {} px on either side",
                          with_seam.before, with_seam.band_px);
    lines += fmt::format("  seam at {} px: {:.2f} {}\n", seam, with_seam.after, now);
    told.add(Json::object()
                 .add("at_px", Json::number(seam))
                 .add("before", Json::number(with_seam.before))
                 .add("after", Json::number(with_seam.after))
                 .add("band_px", Json::number(with_seam.band_px)));
    table.row(
        seam, with_seam.before, with_seam.after,
        with_seam.band_px == 0 ? Json::text("left as it was") : Json::number(with_seam.band_px));
    joined.stored = with_changes(side_by_side(joined.stored, next.stored),
                                 side_by_side(joined.picture, next.picture), with_seam.picture);
    joined.picture = std::move(with_seam.picture);
    if (!options.report.empty()) cut = side_by_side(cut, next.stored);
  }
  if (options.down) {
    joined.stored = transposed(joined.stored);
    cut = transposed(cut);
  }
  write_encoded_texture(
      options.out, joined.stored,
      fmt::format("{} pictures joined, seed {}", options.pictures.size(), options.seams.seed));
  if (!options.report.empty()) write_report(options, cut, joined.stored, table);
  progress.end();
  print_result(options,
               Json::object().add("out", Json::text(options.out)).add("seams", std::move(told)),
               fmt::format("{}: {}×{} pixels\n", options.out, joined.stored.width(),
                           joined.stored.height()) +
                   lines);
  return 0;
}

}  // namespace

Action add_texture_seam(CommandOptions& command) {
  const auto options = std::make_shared<TextureSeamOptions>();
  command
      .add_option("PICTURE PICTURE", options->pictures,
                  "Two or more pictures of one height, from left to right")
      .required()
      .files(FileUse::input);
  command.add_option("--out PICTURE", options->out, "The picture: .png or .tif")
      .required()
      .files(FileUse::writes);
  command.add_flag("--down", options->down,
                   "From top to bottom instead; the pictures then have one width");
  command
      .add_option(
          "--band-px PX", options->seams.band_px,
          "How far from a seam pixels may change. Default: by the step at the seam, 24 to 96")
      .range(8, 256);
  command.add_option("--seed N", options->seams.seed, "Random seed of the border. Default: 1");
  add_run_options(command, *options);
  command
      .add_option("--report FOLDER", options->report,
                  "Writes a page with the pictures before and after joining, and the visibility of "
                  "the seams")
      .files(FileUse::folder);
  command.footer(
      "Each picture is extended over the seam by its own texture model, up to a ragged border that "
      "is synthesized by a model of both.\n"
      "An invisible seam is not changed, nor is anything farther from the seam.\n"
      "\n"
      "  belvedere texture seam meadow.png scree.png --out slope.png");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
