#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/letters.h"
#include "renderer/exemplar/painting_segments.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/image_io.h"
#include "renderer/image/label_image.h"
#include "renderer/image/png_palette.h"
#include "texture/segment/segment_figures.h"
#include "texture/synthesis/guide_stack.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/options/run_options.h"
#include "tools/report/report_pictures.h"
#include "tools/report/segment_page.h"

namespace belvedere::tools {
namespace {

using Colours = std::vector<std::array<std::uint8_t, 3>>;

struct SegmentOptions : RunOptions {
  std::string painting, out, page, compare;
  std::optional<double> theta;  // none: as many groups as `most`
  int max = 30;
  bool numbers = false;
};

// Classes in the colours of class maps; numbers of groups in the average colours of their paint.
Colours colours_of(const SegmentOptions& options, const Grid<std::uint8_t>& mask,
                   const Grid<glm::vec3>& picture) {
  if (!options.numbers) return class_map_colours();
  Colours colours(256, {0, 0, 0});
  std::vector<glm::dvec3> sum(256, glm::dvec3(0.0));
  std::vector<double> pixels(256, 0.0);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    sum[mask[i]] += picture[i];
    pixels[mask[i]] += 1.0;
  }
  for (std::size_t k = 0; k < unused_label; ++k)
    for (std::size_t c = 0; c < 3 && pixels[k] > 0.0; ++c)
      colours[k][c] = static_cast<std::uint8_t>(
          std::clamp(255.0 * sum[k][static_cast<int>(c)] / pixels[k] + 0.5, 0.0, 255.0));
  return colours;
}

// How well the groups, and their inferred classes, agree with labels drawn by hand.
struct Agreement {
  SegmentAgreement groups, named;
};

Agreement agreement_with(const SegmentOptions& options, const PaintingSegments& segments,
                         const Partition& groups, const std::vector<std::uint8_t>& classes,
                         Progress& progress) {
  const LabelImages drawn = read_label_images({options.compare}, progress);
  const Grid<std::uint8_t>& labels = drawn.labels.front();
  if (!labels.same_size(segments.pieces))
    throw Error(ErrorKind::input, options.compare,
                fmt::format("{} × {} pixels", labels.width(), labels.height()),
                fmt::format("the size of {}: {} × {}", options.painting, segments.pieces.width(),
                            segments.pieces.height()));
  Grid<std::uint16_t> group(labels.width(), labels.height(), no_piece);
  Grid<std::uint16_t> named(labels.width(), labels.height(), no_piece);
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (segments.pieces[i] == no_piece) continue;
    group[i] = groups[segments.pieces[i]];
    named[i] = classes[group[i]];
  }
  return {segment_agreement(group, labels), segment_agreement(named, labels)};
}

