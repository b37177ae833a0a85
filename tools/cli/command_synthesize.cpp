#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <tuple>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/image/provenance.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synthesize.h"
#include "tools/cli/commands.h"
#include "tools/cli/synthesis_files.h"
#include "tools/cli/synthesis_sweep.h"
#include "tools/cli/synthesize_replay.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/synthesis_report_page.h"

namespace belvedere::tools {
namespace {

struct SynthesizeOptions : RunOptions {
  SynthesisFiles files;
  std::vector<std::tuple<std::string, std::string, std::string, double>> guides;
  std::vector<std::pair<int, int>> fallback;
  std::string out;
  bool force = false;
  std::string match;
  std::string replay;
  std::string report;
  std::vector<std::string> sweeps;
  SynthesisParameters parameters;
  std::vector<std::tuple<int, int, double>> class_dissimilarity;
  int memory_mib = 0;
};

void check_picture_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw Error(ErrorKind::usage, "--out " + path,
                "is not the name of a picture that can be written",
                ".png (8 bit) or .tif (16 bit)");
}

// Without folders: the same files give the same header wherever they are.
FileNotes make_notes(const SynthesizeOptions& options) {
  std::map<std::string, std::string> inputs;
  const auto add = [&](const std::string& path) { inputs[file_name(path)] = path; };
  for (const std::string& picture : options.files.pictures) add(picture);
  for (const auto& [source, target] : options.files.labels) {
    add(source);
    add(target);
  }
  for (const std::string& mask : options.files.exclusions)
    if (mask != "-") add(mask);
  for (const GuidePair& guide : options.files.guides) {
    add(guide.source);
    add(guide.target);
  }
  FileNotes notes = to_notes(make_provenance("", inputs));
  std::string weights;
  std::string around = options.parameters.surroundings_of;
  for (const auto& [a, b, value] : options.class_dissimilarity)
    around += fmt::format(" {}/{} {}", a, b, value);
  if (around != SynthesisParameters().surroundings_of) notes["belvedere:surroundings"] = around;
  if (options.parameters.distance != "ssd")
    notes["belvedere:patch_distance"] = options.parameters.distance;
  for (const GuidePair& guide : options.files.guides)
    weights += fmt::format(" {} {}", guide.name, guide.weight);
  notes["belvedere:synthesis"] = fmt::format(
      "seed {} levels {} reuse {} copy_cap {} neighbourhood {} surroundings {} harmonize {} "
      "weights{}",
      options.parameters.seed, options.parameters.levels, options.parameters.reuse,
      options.parameters.copy_cap, options.parameters.neighbourhood,
      options.parameters.surroundings, options.files.harmonize, weights);
  return notes;
}

std::vector<MatchedPicture> matched_pictures(const SynthesisInputs& inputs) {
  std::vector<MatchedPicture> pictures;
  for (const Exemplar& exemplar : inputs.exemplars)
    pictures.push_back({exemplar.name, exemplar.picture.width(), exemplar.picture.height()});
  return pictures;
}

std::string class_name_of(std::uint8_t label) { return fmt::format("class {}", label); }

// The request as it would be typed, without folders: the same on every machine.
std::string describe_command(const SynthesizeOptions& options) {
  std::string out = "belvedere synthesize";
  for (std::size_t i = 0; i < options.files.pictures.size(); ++i)
    out += fmt::format(" --picture {} --label {} {}", file_name(options.files.pictures[i]),
                       file_name(options.files.labels[i].first),
                       file_name(options.files.labels[i].second));
  for (const GuidePair& guide : options.files.guides)
    out += fmt::format(" --guide {} {} {} {}", guide.name, file_name(guide.source),
                       file_name(guide.target), guide.weight);
  for (const std::string& mask : options.files.exclusions)
    out += fmt::format(" --exclude {}", file_name(mask));
  if (options.files.harmonize != "off")
    out += fmt::format(" --harmonize {}", options.files.harmonize);
  for (const auto& [from, to] : options.fallback) out += fmt::format(" --fallback {} {}", from, to);
  const SynthesisParameters& p = options.parameters;
  if (p.distance != "ssd") out += " --patch-distance " + p.distance;
  if (p.surroundings_of != "commonest") out += " --surroundings-of " + p.surroundings_of;
  for (const auto& [a, b, value] : options.class_dissimilarity)
    out += fmt::format(" --class-dissimilarity {} {} {}", a, b, value);
  return out + fmt::format(
                   " --seed {} --levels {} --reuse {} --copy-cap {} --neighbourhood {} "
                   "--surroundings {} --out {}",
                   p.seed, p.levels, p.reuse, p.copy_cap, p.neighbourhood, p.surroundings,
                   file_name(options.out));
}

// Messages and --fallback refer to labels by number.
void note_colours(const std::vector<Rgb8>& colours, Progress& progress) {
  std::string list;
  for (std::size_t k = 0; k < colours.size(); ++k)
    list += fmt::format("{} {} is #{:02x}{:02x}{:02x}", k == 0 ? "" : ",", k, colours[k][0],
                        colours[k][1], colours[k][2]);
  if (!list.empty()) progress.note("labels by colour:" + list);
}

void print_result(const SynthesizeOptions& options, int width, int height, std::size_t empty,
                  Progress& progress) {
  if (empty > 0)
    progress.note(fmt::format("{} pixels stay black: nothing may be copied there", empty));
  if (!options.json) return;
  print_out(Json::object()
                .add("out", Json::text(options.out))
                .add("match", Json::text(options.match))
                .add("width", Json::number(width))
                .add("height", Json::number(height))
                .add("pixels_without_texel", Json::number(static_cast<double>(empty)))
                .str() +
            "\n");
}

int run_replay(const SynthesizeOptions& options) {
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const ReplayResult result =
      replay_layers({options.replay, options.files.pictures, options.out}, progress);
  print_result(options, result.width, result.height, result.without_texel, progress);
  return 0;
}

int run_sweep(const SynthesizeOptions& options, const SynthesisInputs& inputs, Progress& progress) {
  std::vector<std::string> guides;
  for (const Guide& guide : inputs.target.guides) guides.push_back(guide.name);
  std::vector<SweepAxis> axes;
  std::string command = describe_command(options);
  for (const std::string& sweep : options.sweeps) {
    axes.push_back(parse_sweep(sweep, guides));
    command += " --sweep " + sweep;
  }
  if (axes.size() > 2)
    throw Error(ErrorKind::usage, "--sweep", fmt::format("is given {} times", axes.size()),
                "once or twice");
  if (axes.size() == 2 && axes[0].name == axes[1].name)
    throw Error(ErrorKind::usage, "--sweep", fmt::format("{} twice", axes[0].name),
                "two different ones");
  const int count = write_sweep(
      options.out,
      {.title = std::filesystem::path(options.out).lexically_normal().filename().string(),
       .command = command,
       .axes = axes,
       .exemplars = inputs.exemplars,
       .target = inputs.target,
       .parameters = options.parameters},
      progress);
  if (options.json)
    print_out(Json::object()
                  .add("out", Json::text(options.out))
                  .add("syntheses", Json::number(count))
                  .str() +
              "\n");
  return 0;
}

int run(SynthesizeOptions& options) {
  const MemoryLimit memory(static_cast<std::uint64_t>(options.memory_mib) << 20);
  if (!options.replay.empty()) {
    file_guard().writes(options.out, "--out");
    return run_replay(options);
  }
  if (options.sweeps.empty()) {
    check_picture_name(options.out);
    file_guard().writes(options.out, "--out");
  } else {
    const std::string extension = lower_extension(options.out);
    if (extension == ".png" || extension == ".tif" || extension == ".tiff" || extension == ".exr" ||
        extension == ".jpg")
      throw Error(ErrorKind::usage, "--out " + options.out, "is not the name of a folder",
                  "with --sweep, a folder for all results");
    file_guard().writes_into(options.out, "--out", options.force);
  }
  for (const auto& [name, source, target, weight] : options.guides)
    options.files.guides.push_back({name, source, target, weight});
  for (const auto& [from, to] : options.fallback) {
    if (from < 0 || from >= unused_label || to < 0 || to >= unused_label || from == to)
      throw Error(ErrorKind::usage, fmt::format("--fallback {} {}", from, to),
                  "is not a pair of labels", "two different ones, 0 … 254");
    options.parameters.fallback[static_cast<std::uint8_t>(from)] = static_cast<std::uint8_t>(to);
  }
  for (const auto& [a, b, value] : options.class_dissimilarity) {
    if (a < 0 || a >= unused_label || b < 0 || b >= unused_label || a == b)
      throw Error(ErrorKind::usage, fmt::format("--class-dissimilarity {} {}", a, b),
                  "is not a pair of labels", "two different ones, 0 … 254");
    options.parameters
        .class_dissimilarity[{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)}] = value;
  }

  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  SynthesisInputs inputs = read_synthesis(options.files, progress);
  options.parameters.weights = inputs.weights;
  note_colours(inputs.label_colours, progress);
  const FileNotes notes = make_notes(options);
  const std::string scarcity = describe_scarcity(
      class_texels(inputs.exemplars, inputs.target.label, options.parameters.fallback),
      class_name_of);
  if (!scarcity.empty()) progress.note(scarcity);
  if (!options.sweeps.empty()) return run_sweep(options, inputs, progress);
  const MatchField matches =
      synthesize(inputs.exemplars, inputs.target, options.parameters, progress);

