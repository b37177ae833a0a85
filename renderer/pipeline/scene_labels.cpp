#include "renderer/pipeline/scene_labels.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <iterator>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/files/kept_files.h"
#include "base/files/output_file.h"
#include "renderer/image/image_io.h"
#include "renderer/labels/drawing_svg.h"
#include "renderer/labels/label_files.h"
#include "renderer/labels/sheet_painter.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_file.h"
#include "terrain/shape/valley_floor.h"

namespace belvedere {
namespace {

struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  void add(glm::dvec2 position) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
};

std::string metres(const Extent& e) {
  return fmt::format("E {:.0f} … {:.0f}, N {:.0f} … {:.0f}", e.low.x, e.high.x, e.low.y, e.high.y);
}

// The same in degrees, which show errors more clearly; empty without a CRS.
std::string degrees(const std::vector<glm::dvec2>& corners, const std::string& crs) {
  if (crs.empty()) return {};
  std::vector<glm::dvec2> positions = corners;
  PointTransform(crs, "EPSG:4326").apply(positions);
  Extent e;
  for (const glm::dvec2 position : positions) {
    if (!std::isfinite(position.x)) return {};
    e.add(position);
  }
  return fmt::format("longitude {:.2f} … {:.2f}, latitude {:.2f} … {:.2f}", e.low.x + 0.0,
                     e.high.x + 0.0, e.low.y + 0.0, e.high.y + 0.0);
}

// Compares the extents of features and terrain, both in the files' units. `what`: "points", "ways".
[[noreturn]] void fail_outside(const std::string& where, const char* what, std::size_t count,
                               const std::vector<glm::dvec2>& positions, const Dem& dem) {
  Extent found;
  for (const glm::dvec2 position : positions) found.add(position);
  const glm::dvec2 a = dem.transform.to_crs(-.5, dem.height() - .5);
  const glm::dvec2 b = dem.transform.to_crs(dem.width() - .5, -.5);
  const Extent terrain{a, b};
  const std::string found_degrees = degrees(positions, dem.crs);
  const std::string own_degrees = degrees({a, b, {a.x, b.y}, {b.x, a.y}}, dem.crs);
  throw Error(ErrorKind::usage, where,
              fmt::format("none of {} {} lies on the terrain: they lie {}{}", count, what,
                          metres(found), found_degrees.empty() ? "" : " (" + found_degrees + ")"),
              fmt::format("positions within {}{}{}", metres(terrain),
                          dem.crs.empty() ? "" : " (" + describe_crs(dem.crs) + ")",
                          own_degrees.empty() ? "" : ", which is " + own_degrees));
}

bool lies_on(const Dem& dem, glm::dvec2 position) {
  const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
  return cell.x >= -.5 && cell.y >= -.5 && cell.x <= dem.width() - .5 &&
         cell.y <= dem.height() - .5;
}

void require_on_terrain(const std::string& where, const char* what, std::size_t count,
                        const std::vector<glm::dvec2>& positions, const Dem& dem) {
  if (!positions.empty() &&
      std::none_of(positions.begin(), positions.end(),
                   [&](glm::dvec2 position) { return lies_on(dem, position); }))
    fail_outside(where, what, count, positions, dem);
}

// Content of the files of a job.
struct NamesRead {
  std::vector<LabelPoint> points;
  std::vector<LabelShape> shapes;
  std::vector<MapLine> ways;
};

template <class T>
void append(std::vector<T>& to, std::vector<T> more) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

void require_points_on_terrain(const std::vector<LabelPoint>& points, const Dem& dem) {
  std::vector<glm::dvec2> positions;
  for (const LabelPoint& point : points) positions.push_back(point.position);
  if (!points.empty())
    require_on_terrain(points.front().where, "points", points.size(), positions, dem);
}

// The label style of a job, which may differ from that of its scene.
LabelStyle style_of(const LoadedScene& scene, const std::string& file) {
  return *scene.kept->get<LabelStyle>("label style " + file, {file},
                                      [&] { return load_label_style(file); });
}

NamesRead read_names(const LabelJob& job, const LabelStyle& style, const Dem& dem,
                     Progress& progress) {
  NamesRead names;
  for (const VectorSource& file : job.points)
    append(names.points, read_label_points(file, dem.crs, style, progress));
  for (const VectorSource& file : job.shapes)
    append(names.shapes, read_label_shapes(file, dem.crs, style, progress));
  for (const VectorSource& file : job.tracks) append(names.ways, read_lines(file, dem.crs));
  require_points_on_terrain(names.points, dem);
  std::vector<glm::dvec2> positions;
  for (const LabelShape& shape : names.shapes)
    for (const std::vector<glm::dvec2>& part : shape.parts)
      positions.insert(positions.end(), part.begin(), part.end());
  if (!names.shapes.empty())
    require_on_terrain(names.shapes.front().point.where, "lines and areas", names.shapes.size(),
                       positions, dem);
  positions.clear();
  for (const MapLine& way : names.ways)
    positions.insert(positions.end(), way.positions.begin(), way.positions.end());
  if (!names.ways.empty())
    require_on_terrain(names.ways.front().where, "ways", names.ways.size(), positions, dem);
  return names;
}

// The same, read once for a coordinate system.
NamesRead names_of(const LoadedScene& scene, const LabelJob& job, const LabelStyle& style,
                   const Dem& dem, Progress& progress) {
  CacheKeyText key;
  key.add("names in", dem.crs).add("style", job.style);
  key.add("low", dem.transform.to_crs(0, 0))
      .add("high", dem.transform.to_crs(dem.width(), dem.height()));
  std::vector<std::string> files;
  for (const std::vector<VectorSource>* kind : {&job.points, &job.shapes, &job.tracks}) {
    key.add("files", static_cast<std::uint64_t>(kind->size()));
    for (const VectorSource& file : *kind) {
      const auto& [path, crs, encoding] = file;
      key.add("file", path).add("crs", crs).add("encoding", encoding);
      for (std::string& part : vector_parts(path)) files.push_back(std::move(part));
    }
  }
  return *scene.kept->get<NamesRead>(key.str(), files,
                                     [&] { return read_names(job, style, dem, progress); });
}

std::string kinds_of(const LabelStyle& style) {
  std::string out;
  for (const LabelKindStyle& kind : style.kinds) out += (out.empty() ? "" : ", ") + kind.name;
  return out;
}

// Changes what a cartographer decided about single names, and leaves out those that are hidden.
void change_by_hand(const std::vector<SceneNameByHand>& changes, const LabelStyle& style,
                    std::vector<LabelPoint>& points, std::vector<LabelShape>& shapes,
                    Progress& progress) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const SceneNameByHand& change = changes[i];
    const int kind = change.kind.empty() ? -1 : style.find(change.kind);
    if (kind < 0 && !change.kind.empty())
      throw Error(ErrorKind::usage, fmt::format("labels.by_hand.{}.kind", i),
                  fmt::format("\"{}\" is no kind of the style {}", change.kind, style.name),
                  kinds_of(style));
    bool found = false;
    const auto apply = [&](LabelPoint& point) {
      if (point.name != change.name) return false;
      found = true;
      if (kind >= 0) point.kind = kind;
      if (change.rank) point.rank = *change.rank;
      if (change.dx_mm || change.dy_mm)
        point.by_hand_mm = {change.dx_mm.value_or(0.0), change.dy_mm.value_or(0.0)};
      return change.hidden;
    };
    std::erase_if(points, apply);
    std::erase_if(shapes, [&](LabelShape& shape) { return apply(shape.point); });
    if (!found)
      progress.note(fmt::format("labels.by_hand.{}: no file names \"{}\"", i, change.name));
  }
}

