#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "base/error.h"
#include "base/text/text_encoding.h"
#include "renderer/exemplar/texture_models.h"
#include "renderer/pipeline/copy_plan.h"
#include "renderer/pipeline/scene_check.h"
#include "texture/synthesis/match_cost.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/synthesis_files.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/exemplar_verdict.h"

namespace belvedere::tools {
namespace {

struct ExemplarCheckOptions {
  SceneOptions scene;
  std::vector<std::string> pictures;
  std::vector<std::string> labels;
  std::vector<std::tuple<std::string, std::string>> guides;
  std::string target;
  std::vector<std::tuple<std::string, std::string>> target_guides;
  std::vector<std::pair<int, int>> fallback;
  std::string report;
};

// The data to check, from a scene or from files.
struct Subject {
  std::vector<Exemplar> exemplars;
  std::vector<ExemplarFindings::Model> models;
  GuideStack target;                                    // without labels: not known
  double pixels_of_target = 1;                          // that each pixel of `target` represents
  std::vector<std::pair<std::string, double>> weights;  // of guides; absent: 1
  std::map<std::uint8_t, std::uint8_t> fallback;
};

void check_scene_or_files(const ExemplarCheckOptions& options) {
  const bool of_files = !options.pictures.empty();
  const bool more = !options.labels.empty() || !options.guides.empty() || !options.target.empty() ||
                    !options.target_guides.empty();
  if (!of_files && more)
    throw Error(ErrorKind::usage, "command line", "--picture is missing",
                "at least one, or a scene");
  for (const char* extension : {".png", ".tif", ".tiff", ".jpg", ".jpeg", ".exr"})
    if (lower_extension(options.scene.scene) == extension)
      throw Error(ErrorKind::usage, options.scene.scene, "is a picture, not a scene",
                  "a scene file, or --picture " + options.scene.scene + " with --label");
  if (of_files && !options.scene.scene.empty())
    throw Error(ErrorKind::usage, "command line", "both a scene and files of a painting are given",
                "either a scene, or --picture with --label");
}

Subject from_files(const ExemplarCheckOptions& options) {
  SynthesisFiles files;
  files.pictures = options.pictures;
  for (const std::string& label : options.labels) files.labels.emplace_back(label, options.target);
  for (const auto& [name, source] : options.guides) {
    std::string target;
    for (const auto& [target_name, file] : options.target_guides)
      if (target_name == name) target = file;
    files.guides.push_back({name, source, target, 1.0});
  }
  for (const auto& [name, file] : options.target_guides) {
    if (options.target.empty())
      throw Error(ErrorKind::usage, "command line",
                  fmt::format("--target-guide {} is given without --target", name),
                  "--target LABELS");
    if (std::none_of(files.guides.begin(), files.guides.end(),
                     [&, target_guide = name](const GuidePair& guide) {
                       return guide.name == target_guide;
                     }))
      throw Error(ErrorKind::usage, "command line",
                  fmt::format("--target-guide {} is given without --guide {}", name, name),
                  "the same guide of the painting");
  }
  SynthesisInputs inputs = read_synthesis(files);
  Subject subject;
  subject.exemplars = std::move(inputs.exemplars);
  subject.target = std::move(inputs.target);
  for (const auto& [from, to] : options.fallback)
    subject.fallback[to_label("--fallback", from)] = to_label("--fallback", to);
  return subject;
}

Subject from_scene(const ExemplarCheckOptions& options, Progress& progress) {
  const LoadedScene scene = load(options.scene);
  SceneExemplars found = look_at_exemplars(scene, progress, make_cache(options.scene));
  Subject subject;
  subject.target = std::move(found.view);
  subject.pixels_of_target = found.pixels_of_picture;
  for (const auto& [from, to] : with_stand_ins(scene.scene.synthesis.fallback))
    subject.fallback[static_cast<std::uint8_t>(from)] = static_cast<std::uint8_t>(to);
  for (const SceneTextureModel& model : read_texture_models(scene)) {
    ExemplarFindings::Model& told = subject.models.emplace_back();
    told.name = model.name;
    told.always = model.always;
    for (const LandCoverClass id : model.serves)
      told.labels.push_back(static_cast<std::uint8_t>(id));
  }
  for (PaintedExemplar& painted : found.exemplars)
    subject.exemplars.push_back(std::move(painted.exemplar));
  subject.weights = fit_to_paintings(scene.scene, subject.exemplars, progress).weights;
  for (std::size_t e = 0; e < subject.exemplars.size(); ++e)
    subject.exemplars[e].picture = to_rgb8(
        found.exemplars[e].picture);  // the painting itself, not that which seams are measured on
  return subject;
}

// The target's need of the classes that pixels copy from.
void ask(const Subject& subject, GuideStack& asked, ExemplarFindings& findings) {
  findings.target_known = !subject.target.label.empty();
  if (!findings.target_known) return;
  asked.label = serving_labels(subject.exemplars, subject.target.label, subject.fallback);
  const auto scaled = [&](std::size_t pixels) {
    return static_cast<double>(pixels) * subject.pixels_of_target;
  };
  for (ClassTexels available :
       class_texels(subject.exemplars, subject.target.label, subject.fallback)) {
    available.pixels = static_cast<std::size_t>(std::llround(scaled(available.pixels)));
    constexpr int reach = 4;  // levels within which a texel has a pixel's value
    NeededClassTexels& demand = findings.demands.emplace_back();
    demand.available = available;
    for (GuideFit& fit : fit_guides(subject.exemplars, asked, available.label, reach)) {
      double weight = 1.0;
      for (const auto& [name, value] : subject.weights)
        if (name == fit.name) weight = value;
      const double cost = static_cast<double>(guide_cost(1, weight)) * fit.square;
      if (weight > 0.0) demand.guides.push_back({std::move(fit), cost});
    }
    std::stable_sort(demand.guides.begin(), demand.guides.end(),
                     [](const auto& a, const auto& b) { return a.cost > b.cost; });
  }
  std::array<std::size_t, 256> without{};
  std::map<std::pair<std::uint8_t, std::uint8_t>, std::size_t> stand_ins;
  for (std::size_t i = 0; i < asked.label.size(); ++i) {
    const std::uint8_t own = subject.target.label[i];
    if (asked.label[i] == unused_label)
      ++without[own];
    else if (asked.label[i] != own)
      ++stand_ins[{own, asked.label[i]}];
  }
  for (const auto& [pair, pixels] : stand_ins)
    findings.stand_ins.push_back({pair.first, pair.second, std::round(scaled(pixels))});
  for (std::size_t label = 0; label < unused_label; ++label)
    if (without[label] > 0)
      findings.missing.emplace_back(static_cast<std::uint8_t>(label),
                                    std::round(scaled(without[label])));
}

// As typed on the command line, without folders.
std::string describe_command(const ExemplarCheckOptions& options) {
  std::string out = "belvedere exemplar check";
  if (!options.scene.scene.empty()) out += " " + file_name(options.scene.scene);
  for (const std::string& setting : options.scene.files.settings) out += " --set " + setting;
  for (std::size_t i = 0; i < options.pictures.size(); ++i)
    out += fmt::format(" --picture {} --label {}", file_name(options.pictures[i]),
                       file_name(options.labels[i]));
  for (const auto& [guide, file] : options.guides)
    out += fmt::format(" --guide {} {}", guide, file_name(file));
  if (!options.target.empty()) out += " --target " + file_name(options.target);
  for (const auto& [guide, file] : options.target_guides)
    out += fmt::format(" --target-guide {} {}", guide, file_name(file));
  for (const auto& [from, to] : options.fallback) out += fmt::format(" --fallback {} {}", from, to);
  return out;
}

int run(const ExemplarCheckOptions& options) {
  const bool of_files = !options.pictures.empty();
  check_scene_or_files(options);
  const RunLimits limits(make_run(options.scene));
  TerminalProgress progress(options.scene.quiet);
  if (of_files) progress.begin("reading", 0.0);
  const Subject subject = of_files ? from_files(options) : from_scene(options, progress);
  progress.begin("measuring", static_cast<double>(subject.exemplars.size()));
  ExemplarFindings findings;
  findings.models = subject.models;
  findings.explained = explain_paint(subject.exemplars);
  for (const Exemplar& exemplar : subject.exemplars) {
    findings.paintings.push_back({exemplar.name, exemplar.picture.width(),
                                  exemplar.picture.height(), survey_exemplar(exemplar)});
    progress.advance(1.0);
  }
  if (of_files) {
    findings.name = [](std::uint8_t label) { return fmt::format("class {}", label); };
    findings.value = [](const std::string&, int value) { return fmt::format("{}", value); };
  } else {
    findings.name = [](std::uint8_t label) {
      return label < land_cover_class_count
                 ? std::string(class_name(static_cast<LandCoverClass>(label)))
                 : fmt::format("class {}", label);
    };
    findings.value = [](const std::string& guide, int value) {
      return guide == "altitude" ? fmt::format("{} m", 20 * value)
                                 : fmt::format("{}", value);  // steps of make_guide_stack
    };
  }
  GuideStack asked = subject.target;
  ask(subject, asked, findings);
  if (!options.report.empty())
    write_exemplar_report(options.report, subject.exemplars, asked, findings,
                          describe_command(options));
  progress.end();
  print_out(options.scene.json ? findings_json(findings).str() + "\n" : findings_text(findings));
  return 0;
}

}  // namespace

Action add_exemplar_check(CommandOptions& command) {
  const auto options = std::make_shared<ExemplarCheckOptions>();
  add_scene_options(command, options->scene);
  command
      .add_option("--picture FILE", options->pictures,
                  "Instead of a scene: a painting (PNG, TIFF, JPEG); may be repeated")
      .repeated();
  command
      .add_option(
          "--label FILE", options->labels,
          "Its label image: grey, one number per class, 255 is never used; one for each --picture")
      .repeated();
  command
      .add_option("--guide NAME FILE", options->guides,
                  "A guide of it: name (altitude is evaluated) and grey image; may be repeated")
      .repeated();
  command.add_option(
      "--target FILE", options->target,
      "Label image of the picture to be made: checks whether there is enough texture for it");
  command
      .add_option("--target-guide NAME FILE", options->target_guides,
                  "A guide of the picture to be made")
      .repeated();
  command
      .add_option("--fallback LABEL LABEL", options->fallback,
                  "Copies the second label's texture where the first has none")
      .repeated();
  command
      .add_option("--report DIR", options->report,
                  "Also writes a folder with index.html: the paintings, a swatch of each class, "
                  "coverage charts")
      .files(FileUse::folder);
  command.footer(
      "For each class: number of texels, and how many of them lie well inside; how many pixels "
      "they serve before strokes\n"
      "repeat; sharpness of its paint and length of its strokes; altitudes at which it was "
      "painted; and whether left and\n"
      "right were painted alike (0 … 2; chance is the difference of random halves).\n"
      "Of a scene that copies nothing it checks the sheet that the program would paint for it.\n"
      "\n"
      "  belvedere exemplar check scenes/karwendel.toml --data ../data\n"
      "  belvedere exemplar check --picture style.png --label style_class.png --guide altitude "
      "style_alt.png \\\n"
      "    --target target_class.png --target-guide altitude target_alt.png");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
