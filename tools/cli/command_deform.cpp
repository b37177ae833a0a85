#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/files/output_file.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "renderer/labels/label_files.h"
#include "renderer/pipeline/scene_labels.h"
#include "renderer/scene/scene_settings.h"
#include "renderer/trace/relief_sketch.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/world.h"
#include "terrain/io/raster_io.h"
#include "terrain/io/surface_raster.h"
#include "terrain/shape/valley_floor.h"
#include "tools/cli/commands.h"
#include "tools/cli/deform_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// Arguments of `deform --locate`: positions as "E,N", and files of points.
struct LocateQuestions {
  std::vector<std::string> positions;
  std::vector<std::string> files;
};

// A table of all points of the files, for spreadsheets, and the same as JSON.
struct LocatedTable {
  std::string csv;
  Json json = Json::array();
};
// A position in JSON: [x, y].
Json pair_json(glm::dvec2 p);

bool names_a_file(const std::string& text) {
  constexpr std::array extensions = {".csv", ".gpkg", ".geojson", ".json", ".geojsonl", ".ndjson",
                                     ".shp", ".fgb",  ".gpx",     ".osm",  ".pbf"};
  return std::find(extensions.begin(), extensions.end(), lower_extension(text)) != extensions.end();
}

Json json_of(const LabelSheet& sheet, const Label& label) {
  const LabelMark& mark = label.mark;
  Json entry = Json::object()
                   .add("name", Json::text(label.point.name))
                   .add("kind", Json::text(sheet.kind_of(label).name))
                   .add("where", Json::text(label.point.where))
                   .add("place", pair_json(label.point.position))
                   .add("outcome", Json::text(std::string(name_of(mark.state))))
                   .add("visible", Json::boolean(mark.state == MarkState::seen));
  if (label.point.altitude_m) entry.add("altitude_file_m", Json::number(*label.point.altitude_m));
  if (!std::isnan(mark.dem_altitude_m))
    entry.add("altitude_dem_m", Json::number(mark.dem_altitude_m));
  if (mark.state != MarkState::outside_terrain && mark.state != MarkState::behind_eye)
    entry.add("pixel", pair_json(mark.pixel))
        .add("distance_m", Json::number(mark.distance_m))
        .add("in_picture", Json::boolean(mark.state != MarkState::outside_picture));
  if (mark.in_front) entry.add("hiding_place", pair_json(mark.in_front->position));
  if (!label.hidden_by.empty()) entry.add("hidden_by", Json::text(label.hidden_by));
  return entry;
}

Json pair_json(glm::dvec2 p) { return Json::array({Json::number(p.x), Json::number(p.y)}); }

// "681500,5237300" is a position; a name with the extension of a file of points is a file. Throws
// Error(usage) for anything else.
LocateQuestions sort_questions(const std::vector<std::string>& asked) {
  LocateQuestions questions;
  for (const std::string& text : asked) {
    if (names_a_file(text)) {
      questions.files.push_back(text);
      continue;
    }
    try {
      parse_pair(text, "--locate");
    } catch (const Error& error) {
      throw Error(ErrorKind::usage, "--locate", '"' + text + '"',
                  "E,N: two numbers separated by a comma; or a file of points: .csv, .gpkg, "
                  ".geojson, .json, .geojsonl, .ndjson, .shp, .fgb, .gpx, .osm or .pbf");
    }
    questions.positions.push_back(text);
  }
  return questions;
}

LocatedTable locate_files(const BareView& bare, const std::vector<std::string>& files,
                          Progress& progress) {
  const LabelSheet sheet = locate_points(files, bare, progress);
  LocatedTable table;
  table.csv = places_csv(sheet);
  for (const Label& label : sheet.labels) table.json.add(json_of(sheet, label));
  return table;
}

// The report that is printed: lines of text and the same as JSON members, side by side.
struct DeformReport {
  std::string text;
  std::string table;  // CSV, for files of points
  Json json = Json::object();
};

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

