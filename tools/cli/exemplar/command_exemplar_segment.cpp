#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "renderer/exemplar/painting_segments.h"
#include "renderer/image/image_io.h"
#include "renderer/image/png_palette.h"
#include "texture/synthesis/guide_stack.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/report/segment_page.h"

namespace belvedere::tools {
namespace {

using Colours = std::vector<std::array<std::uint8_t, 3>>;

struct Options {
  std::string painting, out, page;
  double theta = usual_theta;
  int most = 30;
  bool numbers = false;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

std::array<std::uint8_t, 3> bytes_of(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 255U), static_cast<std::uint8_t>(rgb & 255U)};
}

// Classes in the colours of class maps; numbers of groups in the mean colours of their paint.
Colours colours_of(const Options& options, const Grid<std::uint8_t>& mask, const Grid<glm::vec3>& picture) {
  Colours colours(256, {0, 0, 0});
  if (!options.numbers) {
    for (const LandCoverClassInfo& info : land_cover_classes()) colours[static_cast<std::size_t>(info.id)] = bytes_of(info.rgb);
    return colours;
  }
  std::vector<glm::dvec3> sum(256, glm::dvec3(0.0));
  std::vector<double> pixels(256, 0.0);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    sum[mask[i]] += picture[i];
    pixels[mask[i]] += 1.0;
  }
  for (std::size_t k = 0; k < unused_label; ++k)
    for (std::size_t c = 0; c < 3 && pixels[k] > 0.0; ++c)
      colours[k][c] = static_cast<std::uint8_t>(std::clamp(255.0 * sum[k][static_cast<int>(c)] / pixels[k] + 0.5, 0.0, 255.0));
  return colours;
}

int run(const Options& options) {
  for (const std::string* path : {&options.out, &options.page})
    if (!path->empty()) check_place(*path);
  if (ending_of(options.out) != ".png") throw Error(ErrorKind::usage, "--out", options.out, "a .png");
  const std::string page_ending = options.page.empty() ? ".html" : ending_of(options.page);
  if (page_ending != ".html" && page_ending != ".htm") throw Error(ErrorKind::usage, "--page", options.page, "a .html");
  for (const std::string* path : {&options.out, &options.page}) {
    std::error_code ignored;
    if (!path->empty() && std::filesystem::equivalent(*path, options.painting, ignored))
      throw Error(ErrorKind::usage, "command line", *path + " is what is read", "a file of its own");
  }
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  Grid<float> alpha;
  const Grid<glm::vec3> picture = read_picture(options.painting, &alpha);
  progress.begin("segmenting", 0.0);
  const PaintingSegments segments = segment_painting(picture, alpha, options.theta, options.painting);
  const std::size_t groups = std::min(segments.groups, static_cast<std::size_t>(options.most));
  std::vector<std::uint8_t> classes = guesses_of(segments, groups);
  std::map<std::string, int> shown;
  for (const std::uint8_t id : classes) ++shown[std::string(class_name(static_cast<LandCoverClass>(id)))];
  if (options.numbers)
    for (std::size_t k = 0; k < classes.size(); ++k) classes[k] = static_cast<std::uint8_t>(k);
  const Grid<std::uint8_t> mask = class_mask(segments, cut_tree(segments.tree, groups), classes);
  image_io::write_palette_png(options.out, mask, colours_of(options, mask, picture));
  if (!options.page.empty())
    write_segment_page(options.page, file_name(options.painting), file_name(options.out), picture, segments, groups);
  progress.end();
  if (options.json) {
    Json guesses = Json::object();
    for (const auto& [name, count] : shown) guesses.add(name, Json::number(count));
    print_out(Json::object()
                  .add("out", Json::text(options.out))
                  .add("pieces", Json::number(static_cast<double>(segments.tree.pieces)))
                  .add("groups", Json::number(static_cast<double>(groups)))
                  .add("guesses", std::move(guesses))
                  .str() +
              "\n");
  } else if (!options.quiet) {
    std::string guesses;
    for (const auto& [name, count] : shown) guesses += fmt::format("{}{} {}", guesses.empty() ? "" : ", ", count, name);
    print_out(fmt::format("{}: {} groups of {} pieces; at a first guess {}\n", options.out, groups, segments.tree.pieces, guesses));
  }
  return 0;
}

}  // namespace

Action add_exemplar_segment(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("PAINTING", options->painting, "A painting or a scan: PNG, TIFF or JPEG")->required()->type_name("PICTURE");
  command.add_option("--out", options->out, "The mask: a .png whose numbers are classes, for `classes` of an [[exemplar]]")
      ->required()
      ->type_name("MASK");
  command.add_option("--page", options->page, "Also a page (.html) to merge, split and name the groups with clicks, and to save the mask")
      ->type_name("PAGE");
  command.add_option("--groups", options->theta, "How unlike a group's parts may be; more makes fewer groups. Default: 1.1")
      ->type_name("X")
      ->check(CLI::Range(0.0, 10.0));
  command.add_option("--most", options->most, "No more groups than these; the likest are joined. Default: 30")
      ->type_name("N")
      ->check(CLI::Range(1, 254));
  command.add_flag("--numbers", options->numbers, "Numbers of groups in the mask instead of classes, as `synthesize --label` takes them");
  command.add_option("--threads", options->threads, "Processor threads; 0, the default, takes all. Changes no pixel")->type_name("N");
  command.add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command.add_flag("--json", options->json, "Say what came out as JSON");
  command.footer(
      "Finds what belongs together in a painting: groups to be merged and named by whoever sees what is painted. The\n"
      "classes that the mask begins with are guesses by place, colour and strokes.\n\n"
      "  belvedere exemplar segment painting.jpg --out mask.png --page groups.html");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
