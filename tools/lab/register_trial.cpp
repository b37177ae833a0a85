// How well paintings are registered to their terrain: secret scenes of four regions, pairs with
// noise and wrong ones, and where 200 other pixels come to lie. Prints a line per run and a table.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/random.h"
#include "base/statistics.h"
#include "renderer/exemplar/classes_by_paint.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/register/register_by_paint.h"
#include "renderer/register/registered_ground.h"
#include "renderer/register/registered_guidance.h"
#include "terrain/register/registration.h"
#include "tools/lab/secret_scene.h"
#include "tools/options/options.h"

namespace belvedere::bench {
namespace {

// How well the classes of a painting agree with the true ones: mean intersection over union of
// those on more than half a percent of the ground, and the share of ground with the right one.
struct ClassAgreement {
  double iou = 0.0;
  double right = 0.0;
};

struct CoverTrial {
  PainterLines lines;             // found
  ClassAgreement rules, painted;  // with the lines of the climate: rules alone, and the paint
  ClassAgreement own_rules, own;  // with the painter's own lines
};

ClassAgreement agreement(const Grid<std::uint8_t>& classes, const GuidanceBuffers& truth) {
  constexpr double min_share = 0.005;
  std::array<double, 256> both{}, drawn{}, found{};
  double ground = 0.0, right = 0.0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (truth.is_sky(i)) continue;
    const auto id = static_cast<std::uint8_t>(truth.land_cover[i]);
    ++ground;
    ++drawn[id];
    ++found[classes[i]];
    if (classes[i] != id) continue;
    ++both[id];
    ++right;
  }
  ClassAgreement out{0.0, right / ground};
  double counted = 0.0;
  for (std::size_t id = 0; id < drawn.size(); ++id) {
    if (drawn[id] < min_share * ground) continue;
    out.iou += both[id] / (drawn[id] + found[id] - both[id]);
    ++counted;
  }
  out.iou /= counted;
  return out;
}

// Compares the classes of a registered painting of that terrain with the truth: guidance.exr of the
// picture that was painted.
CoverTrial try_cover(const Registration& registration, const Grid<glm::vec3>& painting,
                     const std::shared_ptr<const Dem>& dem, const std::string& truth_file) {
  const GuidanceBuffers truth = read_guidance(truth_file);
  const glm::ivec2 size(painting.width(), painting.height());
  LoadedScene loaded;
  loaded.scene = registered_scene(registration, size);
  loaded.scene.deform.allow_folds = true;
  const RegisteredView view(registration, loaded.scene, *dem, size, silent_progress());
  const Grid<float> sigma_px = trace_registered(view).sigma_px;
  GuidanceBuffers guidance = trace_registered_guidance(loaded, dem, size, {});
  CoverTrial out;
  out.rules = agreement(places_of(guidance).labels, truth);
  out.painted = agreement(classes_by_paint(painting, places_of(guidance)), truth);
  const RegisteredCover cover =
      find_registered_cover(painting, sigma_px, guidance, loaded, *dem, silent_progress());
  out.lines = cover.lines;
  cover_scene(cover, loaded.scene);
  renew_land_cover(loaded, *dem, guidance, silent_progress());
  out.own_rules = agreement(places_of(guidance).labels, truth);
  out.own = agreement(classes_by_paint(painting, places_of(guidance)), truth);
  return out;
}

struct TrialOptions {
  std::string data;
  std::vector<std::string> regions;
  int scenes = 3;
  int first = 0;
  int draws = 3;
  int count = 40;
  double sigma_px = 3.0;
  double wrong = 0.1;
  bool known = false;
  std::string write;
  std::string paint;
  bool classes = false;
};

struct Trial {
  std::vector<double> view_px, all_px, still_px, moved_px;
  std::size_t wrong = 0, found = 0, good = 0, thrown = 0;
  double sigma_px = 0.0;
  int rounds = 0;
  std::size_t matches = 0;
  std::optional<CoverTrial> cover;
  double valleys_m = 0.0;
};

Trial run_trial(const SecretScene& scene, const SecretPairs& secret, const TrialOptions& options,
                const std::string& name, std::uint64_t seed) {
  RegistrationParameters parameters;
  if (options.known) {
    parameters.sigma_px = 3.0;
    parameters.view.kinds = {scene.camera.projection == "perspective" ? ViewKind::plane
                             : scene.camera.projection == "panini"    ? ViewKind::panini
                                                                      : ViewKind::cylinder};
  }
  const glm::ivec2 size(scene.camera.width, scene.camera.height);
  Registration found = register_pairs(secret.pairs, size, parameters);
  Trial out;
  DrawnGround ground;
  if (!options.paint.empty()) {
    const Grid<glm::vec3> painting =
        read_painting(fmt::format("{}/{}.png", options.paint, name), silent_progress());
    PaintRegistration by_paint =
        register_by_paint(found, secret.pairs, painting, *scene.dem, silent_progress());
    found = by_paint.registration;
    ground = std::move(by_paint.ground);
    out.rounds = by_paint.rounds;
    out.matches = by_paint.matches;
    out.valleys_m = found.valleys_m;
    const std::string truth = fmt::format("{}/out_{}/guidance.exr", options.paint, name);
    if (options.classes)
      out.cover = try_cover(found, painting, std::make_shared<const Dem>(*scene.dem), truth);
  }
  const DisplacementField field(found.displacement);
  const FittedView& alone = found.kinds.front();
  out.sigma_px = found.sigma_px;
  for (std::size_t i = 0; i < secret.pairs.size(); ++i) {
    const bool thrown = found.findings[i].wrong;
    ++(secret.wrong[i] ? out.wrong : out.good);
    if (thrown) ++(secret.wrong[i] ? out.found : out.thrown);
  }
  constexpr std::size_t held_out = 200;
  for (const SeenPixel& at : seen_pixels(scene, held_out, mix_bits(seed + 3))) {
    const ViewPixel pixel = project_in_view(alone.frame, alone.view, at.position, at.altitude_m);
    out.view_px.push_back(
        glm::length(glm::dvec2(pixel.u.value, pixel.v.value) * found.scale - at.pixel));
    ControlPair place{.position = at.position, .altitude_m = at.altitude_m};
    place = ground.drawn(place);
    const double off =
        glm::length(registered_pixel(found, field, place.position, place.altitude_m) - at.pixel);
    out.all_px.push_back(off);
    (scene.on_moved_ground(at.position) ? out.moved_px : out.still_px).push_back(off);
  }
  return out;
}

std::string share(std::size_t part, std::size_t whole) {
  return fmt::format(
      "{:.0f} %",
      whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

void print_table(const std::vector<Trial>& trials) {
  std::vector<double> view, view_90, all, all_90, still, moved;
  std::size_t within_3 = 0, within_5 = 0, wrong = 0, found = 0, good = 0, thrown = 0;
  for (const Trial& t : trials) {
    view.push_back(median(t.view_px));
    view_90.push_back(percentile(t.view_px, 0.9));
    all.push_back(median(t.all_px));
    all_90.push_back(percentile(t.all_px, 0.9));
    within_3 += all.back() <= 3.0 ? 1 : 0;
    within_5 += all.back() <= 5.0 ? 1 : 0;
    if (!t.still_px.empty()) still.push_back(median(t.still_px));
    if (!t.moved_px.empty()) moved.push_back(median(t.moved_px));
    wrong += t.wrong, found += t.found, good += t.good, thrown += t.thrown;
  }
  fmt::print(
      "| runs | view alone | with field | worst | <= 3 px | <= 5 px | still | moved | wrong found "
      "| "
      "good thrown out |\n|---|---|---|---|---|---|---|---|---|---|\n");
  fmt::print(
      "| {} | {:.1f} / {:.0f} | {:.1f} / {:.0f} | {:.0f} | {} | {} | {:.1f} | {:.1f} | {} of {} | "
      "{} |\n",
      trials.size(), median(view), median(view_90), median(all), median(all_90),
      *std::max_element(all.begin(), all.end()), share(within_3, trials.size()),
      share(within_5, trials.size()), median(still), median(moved), found, wrong,
      share(thrown, good));
}

// A line of a table of the land cover.
std::string cover_row(const CoverTrial& of) {
  const auto cell = [](const ClassAgreement& a) {
    return fmt::format("{:.2f} / {:.2f}", a.iou, a.right);
  };
  return fmt::format("{} | {} | {} | {}", cell(of.rules), cell(of.painted), cell(of.own_rules),
                     cell(of.own));
}

// The means, of the trials that have them.
void print_cover_table(const std::vector<Trial>& trials) {
  CoverTrial mean;
  double count = 0.0;
  for (const Trial& trial : trials) count += trial.cover ? 1.0 : 0.0;
  if (count == 0.0) return;
  for (const Trial& trial : trials) {
    if (!trial.cover) continue;
    for (ClassAgreement CoverTrial::*of :
         {&CoverTrial::rules, &CoverTrial::painted, &CoverTrial::own_rules, &CoverTrial::own}) {
      (mean.*of).iou += ((*trial.cover).*of).iou / count;
      (mean.*of).right += ((*trial.cover).*of).right / count;
    }
  }
  fmt::print(
      "| mean IoU / right | rules by climate | with paint | rules by own lines | with paint |\n"
      "|---|---|---|---|---|\n| {:.0f} runs | {} |\n",
      count, cover_row(mean));
}

int measure_registration(int argc, char** argv) {
  tools::CommandLine line("register_trial", "Measures how well paintings are registered.");
  tools::CommandOptions& command = line.options();
  TrialOptions options;
  command.add_option("--data", options.data, "Folder of the regions' elevation").required();
  command.add_option("--region", options.regions, "Only these regions");
  command.add_option("--scenes", options.scenes, "Scenes of each region")
      .range(1, 100)
      .show_default();
  command.add_option("--first", options.first, "Number of the first scene")
      .range(0, 1000)
      .show_default();
  command.add_option("--draws", options.draws, "Draws of pairs of each scene")
      .range(1, 100)
      .show_default();
  command.add_option("--pairs", options.count, "Pairs of each draw").range(8, 400).show_default();
  command.add_option("--sigma", options.sigma_px, "Noise of pixels")
      .range(0.0, 50.0)
      .show_default();
  command.add_option("--wrong", options.wrong, "Share of wrong pairs")
      .range(0.0, 0.5)
      .show_default();
  command.add_option("--write", options.write, "Folder for the scenes and pairs as files");
  command.add_option(
      "--paint", options.paint,
      "Folder of the scenes' paintings, REGION_NUMBER.png: registered by them as well");
  command.add_flag("--classes", options.classes,
                   "With --paint: how well classes agree with out_REGION_NUMBER/guidance.exr "
                   "beside the paintings");
  command.add_flag("--known", options.known, "Kind of view and noise of 3 px are told");
  if (const std::string help = line.read({argv + 1, argv + argc}); !help.empty()) {
    fmt::print("{}", help);
    return 0;
  }
  std::vector<Trial> trials;
  for (const SecretRegion& region : secret_regions()) {
    if (!options.regions.empty() && std::find(options.regions.begin(), options.regions.end(),
                                              region.name) == options.regions.end())
      continue;
    const Dem dem = read_secret_region(region, options.data);
    for (int i = options.first; i < options.first + options.scenes; ++i) {
      const SecretScene scene = make_secret_scene(
          dem, region,
          mix_bits(mix_bits(static_cast<std::uint64_t>(&region - secret_regions().data()) + 1) +
                   static_cast<std::uint64_t>(i)));
      for (int draw = 0; draw < options.draws; ++draw) {
        const std::uint64_t seed = mix_bits(static_cast<std::uint64_t>(1000 * i + draw) + 7);
        const SecretPairs pairs = make_secret_pairs(
            scene, {static_cast<std::size_t>(options.count), options.sigma_px, options.wrong},
            seed);
        if (!options.write.empty()) {
          const std::string name = fmt::format("{}/{}_{}", options.write, region.name, i);
          write_text_file(name + ".toml", secret_scene_text(scene, region));
          write_text_file(fmt::format("{}_{}.csv", name, draw), secret_pairs_text(scene, pairs));
        }
        const Trial trial =
            run_trial(scene, pairs, options, fmt::format("{}_{}", region.name, i), seed);
        fmt::print(
            "{:10} {:2} {:11} {:2.0f} % moved, {} draw {}: view {:.1f} / {:.0f}, field {:.1f} / "
            "{:.0f}, still {:.1f}, moved {:.1f}, wrong {} of {}, thrown {}, sigma {:.1f}, {} "
            "rounds, "
            "{} matches, valleys {:.0f} of {:.0f} m\n",
            region.name, i, scene.camera.projection, 100.0 * scene.moved_share,
            scene.widened_m > 0.0 ? "wide" : "    ", draw, median(trial.view_px),
            percentile(trial.view_px, 0.9), median(trial.all_px), percentile(trial.all_px, 0.9),
            median(trial.still_px), median(trial.moved_px), trial.found, trial.wrong, trial.thrown,
            trial.sigma_px, trial.rounds, trial.matches, trial.valleys_m, scene.widened_m);
        if (trial.cover)
          fmt::print("  treeline {:.0f}, snow line {:.0f}{}: IoU / right {}\n",
                     trial.cover->lines.treeline_m, trial.cover->lines.snowline_m,
                     trial.cover->lines.winter ? ", winter" : "", cover_row(*trial.cover));
        std::fflush(stdout);
        trials.push_back(trial);
      }
    }
  }
  print_table(trials);
  print_cover_table(trials);
  return 0;
}

}  // namespace

}  // namespace belvedere::bench

int main(int argc, char** argv) {
  try {
    return belvedere::bench::measure_registration(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "register_trial: %s\n", error.what());
    return 1;
  }
}