int run(const SegmentOptions& options) {
  if (lower_extension(options.out) != ".png")
    throw Error(ErrorKind::usage, "--out", options.out, "a .png");
  const std::string page_extension = options.page.empty() ? ".html" : lower_extension(options.page);
  if (page_extension != ".html" && page_extension != ".htm")
    throw Error(ErrorKind::usage, "--report", options.page, "a .html");
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  Grid<float> alpha;
  const Grid<glm::vec3> picture = read_painting(options.painting, progress, &alpha);
  progress.begin("segmenting", 0.0);
  const PaintingSegments segments =
      segment_painting(picture, alpha, options.theta.value_or(usual_theta), options.painting);
  // Merging two groups takes a click, while a group of two things must be split first. So without a
  // given limit of dissimilarity, rather more groups are made than were found.
  const std::size_t found = options.theta ? segments.groups : segments.tree.pieces;
  const std::size_t groups = std::min(found, static_cast<std::size_t>(options.max));
  std::vector<std::uint8_t> classes = inferred_class_of(segments, groups);
  std::map<std::string, int> shown;
  for (const std::uint8_t id : classes)
    ++shown[std::string(class_name(static_cast<LandCoverClass>(id)))];
  const Partition partition = cut_tree(segments.tree, groups);
  std::optional<Agreement> agreement;
  if (!options.compare.empty())
    agreement = agreement_with(options, segments, partition, classes, progress);
  if (options.numbers)
    for (std::size_t k = 0; k < classes.size(); ++k) classes[k] = static_cast<std::uint8_t>(k);
  const Grid<std::uint8_t> mask = class_mask(segments, partition, classes);
  image_io::write_palette_png(options.out, mask, colours_of(options, mask, picture));
  if (!options.page.empty())
    write_segment_page(options.page, file_name(options.painting), file_name(options.out), picture,
                       segments, groups);
  progress.end();
  if (options.json) {
    Json inferred = Json::object();
    for (const auto& [name, count] : shown) inferred.add(name, Json::number(count));
    Json told = Json::object()
                    .add("out", Json::text(options.out))
                    .add("pieces", Json::number(static_cast<double>(segments.tree.pieces)))
                    .add("groups", Json::number(static_cast<double>(groups)))
                    .add("inferred", std::move(inferred));
    if (agreement)
      told.add("agreement",
               Json::object()
                   .add("merged", Json::number(agreement->groups.merged))
                   .add("one_to_one", Json::number(agreement->groups.one_to_one))
                   .add("named_one_to_one", Json::number(agreement->named.one_to_one)));
    print_out(told.str() + "\n");
  } else if (!options.quiet) {
    std::string inferred;
    for (const auto& [name, count] : shown)
      inferred += fmt::format("{}{} {}", inferred.empty() ? "" : ", ", count, name);
    print_out(fmt::format("{}: {} groups of {} pieces; classes inferred: {}\n", options.out, groups,
                          segments.tree.pieces, inferred));
    if (agreement)
      print_out(fmt::format(
          "  intersection over union with {}: {:.2f} merged, {:.2f} one to one; {:.2f} as named\n",
          options.compare, agreement->groups.merged, agreement->groups.one_to_one,
          agreement->named.one_to_one));
  }
  return 0;
}

}  // namespace

Action add_exemplar_segment(CommandOptions& command) {
  const auto options = std::make_shared<SegmentOptions>();
  command.add_option("PAINTING", options->painting, "A painting or a scan: PNG, TIFF or JPEG")
      .required()
      .type_name("PICTURE")
      .files(FileUse::input);
  command
      .add_option("--out", options->out,
                  "The mask: a .png whose numbers are classes, for `classes` of an [[exemplar]]")
      .required()
      .type_name("MASK")
      .files(FileUse::writes);
  command
      .add_option("--report", options->page,
                  "Also writes a page (.html) to merge, split and name the groups with clicks, and "
                  "to save the mask")
      .type_name("PAGE")
      .files(FileUse::page);
  command
      .add_option("--groups", options->theta,
                  "Limit of the dissimilarity within a group, such as 1.1; a larger value makes "
                  "fewer groups. Default: by --max-groups")
      .type_name("X")
      .range(0.0, 10.0);
  command
      .add_option("--max-groups", options->max,
                  "Number of groups; the most similar are joined. With --groups an upper limit. "
                  "Default: 30")
      .type_name("N")
      .range(1, 254);
  command.add_flag("--numbers", options->numbers,
                   "Writes numbers of groups to the mask instead of classes, as `synthesize "
                   "--label` takes them");
  command
      .add_option("--compare", options->compare,
                  "A mask drawn by hand, in flat colours or numbers: reports how well the groups "
                  "agree with it")
      .type_name("MASK")
      .files(FileUse::input);
  add_run_options(command, *options);
  command.footer(
      "Finds groups of similar paint in a painting, to be merged and named by a person who "
      "recognizes what is painted. The\n"
      "classes that the mask begins with are inferred from position, colour and strokes.\n"
      "\n"
      "  belvedere exemplar segment painting.jpg --out mask.png --report groups.html");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
