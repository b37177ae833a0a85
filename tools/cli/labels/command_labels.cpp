#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "base/parallel.h"
#include "renderer/labels/label_files.h"
#include "renderer/labels/labels.h"
#include "renderer/world/valley_view.h"
#include "terrain/io/crs.h"
#include "terrain/shape/summits.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/report/text_file.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct Options {
  SceneOptions scene;
  std::vector<std::string> points;
  std::vector<std::string> tracks;
  std::string style = "classic";
  int summits = -1;  // -1: 30 where there are no files of points, else none
  SummitParameters tops;
  std::string under;
  std::string out;
};

constexpr int usual_summits = 30;

// The places' extent beside the terrain's, both as the files would say them.
[[noreturn]] void fail_outside(const std::vector<LabelPoint>& points, const Dem& dem) {
  glm::dvec2 low = points.front().place;
  glm::dvec2 high = low;
  for (const LabelPoint& point : points) {
    low = glm::min(low, point.place);
    high = glm::max(high, point.place);
  }
  const glm::dvec2 a = dem.transform.to_crs(-.5, dem.height() - .5);
  const glm::dvec2 b = dem.transform.to_crs(dem.width() - .5, -.5);
  throw Error(ErrorKind::usage, points.front().where,
              fmt::format("none of {} points lies on the terrain: they lie E {:.0f} … {:.0f}, N {:.0f} … {:.0f}", points.size(), low.x,
                          high.x, low.y, high.y),
              fmt::format("places within E {:.0f} … {:.0f}, N {:.0f} … {:.0f}{}", a.x, b.x, a.y, b.y,
                          dem.crs.empty() ? "" : " (" + describe_crs(dem.crs) + ")"));
}

// Fonts that a style names and the machine lacks: the picture then looks other than the style means.
void note_fonts(const LabelStyle& style, Progress& progress) {
  const TextMeasure measure;
  std::map<std::string, std::string> taken;
  for (const LabelKindStyle& kind : style.kinds) taken[kind.family] = measure.family_of(text_style(kind, 1.0));
  for (const auto& [asked, found] : taken)
    if (!asked.starts_with(found)) progress.note(fmt::format("of the fonts \"{}\" {} is taken: the first is not installed", asked, found));
}