void report_folds(const Grid<float>& altitude_m, const GeoTransform& transform,
                  const Deformation& deformation, DeformReport& report) {
  Json folds = Json::array();
  for (const FoldSummary& fold :
       summarize_folds(find_folds(altitude_m, transform, deformation), deformation.parameters())) {
    report.text +=
        fmt::format("fold: {} folds the ground over itself around E {:.0f} N {:.0f}, {} facets\n",
                    fold.handle ? fmt::format("deform.handles.{}", *fold.handle) : "deform.field",
                    fold.centre.x, fold.centre.y, fold.facets);
    folds.add(Json::object()
                  .add("handle", fold.handle ? Json::number(static_cast<double>(*fold.handle))
                                             : Json::raw("null"))
                  .add("facets", Json::number(static_cast<double>(fold.facets)))
                  .add("place", pair_json(fold.centre)));
  }
  if (report.text.empty() && deformation.moves_in_plan()) report.text += "no folds\n";
  report.json.add("folds", std::move(folds));
}

Json distortion_json(const BendDistortion& d) {
  return Json::object()
      .add("largest_deg", Json::number(d.largest_deg))
      .add("mean_deg", Json::number(d.mean_deg))
      .add("bending_deg_per_10km", Json::number(d.bending_deg_per_10km));
}

std::string describe(const BendDistortion& d) {
  return fmt::format(
      "ground tilted by up to {:.1f}°, {:.1f}° on average, changing by up to {:.1f}° in 10 km",
      d.largest_deg, d.mean_deg, d.bending_deg_per_10km);
}

void report_valleys(const BareView& bare, const ValleySight& sight, DeformReport& report) {
  const BendProfile own(bare.view.deform.bend);
  const double share = sight.visible_share(own);
  const double unbent = sight.visible_share(BendProfile({}));
  const BendDistortion distortion = measure_distortion(own, sight.nearest_m(), sight.farthest_m());
  report.text += fmt::format(
      "valley floor in the view: {:.1f} km², of which {} is visible ({} without a bend)\n",
      sight.floor_km2(), percent(share), percent(unbent));
  report.text += fmt::format("bend: {}\n", describe(distortion));
  report.json.add("valley_floor_km2", Json::number(sight.floor_km2()))
      .add("visible_share", Json::number(share))
      .add("visible_share_unbent", Json::number(unbent))
      .add("distortion", distortion_json(distortion));
}

void report_places(const BareView& bare, const DeformOptions& options, DeformReport& report,
                   Progress& progress) {
  const GeoMap map = bare.geo_map();
  Json located = Json::array();
  const LocateQuestions questions = sort_questions(options.locate);
  if (!questions.files.empty()) {
    LocatedTable table = locate_files(bare, questions.files, progress);
    report.table = std::move(table.csv);
    report.json.add("points", std::move(table.json));
  }
  for (const std::string& text : questions.positions) {
    const glm::dvec2 position = parse_pair(text, "--locate");
    const auto at = map.to_image(position);
    Json entry = Json::object().add("place", pair_json(position));
    if (!at) {
      report.text +=
          fmt::format("E {:.1f} N {:.1f}: {}\n", position.x, position.y,
                      map.on_surface(position) ? "behind the eye" : "outside the terrain");
      entry.add("visible", Json::boolean(false));
    } else {
      const char* seen = at->visible      ? "seen"
                         : at->in_picture ? "hidden behind ground"
                                          : "outside the picture";
      report.text +=
          fmt::format("E {:.1f} N {:.1f}: pixel {:.2f},{:.2f}, {:.0f} m away, {}\n", position.x,
                      position.y, at->pixel.x, at->pixel.y, at->distance_m, seen);
      entry.add("pixel", pair_json(at->pixel))
          .add("distance_m", Json::number(at->distance_m))
          .add("in_picture", Json::boolean(at->in_picture))
          .add("visible", Json::boolean(at->visible));
    }
    located.add(std::move(entry));
  }
  Json shown = Json::array();
  for (const std::string& text : options.at) {
    const glm::dvec2 pixel = parse_pair(text, "--at");
    const auto position = map.to_geo(pixel);
    Json entry = Json::object().add("pixel", pair_json(pixel));
    if (!position) {
      report.text += fmt::format("pixel {:.2f},{:.2f}: sky\n", pixel.x, pixel.y);
    } else {
      report.text += fmt::format(
          "pixel {:.2f},{:.2f}: E {:.1f} N {:.1f}, {:.1f} m above the datum, {:.0f} m away\n",
          pixel.x, pixel.y, position->position.x, position->position.y, position->altitude_m,
          position->distance_m);
      entry.add("place", pair_json(position->position))
          .add("altitude_m", Json::number(position->altitude_m))
          .add("distance_m", Json::number(position->distance_m));
    }
    shown.add(std::move(entry));
  }
  if (!questions.positions.empty()) report.json.add("located", std::move(located));
  if (!options.at.empty()) report.json.add("shown", std::move(shown));
}

