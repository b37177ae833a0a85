#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/filter.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/exemplar/classes_by_paint.h"
#include "texture/composite/learn_composite.h"
#include "texture/composite/make_composite.h"
#include "texture/composite/make_label_map.h"
#include "texture/segment/segment.h"
#include "texture/synthesis/exemplar.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

struct CompositeLearnOptions : RunOptions {
  std::string crop, labels, out, report;
  std::string found;  // labels that the program found
  BeginOptions begin;
  CompositeParameters composite;
};

// Results of a run, for all forms of output.
struct CompositeFindings {
  CompositeModel model;
  std::size_t bytes = 0;
  std::vector<std::string> names;
  std::vector<std::size_t> pixels;  // of each label in the crop
  Grid<std::uint8_t> map;           // made, of the crop's size
  LabelMapFigures map_figures;
  Grid<Rgb8> filled;  // the crop's own map
  Grid<Rgb8> made;    // the synthesized one
  LayoutFigures filled_figures;
  LayoutFigures made_figures;
};

std::string border_text(const CompositeFindings& found) {
  const auto wanted = border_shares(found.model.map);
  std::string out;
  for (std::size_t s = 0; s < label_scales; ++s)
    out += fmt::format("{}{:.4f} of {:.4f}", s == 0 ? "" : ", ", found.map_figures.borders[s],
                       wanted[s]);
  return out;
}

std::string as_text(const CompositeLearnOptions& options, const CompositeFindings& found) {
  std::string out =
      fmt::format("{}: {} labels{}, {} bytes\n", options.out, found.model.labels.size(),
                  found.model.transition ? " and a transition" : "", found.bytes);
  for (std::size_t k = 0; k < found.names.size(); ++k)
    out += fmt::format("  {:<10} {} pixels, {} types\n", found.names[k], found.pixels[k],
                       found.model.labels[k].model.cliques.size());
  out +=
      fmt::format("  a synthesized map  pairs {:.3f}, borders' patterns {:.3f}, by height {:.3f}\n",
                  found.map_figures.pairs, found.map_figures.rings, found.map_figures.profile);
  out += fmt::format("  its borders    1, 2, 4, 8, 16 px apart: {}\n", border_text(found));
  out += fmt::format(
      "  colours by height, pairs far apart: {:.3f}, {:.3f} over the crop's map; {:.3f}, {:.3f} "
      "over the synthesized one\n",
      found.filled_figures.profile, found.filled_figures.far_pairs, found.made_figures.profile,
      found.made_figures.far_pairs);
  return out;
}

Json as_json(const CompositeLearnOptions& options, const CompositeFindings& found) {
  const auto layout = [](const LayoutFigures& f) {
    return Json::object()
        .add("profile", Json::number(f.profile))
        .add("far_pairs", Json::number(f.far_pairs));
  };
  Json labels = Json::array();
  for (std::size_t k = 0; k < found.names.size(); ++k)
    labels.add(Json::object()
                   .add("name", Json::text(found.names[k]))
                   .add("pixels", Json::number(static_cast<double>(found.pixels[k])))
                   .add("types", Json::number(static_cast<double>(
                                     found.model.labels[k].model.cliques.size()))));
  return Json::object()
      .add("out", Json::text(options.out))
      .add("bytes", Json::number(static_cast<double>(found.bytes)))
      .add("labels", std::move(labels))
      .add("transition", Json::boolean(found.model.transition.has_value()))
      .add("map", Json::object()
                      .add("pairs", Json::number(found.map_figures.pairs))
                      .add("rings", Json::number(found.map_figures.rings))
                      .add("profile", Json::number(found.map_figures.profile)))
      .add("filled", layout(found.filled_figures))
      .add("made", layout(found.made_figures));
}