std::vector<VectorSource> sources_of(const LoadedScene& scene,
                                     const std::vector<SceneLabelFile>& files, Progress& progress) {
  std::vector<VectorSource> sources;
  for (const SceneLabelFile& file : files) {
    if (!file.enabled) continue;
    VectorSource source = file.source;
    source.path = find_scene_file(scene, file.file);
    if (!source.path.empty())
      sources.push_back(std::move(source));
    else if (file.optional)
      progress.note(file.file + " is missing: its names are left out" +
                    similar_scene_file_hint(scene, file.file));
    else
      throw missing_scene_file(scene, file.file);
  }
  return sources;
}

// The same drawing as SVG and PNG, on white, because slide and text programs take PNG.
void write_profile(const LabelSheet& sheet, std::size_t track,
                   const std::filesystem::path& folder) {
  constexpr double px_per_mm = 300.0 / 25.4;
  const Drawing drawing = profile_drawing(sheet.tracks[track], sheet.style.track.colour, px_per_mm);
  const std::string stem = (folder / fmt::format("profile_{}", track + 1)).string();
  write_text_file(stem + ".svg", drawing_svg(drawing, drawing.size_px.x / px_per_mm));
  Grid<glm::vec3> pixels(static_cast<int>(std::lround(drawing.size_px.x)),
                         static_cast<int>(std::lround(drawing.size_px.y)), glm::vec3(1.F));
  SheetPainter(drawing).paint(pixels, {0, 0});
  write_png8(stem + ".png", pixels, {});
}

}  // namespace

LabelJob label_job(const LoadedScene& scene, Progress& progress) {
  const SceneLabels& labels = scene.scene.labels;
  return {.points = sources_of(scene, labels.points, progress),
          .shapes = sources_of(scene, labels.shapes, progress),
          .tracks = sources_of(scene, labels.tracks, progress),
          .summits = labels.summits,
          .min_prominence_m = labels.min_prominence_m,
          .style = find_named_file(scene, "labels", labels.style),
          .by_hand = labels.by_hand};
}