Grid<glm::vec3> sketch(const BareView& bare, const Grid<std::uint8_t>& floor) {
  return make_relief_sketch(*bare.generalized_m, bare.dem->transform, floor, bare.deformation,
                            *bare.tracer, *bare.camera, bare.view.sun_direction);
}

// The keys go to stdout, the comparison to a picture.
void search(BareView& bare, const ValleySight& sight, const DeformOptions& options,
            DeformReport& report, Progress& progress) {
  const BendFound found = search_bend(sight,
                                      {.max_inclination_deg = options.max_distortion_deg,
                                       .max_bending_deg_per_10km = options.max_bending_deg,
                                       .points = options.points},
                                      progress);
  report.text += fmt::format(
      "\n"
      "# Shows {} of the valley floor; {}. {} curves tried.\n",
      percent(found.visible_share), describe(found.distortion), found.tried);
  Json points = Json::array();
  for (const BendPoint& point : found.curve.points) {
    report.text += fmt::format("[[deform.bend.points]]\ndistance_m = {}\ninclination_deg = {}\n",
                               point.distance_m, *point.inclination_deg);
    points.add(Json::object()
                   .add("distance_m", Json::number(point.distance_m))
                   .add("inclination_deg", Json::number(*point.inclination_deg)));
  }
  report.json.add("found", Json::object()
                               .add("visible_share", Json::number(found.visible_share))
                               .add("distortion", distortion_json(found.distortion))
                               .add("tried", Json::number(found.tried))
                               .add("points", std::move(points)));
  if (options.out.empty()) return;
  progress.begin("drawing the comparison", 0.0);
  const Grid<std::uint8_t> floor = find_valley_floor(known_altitude(*bare.dem), bare.dem->cell_m());
  const Grid<glm::vec3> before = sketch(bare, floor);
  bend_again(bare, found.curve);
  const Grid<glm::vec3> after = sketch(bare, floor);
  constexpr int gap_px = 6;
  Grid<glm::vec3> both(before.width(), 2 * before.height() + gap_px, glm::vec3(1.F));
  std::copy(before.begin(), before.end(), both.begin());
  std::copy(after.begin(), after.end(),
            both.begin() + static_cast<std::ptrdiff_t>(both.index(0, before.height() + gap_px)));
  write_png8(options.out, both, {});
}

// The comparison does not need the picture's resolution.
void shrink(LoadedScene& scene) {
  constexpr int width_px = 1000;
  SceneOutput& output = scene.scene.output;
  output = with_width(output, std::min(output.width, width_px));
}

void examine(const LoadedScene& loaded, const DeformOptions& options, DeformReport& report,
             Progress& progress, const Cache& cache) {
  LoadedScene scene = loaded;
  const bool positions = !options.locate.empty() || !options.at.empty();
  if (options.search_bend && !positions) shrink(scene);
  BareView bare = make_bare_view(scene, progress, cache);
  report_folds(*bare.generalized_m, bare.dem->transform, bare.deformation, report);
  if (positions) report_places(bare, options, report, progress);
  if (positions && !options.search_bend) return;
  const ValleySight sight = make_valley_sight(bare);
  report_valleys(bare, sight, report);
  if (options.search_bend) search(bare, sight, options, report, progress);
}