void write_report(const CompositeLearnOptions& options, const TextureCrop& crop,
                  const LabelPicture& labels, const CompositeFindings& found) {
  Report report(options.report);
  report.section("pictures", "Crop and composite",
                 "The crop with its labels, and what is made from the model alone: over the crop's "
                 "own map, and over a synthesized one. Look at borders first: they should be as "
                 "ragged, and labels should lie as in the crop.");
  report.picture("crop", to_picture(crop.picture), "the crop");
  report.picture("labels", label_colours(labels.labels, labels.names), "its labels");
  report.next_row();
  report.picture("filled", to_picture(found.filled), "made over the crop's labels");
  report.next_row();
  report.picture("made", to_picture(found.made), "made over synthesized labels");
  report.picture("map", label_colours(found.map, found.names), "synthesized labels");
  report.section("labels", "Labels");
  ReportTable table({{"label", "label"}, {"pixels", "pixels"}, {"types", "types"}});
  for (std::size_t k = 0; k < found.names.size(); ++k)
    table.row(found.names[k], found.pixels[k], found.model.labels[k].model.cliques.size());
  report.table(table);
  report.section("distances", "Distances to the crop");
  report.table(ReportTable({{"made", ""},
                            {"profile", "colours by height", ".3f"},
                            {"far_pairs", "pairs 16–128 px apart", ".3f"}})
                   .row("over the crop's labels", found.filled_figures.profile,
                        found.filled_figures.far_pairs)
                   .row("over synthesized labels", found.made_figures.profile,
                        found.made_figures.far_pairs));
  report.section("map", "The synthesized map");
  report.table(
      ReportTable({{"pairs", "pairs", ".3f"},
                   {"rings", "borders' patterns", ".3f"},
                   {"profile", "labels by height", ".3f"}})
          .row(found.map_figures.pairs, found.map_figures.rings, found.map_figures.profile));
  report.text(
      "Borders, as the share of neighbours 1, 2, 4, 8, 16 pixels apart that differ, of the "
      "crop's: " +
      border_text(found) + ".");
  report.write({.title = "Composite texture: " + file_name(options.crop),
                .lead = fmt::format("A model of {} bytes.", found.bytes),
                .command = fmt::format(
                    "belvedere composite learn {}{} --out {}", file_name(options.crop),
                    options.labels.empty() ? "" : " --labels " + file_name(options.labels),
                    file_name(options.out))});
}

CompositeParameters parameters_of(const CompositeLearnOptions& options) {
  CompositeParameters parameters = options.composite;
  const TextureBegin begin = begin_of(options.begin);
  parameters.choose = options.begin.kind.empty();
  parameters.begin = begin.seed;
  parameters.begin_px = begin.px;
  return parameters;
}

// Names of labels that the program finds: colours that no drawing confuses.
constexpr std::array<const char*, max_labels> found_names = {
    "#0000ff", "#008000", "#808080", "#ffff00", "#ff0000", "#00ffff", "#800080", "#ffffff",
    "#000000", "#808000", "#00ff00", "#800000", "#008080", "#ff00ff", "#000080", "#c0c0c0"};

// The segments of a crop (texture/segment), at most 16, of which those too small to learn are
// joined to their neighbours. Transparent pixels take the nearest label.
LabelPicture find_labels(const TextureCrop& crop, const std::string& path) {
  Grid<float> alpha;
  if (!crop.states.empty()) {
    alpha = Grid<float>(crop.states.width(), crop.states.height());
    std::transform(crop.states.begin(), crop.states.end(), alpha.begin(),
                   [](std::uint8_t state) { return state != 0 ? 1.F : 0.F; });
  }
  const PaintingSegments segments =
      segment_painting(to_picture(crop.picture), alpha, usual_theta, path);
  const Partition groups =
      cut_tree(segments.tree, std::min(segments.groups, std::size_t{max_labels}));
  std::vector<std::uint8_t> numbers(max_labels);
  std::iota(numbers.begin(), numbers.end(), std::uint8_t{0});
  static_assert(unused_label == no_label);
  const Grid<std::uint8_t> pieces = class_mask(segments, groups, numbers);
  LabelPicture out{join_small_labels({crop.picture, crop.states, pieces, {}}), {}};
  Grid<std::uint8_t> known(out.labels.width(), out.labels.height());
  std::size_t count = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    known[i] = out.labels[i] != no_label ? 1 : 0;
    if (known[i] != 0) count = std::max(count, std::size_t{out.labels[i]} + 1);
  }
  if (count < 2)
    throw Error(ErrorKind::input, path, "no two textures are found in it that are large enough",
                fmt::format("a larger crop, at least {} pixels per side of each, or --labels",
                            min_crop_px));
  const Grid<std::int32_t> nearest = nearest_marked(known);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] == 0) out.labels[i] = out.labels[static_cast<std::size_t>(nearest[i])];
  out.names.assign(found_names.begin(), found_names.begin() + static_cast<std::ptrdiff_t>(count));
  return out;
}

