#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "base/angle.h"
#include "base/error.h"
#include "base/json.h"
#include "renderer/compose/proposals.h"
#include "renderer/compose/proposed_scene.h"
#include "renderer/compose/region_climate.h"
#include "renderer/compose/view_changes.h"
#include "renderer/image/output_file.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "terrain/io/source_place.h"
#include "tools/cli/commands.h"
#include "tools/cli/fetch/fetch_options.h"
#include "tools/cli/file_names.h"
#include "tools/cli/new/contact_sheet.h"
#include "tools/cli/new/view_options.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/report/text_file.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct Options {
  SceneOptions common;
  FetchOptions fetch;   // --at: the data come from map services
  std::string fetched;  // folder for them; empty: beside the scene
  std::vector<std::string> dems;
  std::string out;
  std::string pictures;
  std::string title;
  std::string crs;
  std::optional<double> lowest_m;
  int choose = 1;
  int most = 5;
  std::string towards, from, format = "2:1";
  std::vector<std::string> include;
  struct Cover {
    std::string file, legend, crs, unknown;
    int band = 1;
  } cover;
  bool search_bend = false, plain = false;
  bool force = false;
};

bool is_address(const std::string& file) { return file.starts_with("http://") || file.starts_with("https://"); }

// Where a file of the command line lies: as given, or in a --data folder.
fs::path find_file(const Options& options, const std::string& file) {
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

// How the scene names its files, which must lie beside it or in a --data folder: `data` are the folders that rendering needs.
class FileNames {
 public:
  explicit FileNames(const Options& options)
      : folder_(fs::absolute(options.out).parent_path()), given_(options.common.files.data_folders) {}
  std::string name(const fs::path& file) {
    if (is_address(file.string())) return file.string();
    if (const auto name = inside(folder_, file)) return *name;
    for (const std::string& folder : given_)
      if (const auto name = inside(folder, file)) return keep(folder, *name);
    return keep(fs::absolute(file).parent_path().lexically_normal().string(), file.filename().string());
  }
  const std::vector<std::string>& data() const { return data_; }
  std::string folder() const { return folder_.string(); }

 private:
  std::string keep(const std::string& folder, const std::string& name) {
    if (std::find(data_.begin(), data_.end(), folder) == data_.end()) data_.push_back(folder);
    return name;
  }
  fs::path folder_;
  std::vector<std::string> given_;
  std::vector<std::string> data_;
};

// Without a coordinate system nobody knows where the region lies, nor whether its cells are metres.
void require_crs(const std::vector<RasterSource>& sources) {
  for (const RasterSource& source : sources) {
    if (!source.crs.empty() || !read_raster_info(source).crs.empty()) continue;
    throw Error(ErrorKind::input, source.path, "does not say in which coordinate system it is",
                "--crs with the code that the data's source names, such as --crs EPSG:32632, or a .prj file beside it");
  }
}

// A short name of the metric system that the places of the scene are in; empty where only the data's own text names it.
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

ViewWishes wishes_of(const Options& options, const PictureFormat& format, const CoarseGround& ground) {
  ViewWishes out;
  out.format = format;
  out.search_bend = options.search_bend;
  out.plain = options.plain;
  if (!options.towards.empty()) out.towards_deg = read_direction(options.towards);
  const std::string degrees = normalize_crs("EPSG:4326");
  const auto place = [&](const std::string& option, glm::dvec2 lonlat) {
    const glm::dvec2 at = transform_point(degrees, ground.crs, lonlat);
    const GeoTransform& t = ground.transform;
    const double width = ground.cells.width() * t.cell_x;
    const double height = ground.cells.height() * t.cell_y;
    // The viewer may stand outside of the data, what is to be seen may not.
    const double slack = option == "--from" ? 2.0 * ground.side_m : 0.0;
    if (!(at.x >= t.origin_x - slack && at.x <= t.origin_x + width + slack && at.y <= t.origin_y + slack &&
          at.y >= t.origin_y - height - slack))
      throw Error(ErrorKind::usage, option, fmt::format("{},{} lies outside of the data", lonlat.x, lonlat.y),
                  "longitude before latitude, a place within the region");
    return at;
  };
  if (!options.from.empty()) out.from = place("--from", read_lonlat("--from", options.from));
  for (const std::string& text : options.include) {
    const NamedPlace named = read_named_place(text);
    out.include.push_back({named.name, place("--include", named.lonlat)});
  }
  return out;
}

std::string as_json(const ViewSearch& search, const std::vector<Candidate>& proposals, const Options& options, const std::string& sheet) {
  Json list = Json::array();
  for (const Candidate& c : proposals) {
    Json terms = Json::object();
    for (const ScoreTerm& term : c.terms) terms.add(std::string(term.name), Json::number(term.value));
    list.add(Json::object()
                 .add("what", Json::text(describe_view(search, c)))
                 .add("merit", Json::number(c.merit))
                 .add("changes", Json::text(describe_changes(search, c)))
                 .add("viewer", Json::array({Json::number(c.view.viewer.x), Json::number(c.view.viewer.y), Json::number(c.view.eye_m)}))
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

// One size of cells for all drafts, so that land cover is found once: two pixels at the nearest lower edge, and no more cells than are made
// into a ground in half a second. 0: those of the data.
double draft_cell_m(const CoarseGround& ground, const std::vector<Candidate>& proposals, int width_px) {
  constexpr double pixels = 2.0, worth_it = 1.3, most_cells = 0.5e6;
  double least = 1e9;
  for (const Candidate& c : proposals) least = std::min(least, pixels * c.view.near_m * to_radians(c.view.field_of_view_deg) / width_px);
  least = std::max(least, ground.side_m / std::sqrt(most_cells));
  return least > worth_it * ground.source_cell_m ? std::floor(least) : 0.0;
}

void note_limits(const std::vector<RasterSource>& sources, const CoarseGround& ground, const Massifs& massifs, Progress& progress) {
  for (const RasterSource& source : sources)
    if (const std::string doubt = doubt_of_source(source); !doubt.empty()) progress.note(doubt);
  constexpr double much_void = 0.3;
  if (ground.void_share > much_void)
    progress.note(fmt::format("{:.0f} % of the data's frame is empty; views keep away from there", 100.0 * ground.void_share));
  for (const Anchor& summit : massifs.at_the_rim)
    progress.note(
        fmt::format("the mountain that stands out most, {:.0f} m, lies at the edge of the data, where a picture fades out: with data "
                    "that reach {:.0f} km farther it could be the main one",
                    summit.altitude_m, std::ceil(0.15 * ground.side_m / 1000.0)));
}

// Where fetched data go: beside the scene, so that it finds them.
fs::path fetch_folder(const Options& options) {
  if (!options.fetched.empty()) return options.fetched;
  const fs::path scene(options.out);
  return scene.parent_path() / (scene.stem().string() + "_data");
}

ProposedFile proposed(const FetchedMap& map, std::string name) {
  return {.file = std::move(name), .crs = "", .lowest_m = {}, .origin = map.origin, .licence = map.licence, .get_from = map.get_from};
}

// Elevation and, unless the user has his own, land cover of --at; what the scene says of them.
void fetch_data(const Options& options, FileNames& names, const Cache& cache, Progress& progress, ProposedScene& about,
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
  about.land_cover = proposed(*area.land_cover, names.name(folder / area.land_cover->file));
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

// The user's own land cover: what he says of the file is held against it, so that a wrong band or place is found before anything is drawn.
void name_land_cover(const Options& options, FileNames& names, const CoarseGround& ground, Progress& progress, ProposedScene& about) {
  const Options::Cover& cover = options.cover;
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

// What of the merit is won by means beyond the usual.
double won(const Candidate& candidate) {
  double out = candidate.bend.merit + candidate.changes.widened.merit;
  for (const RaisedSummit& summit : candidate.changes.summits) out += summit.gain.merit;
  return out;
}

int run_new(const Options& options) {
  if (options.dems.empty() == options.fetch.at.empty())
    throw Error(ErrorKind::usage, "DEM", options.dems.empty() ? "no elevation is given" : "elevation files and --at are given",
                "one of the two: files of elevation, or --at LON,LAT to fetch it");
  if (fs::exists(options.out) && !options.force)
    throw Error(ErrorKind::output, options.out, "is there already", "another name, or --force to replace it");
  if (options.cover.file.empty() != options.cover.legend.empty())
    throw Error(ErrorKind::usage, options.cover.legend.empty() ? "--land-cover" : "--legend", "goes with the other of the two",
                "--land-cover FILE --legend nlcd, corine, esa_worldcover, fbfm40 or a file");
  const SheetFormat format = read_format(options.format);
  check_place(options.out);
  if (!options.pictures.empty()) check_output_folder(options.pictures);
  allow_servers(options.common);
  TerminalProgress progress(options.common.quiet);
  const Cache cache = make_cache(options.common);
  const Run run = make_run(options.common, Run{}.tile_px, progress, cache);
  const RunLimits limits(run);

  FileNames names(options);
  ProposedScene about;
  about.title = options.title.empty() ? title_of(options.dems.empty() ? options.out : options.dems.front()) : options.title;
  about.width_px = format.width_px;
  about.sheet_width_mm = format.sheet_width_mm;
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
  const CoarseGround ground = read_coarse_ground(dem, progress);
  about.crs = short_crs(ground.crs);
  if (!options.cover.file.empty()) name_land_cover(options, names, ground, progress, about);
  progress.begin("looking for views", 0.0);
  const Massifs massifs = find_massifs(ground);
  require_region(ground, massifs, dem.sources.front().path);
  note_limits(dem.sources, ground, massifs, progress);
  if (is_canyon_country(region_climate(ground))) {
    about.palette = "desert";
    about.palette_why = "the climate of the place is dry and warm";
    // Dry mountains are of any rock; plateaus that canyons cut are of beds.
    constexpr double mostly = 0.5;
    if (ground.plateau > mostly) about.rock = "sandstone";
    about.rock_why = "of canyons in dry country; or limestone, granite, volcanic";
  }
  const ViewSearch search{ground, massifs, wishes_of(options, format.picture, ground)};
  const std::vector<Candidate> proposals = propose_views(search, {.most = options.most});
  if (options.choose > static_cast<int>(proposals.size()))
    throw Error(ErrorKind::usage, "--choose", fmt::format("{}, and there are {} proposals that differ", options.choose, proposals.size()),
                fmt::format("1 … {}", proposals.size()));

  std::vector<std::string> texts;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    about.number = fmt::format("{} of {}", i + 1, proposals.size());
    texts.push_back(proposed_scene_text(search, proposals[i], about));
  }
  // Read back as rendering will: a scene that does not parse is a fault of the program, and files that are not found are the user's.
  SceneFileOptions files{.data_folders = names.data(), .settings = {}};
  std::vector<LoadedScene> scenes;
  for (const std::string& text : texts) scenes.push_back(parse_scene(text, fs::path(options.out).stem().string(), names.folder(), files));
  std::string sheet;
  if (!options.pictures.empty()) {
    std::vector<LoadedScene> drafts;
    std::vector<std::string> captions;
    ContactSheetParameters look;
    if (format.picture.aspect > 4.0) look = {.width_px = 1200, .columns = 1};
    const double cell_m = draft_cell_m(ground, proposals, look.width_px);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      drafts.push_back(make_small_draft(scenes[i], look.width_px, cell_m));
      const std::string gain = won(proposals[i]) > 0.0 ? fmt::format(", won {:.1f}", won(proposals[i])) : "";
      captions.push_back(fmt::format("{}  merit {:.1f}{}  azimuth {:.0f}, {:.0f} km", i + 1, proposals[i].merit, gain,
                                     proposals[i].view.azimuth_deg, proposals[i].view.far_m / 1000.0));
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
    print_out(
        fmt::format("{} {}. {}\n", static_cast<int>(i) + 1 == options.choose ? "*" : " ", i + 1, describe_view(search, proposals[i])));
  if (!sheet.empty()) print_out(sheet + "\n");
  std::string data;
  for (const std::string& folder : names.data()) data += " --data " + folder;
  print_out(fmt::format("{}\nnext: belvedere render {}{}\n", options.out, options.out, data));
  return 0;
}

}  // namespace

Action add_new(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("DEM", options->dems, "Elevation of the region: one file, or several that are joined; or --at, and it is fetched");
  command.add_option("--out", options->out, "The scene file to write")->type_name("FILE")->required();
  command.add_flag("--force", options->force, "Replaces a scene file that is there");
  command
      .add_option("--pictures", options->pictures,
                  "Renders small pictures of all proposals and writes them there as one sheet, proposals.png")
      ->type_name("DIR");
  command.add_option("--choose", options->choose, "Which of the proposals is written")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 12));
  command.add_option("--proposals", options->most, "How many proposals to make, at most")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 12));
  command
      .add_option("--towards", options->towards, "Where to look: N, NE, southwest … or an azimuth in degrees; 15° either way are left free")
      ->type_name("DIRECTION");
  command.add_option("--from", options->from, "Where the viewer stands: longitude and latitude")->type_name("LON,LAT");
  command
      .add_option("--include", options->include,
                  "A place that must be in the picture: \"Innsbruck|11.39,47.27\" or 11.39,47.27; may be repeated")
      ->type_name("[NAME|]LON,LAT")
      ->allow_extra_args(false);
  command
      .add_option("--format", options->format,
                  "Shape of the sheet: 2:1, 3:1 …; A2, \"A2 upright\"; 2400x1200 pixels; cylinder, \"cylinder 8:1\" for a view all around")
      ->type_name("FORMAT")
      ->capture_default_str();
  command.add_flag("--search-bend", options->search_bend,
                   "Tries bends other than parabolas, and takes one where it makes a better picture");
  command.add_flag("--plain", options->plain,
                   "Neither widens valleys nor raises summits where that makes a better picture: the land is raised and bent as a whole");
  command.add_option("--title", options->title, "Title of the scene; without it the file's name")->type_name("TEXT");
  command.add_option("--crs", options->crs, "Coordinate system of files that do not say it: EPSG:32632, or its definition")
      ->type_name("CRS");
  command.add_option("--lowest", options->lowest_m, "Altitudes below this are faults of the data, in metres")->type_name("M");
  CLI::Option* cover =
      command.add_option("--land-cover", options->cover.file, "A raster of land cover; without it, climate and shape of the ground tell")
          ->type_name("FILE");
  command.add_option("--legend", options->cover.legend, "What its codes mean: nlcd, corine, esa_worldcover, fbfm40, or a file")
      ->type_name("NAME");
  command.add_option("--land-cover-band", options->cover.band, "Which band of that file holds the codes, where it is not the first")
      ->type_name("N")
      ->check(CLI::Range(1, 65535))
      ->needs(cover);
  command
      .add_option("--land-cover-crs", options->cover.crs,
                  "Its coordinate system, where the file does not say it and it is not that of --crs: EPSG:26911, or its definition")
      ->type_name("CRS")
      ->needs(cover);
  command.add_option("--land-cover-unknown", options->cover.unknown, "The class of codes that the legend lacks, such as shrub")
      ->type_name("CLASS")
      ->needs(cover);
  add_file_options(command, options->common);
  add_fetch_options(command, options->fetch);
  command.add_option("--fetched", options->fetched, "The folder for what --at fetches; default: beside the scene, SCENE_data")
      ->type_name("DIR");
  add_run_options(command, options->common);
  command.footer(
      "Looks at the elevation alone and proposes views that differ: where to stand, where to look, how far to bend and raise\n"
      "the ground. Sky, foreground and horizon are laid out by rule; mountains, canyons, lakes, open valleys and ranges decide\n"
      "which view is best. The scene says at each value why it is so; change what you like, and belvedere check judges it\n"
      "by the same measures.\n\n"
      "  belvedere new my_dem.tif --out scene.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --pictures proposals\n"
      "  belvedere new my_dem.tif --out scene.toml --choose 2 --force\n"
      "  belvedere new --at 11.4,47.35 --size 60 --out karwendel.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --towards south --format 3:1 --include \"Innsbruck|11.39,47.27\"");
  return [options] { return run_new(*options); };
}

}  // namespace belvedere::tools
