#include "terrain/fetch/fetch_area.h"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "base/text/json.h"
#include "terrain/io/crs.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

std::string line(const char* key, const std::string& text) {
  return fmt::format("{} = {}\n", key, json_quoted(text));
}

std::string map_record(const FetchedMap& map) {
  const RasterFrame& frame = map.frame;
  std::string out = "\n[[fetched]]\n" + line("file", map.file) + line("hash", map.hash) +
                    line("source", map.source.id) + line("credit", map.source.credit) +
                    line("licence", map.source.licence) + line("crs", describe_crs(frame.crs)) +
                    fmt::format("width = {}\nheight = {}\ncell_m = {}\nwest = {}\nnorth = {}\n",
                                frame.width, frame.height, frame.transform.cell_x,
                                frame.transform.origin_x, frame.transform.origin_y);
  for (const FetchedTile& tile : map.tiles) {
    out += "\n[[fetched.tiles]]\n" + line("name", tile.name) + line("address", tile.address);
    if (tile.about.missing) {
      out += "missing = true\n";
      continue;
    }
    out += fmt::format("bytes = {}\n", tile.about.bytes);
    if (!tile.about.tag.empty()) out += line("tag", tile.about.tag);
    out += line("cells_hash", tile.hash);
  }
  return out;
}

}  // namespace

std::string fetch_record(const FetchParameters& parameters, const FetchedArea& area,
                         const RecordHead& head) {
  std::string out =
      "# Written by belvedere fetch. The first tables can be copied into a scene; the others give "
      "the source of every cell:\n# hashes as in belvedere lock, tags as sent by the servers.\n\n";
  if (head) out += head(area);
  out += fmt::format("\n[request]\nat = [{}, {}]\nsize_km = [{}, {}]\n", parameters.at_lonlat.x,
                     parameters.at_lonlat.y, parameters.size_km.x, parameters.size_km.y);
  out += map_record(area.elevation);
  if (area.land_cover) out += map_record(*area.land_cover);
  return out;
}

void write_fetch_record(const std::string& path, const FetchParameters& parameters,
                        const FetchedArea& area, const RecordHead& head) {
  write_text_file(path, fetch_record(parameters, area, head));
}

