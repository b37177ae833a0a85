#include "renderer/pipeline/scene_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "renderer/image/output_file.h"
#include "renderer/labels/label_files.h"
#include "terrain/io/crs.h"
#include "terrain/shape/summits.h"

namespace belvedere {
namespace {

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

std::vector<std::string> paths_of(const LoadedScene& scene, const std::vector<SceneLabelFile>& files, Progress& progress) {
  std::vector<std::string> paths;
  for (const SceneLabelFile& file : files) {
    std::string path = find_scene_file(scene, file.file);
    if (!path.empty())
      paths.push_back(std::move(path));
    else if (file.optional)
      progress.note(file.file + " is missing: its names are left out");
    else
      throw Error(ErrorKind::input, file.file, "there is no such file", "a file beside the scene, or in a folder named with --data");
  }
  return paths;
}

}  // namespace

LabelJob label_job(const LoadedScene& scene, Progress& progress) {
  const SceneLabels& labels = scene.scene.labels;
  return {.points = paths_of(scene, labels.points, progress),
          .shapes = paths_of(scene, labels.shapes, progress),
          .tracks = paths_of(scene, labels.tracks, progress),
          .summits = labels.summits,
          .least_prominence_m = labels.least_prominence_m,
          .style = find_named_file(scene, "labels", labels.style)};
}

LabelSheet make_label_sheet(const LoadedScene& scene, const LabelJob& job, const BareView& bare, Progress& progress) {
  const LabelStyle style = load_label_style(job.style);
  std::vector<LabelPoint> points;
  for (const std::string& file : job.points) {
    const std::vector<LabelPoint> more = read_label_points(file, bare.dem.crs, style, progress);
    points.insert(points.end(), more.begin(), more.end());
  }
  const std::size_t named = points.size();
  std::vector<LabelShape> shapes;
  for (const std::string& file : job.shapes) {
    const std::vector<LabelShape> more = read_label_shapes(file, bare.dem.crs, style, progress);
    shapes.insert(shapes.end(), more.begin(), more.end());
  }
  if (job.summits > 0) {
    progress.begin("looking for summits", 0.0);
    const std::vector<Summit> summits = find_summits(known_altitude(bare.dem), {.least_prominence_m = job.least_prominence_m});
    const std::vector<LabelPoint> unnamed = unnamed_summits(summits, bare.dem.transform, bare.dem.cell_m(), points, style);
    points.insert(points.end(), unnamed.begin(), unnamed.end());
  }
  std::vector<MapLine> lines;
  for (const std::string& file : job.tracks) {
    const std::vector<MapLine> more = read_lines(file, bare.dem.crs);
    lines.insert(lines.end(), more.begin(), more.end());
  }
  if (points.empty() && lines.empty() && shapes.empty())
    throw Error(ErrorKind::usage, "labels", "nothing to name", "--points FILE with points, --shapes FILE, --summits N or --tracks FILE");

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
  for (std::size_t i = named; i < points.size() && kept < named + static_cast<std::size_t>(job.summits); ++i)
    if (marks[i].state == MarkState::seen) {
      points[kept] = points[i];
      marks[kept++] = marks[i];
    }
  points.resize(kept);
  marks.resize(kept);
  // Shapes follow the points, each with the line that its name may stand on.
  std::vector<std::vector<glm::dvec2>> along(points.size());
  std::vector<ShapeRun> runs = find_shape_runs(ground, shapes);
  if (!runs.empty() &&
      std::all_of(runs.begin(), runs.end(), [](const ShapeRun& run) { return run.mark.state == MarkState::outside_terrain; })) {
    std::vector<LabelPoint> places;
    for (const LabelShape& shape : shapes) places.push_back(shape.point);
    fail_outside(places, bare.dem);
  }
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    points.push_back(shapes[i].point);
    marks.push_back(runs[i].mark);
    along.push_back(std::move(runs[i].line));
  }

  progress.begin("placing names", 0.0);
  const glm::ivec2 size = bare.camera->size();
  LabelSheet sheet = make_labels(points, marks, find_skyline(map, size), style, size, scene.scene.output.sheet_width_mm, along);
  sheet.tracks = find_tracks(ground, lines);
  return sheet;
}

void write_label_files(const LabelSheet& sheet, const std::string& crs, const std::string& folder, const std::string& under,
                       Progress& progress) {
  const std::filesystem::path place = folder;
  write_text_file((place / "labels.svg").string(), labels_svg(sheet, under));
  write_text_file((place / "labels.csv").string(), labels_csv(sheet));
  if (crs.empty())
    progress.note("labels.geojson is left out: the terrain has no coordinate system, and GeoJSON speaks longitude and latitude");
  else
    write_text_file((place / "labels.geojson").string(), labels_geojson(sheet, crs));
  for (std::size_t i = 0; i < sheet.tracks.size(); ++i)
    write_text_file((place / fmt::format("profile_{}.svg", i + 1)).string(), profile_svg(sheet.tracks[i], sheet.style.track.colour));
}

}  // namespace belvedere
