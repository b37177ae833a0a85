#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/files/output_file.h"
#include "base/math.h"
#include "base/progress.h"
#include "base/text/json.h"
#include "base/text/missing_file.h"
#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/proposed_scene.h"
#include "renderer/compose/region_climate.h"
#include "renderer/compose/view_changes.h"
#include "renderer/style/style_file.h"
#include "renderer/world/viewer_check.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/crs.h"
#include "terrain/io/dem.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_io.h"
#include "tools/cli/commands.h"
#include "tools/cli/new/contact_sheet.h"
#include "tools/cli/new/new_options.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// Names of the scene's files, which must be beside it or in a --data folder.
class SceneFileNames {
 public:
  explicit SceneFileNames(const NewOptions& options);
  // The scene's name for a file; its folder is added to data() if the scene needs it.
  std::string name(const std::string& path);
  // The folders that rendering needs as --data.
  const std::vector<std::string>& data() const { return data_; }
  // The scene's own.
  const std::string& folder() const { return folder_; }

 private:
  std::string keep(const std::string& folder, const std::string& name);

  std::string folder_;
  std::vector<std::string> given_;
  std::vector<std::string> data_;
};

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

// Checks before any work that the files that options name exist, and that style and legend are
// such.
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

// Path of the style file that the scene names, or its built-in name.
std::string find_style(const NewOptions& options, SceneFileNames& names) {
  const std::string& style = options.style;
  return is_style_file(style) ? names.name(find_file(options, style)) : style;
}

// The elevation of the region: the files of the command line or, with --at, what is fetched for it,
// with its land cover. `about` receives the scene's keys for them. Throws Error(input) for files
// that do not exist or are not georeferenced, and the errors of fetch_area.
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

// The user's own land cover: his description of the file is checked against it, so that a wrong
// band or position is found before rendering. Throws Error(input) for a file that does not exist,
// is not georeferenced, or does not overlap the ground.
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

namespace fs = std::filesystem;

// A short name of the metric CRS of the scene; empty where only the WKT of the data names it.
std::string short_crs(const std::string& crs) {
  const std::string name = describe_crs(crs);
  if (!name.starts_with("EPSG:")) return "";
  return same_crs(normalize_crs(name), crs) ? name : "";
}