int run(const CompositeLearnOptions& options) {
  if (!options.found.empty() && lower_extension(options.found) != ".png")
    throw Error(ErrorKind::usage, "--found", options.found, "a .png");
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const TextureCrop crop = read_crop(options.crop, "");
  if (crop.transparent > 0)
    progress.note(fmt::format("{} transparent pixels are left out", crop.transparent));
  const LabelPicture labels = options.labels.empty() ? find_labels(crop, options.crop)
                                                     : read_label_picture(options.labels, progress);
  if (!options.found.empty()) write_label_picture(options.found, labels.labels, labels.names);
  if (!labels.labels.same_size(crop.picture))
    throw Error(ErrorKind::input, options.labels,
                fmt::format("{} × {} pixels", labels.labels.width(), labels.labels.height()),
                fmt::format("the size of {}: {} × {}", options.crop, crop.picture.width(),
                            crop.picture.height()));
  CompositeFindings found;
  found.names = labels.names;
  for (std::size_t k = 0; k < labels.names.size(); ++k)
    found.pixels.push_back(static_cast<std::size_t>(
        std::count(labels.labels.begin(), labels.labels.end(), static_cast<std::uint8_t>(k))));
  found.model = learn_composite({crop.picture, crop.states, labels.labels, labels.names},
                                parameters_of(options), progress);
  const std::string text = composite_text(found.model);
  found.bytes = text.size();
  write_text_file(options.out, text);

  found.map =
      make_label_map(found.model.map, crop.picture.width(), crop.picture.height(), {}, progress);
  found.map_figures = label_map_figures(found.model.map, found.map);
  found.filled = make_composite(
      found.model,
      options.labels.empty() ? labels.labels : read_drawn_labels(options.labels, found.names), {},
      progress);
  found.made = make_composite(found.model, found.map, {}, progress);
  found.filled_figures = layout_figures(crop.picture, found.filled);
  found.made_figures = layout_figures(crop.picture, found.made);
  if (!options.report.empty()) write_report(options, crop, labels, found);
  progress.end();
  print_result(options, as_json(options, found), as_text(options, found));
  return 0;
}

}  // namespace

Action add_composite_learn(CommandOptions& command) {
  const auto options = std::make_shared<CompositeLearnOptions>();
  command
      .add_option("CROP PICTURE", options->crop,
                  "A painting, or a part of one, that shows several textures")
      .required()
      .files(FileUse::input);
  command
      .add_option("--labels PICTURE", options->labels,
                  "Label image of its size in 2 to 16 flat colours, or of grey numbers; number 255 "
                  "is left out.\n"
                  "Each colour is one texture, 48 pixels per side or more. Default: segments that "
                  "the program finds")
      .files(FileUse::input);
  command
      .add_option("--found PICTURE", options->found,
                  "Without --labels: also writes the labels found, to be edited and passed to it")
      .files(FileUse::writes)
      .excludes({command.option("--labels")});
  command.add_option("--out COMPOSITE", options->out, "The model: a text file of about 15 KB")
      .required()
      .files(FileUse::writes);
  command
      .add_option("--types N", options->composite.learn.types,
                  "Maximum number of statistics per texture, 16 to 200. Default: 40")
      .range(16, 200);
  add_begin_options(command, options->begin,
                    "Initial noise of all textures, which determines the shape of their dabs: "
                    "white, streaks or discs.\n"
                    "Default: for each the noise that comes closest to the crop");
  add_run_options(command, *options, "bit");
  command
      .add_option("--report FOLDER", options->report,
                  "Writes a page with the crop beside the composite, and all figures")
      .files(FileUse::folder);
  command.footer(
      "One texture model of a picture with sky above water beside rock would mix them all. A "
      "composite learns each texture by itself, the paint\n"
      "along their borders, and the arrangement of the labels: what lies side by side, what above "
      "what, and the shape of borders.\n"
      "\n"
      "  belvedere composite learn coast.png --found coast_labels.png --out coast.composite\n"
      "  belvedere composite learn coast.png --labels coast_labels.png --out coast.composite "
      "--report coast_report");
  return [options] { return run(*options); };
}