namespace {

namespace fs = std::filesystem;

constexpr const char* elevation_file = "elevation.tif";
constexpr const char* cover_file = "land_cover.tif";
constexpr const char* record_file = "fetched.toml";

void check(const FetchParameters& parameters) {
  const auto hold = [](const char* what, double value, double min, double max, const char* unit) {
    if (!(value >= min && value <= max))
      throw Error(ErrorKind::usage, what, fmt::format("{}", value),
                  fmt::format("{} … {} {}", min, max, unit));
  };
  const glm::dvec2 at = parameters.at_lonlat;
  if (std::abs(at.y) > 90.0 && std::abs(at.x) <= 90.0)
    throw Error(ErrorKind::usage, "position",
                fmt::format("{},{}: {} is not a latitude", at.x, at.y, at.y),
                "longitude first, then latitude");
  hold("longitude", at.x, -180.0, 180.0, "°");
  hold("latitude", at.y, -90.0, 90.0, "°");
  hold("size", parameters.size_km.x, 1.0, 400.0, "km");
  hold("size", parameters.size_km.y, 1.0, 400.0, "km");
  if (parameters.cell_m != 0.0)
    hold("cell size of the elevation", parameters.cell_m, 1.0, 10000.0, "m");
  if (parameters.cover_cell_m != 0.0)
    hold("cell size of the land cover", parameters.cover_cell_m, 1.0, 10000.0, "m");
  if (!parameters.mirror.empty()) {
    if (!is_address(parameters.mirror))
      throw Error(ErrorKind::usage, parameters.mirror, "not a URL",
                  "http://SERVER/FOLDER or https://…");
    check_address(parameters.mirror);
  }
}

MapSource source_of_kind(const std::string& name, MapSourceKind kind) {
  MapSource source = read_map_source(name);
  if (source.kind != kind)
    throw Error(ErrorKind::usage, name,
                kind == MapSourceKind::elevation ? "contains land cover" : "contains elevation",
                kind == MapSourceKind::elevation ? "a source of kind = \"elevation\""
                                                 : "a source of kind = \"land_cover\"");
  return source;
}

// A temporary folder next to the results, because its files may be large; removed with the object.
class WorkPlace {
 public:
  explicit WorkPlace(const std::string& folder)
      : path_(fs::path(folder) / fmt::format(".fetch-{}", ::getpid())) {
    std::error_code problem;
    fs::create_directories(path_, problem);
    if (problem)
      throw Error(ErrorKind::output, folder,
                  "cannot create or write the folder: " + problem.message());
  }
  ~WorkPlace() {
    try {
      std::error_code ignored;
      fs::remove_all(path_, ignored);
    } catch (const std::bad_alloc&) {  // a folder stays
    }
  }
  WorkPlace(const WorkPlace&) = delete;
  WorkPlace& operator=(const WorkPlace&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

template <class T>
std::vector<RasterSource> write_parts(const TileMosaic<T>& mosaic, const WorkPlace& position,
                                      const std::string& name) {
  std::vector<RasterSource> sources;
  for (const Raster<T>& part : mosaic.parts) {
    RasterSource source;
    source.path = position.file(fmt::format("{}{}.tif", name, sources.size()));
    write_raster(source.path, part);
    sources.push_back(source);
  }
  return sources;
}

// Degrees around a frame, and the cells needed around its edge for resampling.
DegreeBox degrees_to_read(const RasterFrame& frame, const std::string& crs) {
  constexpr int more = 4;
  RasterFrame wider = frame;
  wider.transform.origin_x -= more * frame.transform.cell_x;
  wider.transform.origin_y += more * frame.transform.cell_y;
  wider.width += 2 * more;
  wider.height += 2 * more;
  return degrees_around(wider, crs);
}

// Heights of the frame. If the source's cell width changes with latitude, each part is resampled
// separately, with rows of its neighbour, and fills the cells inside it.
Raster<float> warp_parts(const TileMosaic<float>& mosaic, const RasterFrame& frame,
                         const MapSource& source, const WorkPlace& position, Progress& progress) {
  const std::vector<RasterSource> files = write_parts(mosaic, position, "elevation");
  Raster<float> out = warp_rasters({files[0]}, frame, progress);
  const PointTransform to_degrees(frame.crs, source.crs);
  std::vector<glm::dvec2> positions(static_cast<std::size_t>(frame.width));
  for (std::size_t part = 1; part < files.size(); ++part) {
    const Raster<float> further = warp_rasters({files[part]}, frame, progress);
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x)
        positions[static_cast<std::size_t>(x)] = frame.transform.to_crs(x, y);
      to_degrees.apply(positions);
      for (int x = 0; x < frame.width; ++x)
        if (positions[static_cast<std::size_t>(x)].y < mosaic.south[part - 1])
          out.cells(x, y) = further.cells(x, y);
    }
  }
  return out;
}

// The day of the oldest response, in UTC.
std::string day_of(const std::vector<FetchedTile>& tiles) {
  std::int64_t oldest = tiles.front().about.asked_unix_s;
  for (const FetchedTile& tile : tiles) oldest = std::min(oldest, tile.about.asked_unix_s);
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(oldest)));
}