std::string title_of(const std::string& path) {
  std::string title = fs::path(path).stem().string();
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

ViewRequest request_of(const NewOptions& options, const ViewFormat& format,
                       const CoarseGround& ground) {
  ViewRequest out;
  out.format = format;
  out.plain = options.plain;
  if (!options.towards.empty()) out.towards_deg = read_direction(options.towards);
  const GeoTransform& t = ground.transform;
  const DataExtent data{
      {t.to_crs(-0.5, ground.cells.height() - 0.5), t.to_crs(ground.cells.width() - 0.5, -0.5)},
      ground.crs};
  const auto position = [&](const std::string& option, glm::dvec2 lonlat) {
    // The viewer may stand outside the data, places that must be visible may not.
    return place_near_data({option, lonlat, true}, data,
                           option == "--from" ? 2.0 * ground.side_m : 0.0);
  };
  if (!options.from.empty()) out.from = position("--from", read_lonlat("--from", options.from));
  for (const std::string& text : options.include) {
    const NamedPlace named = read_named_place(text);
    out.include.push_back({named.name, position("--include", named.lonlat)});
  }
  return out;
}

std::string as_json(const ViewSearch& search, const std::vector<Candidate>& proposals,
                    const NewOptions& options, const std::string& sheet) {
  Json list = Json::array();
  for (const Candidate& c : proposals) {
    Json terms = Json::object();
    for (const ScoreTerm& term : c.terms)
      terms.add(std::string(term.name), Json::number(term.value));
    list.add(
        Json::object()
            .add("what", Json::text(describe_view(search, c)))
            .add("merit", Json::number(c.merit))
            .add("changes", Json::text(describe_changes(search, c)))
            .add("viewer", Json::array({Json::number(c.view.viewer.x),
                                        Json::number(c.view.viewer.y), Json::number(c.view.eye_m)}))
            .add("azimuth_deg", Json::number(c.view.azimuth_deg))
            .add("measures", std::move(terms)));
  }
  return Json::object()
             .add("scene", Json::text(options.out))
             .add("chosen", Json::number(options.choose))
             .add("pictures", Json::text(sheet))
             .add("proposals", std::move(list))
             .str() +
         "\n";
}

// Millions of cells of all drafts, so that land cover is computed once: two pixels wide at the
// nearest lower edge, and no more than can be prepared in half a second. 0: those of the data.
double draft_mcells(const CoarseGround& ground, const std::vector<Candidate>& proposals,
                    int width_px) {
  constexpr double pixels = 2.0, worth_it = 1.3, max_cells = 0.5e6;
  double min = 1e9;
  for (const Candidate& c : proposals)
    min = std::min(min, pixels * c.view.near_m * to_radians(c.view.field_of_view_deg) / width_px);
  min = std::max(min, ground.side_m / std::sqrt(max_cells));
  const double side = ground.side_m / min;
  return min > worth_it * ground.source_cell_m ? 1e-6 * side * side : 0.0;
}

void note_limits(const CoarseGround& ground, const Massifs& massifs, Progress& progress) {
  constexpr double much_void = 0.3;
  if (ground.void_share > much_void)
    progress.note(fmt::format("{:.0f} % of the data's extent is empty; views avoid it",
                              100.0 * ground.void_share));
  for (const Anchor& summit : massifs.at_the_rim)
    progress.note(
        fmt::format("the most prominent mountain, {:.0f} m, lies at the edge of the data, where a "
                    "picture fades out: with data {:.0f} km farther it could be the main one",
                    summit.altitude_m, std::ceil(0.15 * ground.side_m / 1000.0)));
}

// The part of the merit that is gained by unusual means.
double won(const Candidate& candidate) {
  double out = candidate.changes.widened.merit;
  for (const RaisedSummit& summit : candidate.changes.summits) out += summit.gain.merit;
  return out;
}

// The ground in which views are searched, and the keys of a scene besides its view.
struct Region {
  CoarseGround ground;
  Massifs massifs;
  ProposedScene about;
};

Region read_region(const NewOptions& options, const SheetFormat& format, SceneFileNames& names,
                   const Cache& cache, Progress& progress) {
  check_files(options);
  ProposedScene about;
  about.title = options.title.empty()
                    ? title_of(options.dems.empty() ? options.out : options.dems.front())
                    : options.title;
  about.style = find_style(options, names);
  about.width_px = format.width_px;
  about.sheet_width_mm = format.sheet_width_mm;
  const DemParameters dem = find_elevation(options, names, cache, progress, about);
  CoarseGround ground = read_coarse_ground(dem, progress);
  about.crs = short_crs(ground.crs);
  if (!options.cover.file.empty()) find_land_cover(options, names, ground, progress, about);
  progress.begin("looking for views", 0.0);
  Massifs massifs = find_massifs(ground);
  require_region(ground, massifs, dem.sources.front().path);
  note_limits(ground, massifs, progress);
  const RegionClimate climate = region_climate(ground);
  if (about.style.empty()) {  // a style has its own palette
    about.palette = dry_palette(climate, ground.plateau);
    about.palette_why = "the climate here is dry; or summer, steppe, high_desert, desert";
  }
  if (is_canyon_country(climate)) {
    // Dry mountains may be of any rock; plateaus cut by canyons are of beds.
    constexpr double mostly = 0.5;
    if (ground.plateau > mostly) about.rock = "sandstone";
    about.rock_why = "of canyons in dry country; or limestone, granite, volcanic";
  }
  return {std::move(ground), std::move(massifs), std::move(about)};
}

}  // namespace

std::string new_scene_text(const NewOptions& options, const Cache& cache, Progress& progress) {
  const SheetFormat format = read_format(options.format);
  SceneFileNames names(options);
  const Region region = read_region(options, format, names, cache, progress);
  const ViewSearch search{region.ground, region.massifs,
                          request_of(options, format.picture, region.ground)};
  return proposed_scene_text(search, propose_views(search, {.max = options.max}).front(),
                             region.about);
}

