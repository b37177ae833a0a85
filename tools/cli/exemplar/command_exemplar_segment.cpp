#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "base/text/embedded.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/exemplar/classes_by_paint.h"
#include "renderer/exemplar/name_questions.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/image_io.h"
#include "renderer/image/label_image.h"
#include "renderer/image/png_palette.h"
#include "texture/segment/segment.h"
#include "texture/segment/segment_figures.h"
#include "texture/synthesis/exemplar.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr int widest_shown = 1400;  // px; the mask keeps the painting's own size

// Run-length coding of pieces: two bytes of the piece, low first, and the run's length in groups of
// seven bits, low first, all but the last flagged.
std::string runs_of(const Grid<std::uint16_t>& pieces) {
  std::string out;
  for (std::size_t at = 0; at < pieces.size();) {
    std::size_t end = at + 1;
    while (end < pieces.size() && pieces[end] == pieces[at]) ++end;
    out += static_cast<char>(pieces[at] & 255);
    out += static_cast<char>(pieces[at] >> 8);
    for (std::size_t length = end - at; length > 0; length >>= 7)
      out += static_cast<char>((length & 127U) | (length > 127U ? 128U : 0U));
    at = end;
  }
  return out;
}

// What the page begins with.
struct PageContents {
  std::string title, mask, names;  // of files
  NamedGroups groups;
  NameQuestions questions;
};

std::string script_data(const PageContents& contents, const Grid<glm::vec3>& picture,
                        const PaintingSegments& segments) {
  Json joins = Json::array();
  for (const auto& join : segments.tree.joins) joins.add(Json::numbers(join));
  Json classes = Json::array();
  for (const LandCoverClassInfo& info : land_cover_classes())
    classes.add(Json::object()
                    .add("number", Json::number(static_cast<double>(info.id)))
                    .add("name", Json::text(info.name))
                    .add("colour", Json::text(fmt::format("#{:06x}", info.rgb))));
  return script_json(
      Json::object()
          .add("width", Json::number(picture.width()))
          .add("height", Json::number(picture.height()))
          .add("mask", Json::text(contents.mask))
          .add("names", Json::text(contents.names))
          .add("groups", Json::numbers(contents.groups.nodes))
          .add("named", Json::numbers(contents.groups.named))
          .add("shows", Json::numbers(contents.groups.classes))
          .add("questions", Json::numbers(contents.questions.of_group))
          .add("inferred", Json::numbers(segments.inferred))
          .add("joins", std::move(joins))
          .add("classes", std::move(classes))
          .add("pieces", Json::text(base64(runs_of(segments.pieces))))
          .add("picture", Json::text(png_address(reduce_blocks(
                              picture, (picture.width() + widest_shown - 1) / widest_shown))))
          .str());
}

// A self-contained page without network access: the painting with the borders of its groups, which
// clicks and keys merge, split and name; questions of what like groups show; undo; the mask as a
// file that `[[exemplar]]` reads, and what was said as one that this command reads. Throws
// Error(output).
void write_segment_page(const std::string& path, const PageContents& contents,
                        const Grid<glm::vec3>& picture, const PaintingSegments& segments) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int factor = (picture.width() + widest_shown - 1) / widest_shown;
  const std::string text =
      filled_page(embedded_file("segment/index.html"),
                  {{"title", markup_text(contents.title)},
                   {"mask", markup_text(contents.mask)},
                   {"names", markup_text(contents.names)},
                   {"width", fmt::format("{}", (picture.width() + factor - 1) / factor)},
                   {"height", fmt::format("{}", (picture.height() + factor - 1) / factor)},
                   {"css", std::string(embedded_file("segment/segment.css"))},
                   {"data", script_data(contents, picture, segments)},
                   {"groups", std::string(embedded_file("segment/groups.js"))},
                   {"page", std::string(embedded_file("segment/segment.js"))}});
  write_text_file(path, text);
}

using Colours = std::vector<std::array<std::uint8_t, 3>>;