std::string list_tiles(const std::vector<FetchedTile>& tiles) {
  constexpr std::size_t max_named = 12;
  std::vector<std::string> names;
  for (const FetchedTile& tile : tiles)
    if (!tile.about.missing) names.push_back(tile.name);
  const std::size_t more = names.size() > max_named ? names.size() - max_named : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

FetchedMap describe_map(const MapSource& source, const RasterFrame& frame,
                        std::vector<FetchedTile> tiles, const std::string& file,
                        const std::string& folder, const FetchParameters& parameters) {
  FetchedMap map;
  map.file = file;
  map.origin = fmt::format("{}{}, tiles {}; fetched {}", source.name,
                           source.date.empty() ? "" : " (" + source.date + ")", list_tiles(tiles),
                           day_of(tiles));
  map.licence = fmt::format("{}. {}", source.credit, source.licence);
  map.get_from = fmt::format("belvedere fetch --at {},{} --size {}x{}{}", parameters.at_lonlat.x,
                             parameters.at_lonlat.y, parameters.size_km.x, parameters.size_km.y,
                             source.get_from.empty() ? "" : "; " + source.get_from);
  map.source = source;
  map.frame = frame;
  map.tiles = std::move(tiles);
  map.hash = hash_file((fs::path(folder) / file).string());
  return map;
}

// Cells without a tile become sea if the ground there is at sea level or unknown.
void fill_sea(Grid<std::int32_t>& codes, const RasterFrame& frame, const MapSource& source,
              const std::vector<FetchedTile>& tiles, const Raster<float>& ground,
              Progress& progress) {
  std::vector<MapTile> missing;
  for (const FetchedTile& tile : tiles)
    if (tile.about.missing) missing.push_back(tile.tile);
  if (source.missing != MissingTile::sea || missing.empty()) return;
  constexpr float level_m = 3.0F;
  const PointTransform to_degrees(frame.crs, source.crs);
  const double around = std::round(360.0 / source.tile_deg.x);
  std::size_t dry = 0;
  std::vector<glm::dvec2> positions;
  for (int y = 0; y < codes.height(); ++y) {
    positions.clear();
    for (int x = 0; x < codes.width(); ++x) positions.push_back(frame.transform.to_crs(x, y));
    to_degrees.apply(positions);
    for (int x = 0; x < codes.width(); ++x) {
      if (codes(x, y) > 0) continue;
      const glm::dvec2 p = positions[static_cast<std::size_t>(x)];
      const int row = static_cast<int>(std::floor((source.origin_deg.y - p.y) / source.tile_deg.y));
      const double column = std::floor((p.x - source.origin_deg.x) / source.tile_deg.x);
      const auto is_here = [&](MapTile tile) {
        return tile.row == row && std::remainder(tile.column - column, around) == 0.0;
      };
      if (std::none_of(missing.begin(), missing.end(), is_here)) continue;
      const glm::dvec2 at = frame.transform.to_crs(x, y);
      const glm::dvec2 cell = ground.transform.to_cell(at.x, at.y);
      const float altitude = ground.cells.clamped(static_cast<int>(std::lround(cell.x)),
                                                  static_cast<int>(std::lround(cell.y)));
      if (std::isfinite(altitude) && std::abs(altitude) > level_m)
        ++dry;
      else
        codes(x, y) = static_cast<std::int32_t>(source.sea_value);
    }
  }
  if (dry > 0)
    progress.note(
        fmt::format("{}: {} cells above sea level are in tiles that the service does not have; "
                    "their class is unknown",
                    source.name, dry));
}

FetchedMap fetch_cover(const FetchParameters& parameters, const std::string& folder,
                       const Raster<float>& ground, const WorkPlace& position,
                       const FetchContext& context) {
  const MapSource source = source_of_kind(parameters.land_cover, MapSourceKind::land_cover);
  double cell_m = parameters.cover_cell_m > 0.0 ? parameters.cover_cell_m : source.cell_m;
  constexpr double max_cells = 64e6;
  const double area_m2 = 1e6 * parameters.size_km.x * parameters.size_km.y;
  if (parameters.cover_cell_m == 0.0)
    cell_m *= std::max(1.0, std::ceil(std::sqrt(area_m2 / max_cells) / cell_m));
  const RasterFrame frame = fetch_frame(parameters, cell_m);
  const int step =
      std::max(1, static_cast<int>(std::lround(std::floor(cell_m / source.cell_m + 1e-6))));
  const TileMosaic<std::uint8_t> mosaic =
      read_cover_tiles(source, degrees_around(frame, source.crs), step, parameters.mirror, context);
  Raster<std::int32_t> codes{Grid<std::int32_t>(frame.width, frame.height, -1), frame.transform,
                             frame.crs};
  if (!mosaic.parts.empty())
    codes = warp_codes(write_parts(mosaic, position, "cover"), frame, context.progress);
  fill_sea(codes.cells, frame, source, mosaic.tiles, ground, context.progress);
  ByteRasterRows file((fs::path(folder) / cover_file).string(),
                      {.frame = frame,
                       .bands = {{fmt::format("{} (legend {})", source.name, source.legend)}},
                       .zero_is_void = true});
  constexpr int strip = 256;
  for (int y = 0; y < frame.height; y += strip) {
    Grid<std::uint8_t> rows(frame.width, std::min(strip, frame.height - y));
    for (int v = 0; v < rows.height(); ++v)
      for (int x = 0; x < frame.width; ++x)
        rows(x, v) = static_cast<std::uint8_t>(std::max(codes.cells(x, y + v), 0));
    file.write(y, {rows});
    context.progress.advance(0.0);
  }
  file.commit();
  return describe_map(source, frame, mosaic.tiles, cover_file, folder, parameters);
}

}  // namespace

