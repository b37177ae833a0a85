#include "tools/cli/new/region_sources.h"

#include <fmt/core.h>

#include <filesystem>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/text/missing_file.h"
#include "renderer/style/style_file.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/crs.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_io.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

// Path of a file of the command line: as given, or in a --data folder.
fs::path find_file(const NewOptions& options, const std::string& file) {
  std::error_code ignored;
  if (is_address(file) || fs::exists(file, ignored)) return file;
  for (const std::string& folder : options.common.files.data_folders)
    if (fs::exists(fs::path(folder) / file, ignored)) return fs::path(folder) / file;
  throw missing_file(file, "a local file, here or in a --data folder");
}

bool is_style_file(const std::string& style) { return style.ends_with(".toml"); }

std::optional<std::string> inside(const fs::path& folder, const fs::path& file) {
  std::error_code problem;
  const fs::path from = fs::weakly_canonical(fs::absolute(folder), problem);
  const fs::path relative =
      fs::weakly_canonical(fs::absolute(file), problem).lexically_relative(from);
  if (problem || relative.empty() || *relative.begin() == "..") return std::nullopt;
  return relative.generic_string();
}

// Without a coordinate system neither the position of the region nor the unit of its cells is
// known.
void require_crs(const std::vector<RasterSource>& sources) {
  for (const RasterSource& source : sources) {
    if (!source.crs.empty() || !read_raster_info(source).crs.empty()) continue;
    throw Error(ErrorKind::input, source.path, "has no coordinate system",
                "--crs with the code that the data's source names, such as --crs EPSG:32632, or a "
                ".prj file beside it");
  }
}

// Folder of fetched data: beside the scene, so that the scene finds them.
fs::path fetch_folder(const NewOptions& options) {
  if (!options.fetched.empty()) return options.fetched;
  const fs::path scene(options.out);
  return scene.parent_path() / (scene.stem().string() + "_data");
}

ProposedFile proposed(const FetchedMap& map, std::string name) {
  return {.file = std::move(name),
          .crs = "",
          .lowest_m = {},
          .origin = map.origin,
          .licence = map.licence,
          .get_from = map.get_from};
}

// Elevation and, unless the user gives a file, land cover of --at, with their keys for the scene.
void fetch_data(const NewOptions& options, SceneFileNames& names, const Cache& cache,
                Progress& progress, ProposedScene& about, DemParameters& dem) {
  FetchOptions wanted = options.fetch;
  wanted.http_options.silence_s = options.common.http_silence_s;
  if (!options.cover.file.empty()) wanted.no_land_cover = true;
  wanted.replace = options.force;
  const fs::path folder = fetch_folder(options);
  const FetchedArea area =
      fetch_area(fetch_parameters(wanted), folder.string(), cache, progress, sources_for_scenes);
  RasterSource source;
  source.path = (folder / area.elevation.file).string();
  about.sources.push_back(proposed(area.elevation, names.name(source.path)));
  dem.sources.push_back(std::move(source));
  if (!area.land_cover) return;
  about.land_cover =
      proposed(*area.land_cover, names.name((folder / area.land_cover->file).string()));
  about.legend = area.land_cover->source.legend;
}

// Share of the region that a raster covers, 0…1: by points at the centres of squares.
double share_under(const CoarseGround& ground, const RasterInfo& info, const std::string& crs) {
  constexpr int positions = 12;  // per side
  std::vector<glm::dvec2> at;
  for (int j = 0; j < positions; ++j)
    for (int i = 0; i < positions; ++i) {
      const glm::dvec2 cell((i + 0.5) / positions * ground.cells.width() - 0.5,
                            (j + 0.5) / positions * ground.cells.height() - 0.5);
      const glm::dvec2 position = ground.transform.to_crs(cell.x, cell.y);
      if (const GroundCell* c = ground.at(position); c != nullptr && c->known)
        at.push_back(position);
    }
  if (at.empty()) return 1.0;
  const std::size_t all = at.size();
  PointTransform(ground.crs, crs).apply(at);
  const auto under = std::count_if(at.begin(), at.end(), [&](glm::dvec2 position) {
    const glm::dvec2 cell = info.transform.to_cell(position.x, position.y);
    return cell.x > -0.5 && cell.y > -0.5 && cell.x < info.width - 0.5 &&
           cell.y < info.height - 0.5;
  });
  return static_cast<double>(under) / static_cast<double>(all);
}

}  // namespace

