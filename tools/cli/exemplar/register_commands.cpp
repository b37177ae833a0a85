#include "tools/cli/exemplar/register_commands.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/exemplar/classes_by_paint.h"
#include "renderer/exemplar/uncertain_places.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/png_palette.h"
#include "renderer/labels/label_points.h"
#include "renderer/labels/label_style.h"
#include "renderer/register/register_by_paint.h"
#include "renderer/register/registered_ground.h"
#include "renderer/register/registered_guidance.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/scene_dem.h"
#include "terrain/io/crs.h"
#include "terrain/register/control_pairs.h"
#include "tools/cli/commands.h"
#include "tools/cli/studio/painting_work.h"
#include "tools/cli/studio/serve_page.h"
#include "tools/cli/terminal.h"
#include "tools/pick/picking.h"
#include "tools/report/register_page.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {

void add_register_options(CommandOptions& command, RegisterOptions& options,
                          const std::string& pairs) {
  command.add_option("PAINTING PICTURE", options.painting, "A painted panorama or its scan")
      .required()
      .files(FileUse::input);
  command.add_option("DEM DEM", options.dems, "Elevation of the region that it shows")
      .required()
      .files(FileUse::input);
  command.add_option("--pairs PAIRS", options.pairs, pairs).required();
  command
      .add_option("--sigma PX", options.sigma_px,
                  "How exactly pixels were clicked: standard deviation in pixels. Default: "
                  "estimated")
      .range(0.1, 100.0);
  command
      .add_option("--projection", options.projection,
                  "As which projection the painting is fitted. Default: the one that fits best")
      .one_of({"auto", "perspective", "cylindrical", "panini"});
  command.add_flag("--cropped", options.cropped,
                   "The painting was cropped on one side: its middle is not that of the view");
  command.add_option("--crs CRS", options.crs,
                     "CRS of the elevation, where its files do not name it");
  command
      .add_option("--cell M", options.cell_m,
                  "Side of the ground's cells in metres. Default: that of the data")
      .range(0.1, 10000.0);
  add_run_options(command, options);
}

DemParameters dem_parameters(const RegisterOptions& options) {
  DemParameters out;
  for (const std::string& path : options.dems) {
    RasterSource source;
    source.path = path;
    source.crs = options.crs;
    out.sources.push_back(source);
  }
  out.cell_m = options.cell_m;
  return out;
}

RegistrationParameters registration_parameters(const RegisterOptions& options) {
  RegistrationParameters out;
  out.sigma_px = options.sigma_px;
  out.view.cropped = options.cropped;
  if (options.projection != "auto")
    std::erase_if(out.view.kinds,
                  [&](ViewKind kind) { return view_kind_name(kind) != options.projection; });
  return out;
}

namespace {

constexpr std::array<std::string_view, 6> about = {"terrain", "deform",        "camera",
                                                   "sun",     "light.regions", "output"};
constexpr std::string_view about_valleys = "generalize";  // if they are wider

}  // namespace

std::string registered_scene_text(const Scene& scene) {
  std::vector<std::string_view> sections(about.begin(), about.end());
  if (scene.generalize.valleys.width_m > 0.F) sections.push_back(about_valleys);
  const std::string text = write_scene(scene);
  std::string out, line;
  bool wanted = true;
  for (std::istringstream lines(text); std::getline(lines, line);) {
    if (line.starts_with("[")) {
      const std::string name = line.substr(line.find_first_not_of('['));
      wanted = std::any_of(sections.begin(), sections.end(), [&](std::string_view section) {
        return name.starts_with(section) &&
               (name[section.size()] == ']' || name[section.size()] == '.');
      });
    }
    if (wanted) out += line + "\n";
  }
  if (!scene.land_cover.settings.empty()) out += "\n[land_cover.settings]\n";
  for (const auto& [name, value] : scene.land_cover.settings)
    out += fmt::format("{} = {}\n", name, value);
  return out;
}