namespace {

struct CompositeMakeOptions : RunOptions {
  std::string model, labels, map, out, report;
  std::vector<int> size;
  std::vector<int> window;
  bool strips = false;
  std::uint64_t seed = 1;
};

// The requested window, within the map.
PixelRect window_of(const std::vector<int>& w, const Grid<std::uint8_t>& labels) {
  const std::int64_t right = std::int64_t{w[0]} + w[2];
  const std::int64_t below = std::int64_t{w[1]} + w[3];
  if (w[0] < 0 || w[1] < 0 || w[2] < 1 || w[3] < 1 || right > labels.width() ||
      below > labels.height())
    throw Error(
        ErrorKind::usage, "--window",
        fmt::format("{} × {} pixels at {}, {}", w[2], w[3], w[0], w[1]),
        fmt::format("a part of the map of {} × {} pixels", labels.width(), labels.height()));
  return {w[0], w[1], w[0] + w[2], w[1] + w[3]};
}

// The label map beside the result, and the share of each label.
void write_make_report(const CompositeMakeOptions& options, const std::vector<std::string>& names,
                       const Grid<std::uint8_t>& labels, const Grid<Rgb8>& made) {
  const std::string file = file_name(options.model);
  ReportTable table({{"label", "label"}, {"pixels", "pixels"}});
  for (std::size_t k = 0; k < names.size(); ++k)
    table.row(names[k], std::count(labels.begin(), labels.end(), static_cast<std::uint8_t>(k)));
  std::string asked = options.labels.empty()
                          ? fmt::format("--size {}", fmt::join(options.size, "x"))
                          : fmt::format("--labels {}", file_name(options.labels));
  if (!options.window.empty()) asked += fmt::format(" --window {}", fmt::join(options.window, ","));
  Report report(options.report);
  report.section("pictures", "Pictures",
                 "The label map on the left, the result on the right. Look at borders first: they "
                 "should be as ragged as in a painting.");
  report.picture("labels", label_colours(labels, names),
                 options.labels.empty() ? "synthesized labels" : "drawn labels");
  report.picture("made", to_picture(made), fmt::format("made with seed {}", options.seed));
  report.section("figures", "Figures");
  report.table(table);
  report.write({.title = "Composite texture: " + file,
                .lead = fmt::format("{} × {} pixels of {} textures.", made.width(), made.height(),
                                    names.size()),
                .command = fmt::format("belvedere composite make {} {} --seed {} --out {}", file,
                                       asked, options.seed, file_name(options.out))});
}

constexpr int max_shown_px = 4096;  // in the report, of a picture in strips

int run_make(const CompositeMakeOptions& options) {
  if (options.size.empty() == options.labels.empty())
    throw Error(ErrorKind::usage, "command line",
                options.size.empty() ? "neither --size nor --labels is given"
                                     : "both --size and --labels are given",
                "one of them: a label image has its own size");
  check_texture_name(options.out);
  if (!options.map.empty() && lower_extension(options.map) != ".png")
    throw Error(ErrorKind::usage, "--map", options.map, "a .png");
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const CompositeModel model = read_composite(options.model);
  std::vector<std::string> names;
  for (const CompositeLabel& label : model.labels) names.push_back(label.name);
  TextureParameters parameters;
  parameters.seed = options.seed;
  const Grid<std::uint8_t> labels =
      options.labels.empty() ? make_label_map(model.map, options.size[0], options.size[1],
                                              {.seed = options.seed}, progress)
                             : read_drawn_labels(options.labels, names, progress);
  const PixelRect all{0, 0, labels.width(), labels.height()};
  const PixelRect window = options.window.empty() ? all : window_of(options.window, labels);
  const bool strips =
      options.strips ||
      (options.window.empty() && std::int64_t{all.width()} * all.height() > max_texture_pixels);
  const std::string note = fmt::format("{} seed {}", file_name(options.model), options.seed);
  Grid<Rgb8> made;  // in strips: the first one, as far as the report shows it
  if (strips) {
    const CompositeRecord record = record_composite(model, parameters, progress);
    write_texture_strips(options.out, window.width(), window.height(), note, [&](PixelRect strip) {
      Grid<Rgb8> rows = make_composite_window(
          model, record, labels, moved(strip, window.x0, window.y0), parameters, progress);
      if (made.empty())
        made = part_of(rows, {0, 0, std::min(rows.width(), max_shown_px), rows.height()});
      return rows;
    });
  } else {
    made = options.window.empty()
               ? make_composite(model, labels, parameters, progress)
               : make_composite_window(model, record_composite(model, parameters, progress), labels,
                                       window, parameters, progress);
    write_texture(options.out, made, note);
  }
  if (!options.map.empty()) write_label_picture(options.map, labels, names);
  if (!options.report.empty())
    write_make_report(
        options, names,
        part_of(labels, moved({0, 0, made.width(), made.height()}, window.x0, window.y0)), made);
  progress.end();
  print_result(options,
               Json::object()
                   .add("out", Json::text(options.out))
                   .add("width", Json::number(window.width()))
                   .add("height", Json::number(window.height())),
               fmt::format("{}: {}×{} pixels\n", options.out, window.width(), window.height()));
  return 0;
}

}  // namespace