struct SegmentOptions : RunOptions {
  std::string painting, out, page, compare, names;
  std::optional<double> theta;  // none: as many groups as `most`
  int max = 60;
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

// What was said of the painting: in the named file, or in that beside it.
std::vector<PlaceName> names_said(const SegmentOptions& options, const std::string& beside) {
  if (options.numbers && !options.names.empty())
    throw Error(ErrorKind::usage, "--names", "--numbers writes no names", "one of the two");
  if (!options.names.empty()) return read_place_names(options.names);
  if (options.numbers || !std::filesystem::exists(beside)) return {};
  return read_place_names(beside);
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
  const std::string names =
      std::filesystem::path(options.painting).replace_extension(".names.toml").string();
  const std::vector<PlaceName> said = names_said(options, names);
  Grid<float> alpha;
  const Grid<glm::vec3> picture = read_painting(options.painting, progress, &alpha);
  progress.begin("segmenting", 0.0);
  const PaintingSegments segments =
      segment_painting(picture, alpha, options.theta.value_or(usual_theta), options.painting);
  // Merging two groups takes a click, while a group of two things must be split first. So without a
  // given limit of dissimilarity, rather more groups are made than were found.
  const std::size_t found = options.theta ? segments.groups : segments.tree.pieces;
  const NamedGroups named =
      name_groups(segments, std::min(found, static_cast<std::size_t>(options.max)), said);
  const std::size_t groups = named.nodes.size();
  const NameQuestions questions = ask_names(segments, named.nodes);
  std::vector<std::uint8_t> classes = named.classes;
  std::map<std::string, int> shown;
  for (const std::uint8_t id : classes)
    if (id != unused_label) ++shown[std::string(class_name(static_cast<LandCoverClass>(id)))];
  const Partition& partition = named.of_pieces;
  std::optional<Agreement> agreement;
  if (!options.compare.empty())
    agreement = agreement_with(options, segments, partition, classes, progress);
  if (options.numbers)
    for (std::size_t k = 0; k < classes.size(); ++k) classes[k] = static_cast<std::uint8_t>(k);
  const Grid<std::uint8_t> mask = class_mask(segments, partition, classes);
  image_io::write_palette_png(options.out, mask, colours_of(options, mask, picture));
  if (!options.page.empty())
    write_segment_page(
        options.page,
        {file_name(options.painting), file_name(options.out), file_name(names), named, questions},
        picture, segments);
  progress.end();
  if (options.json) {
    Json inferred = Json::object();
    for (const auto& [name, count] : shown) inferred.add(name, Json::number(count));
    Json told = Json::object()
                    .add("out", Json::text(options.out))
                    .add("pieces", Json::number(static_cast<double>(segments.tree.pieces)))
                    .add("groups", Json::number(static_cast<double>(groups)))
                    .add("questions", Json::number(static_cast<double>(questions.count)))
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
  command
      .add_option("PAINTING PICTURE", options->painting, "A painting or a scan: PNG, TIFF or JPEG")
      .required()
      .files(FileUse::input);
  command
      .add_option("--out MASK", options->out,
                  "The mask: a .png whose numbers are classes, for `classes` of an [[exemplar]]")
      .required()
      .files(FileUse::writes);
  command
      .add_option("--report PAGE", options->page,
                  "Also writes a page (.html) to merge, split and name the groups with clicks, and "
                  "to save the mask")
      .files(FileUse::page);
  command
      .add_option("--groups X", options->theta,
                  "Limit of the dissimilarity within a group, such as 1.1; a larger value makes "
                  "fewer groups. Default: by --max-groups")
      .range(0.0, 10.0);
  command
      .add_option("--max-groups N", options->max,
                  "Number of groups; the most similar are joined. With --groups an upper limit. "
                  "Default: 60")
      .range(1, 254);
  command.add_flag("--numbers", options->numbers,
                   "Writes numbers of groups to the mask instead of classes, as `synthesize "
                   "--label` takes them");
  command
      .add_option("--compare MASK", options->compare,
                  "A mask drawn by hand, in flat colours or numbers: reports how well the groups "
                  "agree with it")
      .files(FileUse::input);
  command
      .add_option("--names FILE", options->names,
                  "What a person said that places show, as the page saves it. Default: the file "
                  "beside the painting that ends with .names.toml, if there is one")
      .files(FileUse::input);
  add_run_options(command, *options);
  command.footer(
      "Finds groups of similar paint in a painting, to be merged and named by a person who "
      "recognizes what is painted. The\n"
      "classes that the mask begins with are inferred from position, colour and strokes. Only sky "
      "is ever certain: for the\n"
      "rest the page asks, one question for all groups that look alike.\n"
      "\n"
      "  belvedere exemplar segment painting.jpg --out mask.png --report groups.html");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