int make_new_scene(const NewOptions& options) {
  if (options.dems.empty() == options.fetch.at.empty())
    throw Error(
        ErrorKind::usage, "DEM",
        options.dems.empty() ? "no elevation is given" : "both elevation files and --at are given",
        "one of the two: elevation files, or --at LON,LAT to fetch them");
  if (fs::exists(options.out) && !options.force)
    throw Error(ErrorKind::output, options.out, "exists already",
                "another name, or --force to replace it");
  if (options.cover.file.empty() != options.cover.legend.empty())
    throw Error(ErrorKind::usage, options.cover.legend.empty() ? "--land-cover" : "--legend",
                "needs the other of the two",
                "--land-cover FILE --legend nlcd, corine, esa_worldcover, fbfm40 or a file");
  const SheetFormat format = read_format(options.format);
  allow_servers(options.common);
  TerminalProgress progress(options.common.quiet);
  const Cache cache = make_cache(options.common);
  const Run run = make_run(options.common, Run{}.tile_px, progress, cache);
  const RunLimits limits(run);

  SceneFileNames names(options);
  Region region = read_region(options, format, names, cache, progress);
  const auto& [ground, massifs, about] = region;
  const ViewSearch search{ground, massifs, request_of(options, format.picture, ground)};
  const std::vector<Candidate> proposals = propose_views(search, {.max = options.max});
  if (options.choose > static_cast<int>(proposals.size()))
    throw Error(
        ErrorKind::usage, "--choose",
        fmt::format("{}, but there are {} different proposals", options.choose, proposals.size()),
        fmt::format("1 … {}", proposals.size()));

  std::vector<std::string> texts;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    region.about.number = fmt::format("{} of {}", i + 1, proposals.size());
    texts.push_back(proposed_scene_text(search, proposals[i], about));
  }
  // Parsed again as for rendering: a scene that does not parse is a bug of the program, and missing
  // files are the user's error.
  SceneFileOptions files{.data_folders = names.data(), .settings = {}};
  std::vector<LoadedScene> scenes;
  for (const std::string& text : texts)
    scenes.push_back(
        parse_scene(text, fs::path(options.out).stem().string(), names.folder(), files));
  std::string sheet;
  if (!options.pictures.empty()) {
    std::vector<LoadedScene> drafts;
    std::vector<std::string> captions;
    ContactSheetParameters look;
    if (format.picture.aspect > 4.0) look = {.width_px = 1200, .columns = 1};
    const double mcells = draft_mcells(ground, proposals, look.width_px);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      drafts.push_back(make_small_draft(scenes[i], look.width_px, mcells));
      const std::string gain =
          won(proposals[i]) > 0.0 ? fmt::format(", gained {:.1f}", won(proposals[i])) : "";
      captions.push_back(fmt::format("{}  merit {:.1f}{}  azimuth {:.0f}, {:.0f} km", i + 1,
                                     proposals[i].merit, gain, proposals[i].view.azimuth_deg,
                                     proposals[i].view.far_m / 1000.0));
    }
    sheet = (fs::path(options.pictures) / "proposals.png").string();
    write_contact_sheet(sheet, drafts, captions, run, look);
  }
  write_text_file(options.out, texts[static_cast<std::size_t>(options.choose - 1)]);
  progress.end();

  if (options.common.json) {
    print_out(as_json(search, proposals, options, sheet));
    return 0;
  }
  if (options.common.quiet) return 0;
  for (std::size_t i = 0; i < proposals.size(); ++i)
    print_out(fmt::format("{} {}. {}\n", static_cast<int>(i) + 1 == options.choose ? "*" : " ",
                          i + 1, describe_view(search, proposals[i])));
  if (!sheet.empty()) print_out(sheet + "\n");
  std::string data;
  for (const std::string& folder : names.data()) data += " --data " + folder;
  print_out(fmt::format("{}\nnext: belvedere render {}{}\n", options.out, options.out, data));
  return 0;
}

Action add_new(CommandOptions& command) {
  const auto options = std::make_shared<NewOptions>();
  add_new_options(command, *options);
  return [options] { return make_new_scene(*options); };
}

}  // namespace belvedere::tools
