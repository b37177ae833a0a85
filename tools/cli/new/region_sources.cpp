#include "tools/cli/new/region_sources.h"

#include <fmt/core.h>

#include <filesystem>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_io.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

// Where a file of the command line lies: as given, or in a --data folder.
fs::path find_file(const NewOptions& options, const std::string& file) {
  std::error_code ignored;
  if (is_address(file) || fs::exists(file, ignored)) return file;
  for (const std::string& folder : options.common.files.data_folders)
    if (fs::exists(fs::path(folder) / file, ignored)) return fs::path(folder) / file;
  throw Error(ErrorKind::input, file, "there is no such file",
              options.common.files.data_folders.empty() ? "" : "a file here or in a --data folder");
}

std::optional<std::string> inside(const fs::path& folder, const fs::path& file) {
  std::error_code problem;
  const fs::path from = fs::weakly_canonical(fs::absolute(folder), problem);
  const fs::path relative = fs::weakly_canonical(fs::absolute(file), problem).lexically_relative(from);
  if (problem || relative.empty() || *relative.begin() == "..") return std::nullopt;
  return relative.generic_string();
}

// Without a coordinate system nobody knows where the region lies, nor whether its cells are metres.
void require_crs(const std::vector<RasterSource>& sources) {
  for (const RasterSource& source : sources) {
    if (!source.crs.empty() || !read_raster_info(source).crs.empty()) continue;
    throw Error(ErrorKind::input, source.path, "does not say in which coordinate system it is",
                "--crs with the code that the data's source names, such as --crs EPSG:32632, or a .prj file beside it");
  }
}

// Where fetched data go: beside the scene, so that it finds them.
fs::path fetch_folder(const NewOptions& options) {
  if (!options.fetched.empty()) return options.fetched;
  const fs::path scene(options.out);
  return scene.parent_path() / (scene.stem().string() + "_data");
}

ProposedFile proposed(const FetchedMap& map, std::string name) {
  return {.file = std::move(name), .crs = "", .lowest_m = {}, .origin = map.origin, .licence = map.licence, .get_from = map.get_from};
}

// Elevation and, unless the user has his own, land cover of --at; what the scene says of them.
void fetch_data(const NewOptions& options, SceneFileNames& names, const Cache& cache, Progress& progress, ProposedScene& about,
                DemParameters& dem) {
  FetchOptions wanted = options.fetch;
  wanted.manners.silence_s = options.common.http_silence_s;
  if (!options.cover.file.empty()) wanted.no_land_cover = true;
  const fs::path folder = fetch_folder(options);
  const FetchedArea area = fetch_area(fetch_parameters(wanted), folder.string(), cache, progress, sources_for_scenes);
  RasterSource source;
  source.path = (folder / area.elevation.file).string();
  about.sources.push_back(proposed(area.elevation, names.name(source.path)));
  dem.sources.push_back(std::move(source));
  if (!area.land_cover) return;
  about.land_cover = proposed(*area.land_cover, names.name((folder / area.land_cover->file).string()));
  about.legend = area.land_cover->source.legend;
}

// How much of the region a raster lies over, 0…1: by places in the middle of squares.
double share_under(const CoarseGround& ground, const RasterInfo& info, const std::string& crs) {
  constexpr int places = 12;  // a side
  std::vector<glm::dvec2> at;
  for (int j = 0; j < places; ++j)
    for (int i = 0; i < places; ++i) {
      const glm::dvec2 cell((i + 0.5) / places * ground.cells.width() - 0.5, (j + 0.5) / places * ground.cells.height() - 0.5);
      const glm::dvec2 place = ground.transform.to_crs(cell.x, cell.y);
      if (const GroundCell* c = ground.at(place); c != nullptr && c->known) at.push_back(place);
    }
  if (at.empty()) return 1.0;
  const std::size_t all = at.size();
  PointTransform(ground.crs, crs).apply(at);
  const auto under = std::count_if(at.begin(), at.end(), [&](glm::dvec2 place) {
    const glm::dvec2 cell = info.transform.to_cell(place.x, place.y);
    return cell.x > -0.5 && cell.y > -0.5 && cell.x < info.width - 0.5 && cell.y < info.height - 0.5;
  });
  return static_cast<double>(under) / static_cast<double>(all);
}

}  // namespace

SceneFileNames::SceneFileNames(const NewOptions& options)
    : folder_(fs::absolute(options.out).parent_path().string()), given_(options.common.files.data_folders) {}

std::string SceneFileNames::name(const std::string& path) {
  const fs::path file(path);
  if (is_address(file.string())) return file.string();
  if (const auto name = inside(folder_, file)) return *name;
  for (const std::string& folder : given_)
    if (const auto name = inside(folder, file)) return keep(folder, *name);
  return keep(fs::absolute(file).parent_path().lexically_normal().string(), file.filename().string());
}

std::string SceneFileNames::keep(const std::string& folder, const std::string& name) {
  if (std::find(data_.begin(), data_.end(), folder) == data_.end()) data_.push_back(folder);
  return name;
}

DemParameters find_elevation(const NewOptions& options, SceneFileNames& names, const Cache& cache, Progress& progress,
                             ProposedScene& about) {
  DemParameters dem;
  for (const std::string& file : options.dems) {
    RasterSource source;
    source.path = find_file(options, file).string();
    source.crs = options.crs;
    source.lowest_m = options.lowest_m;
    about.sources.push_back({.file = names.name(source.path), .crs = options.crs, .lowest_m = options.lowest_m});
    dem.sources.push_back(std::move(source));
  }
  if (!options.fetch.at.empty()) fetch_data(options, names, cache, progress, about, dem);
  require_crs(dem.sources);
  return dem;
}

void find_land_cover(const NewOptions& options, SceneFileNames& names, const CoarseGround& ground, Progress& progress,
                     ProposedScene& about) {
  const NewOptions::Cover& cover = options.cover;
  RasterSource source;
  source.path = find_file(options, cover.file).string();
  source.band = cover.band;
  const RasterInfo info = read_raster_info(source);
  std::string crs = cover.crs;
  if (crs.empty() && info.crs.empty()) crs = options.crs;
  if (crs.empty() && info.crs.empty())
    throw Error(ErrorKind::input, source.path, "does not say in which coordinate system it is",
                "--land-cover-crs with the code that the data's source names, such as EPSG:32632, or a .prj file beside it");
  const double share = share_under(ground, info, crs.empty() ? info.crs : normalize_crs(crs));
  if (share == 0.0)
    throw Error(ErrorKind::input, source.path, "lies elsewhere than the elevation",
                "land cover of the same region, and --land-cover-crs that is its own");
  constexpr double nearly_all = 0.95;
  if (share < nearly_all) progress.note(fmt::format("{} lies under {:.0f} % of the region alone", source.path, 100.0 * share));
  about.land_cover = ProposedFile{.file = names.name(source.path), .crs = crs, .band = cover.band};
  // A legend is the name of one that the program has, or a file, which the scene must find as well.
  about.legend = fs::path(cover.legend).has_extension() ? names.name(find_file(options, cover.legend)) : cover.legend;
  about.unknown = cover.unknown;
}

}  // namespace belvedere::tools
