#include <fmt/core.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/text/json.h"
#include "renderer/labels/labels.h"
#include "renderer/pipeline/scene_labels.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct LabelsOptions {
  SceneOptions scene;
  bool force = false;
  std::vector<std::string> points;
  std::vector<std::string> shapes;
  std::vector<std::string> tracks;
  std::string style;
  int summits = -1;               // -1: the scene's; 30 where nothing else is named
  double min_prominence_m = 0.0;  // 0: the scene's
  std::string under;
  std::string out;
};

constexpr int usual_summits = 30;

int run(const LabelsOptions& options) {
  const LoadedScene scene = load(options.scene);
  const RunLimits limits(make_run(options.scene));
  const Cache cache = make_cache(options.scene);
  TerminalProgress progress(options.scene.quiet);
  require_scene_files(scene);
  LabelJob job = label_job(scene, progress);
  for (const auto& [own, scenes] :
       {std::pair(&options.points, &job.points), std::pair(&options.shapes, &job.shapes),
        std::pair(&options.tracks, &job.tracks)})
    if (!own->empty()) scenes->assign(own->begin(), own->end());
  if (!options.style.empty()) job.style = options.style;
  if (options.min_prominence_m > 0.0) job.min_prominence_m = options.min_prominence_m;
  if (options.summits >= 0)
    job.summits = options.summits;
  else if (job.points.empty() && job.shapes.empty() && job.tracks.empty() && job.summits == 0)
    job.summits = usual_summits;
  require_fonts(load_label_style(job.style));
  const fs::path folder = options.out;
  file_guard().writes_into(options.out, "--out", options.force,
                           {{"labels.svg", "labels.csv", "labels.geojson"}});

  const BareView bare = make_bare_view(scene, progress, cache);
  const LabelSheet sheet = make_label_sheet(scene, job, bare, progress);
  const std::string under =
      options.under.empty() ? "" : fs::relative(options.under, folder).generic_string();
  write_label_files(sheet, bare.dem->crs, folder.string(), under, progress);
  progress.end();

  std::array<std::size_t, 5> states{};
  std::size_t placed = 0;
  for (const Label& label : sheet.labels) {
    ++states[static_cast<std::size_t>(label.mark.state)];
    placed += label.spot.placed ? 1 : 0;
  }
  const std::size_t seen = states[static_cast<std::size_t>(MarkState::seen)];
  if (options.scene.json) {
    Json json = Json::object()
                    .add("out", Json::text(options.out))
                    .add("points", Json::number(static_cast<double>(sheet.labels.size())))
                    .add("placed", Json::number(static_cast<double>(placed)))
                    .add("no_room", Json::number(static_cast<double>(seen - placed)));
    for (const MarkState state : {MarkState::hidden, MarkState::outside_picture,
                                  MarkState::behind_eye, MarkState::outside_terrain})
      json.add(std::string(name_of(state)),
               Json::number(static_cast<double>(states[static_cast<std::size_t>(state)])));
    Json tracks = Json::array();
    for (const Track& track : sheet.tracks)
      tracks.add(Json::object()
                     .add("name", Json::text(track.name))
                     .add("length_m", Json::number(std::round(track.length_m)))
                     .add("climb_m", Json::number(std::round(track.climb_m)))
                     .add("seen_m", Json::number(std::round(track.seen_m))));
    json.add("tracks", std::move(tracks));
    print_out(json.str() + "\n");
  } else {
    std::string text = fmt::format("{}: {} of {} names placed", (folder / "labels.svg").string(),
                                   placed, sheet.labels.size());
    if (seen > placed) text += fmt::format(", {} without room", seen - placed);
    for (const MarkState state : {MarkState::hidden, MarkState::outside_picture,
                                  MarkState::behind_eye, MarkState::outside_terrain})
      if (const std::size_t count = states[static_cast<std::size_t>(state)]; count > 0)
        text += fmt::format(", {} {}", count, name_of(state));
    text += '\n';
    for (const Track& track : sheet.tracks)
      text += fmt::format("{}: {:.1f} km, {:.0f} m up, {:.1f} km of it visible\n",
                          track.name.empty() ? track.where : track.name, track.length_m / 1000.0,
                          track.climb_m, track.seen_m / 1000.0);
    print_out(text);
  }
  return 0;
}

}  // namespace

Action add_labels(CommandOptions& command) {
  const auto options = std::make_shared<LabelsOptions>();
  add_scene_options(command, options->scene);
  command
      .add_option("--points FILE", options->points,
                  "Points with names, instead of those of the scene's [labels]: .csv, .gpkg, "
                  ".geojson, .shp, .fgb, .gpx or .osm; may be repeated")
      .files(FileUse::input);
  command
      .add_option("--tracks FILE", options->tracks,
                  "Tracks to draw, with a profile each: .gpx, .gpkg, .geojson, .shp or .fgb; may "
                  "be repeated")
      .files(FileUse::input);
  command
      .add_option("--shapes FILE", options->shapes,
                  "Lines and areas whose names are curved along them, valleys and lakes: .gpkg, "
                  ".geojson, .shp or .fgb; may be repeated")
      .files(FileUse::input);
  command.add_option("--style STYLE", options->style,
                     "Style of the names: classic, or a .toml file. Default: the scene's");
  command
      .add_option("--summits N", options->summits,
                  "Number of the DEM's own summits to label as well, with their altitudes. "
                  "Default: 30 without --points")
      .range(0, 10000);
  command
      .add_option("--min-prominence M", options->min_prominence_m,
                  "Prominence from which a point of the DEM counts as a summit, in metres above "
                  "the highest pass to higher ground. Default: the scene's, 150")
      .range(1.0, 9000.0);
  command
      .add_option("--under FILE", options->under,
                  "A picture of the scene that labels.svg shows beneath the names")
      .files(FileUse::input);
  command.add_option("--out DIR", options->out, "Folder for the results; created if missing")
      .required()
      .files(FileUse::later);
  command.add_force(options->force);
  command.footer(
      "Writes labels.svg (over the picture, text as text), labels.csv and labels.geojson: each "
      "point's pixel, distance, and whether\n"
      "it is visible or what hides it. Summits are marked where they are drawn. Files have columns "
      "name, kind, rank (1 … 9) and ele.\n"
      "\n"
      "  belvedere labels scenes/karwendel.toml --data ../data --points scenes/karwendel_names.csv "
      "--under out/karwendel/panorama.png --out out/karwendel\n"
      "  belvedere labels my_scene.toml --summits 40 --out names\n"
      "  belvedere labels my_scene.toml --tracks tour.gpx --under panorama.png --out tour");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