int run(const Options& options) {
  const LoadedScene scene = load(options.scene);
  const RunLimits limits(make_run(options.scene));
  const Cache cache = make_cache(options.scene);
  TerminalProgress progress(options.scene.quiet);
  require_scene_files(scene);
  const LabelStyle style = load_label_style(options.style);
  note_fonts(style, progress);
  const fs::path folder = options.out;
  check_place((folder / "labels.svg").string());

  const BareView bare = make_bare_view(scene, progress, cache);
  std::vector<LabelPoint> points;
  for (const std::string& file : options.points) {
    const std::vector<LabelPoint> more = read_label_points(file, bare.dem.crs, style, progress);
    points.insert(points.end(), more.begin(), more.end());
  }
  const std::size_t named = points.size();
  const int most = options.summits >= 0 ? options.summits : options.points.empty() && options.tracks.empty() ? usual_summits : 0;
  if (most > 0) {
    progress.begin("looking for summits", 0.0);
    SummitParameters tops = options.tops;
    const std::vector<Summit> summits = find_summits(known_altitude(bare.dem), tops);
    std::vector<LabelPoint> unnamed = unnamed_summits(summits, bare.dem.transform, bare.dem.cell_m(), points, style);
    points.insert(points.end(), unnamed.begin(), unnamed.end());
  }
  std::vector<MapLine> lines;
  for (const std::string& file : options.tracks) {
    const std::vector<MapLine> more = read_lines(file, bare.dem.crs);
    lines.insert(lines.end(), more.begin(), more.end());
  }
  if (points.empty() && lines.empty())
    throw Error(ErrorKind::usage, "labels", "nothing to name", "--points FILE with points, --summits N or --tracks FILE");

  progress.begin("finding places", 0.0);
  const GeoMap map = bare.geo_map();
  const DrawnGround ground{bare.dem.altitude_m, bare.generalized_m, bare.dem.transform, bare.dem.cell_m(), map};
  std::vector<LabelMark> marks = find_marks(ground, points, style);
  if (named > 0 && std::all_of(marks.begin(), marks.begin() + static_cast<std::ptrdiff_t>(named),
                               [](const LabelMark& mark) { return mark.state == MarkState::outside_terrain; })) {
    points.resize(named);
    fail_outside(points, bare.dem);
  }
  // Of the DEM's own summits the most prominent that are seen; named ones are all listed.
  std::size_t kept = named;
  for (std::size_t i = named; i < points.size() && kept < named + static_cast<std::size_t>(most); ++i)
    if (marks[i].state == MarkState::seen) {
      points[kept] = points[i];
      marks[kept++] = marks[i];
    }
  points.resize(kept);
  marks.resize(kept);

  progress.begin("placing names", 0.0);
  const glm::ivec2 size = bare.camera->size();
  LabelSheet sheet = make_labels(points, marks, find_skyline(map, size), style, size, scene.scene.output.sheet_width_mm);
  sheet.tracks = find_tracks(ground, lines);
  const std::string under = options.under.empty() ? "" : fs::relative(options.under, folder).generic_string();
  write_text_file((folder / "labels.svg").string(), labels_svg(sheet, under));
  write_text_file((folder / "labels.csv").string(), labels_csv(sheet));
  if (bare.dem.crs.empty())
    progress.note("labels.geojson is left out: the terrain has no coordinate system, and GeoJSON speaks longitude and latitude");
  else
    write_text_file((folder / "labels.geojson").string(), labels_geojson(sheet, bare.dem.crs));
  for (std::size_t i = 0; i < sheet.tracks.size(); ++i)
    write_text_file((folder / fmt::format("profile_{}.svg", i + 1)).string(), profile_svg(sheet.tracks[i], style.track.colour));
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
                    .add("points", Json::number(static_cast<double>(points.size())))
                    .add("placed", Json::number(static_cast<double>(placed)))
                    .add("no_room", Json::number(static_cast<double>(seen - placed)));
    for (const MarkState state : {MarkState::hidden, MarkState::outside_picture, MarkState::behind_eye, MarkState::outside_terrain})
      json.add(std::string(name_of(state)), Json::number(static_cast<double>(states[static_cast<std::size_t>(state)])));
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
    std::string text = fmt::format("{}: {} of {} names placed", (folder / "labels.svg").string(), placed, points.size());
    if (seen > placed) text += fmt::format(", {} without room", seen - placed);
    for (const MarkState state : {MarkState::hidden, MarkState::outside_picture, MarkState::behind_eye, MarkState::outside_terrain})
      if (const std::size_t count = states[static_cast<std::size_t>(state)]; count > 0)
        text += fmt::format(", {} {}", count, name_of(state));
    text += '\n';
    for (const Track& track : sheet.tracks)
      text += fmt::format("{}: {:.1f} km, {:.0f} m up, {:.1f} km of it seen\n", track.name.empty() ? track.where : track.name,
                          track.length_m / 1000.0, track.climb_m, track.seen_m / 1000.0);
    print_out(text);
  }
  return 0;
}

}  // namespace

Action add_labels(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  add_scene_options(command, options->scene);
  command.add_option("--points", options->points, "Points with names: .csv, .gpkg, .geojson, .shp or .fgb; may be repeated")
      ->type_name("FILE");
  command
      .add_option("--tracks", options->tracks, "Ways to draw, with a profile each: .gpx, .gpkg, .geojson, .shp or .fgb; may be repeated")
      ->type_name("FILE");
  command.add_option("--style", options->style, "How names are set: classic, or a .toml file")->type_name("STYLE")->capture_default_str();
  command.add_option("--summits", options->summits, "So many of the DEM's own summits as well, with their altitudes; 30 without --points")
      ->type_name("N")
      ->check(CLI::Range(0, 10000));
  command
      .add_option("--least-prominence", options->tops.least_prominence_m,
                  "What counts as a summit of the DEM: so high over the way to higher ground, in metres")
      ->type_name("M")
      ->check(CLI::Range(1.0, 9000.0))
      ->capture_default_str();
  command.add_option("--under", options->under, "A picture of the scene that labels.svg shows beneath the names")->type_name("FILE");
  command.add_option("--out", options->out, "Folder for the results; made where it is missing")->required()->type_name("DIR");
  command.footer(
      "Writes labels.svg (over the picture, text as text), labels.csv and labels.geojson: each point's pixel, distance, and whether\n"
      "it is seen or what hides it. Summits are marked where they are drawn. Files have columns name, kind, rank (1 … 9) and ele.\n\n"
      "  belvedere labels scenes/karwendel.toml --data ../data --points scenes/karwendel_names.csv --under out/karwendel/panorama.png "
      "--out out/karwendel\n"
      "  belvedere labels my_scene.toml --summits 40 --out names\n"
      "  belvedere labels my_scene.toml --tracks tour.gpx --under panorama.png --out tour");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