  progress.begin("writing", 0.0);
  std::vector<const Grid<glm::vec3>*> layers;
  for (const Grid<glm::vec3>& picture : inputs.pictures) layers.push_back(&picture);
  const Grid<glm::vec3> picture =
      replay(matches, layers, Grid<glm::vec3>());  // black where nothing could be copied
  const PictureFileOptions file{.icc_profile = inputs.profile, .notes = notes};
  if (lower_extension(options.out) == ".png")
    write_png8(options.out, picture, file);
  else
    write_tiff16(options.out, picture, file);
  if (!options.match.empty())
    write_matches(options.match, matches, matched_pictures(inputs), notes);
  if (!options.report.empty())
    write_synthesis_report(options.report,
                           {.title = file_name(options.out),
                            .command = describe_command(options),
                            .exemplars = inputs.exemplars,
                            .target = inputs.target,
                            .parameters = options.parameters,
                            .matches = matches,
                            .class_name = class_name_of},
                           progress);
  const auto empty = std::count_if(matches.begin(), matches.end(),
                                   [](const Match& m) { return m.exemplar == Match::none; });
  print_result(options, picture.width(), picture.height(), static_cast<std::size_t>(empty),
               progress);
  return 0;
}

}  // namespace

Action add_synthesize(CommandOptions& command) {
  const auto options = std::make_shared<SynthesizeOptions>();
  SynthesisParameters& parameters = options->parameters;
  command.add_force(options->force);
  command
      .add_option("--picture STYLE", options->files.pictures,
                  "The painting (PNG, TIFF, JPEG); may be repeated")
      .required()
      .repeated();
  const Option label =
      command
          .add_option("--label STYLE TARGET", options->files.labels,
                      "Label images of the painting and of the target: grey, one number per class, "
                      "255 is never used, or drawn in flat colours; one for each --picture")
          .takes("two files, of the painting and of the target")
          .repeated();
  const Option guide = command
                           .add_option("--guide NAME STYLE TARGET WEIGHT", options->guides,
                                       "A further guide: name, grey image of the painting, of the "
                                       "target, and weight 0…100; may be repeated")
                           .takes("a name, two files and a weight")
                           .repeated();
  command
      .add_option("--out FILE", options->out,
                  "The result: .png (8 bit) or .tif (16 bit); with --replay also .exr")
      .required()
      .files(FileUse::later);
  const Option match =
      command
          .add_option(
              "--match FILE", options->match,
              "Also writes where each pixel was copied from: OpenEXR with channels exemplar, x, y")
          .files(FileUse::writes);
  const Option report =
      command
          .add_option("--report DIR", options->report,
                      "Also writes a folder with index.html: quality of the result, origin of its "
                      "pixels, cost of each guide, worst places")
          .files(FileUse::folder);
  command
      .add_option(
          "--exclude MASK", options->files.exclusions,
          "Grey image of the painting's size: pixels that are not black are never copied "
          "(lettering, frames, figures); the first belongs to the first --picture …, - is none")
      .repeated();
  command
      .add_option("--harmonize HOW", options->files.harmonize,
                  "Matches the colours of several paintings first: label by label to their common "
                  "colours or to the first; or by\n"
                  "regions of similar colour, ignoring labels, to the first")
      .show_default()
      .one_of({"off", "common", "first", "regions"});
  command
      .add_option("--fallback LABEL LABEL", options->fallback,
                  "Copies the second label's texture where the first has none")
      .repeated();
  command.add_option("--seed N", parameters.seed, "Random seed of the result").show_default();
  command.add_option("--levels N", parameters.levels, "Levels from coarse to fine")
      .show_default()
      .range(1, 8);
  command.add_option("--reuse X", parameters.reuse, "Strength of the penalty on repetition")
      .show_default()
      .range(0.0, 10.0);
  command
      .add_option("--copy-cap N", parameters.copy_cap,
                  "Largest piece copied whole, in pixels of area")
      .show_default()
      .range(16, 100000);
  command
      .add_option("--neighbourhood N", parameters.neighbourhood,
                  "Side of the patches that are compared, in pixels: 3, 5, 7, 9 or 11")
      .show_default()
      .one_of({3, 5, 7, 9, 11});
  command
      .add_option(
          "--patch-distance WHICH", parameters.distance,
          "How patches are compared: squared differences of colour, or the same without the "
          "difference of their mean lightness")
      .show_default()
      .one_of({"ssd", "normalized"});
  command
      .add_option("--surroundings X", parameters.surroundings,
                  "Weight of the classes around a pixel")
      .show_default()
      .range(0.0, 100.0);
  command
      .add_option("--surroundings-of WHICH", parameters.surroundings_of,
                  "Which of the surrounding classes count: the commonest, or all by their shares")
      .show_default()
      .one_of({"commonest", "all"});
  command
      .add_option("--class-dissimilarity LABEL LABEL X", options->class_dissimilarity,
                  "Dissimilarity of two labels as surroundings: 0 (interchangeable) to 1, the "
                  "default; may be repeated")
      .repeated();
  const Option replay = command
                            .add_option("--replay MATCH", options->replay,
                                        "Copies other layers of the same paintings, one --picture "
                                        "each, exactly as a --match file records; needs no labels")
                            .excludes({label, guide, match, report});
  command
      .add_option(
          "--sweep NAME=V,V…", options->sweeps,
          "Tries several values of seed, levels, reuse, copy-cap, neighbourhood, surroundings or "
          "of a guide's weight; --out is then a folder. Give it twice to vary two at once")
      .repeated()
      .excludes({match, report, replay});
  add_run_options(command, *options);
  command
      .add_option("--memory MIB", options->memory_mib,
                  "Memory for pictures; 0, the default, is three quarters of the machine's")
      .range(0, 1 << 30);
  command.footer(
      "  belvedere synthesize --picture style.png --label style_class.png target_class.png \\\n"
      "    --guide altitude style_alt.png target_alt.png 1.0 --out out.png --match match.exr\n"
      "\n"
      "With several paintings, the first --label and the first --guide of a name belong to the "
      "first\n"
      "--picture, the second to the second, and so on; they all name the same target.\n"
      "\n"
      "  belvedere synthesize --replay match.exr --picture style_16bit.tif --out out_16bit.tif\n"
      "\n"
      "copies another layer of the same painting (its 16-bit scan, its guidance.exr) at full\n"
      "precision; the layer has the painting's size.\n"
      "\n"
      "  belvedere synthesize --picture style.png --label style_class.png target_class.png \\\n"
      "    --guide altitude style_alt.png target_alt.png 1.0 --sweep altitude=0.3,1,3 --sweep "
      "reuse=0,1 --out sweep\n"
      "\n"
      "puts six results side by side: sweep/sheet.png, and their figures in sweep/index.html.");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
