#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/image/image_io.h"
#include "texture/statistical/photometric.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"

namespace belvedere::tools {
namespace {

struct TextureCorrectOptions : RunOptions {
  std::string source, target, out, report;
  int regions = PhotometricParameters{}.regions;
};

// Mask of opaque pixels; empty: all are.
Grid<std::uint8_t> opaque(const Grid<float>& alpha) {
  if (std::all_of(alpha.begin(), alpha.end(), [](float a) { return a >= 1.F; })) return {};
  Grid<std::uint8_t> out(alpha.width(), alpha.height());
  std::transform(alpha.begin(), alpha.end(), out.begin(),
                 [](float a) { return static_cast<std::uint8_t>(a >= 1.F ? 1 : 0); });
  return out;
}

Json distances_json(const std::array<double, 3>& distance) {
  return Json::object()
      .add("hue", Json::number(distance[0]))
      .add("saturation", Json::number(distance[1]))
      .add("value", Json::number(distance[2]));
}

void write_report(const TextureCorrectOptions& options, const Grid<glm::vec3>& source,
                  const Grid<glm::vec3>& target, const Grid<glm::vec3>& out,
                  const std::array<double, 3>& before, const std::array<double, 3>& after) {
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "The picture, the corrected picture, and the picture whose colours it takes. Look "
                 "for specks of a hue that neither has. The figures are distances of the "
                 "histograms: 0 equal, 2 disjoint.");
  report.picture("source", source, "the picture");
  report.picture("corrected", out, "corrected");
  report.picture("target", target, "whose colours it takes");
  report.section("figures", "Figures");
  report.table(ReportTable({{"when", ""},
                            {"hue", "hue", ".2f"},
                            {"saturation", "saturation", ".2f"},
                            {"value", "value", ".2f"}})
                   .row("before", before[0], before[1], before[2])
                   .row("after", after[0], after[1], after[2]));
  report.write({.title = "Corrected colours: " + file_name(options.source),
                .lead = fmt::format("In the colours of {}, {} regions.", file_name(options.target),
                                    options.regions),
                .command = fmt::format("belvedere texture correct {} --to {} --regions {} --out {}",
                                       file_name(options.source), file_name(options.target),
                                       options.regions, file_name(options.out))});
}

int run(const TextureCorrectOptions& options) {
  check_texture_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  Grid<float> source_alpha;
  Grid<float> target_alpha;
  const Grid<glm::vec3> source = read_picture(options.source, &source_alpha);
  const Grid<glm::vec3> target = read_picture(options.target, &target_alpha);
  PhotometricParameters parameters;
  parameters.regions = options.regions;
  note_rounding(options.source, options.out, progress);
  for (const Grid<float>* alpha : {&source_alpha, &target_alpha})
    if (const auto clear =
            std::count_if(alpha->begin(), alpha->end(), [](float a) { return a < 1.F; });
        clear > 0)
      progress.note(
          fmt::format("{} transparent pixels of {} are not measured", clear,
                      file_name(alpha == &source_alpha ? options.source : options.target)));
  progress.begin("correcting", 0.0);
  const Grid<glm::vec3> out =
      correct_colours(source, target, parameters, opaque(source_alpha), opaque(target_alpha));
  write_encoded_texture(
      options.out, out,
      fmt::format("{} with the colours of {} regions {}", file_name(options.source),
                  file_name(options.target), options.regions));
  const std::array<double, 3> before = colour_histogram_distance(source, target);
  const std::array<double, 3> after = colour_histogram_distance(out, target);
  if (!options.report.empty()) write_report(options, source, target, out, before, after);
  progress.end();
  print_result(
      options,
      Json::object()
          .add("out", Json::text(options.out))
          .add("before", distances_json(before))
          .add("after", distances_json(after)),
      fmt::format("{}: hue {:.2f} to {:.2f}, saturation {:.2f} to {:.2f}, value {:.2f} to {:.2f} "
                  "(0 equal … 2 disjoint)\n",
                  options.out, before[0], after[0], before[1], after[1], before[2], after[2]));
  return 0;
}

}  // namespace

Action add_texture_correct(CommandOptions& command) {
  const auto options = std::make_shared<TextureCorrectOptions>();
  command.add_option("SOURCE PICTURE", options->source, "The picture to correct: PNG, TIFF or JPEG")
      .required()
      .files(FileUse::input);
  command.add_option("--to PICTURE", options->target, "The picture whose colours it takes")
      .required()
      .files(FileUse::input);
  command.add_option("--out PICTURE", options->out, "The corrected picture: .png or .tif")
      .required()
      .files(FileUse::writes);
  command
      .add_option("--regions N", options->regions,
                  "Number of regions of similar colour that are paired. Default: 3")
      .range(1, 5);
  add_run_options(command, *options);
  command
      .add_option("--report FOLDER", options->report,
                  "Writes a page with the picture before and after beside the other, and the "
                  "distances of their colours")
      .files(FileUse::folder);
  command.footer(
      "Pairs regions of similar colour of both pictures, and gives each the distributions of hue, "
      "saturation and\n"
      "brightness of its partner. Use it before combining paintings of several painters, seasons "
      "or scans.\n"
      "\n"
      "  belvedere texture correct scan.tif --to painting.jpg --out corrected.tif");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