namespace {

struct PickOptions : RegisterOptions {
  std::vector<std::string> names;
  PageOptions page;
};

std::vector<NamedPlace> read_named_places(const PickOptions& options, const std::string& crs,
                                          Progress& progress) {
  std::vector<NamedPlace> out;
  const LabelStyle style = load_label_style("classic");
  const int summit = style.find("summit");
  for (const std::string& file : options.names) {
    VectorSource source;
    source.path = file;
    for (const LabelPoint& point : read_label_points(source, crs, style, progress))
      out.push_back({point.name, point.position, point.kind == summit});
  }
  return out;
}

// As a shell takes it for one word.
std::string shell_word(const std::string& text) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 ||
           std::string_view("_./-+=:,@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// The command that registers the painting by these pairs.
std::string next_command(const PickOptions& options) {
  std::string dems;
  for (const std::string& dem : options.dems) dems += " " + shell_word(dem);
  return fmt::format("belvedere exemplar register {}{} --pairs {} --out registered",
                     shell_word(options.painting), dems, shell_word(options.pairs));
}

}  // namespace

PickingInput picking_input(const LoadedScene& scene, const std::string& painting,
                           const std::string& pairs, const Run& run) {
  PickingInput input;
  input.pairs = pairs;
  input.painting_name = file_name(painting);
  input.painting = read_painting(painting, run.progress);
  input.dem = open_scene_dem(scene, run.progress, run.cache).dem;
  if (input.dem.crs.empty())
    throw Error(ErrorKind::usage, "terrain", "has no CRS", "a terrain whose place is known");
  PickOptions options;
  options.painting = painting;
  options.pairs = pairs;
  for (const SceneInput& each : scene_inputs(scene))
    if (each.key.starts_with("terrain.") && !each.path.empty()) options.dems.push_back(each.path);
  input.next = next_command(options);
  input.port = -1;
  return input;
}

namespace {

int run_pick(const PickOptions& options) {
  file_guard().writes(options.pairs, "--pairs");
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  PickingInput input;
  input.pairs = options.pairs;
  input.painting_name = file_name(options.painting);
  input.painting = read_painting(options.painting, progress);
  input.dem = read_dem(dem_parameters(options), progress);
  if (input.dem.crs.empty())
    throw Error(ErrorKind::usage, options.dems.front(), "has no CRS", "--crs, or a file with one");
  input.named = read_named_places(options, input.dem.crs, progress);
  input.registration = registration_parameters(options);
  input.next = next_command(options);
  input.port = options.page.port;
  Picking picking(std::move(input), progress);
  progress.end();
  serve_page(served_page(picking), options.page.headless);
  return 0;
}

}  // namespace

Action add_exemplar_pick(CommandOptions& command) {
  const auto options = std::make_shared<PickOptions>();
  add_register_options(
      command, *options,
      "The pairs that are picked, a .csv that is made if it is missing; each click "
      "is written at once");
  command.option("--pairs").files(FileUse::edits);
  command
      .add_option("--names FILE", options->names,
                  "Names of summits and other places: a .csv, GeoPackage, GeoJSON … as for labels")
      .files(FileUse::input);
  add_page_options(command, options->page);
  command.footer(
      "Opens a page with the painting beside a relief map. A click on a summit in one and a click\n"
      "in the other make a pair; from five pairs on, each proposes the other, and from eight the\n"
      "page tells how far each pair is off. Only this machine can reach it.\n"
      "\n"
      "  belvedere exemplar pick painting.jpg dem.tif --pairs pairs.csv --names summits.csv");
  return [options] { return run_pick(*options); };
}

namespace {

namespace fs = std::filesystem;

constexpr int register_report_px = 1400;  // longest side of the pictures of the report
// Maximum cells of the ground that is drawn to look for it in the paint, and for the report.
constexpr std::size_t max_drawn_cells = 1'500'000;

struct RegisterCommand : RegisterOptions {
  std::string out;
  bool pairs_only = false;
};

// The scene with its terrain: files by their names, which --data finds.
Scene scene_with_terrain(const RegisterOptions& options, Scene scene, const Dem& dem) {
  scene.title = fs::path(options.painting).stem().string();
  for (const std::string& path : options.dems) {
    SceneSource& source = scene.terrain.sources.emplace_back();
    source.file = file_name(path);
    source.raster.crs = options.crs;
  }
  scene.terrain.dem.cell_m = options.cell_m;
  const std::string crs = describe_crs(dem.crs);
  if (crs.starts_with("EPSG:")) scene.terrain.dem.crs = crs;
  scene.deform.allow_folds = true;  // the report counts them
  return scene;
}

std::vector<std::string> folders_of(const std::vector<std::string>& files) {
  std::vector<std::string> out;
  for (const std::string& file : files) {
    const std::string folder = fs::absolute(file).parent_path().lexically_normal().string();
    if (std::find(out.begin(), out.end(), folder) == out.end()) out.push_back(folder);
  }
  return out;
}

// How far the place of each pixel is known, for `trust` of an exemplar; the sky's is.
Grid<std::uint8_t> trust_of_pixels(const Grid<float>& sigma_px, glm::ivec2 painting_px) {
  Grid<std::uint8_t> out(painting_px.x, painting_px.y, 255);
  for (int y = 0; y < painting_px.y; ++y)
    for (int x = 0; x < painting_px.x; ++x) {
      const int column = std::min(x * sigma_px.width() / painting_px.x, sigma_px.width() - 1);
      const int row = std::min(y * sigma_px.height() / painting_px.y, sigma_px.height() - 1);
      const float sigma = sigma_px(column, row);
      if (std::isnan(sigma)) continue;
      out(x, y) = static_cast<std::uint8_t>(
          std::lround(255.F * place_trust(static_cast<double>(sigma), painting_px.x)));
    }
  return out;
}

// All that is found of a painting.
struct RegisteredPainting {
  glm::ivec2 size_px{0};
  Scene scene;
  Grid<std::uint8_t> classes;
  RegisterReportInput report;
};

// Every so many pixels of a mask.
Grid<std::uint8_t> reduced_classes(const Grid<std::uint8_t>& mask, int width, int height) {
  Grid<std::uint8_t> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out(x, y) = mask((2 * x + 1) * mask.width() / (2 * width),
                       (2 * y + 1) * mask.height() / (2 * height));
  return out;
}

// Land cover and light of the painting on the ground that the scene shows: settings of the scene,
// and sections of the report. Returns the class of each pixel.
Grid<std::uint8_t> look_at_paint(const Grid<glm::vec3>& painting, std::shared_ptr<const Dem> dem,
                                 Scene& scene, RegisterReportInput& report, Progress& progress) {
  LoadedScene loaded;
  loaded.scene = scene;
  GuidanceBuffers guidance = trace_registered_guidance(
      loaded, dem, {report.picture.width(), report.picture.height()}, {.progress = progress});
  report.cover = find_registered_cover(report.picture, report.ground.sigma_px, guidance, loaded,
                                       *dem, progress);
  cover_scene(report.cover, scene);
  loaded.scene = scene;
  renew_land_cover(loaded, *dem, guidance, silent_progress());
  report.light = find_registered_light(report.picture, guidance, scene.camera.position.value());
  light_scene(report.light, scene);
  return classes_by_paint(painting, places_of(guidance));
}

RegisteredPainting register_painting(const RegisterCommand& options, Progress& progress) {
  RegisteredPainting out;
  progress.begin("reading", 0.0);
  const Grid<glm::vec3> painting = read_painting(options.painting, progress);
  out.size_px = {painting.width(), painting.height()};
  const Dem dem = read_dem(dem_parameters(options), progress);
  const auto drawn = std::make_shared<const Dem>(highest_cells(dem, max_drawn_cells));
  RegisterReportInput& report = out.report;
  report.painting = file_name(options.painting);
  report.command = fmt::format("belvedere exemplar register {} … --pairs {}", report.painting,
                               file_name(options.pairs));
  report.pairs = read_control_pairs(options.pairs, out.size_px, dem);
  progress.begin("registering", 0.0);
  report.registration =
      register_pairs(report.pairs, out.size_px, registration_parameters(options), progress);
  DrawnGround ground{.dem = *drawn};
  if (!options.pairs_only) {
    PaintRegistration by_paint =
        register_by_paint(report.registration, report.pairs, painting, *drawn, progress);
    report.registration = std::move(by_paint.registration);
    report.painted_places = by_paint.matches;
    ground = std::move(by_paint.ground);
  }
  const Scene registered = registered_scene(report.registration, out.size_px);
  progress.begin("drawing", 0.0);
  report.picture = reduced_picture(painting, register_report_px);
  const RegisteredView view(report.registration, registered, ground.dem,
                            {report.picture.width(), report.picture.height()}, progress);
  report.ground = trace_registered(view);
  report.ground.folded = folded_facets(view);
  out.scene = scene_with_terrain(options, registered, dem);
  out.classes = look_at_paint(painting, drawn, out.scene, report, progress);
  report.classes = reduced_classes(out.classes, report.picture.width(), report.picture.height());
  return out;
}

int run(const RegisterCommand& options) {
  const auto in_folder = [&](const char* name) { return (fs::path(options.out) / name).string(); };
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const RegisteredPainting found = register_painting(options, progress);
  const RegisterReportInput& input = found.report;
  write_text_file(in_folder("registered.toml"),
                  fmt::format("# {} registered to its terrain by belvedere exemplar register.\n{}",
                              input.painting, registered_scene_text(found.scene)));
  image_io::write_grey_png(in_folder("trust.png"),
                           trust_of_pixels(input.ground.sigma_px, found.size_px));
  image_io::write_palette_png(in_folder("classes.png"), found.classes, class_map_colours());
  write_register_report(options.out, input);
  progress.end();
  if (options.json) {
    print_out(registration_json(input).str() + "\n");
    return 0;
  }
  if (options.quiet) return 0;
  for (const std::size_t i : pairs_worst_first(input.registration)) {
    const PairFinding& finding = input.registration.findings[i];
    if (!finding.wrong && !finding.doubted) continue;
    print_out(fmt::format("{}:{} {}: {:.0f} px off; {}\n", file_name(options.pairs),
                          input.pairs[i].line, input.pairs[i].name, finding.others_px,
                          pair_words(finding, input.registration.sigma_px).sentence));
  }
  std::string data;
  for (const std::string& folder : folders_of(options.dems)) data += " --data " + folder;
  print_out(fmt::format("{}\nnext: belvedere guidance {}{} --out {}\n", in_folder("index.html"),
                        in_folder("registered.toml"), data, options.out));
  return 0;
}

}  // namespace

Action add_exemplar_register(CommandOptions& command) {
  const auto options = std::make_shared<RegisterCommand>();
  add_register_options(
      command, *options,
      "Places that are recognized in it: a .csv with columns x_px, y_px, lon, lat, name "
      "and optionally sure");
  command.option("--pairs").files(FileUse::input);
  command
      .add_option(
          "--out DIR", options->out,
          "Folder for registered.toml, trust.png, classes.png and the report; created if missing")
      .required()
      .files(FileUse::folder);
  command.add_flag("--pairs-only", options->pairs_only,
                   "Do not look for the ground's relief in the paint");
  command.footer(
      "Finds the place of every pixel of a painting from some forty places that a person\n"
      "recognizes in it, without a first estimate of the view: the view itself, where the\n"
      "painter moved the ground, where the sun stands, forest ends and snow begins, and the\n"
      "class of each pixel. Pairs that do not agree with the others are named. The result is\n"
      "a scene, whose guidance serves the painting as an exemplar.\n"
      "\n"
      "  belvedere exemplar register painting.jpg dem.tif --pairs pairs.csv --out registered");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
