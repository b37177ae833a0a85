#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text/json.h"
#include "renderer/features/drawn_features.h"
#include "renderer/ground/scene_ground_map.h"
#include "renderer/world/scene_features.h"
#include "renderer/world/world.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct FeaturesCheckOptions {
  SceneOptions scene;
};

std::string count_of(std::size_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

// Features of a source that were left out, and why.
std::vector<std::string> left_out(const SourceReading& reading) {
  std::vector<std::string> lines;
  const auto add = [&](std::size_t count, const std::string& why) {
    if (count > 0) lines.push_back(fmt::format("{} left out: {}", count, why));
  };
  add(reading.without_shape, "without coordinates, or with too few");
  add(reading.unplaceable, "outside the valid area of the terrain's coordinate system");
  add(reading.wrong_shape, "of a geometry type that does not fit their kind");
  std::vector<std::pair<std::string, std::size_t>> words(reading.unknown.begin(),
                                                         reading.unknown.end());
  std::stable_sort(words.begin(), words.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  constexpr std::size_t max = 20;
  for (std::size_t i = 0; i < words.size() && i < max; ++i)
    add(words[i].second, words[i].first.empty()
                             ? "without a kind"
                             : fmt::format("the style has no kind \"{}\"", words[i].first));
  if (words.size() > max)
    lines.push_back(
        fmt::format("… and {} further words that the style does not contain", words.size() - max));
  if (reading.at_zero > 0)
    lines.push_back(fmt::format("{} at 0, 0, as of missing coordinates", reading.at_zero));
  if (reading.wrong_width > 0)
    lines.push_back(
        fmt::format("{} with a width that is not a number of metres: drawn with the style's width",
                    reading.wrong_width));
  return lines;
}

std::string describe(const FeatureKind& kind, const DrawnCount& count, std::size_t beside) {
  if (becomes_ground(kind))
    return beside > 0 ? fmt::format("part of the ground, {} of them outside the terrain", beside)
                      : "part of the ground";
  std::string text = fmt::format("{} drawn", count.drawn);
  const auto add = [&](std::size_t number, const char* why) {
    if (number > 0) text += fmt::format(", {} {}", number, why);
  };
  add(count.hidden, "hidden by ground");
  add(count.too_far, "too small on the sheet for their kind");
  add(count.outside_picture, "outside the picture");
  add(count.outside_terrain, "outside the terrain");
  if (count.length_m > 0.0)
    text += fmt::format("; {:.1f} km, {:.1f} km of them visible", 0.001 * count.length_m,
                        0.001 * count.seen_m);
  return text;
}

Json to_json(const FeatureSet& set, const DrawnFeatures& drawn,
             const std::vector<std::vector<std::size_t>>& taken) {
  Json sources = Json::array();
  for (std::size_t s = 0; s < set.readings.size(); ++s) {
    const SourceReading& reading = set.readings[s];
    const auto number = [](std::size_t value) { return Json::number(static_cast<double>(value)); };
    Json unknown = Json::object();
    for (const auto& [word, count] : reading.unknown) unknown.add(word, number(count));
    Json kinds = Json::array();
    for (std::size_t k = 0; k < set.style.kinds.size(); ++k) {
      if (taken[s][k] == 0) continue;
      const DrawnCount& count = drawn.counts[s][k];
      kinds.add(Json::object()
                    .add("kind", Json::text(set.style.kinds[k].name))
                    .add("features", number(taken[s][k]))
                    .add("drawn", number(count.drawn))
                    .add("hidden", number(count.hidden))
                    .add("too_far", number(count.too_far))
                    .add("outside_picture", number(count.outside_picture))
                    .add("outside_terrain", number(count.outside_terrain))
                    .add("length_m", Json::number(std::round(count.length_m)))
                    .add("seen_m", Json::number(std::round(count.seen_m))));
    }
    sources.add(Json::object()
                    .add("file", Json::text(reading.file))
                    .add("read", number(reading.read))
                    .add("without_shape", number(reading.without_shape))
                    .add("unplaceable", number(reading.unplaceable))
                    .add("wrong_shape", number(reading.wrong_shape))
                    .add("wrong_width", number(reading.wrong_width))
                    .add("unknown", std::move(unknown))
                    .add("kinds", std::move(kinds)));
  }
  return Json::object().add("style", Json::text(set.style.name)).add("sources", std::move(sources));
}

int run(const FeaturesCheckOptions& options) {
  const LoadedScene scene = load(options.scene);
  const RunLimits limits(make_run(options.scene));
  TerminalProgress progress(options.scene.quiet);
  if (!scene.scene.any_features())
    throw Error(ErrorKind::usage, scene.name, "the scene has no features",
                "[[features]] with source and kind; see features.md");
  require_scene_files(scene);
  read_scene_feature_style(scene);
  const BareView bare = make_bare_view(scene, progress, make_cache(options.scene));
  const FeatureSet set = read_scene_features(scene, bare.dem->crs, silent_progress());
  progress.begin("laying features on the ground", 0.0);
  const GroundSight sight(bare.dem->transform, *bare.surface, *bare.camera, *bare.tracer,
                          *bare.goes_to);
  const DrawnFeatures drawn = draw_features(
      set, sight, {.px_per_mm = scene.scene.output.width / scene.scene.output.sheet_width_mm});
  progress.end();
  std::vector<std::vector<std::size_t>> taken(set.readings.size(),
                                              std::vector<std::size_t>(set.style.kinds.size(), 0));
  for (const Feature& feature : set.features)
    ++taken[static_cast<std::size_t>(feature.source)][static_cast<std::size_t>(feature.kind)];
  std::vector<std::vector<std::size_t>> beside(set.readings.size(),
                                               std::vector<std::size_t>(set.style.kinds.size(), 0));
  for (const Feature& feature : set.features)
    beside[static_cast<std::size_t>(feature.source)][static_cast<std::size_t>(feature.kind)] +=
        lies_beside(feature, *bare.dem) ? 1 : 0;
  if (options.scene.json) {
    print_out(to_json(set, drawn, taken).str() + "\n");
  } else {
    std::string text = fmt::format("style {}\n", set.style.name);
    for (std::size_t s = 0; s < set.readings.size(); ++s) {
      const SourceReading& reading = set.readings[s];
      text += fmt::format("{}: {} read\n", reading.file, count_of(reading.read, "feature"));
      for (std::size_t k = 0; k < set.style.kinds.size(); ++k)
        if (taken[s][k] > 0)
          text += fmt::format("  {:<18} {:>7}: {}\n", set.style.kinds[k].name, taken[s][k],
                              describe(set.style.kinds[k], drawn.counts[s][k], beside[s][k]));
      for (const std::string& line : left_out(reading)) text += "  " + line + '\n';
    }
    print_out(text);
  }
  // After the table, which counts the kinds.
  check_extents(set, *bare.dem);
  return 0;
}

}  // namespace

Action add_features_check(CommandOptions& command) {
  const auto options = std::make_shared<FeaturesCheckOptions>();
  add_scene_options(command, options->scene);
  command.footer(
      "Reads the files of [[features]] and lays them on the ground as it will be drawn, without "
      "rendering. Reports what was read, of which kinds,\n"
      "what is visible, hidden or outside, and what is left out and why. A file without any "
      "feature on the terrain is an error: the\n"
      "coordinate system it states is then wrong.\n"
      "\n"
      "  belvedere features check scenes/karwendel_features.toml --data ../data");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