SceneFileNames::SceneFileNames(const NewOptions& options)
    : folder_(fs::absolute(options.out).parent_path().string()),
      given_(options.common.files.data_folders) {}

std::string SceneFileNames::name(const std::string& path) {
  const fs::path file(path);
  if (is_address(file.string())) return file.string();
  if (const auto name = inside(folder_, file)) return *name;
  for (const std::string& folder : given_)
    if (const auto name = inside(folder, file)) return keep(folder, *name);
  return keep(fs::absolute(file).parent_path().lexically_normal().string(),
              file.filename().string());
}

std::string SceneFileNames::keep(const std::string& folder, const std::string& name) {
  if (std::find(data_.begin(), data_.end(), folder) == data_.end()) data_.push_back(folder);
  return name;
}

void check_files(const NewOptions& options) {
  for (const std::string& file : options.dems) find_file(options, file);
  const std::string& style = options.style;
  if (!style.empty()) read_style(is_style_file(style) ? find_file(options, style).string() : style);
  const NewOptions::Cover& cover = options.cover;
  if (cover.file.empty()) return;
  find_file(options, cover.file);
  read_legend(fs::path(cover.legend).has_extension() ? find_file(options, cover.legend).string()
                                                     : cover.legend,
              options.common.files.data_folders);
}

std::string find_style(const NewOptions& options, SceneFileNames& names) {
  const std::string& style = options.style;
  return is_style_file(style) ? names.name(find_file(options, style)) : style;
}

DemParameters find_elevation(const NewOptions& options, SceneFileNames& names, const Cache& cache,
                             Progress& progress, ProposedScene& about) {
  DemParameters dem;
  for (const std::string& file : options.dems) {
    RasterSource source = elevation_source(find_file(options, file).string(), options.elevation);
    source.crs = options.crs;
    source.lowest_m = options.lowest_m;
    about.sources.push_back({.file = names.name(source.path),
                             .crs = options.crs,
                             .lowest_m = options.lowest_m,
                             .variable = source.variable,
                             .encoding = source.encoding});
    dem.sources.push_back(std::move(source));
  }
  if (!options.fetch.at.empty()) fetch_data(options, names, cache, progress, about, dem);
  require_crs(dem.sources);
  return dem;
}

void find_land_cover(const NewOptions& options, SceneFileNames& names, const CoarseGround& ground,
                     Progress& progress, ProposedScene& about) {
  const NewOptions::Cover& cover = options.cover;
  RasterSource source;
  source.path = find_file(options, cover.file).string();
  source.band = cover.band;
  source.variable = cover.variable;
  const RasterInfo info = read_raster_info(source);
  std::string crs = cover.crs;
  if (crs.empty() && info.crs.empty()) crs = options.crs;
  if (crs.empty() && info.crs.empty())
    throw Error(ErrorKind::input, source.path, "has no coordinate system",
                "--land-cover-crs with the code that the data's source names, such as EPSG:32632, "
                "or a .prj file beside it");
  const double share = share_under(ground, info, crs.empty() ? info.crs : normalize_crs(crs));
  if (share == 0.0)
    throw Error(ErrorKind::input, source.path, "does not overlap the elevation",
                "land cover of the same region, and its own --land-cover-crs");
  constexpr double nearly_all = 0.95;
  if (share < nearly_all)
    progress.note(fmt::format("{} covers only {:.0f} % of the region", source.path, 100.0 * share));
  about.land_cover = ProposedFile{
      .file = names.name(source.path), .crs = crs, .band = cover.band, .variable = cover.variable};
  // A legend is the name of a built-in one, or a file, which the scene must find as well.
  about.legend = fs::path(cover.legend).has_extension()
                     ? names.name(find_file(options, cover.legend))
                     : cover.legend;
  about.unknown = cover.unknown;
}

}  // namespace belvedere::tools