LabelStyle read_label_style(const LoadedScene& scene) {
  return style_of(scene, find_named_file(scene, "labels", scene.scene.labels.style));
}

void check_names(const LoadedScene& scene, const Dem& dem) {
  const LabelJob job = label_job(scene, silent_progress());
  const LabelStyle style = style_of(scene, job.style);
  names_of(scene, job, style, dem, silent_progress());
  if (!job.empty() || scene.scene.margin) require_fonts(style);
}

LabelSheet make_label_sheet(const LoadedScene& scene, const LabelJob& job, const BareView& bare,
                            Progress& progress) {
  const LabelStyle style = style_of(scene, job.style);
  auto [points, shapes, lines] = names_of(scene, job, style, *bare.dem, progress);
  std::vector<LabelPoint> unnamed;
  if (job.summits > 0) {
    progress.begin("looking for summits", 0.0);
    const std::vector<Summit> summits =
        find_summits(known_altitude(*bare.dem), {.min_prominence_m = job.min_prominence_m});
    unnamed = unnamed_summits(summits, bare.dem->transform, bare.dem->cell_m(), points, style);
  }
  // Afterwards, so that a summit whose name is hidden does not get its altitude instead.
  change_by_hand(job.by_hand, style, points, shapes, progress);
  const std::size_t named = points.size();
  points.insert(points.end(), unnamed.begin(), unnamed.end());
  if (points.empty() && lines.empty() && shapes.empty())
    throw Error(ErrorKind::usage, "labels", "nothing to name",
                "--points FILE with points, --shapes FILE, --summits N or --tracks FILE");

  progress.begin("finding positions", 0.0);
  const GeoMap map = bare.geo_map();
  const LocatedGround ground{bare.dem->altitude_m, *bare.generalized_m, bare.dem->transform,
                             bare.dem->cell_m(), map};
  std::vector<LabelMark> marks = find_marks(ground, points, style);
  // The most prominent visible summits of the DEM; named ones are all listed.
  std::size_t kept = named;
  for (std::size_t i = named;
       i < points.size() && kept < named + static_cast<std::size_t>(job.summits); ++i)
    if (marks[i].state == MarkState::seen) {
      points[kept] = points[i];
      marks[kept++] = marks[i];
    }
  points.resize(kept);
  marks.resize(kept);
  // Shapes follow the points, each with the line that its name may follow.
  std::vector<std::vector<glm::dvec2>> along(points.size());
  std::vector<ShapeRun> runs = find_shape_runs(ground, shapes);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    points.push_back(shapes[i].point);
    marks.push_back(runs[i].mark);
    along.push_back(std::move(runs[i].line));
  }

  progress.begin("placing names", 0.0);
  const glm::ivec2 size = bare.camera->size();
  LabelSheet sheet = make_labels(points, marks, find_skyline(map, size), style, size,
                                 scene.scene.output.sheet_width_mm, along);
  sheet.tracks = find_tracks(ground, lines);
  return sheet;
}

LabelSheet locate_points(const std::vector<std::string>& files, const BareView& bare,
                         Progress& progress) {
  LabelSheet sheet;
  sheet.size_px = bare.camera->size();
  sheet.style = load_label_style("classic");
  for (LabelKindStyle& kind : sheet.style.kinds) kind.climb_m = 0.0;
  std::vector<LabelPoint> points;
  for (const std::string& file : files)
    append(points,
           read_label_points(file, bare.dem->crs, sheet.style, progress, NamesAre::optional));
  require_points_on_terrain(points, *bare.dem);
  const GeoMap map = bare.geo_map();
  const LocatedGround ground{bare.dem->altitude_m, *bare.generalized_m, bare.dem->transform,
                             bare.dem->cell_m(), map};
  const std::vector<LabelMark> marks = find_marks(ground, points, sheet.style);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Label& label = sheet.labels.emplace_back();
    label.point = points[i];
    label.mark = marks[i];
    label.hidden_by = hiding_name(points, marks, i);
  }
  return sheet;
}

void write_label_files(const LabelSheet& sheet, const std::string& crs, const std::string& folder,
                       const std::string& under, Progress& progress) {
  const std::filesystem::path path = folder;
  write_text_file((path / "labels.svg").string(), labels_svg(sheet, under));
  write_text_file((path / "labels.csv").string(), labels_csv(sheet));
  if (crs.empty())
    progress.note(
        "labels.geojson is left out: GeoJSON needs longitude and latitude, but the terrain has no "
        "CRS");
  else
    write_text_file((path / "labels.geojson").string(), labels_geojson(sheet, crs));
  for (std::size_t i = 0; i < sheet.tracks.size(); ++i) write_profile(sheet, i, path);
}

}  // namespace belvedere