void write_dem(const LoadedScene& loaded, const DeformOptions& options, DeformReport& report,
               Progress& progress, const Cache& cache) {
  const SceneDem opened = make_scene_dem_and_region(loaded, progress, cache);
  const Dem& dem = opened.dem;
  Grid<float> ground = known_altitude(dem);
  std::optional<glm::dvec2> viewer = loaded.scene.camera.position;
  DeformParameters asked = resolve_deform(loaded.scene.deform, dem);
  if (is_scene(options)) {
    const View view = make_view(loaded.scene, dem, progress, {}, &opened.region);
    viewer = view.viewer_xy;
    asked = view.deform;
    const Grid<float> shown =
        generalize_for_view(loaded, dem, nullptr, view, progress, cache).altitude_m;
    for (std::size_t i = 0; i < ground.size(); ++i)
      if (!std::isnan(ground[i])) ground[i] = shown[i];
  }
  if (!viewer)
    throw Error(ErrorKind::usage, "camera.position_lonlat",
                "the viewer is given in longitude and latitude", "--viewer E,N");
  const Deformation deformation(asked, *viewer);
  report_folds(ground, dem.transform, deformation, report);
  // Voids stay voids, wherever the deformation moves them.
  const auto voids =
      std::count_if(ground.begin(), ground.end(), [](float z) { return std::isnan(z); });
  progress.begin("deforming", 0.0);
  Raster<float> out{
      raster_of_moved(ground, dem.transform, [&](glm::dvec3 p) { return deformation.point(p); }),
      dem.transform, dem.crs};
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  std::size_t empty = 0;
  for (const float z : out.cells) {
    if (std::isnan(z)) {
      ++empty;
      continue;
    }
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  progress.begin("writing the DEM", 0.0);
  write_raster(options.dem_out, out);
  report.text += fmt::format(
      "{}: {} × {} cells of {:.4g} m, {}, heights {:.1f} … {:.1f} m, {} cells without data ({} "
      "before)\n",
      options.dem_out, dem.width(), dem.height(), dem.cell_m(),
      dem.crs.empty() ? "no CRS" : describe_crs(dem.crs), lowest, highest, empty, voids);
  report.json.add("file", Json::text(options.dem_out))
      .add("lowest_m", Json::number(static_cast<double>(lowest)))
      .add("highest_m", Json::number(static_cast<double>(highest)))
      .add("cells_without_data", Json::number(static_cast<double>(empty)));
}

int run(const DeformOptions& options) {
  const bool asks_view = options.search_bend || !options.locate.empty() || !options.at.empty();
  if (!is_scene(options) && (options.dem_out.empty() || asks_view))
    throw Error(ErrorKind::usage, "command line",
                options.dem_out.empty()
                    ? "a DEM is given, but nothing to write"
                    : "a question about a picture, but the input is a DEM, not a scene",
                "belvedere deform DEM OUT.tif, or a scene file (.toml)");
  const bool has_table = !sort_questions(options.locate).files.empty();
  if (!options.out.empty() && options.search_bend == has_table)
    throw Error(ErrorKind::usage, "--out",
                has_table ? "one output file for both a table and a picture"
                          : "--out without --search-bend or --locate FILE",
                "--search-bend --out FILE.png, or --locate FILE --out TABLE.csv");
  const LoadedScene scene = load(options);
  const RunLimits limits(make_run(options.scene));
  const Cache cache = make_cache(options.scene);
  TerminalProgress progress(options.scene.quiet);
  require_scene_files(scene);
  DeformReport report;
  if (!options.dem_out.empty()) write_dem(scene, options, report, progress, cache);
  if (options.dem_out.empty() || asks_view) examine(scene, options, report, progress, cache);
  if (!report.table.empty() && !options.out.empty()) {
    write_text_file(options.out, report.table);
    report.text += options.out + "\n";
    report.table.clear();
  }
  // When a table is printed, stdout holds nothing else; further results are notes.
  if (!report.table.empty() && !options.scene.json)
    for (std::istringstream lines(std::exchange(report.text, {}));
         std::getline(lines, report.text);)
      progress.note(report.text);
  progress.end();
  print_out(options.scene.json     ? report.json.str() + "\n"
            : report.table.empty() ? report.text
                                   : report.table);
  return 0;
}

}  // namespace

Action add_deform(CommandOptions& command) {
  const auto options = std::make_shared<DeformOptions>();
  add_deform_options(command, *options);
  command.footer(
      "For a scene it reports how much valley floor is visible, how strong the bend is, and where "
      "handles fold the ground.\n"
      "A deformed DEM keeps extent, CRS and voids; where ground overlaps, it holds the higher one. "
      "The terrain of a scene is\n"
      "generalized as in the picture.\n"
      "\n"
      "  belvedere deform scenes/karwendel.toml --data ../data --search-bend --out bend.png\n"
      "  belvedere deform scenes/karwendel.toml --data ../data --locate 681500,5237300 --at "
      "1200,700\n"
      "  belvedere deform scenes/karwendel.toml --data ../data --locate huts.gpkg --out huts.csv\n"
      "  belvedere deform dem.tif bent.tif --viewer 692000,5302000 --exaggeration 1.6 --bend "
      "30000:20,60000:8,90000:0\n"
      "  belvedere deform dem.tif turned.tif --handle \"674000,5253500 radius=12000 core=4000 "
      "rotate=50\"");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