RasterFrame fetch_frame(const FetchParameters& parameters, double cell_m) {
  check(parameters);
  RasterFrame frame;
  frame.crs = utm_crs(parameters.at_lonlat);
  const glm::dvec2 centre = transform_point("EPSG:4326", frame.crs, parameters.at_lonlat);
  const glm::dvec2 half = 500.0 * parameters.size_km;
  // A millionth of a cell is rounding.
  const auto down = [&](double m) { return std::floor(m / cell_m + 1e-6); };
  const auto up = [&](double m) { return std::ceil(m / cell_m - 1e-6); };
  const double left = down(centre.x - half.x);
  const double top = up(centre.y + half.y);
  frame.transform = {left * cell_m, top * cell_m, cell_m, cell_m};
  frame.width = static_cast<int>(up(centre.x + half.x) - left);
  frame.height = static_cast<int>(top - down(centre.y - half.y));
  // Near a pole longitudes are meaningless.
  for (const double pole : {90.0, -90.0}) {
    if (std::abs(parameters.at_lonlat.y - pole) > 10.0) continue;
    const glm::dvec2 away =
        glm::dvec2(transform_point("EPSG:4326", frame.crs, {0.0, pole})) - centre;
    if (std::abs(away.x) <= half.x + 10000.0 && std::abs(away.y) <= half.y + 10000.0)
      throw Error(ErrorKind::usage, "position", "the area contains a pole or is close to one",
                  "an area at least 10 km from the pole");
  }
  return frame;
}

DegreeBox degrees_around(const RasterFrame& frame, const std::string& crs) {
  constexpr int steps = 48;
  std::vector<glm::dvec2> positions;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i)
      positions.push_back(
          frame.transform.to_crs(static_cast<double>(frame.width) * i / steps - 0.5,
                                 static_cast<double>(frame.height) * j / steps - 0.5));
  PointTransform(frame.crs, crs).apply(positions);
  const double centre = positions[positions.size() / 2].x;
  DegreeBox box{1e9, 1e9, -1e9, -1e9};
  for (const glm::dvec2& position : positions) {
    const double longitude = centre + std::remainder(position.x - centre, 360.0);
    box.west = std::min(box.west, longitude);
    box.east = std::max(box.east, longitude);
    box.south = std::min(box.south, position.y);
    box.north = std::max(box.north, position.y);
  }
  // Between sampled points, sides may bend outwards by the square of a step.
  const double bulge = 0.02 * std::max(box.east - box.west, box.north - box.south) / steps;
  return {box.west - bulge, std::max(-90.0, box.south - bulge), box.east + bulge,
          std::min(90.0, box.north + bulge)};
}

FetchedArea fetch_area(const FetchParameters& parameters, const std::string& folder,
                       const Cache& cache, Progress& progress, const RecordHead& head) {
  check(parameters);
  const MapSource source = source_of_kind(parameters.elevation, MapSourceKind::elevation);
  if (!parameters.land_cover.empty())
    source_of_kind(parameters.land_cover, MapSourceKind::land_cover);  // fails early
  std::vector<std::string> names = {elevation_file, record_file};
  if (!parameters.land_cover.empty()) names.emplace_back(cover_file);
  file_guard().writes_into(folder, "--out", parameters.replace, names);
  const WorkPlace position(folder);
  const std::int64_t clock = std::chrono::duration_cast<std::chrono::seconds>(
                                 std::chrono::system_clock::now().time_since_epoch())
                                 .count();
  HttpClient client(parameters.http_options, progress);
  const FetchContext context{client, cache, progress,
                             parameters.now_unix_s != 0 ? parameters.now_unix_s : clock,
                             parameters.refresh};

  FetchedArea area;
  const RasterFrame frame =
      fetch_frame(parameters, parameters.cell_m > 0.0 ? parameters.cell_m : source.cell_m);
  // Number of rows that resampling reads on either side of a cell.
  const int shared_rows =
      4 + static_cast<int>(std::ceil(3.0 * frame.transform.cell_y / source.cell_m));
  const TileMosaic<float> mosaic = read_elevation_tiles(source, degrees_to_read(frame, source.crs),
                                                        parameters.mirror, context, shared_rows);
  const Raster<float> ground = warp_parts(mosaic, frame, source, position, progress);
  // Files that belong together: the old record is removed before the first of them is replaced.
  const std::string record = (fs::path(folder) / record_file).string();
  std::error_code ignored;
  fs::remove(record, ignored);
  progress.begin("writing", 0.0);
  write_raster((fs::path(folder) / elevation_file).string(), ground);
  area.elevation = describe_map(source, frame, mosaic.tiles, elevation_file, folder, parameters);
  if (!parameters.land_cover.empty())
    area.land_cover = fetch_cover(parameters, folder, ground, position, context);
  area.record = record;
  area.questions = client.asked();
  area.bytes = client.bytes();
  write_fetch_record(record, parameters, area, head);
  return area;
}

}  // namespace belvedere