Action add_composite_make(CommandOptions& command) {
  const auto options = std::make_shared<CompositeMakeOptions>();
  command
      .add_option("COMPOSITE COMPOSITE", options->model,
                  "A model written by `belvedere composite learn`")
      .required()
      .files(FileUse::input);
  command.add_option("--out PICTURE", options->out, "The picture: .png or .tif")
      .required()
      .files(FileUse::writes);
  command
      .add_option("--size WxH", options->size,
                  "Width and height, in pixels; the label map is synthesized too")
      .list('x', 2)
      .range(1, 1 << 20);
  command
      .add_option("--labels PICTURE", options->labels,
                  "Instead: a label map, drawn in the colours (or numbers) of the crop's labels")
      .files(FileUse::input);
  command
      .add_option("--window X,Y,W,H", options->window,
                  "Only this part of the map: column, row, width and height. Windows fit together "
                  "to the pixel, in any order; they are\n"
                  "parts of the window of the whole map, which differs slightly from a picture "
                  "without --window")
      .list(',', 4);
  command.add_flag("--strips", options->strips,
                   "Makes the picture as windows do and writes it in strips of 512 rows, in little "
                   "memory. Default: over 64 Mpixels");
  command
      .add_option("--map PICTURE", options->map,
                  "Also writes the labels in their colours, to be edited and passed to --labels")
      .files(FileUse::writes);
  command.add_option("--seed N", options->seed, "Random seed. Default: 1");
  add_run_options(command, *options);
  command
      .add_option("--report FOLDER", options->report,
                  "Writes a page with the labels beside the result")
      .files(FileUse::folder);
  command.footer(
      "  belvedere composite make coast.composite --size 1600x1000 --map labels.png --out "
      "another_coast.png\n"
      "  belvedere composite make coast.composite --labels my_labels.png --out my_coast.png\n"
      "  belvedere composite make coast.composite --labels large.png --window 4096,0,2048,2048 "
      "--out piece.tif");
  return [options] { return run_make(*options); };
}

}  // namespace belvedere::tools
