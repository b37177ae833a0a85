#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/output_file.h"
#include "renderer/image/png_palette.h"
#include "renderer/register/register_by_paint.h"
#include "renderer/register/registered_ground.h"
#include "renderer/register/registered_light.h"
#include "renderer/register/registered_scene.h"
#include "renderer/scene/scene_file.h"
#include "terrain/register/control_pairs.h"
#include "terrain/register/registration.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/options/run_options.h"
#include "tools/report/register_page.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> about = {"terrain", "deform",        "camera",
                                                   "sun",     "light.regions", "output"};
constexpr int register_report_px = 1400;  // longest side of the pictures of the report

struct RegisterOptions : RunOptions {
  std::string painting, pairs, out, crs, projection = "auto";
  std::vector<std::string> dems;
  double cell_m = 0.0;
  std::optional<double> sigma_px;
  bool cropped = false;
  bool pairs_only = false;
};

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

// The scene with its terrain: files by their names, which --data finds.
Scene scene_with_terrain(const RegisterOptions& options, Scene scene, const Dem& dem,
                         std::size_t folded) {
  scene.title = fs::path(options.painting).stem().string();
  for (const std::string& path : options.dems) {
    SceneSource& source = scene.terrain.sources.emplace_back();
    source.file = file_name(path);
    source.raster.crs = options.crs;
  }
  scene.terrain.dem.cell_m = options.cell_m;
  const std::string crs = describe_crs(dem.crs);
  if (crs.starts_with("EPSG:")) scene.terrain.dem.crs = crs;
  scene.deform.allow_folds = folded > 0;
  return scene;
}

// The light of the painting on the ground that the scene shows.
RegisteredLight light_of(const Scene& scene, std::shared_ptr<const Dem> dem,
                         const Grid<glm::vec3>& painting, Progress& progress) {
  LoadedScene loaded;
  loaded.scene = scene;
  const GuidanceBuffers guidance = trace_registered_guidance(
      loaded, std::move(dem), {painting.width(), painting.height()}, {.progress = progress});
  return find_registered_light(painting, guidance, scene.camera.position.value());
}

// The sections of a scene file that a registration is about; all others are at their defaults.
std::string registered_sections(const std::string& text) {
  std::string out, line;
  bool wanted = true;
  for (std::istringstream lines(text); std::getline(lines, line);) {
    if (line.starts_with("[")) {
      const std::string name = line.substr(line.find_first_not_of('['));
      wanted = std::any_of(about.begin(), about.end(), [&](std::string_view section) {
        return name.starts_with(section) &&
               (name[section.size()] == ']' || name[section.size()] == '.');
      });
    }
    if (wanted) out += line + "\n";
  }
  return out;
}

std::vector<std::string> folders_of(const std::vector<std::string>& files) {
  std::vector<std::string> out;
  for (const std::string& file : files) {
    const std::string folder = fs::absolute(file).parent_path().lexically_normal().string();
    if (std::find(out.begin(), out.end(), folder) == out.end()) out.push_back(folder);
  }
  return out;
}

// White where the place of a pixel may be off by more than is good for copying.
Grid<std::uint8_t> excluded_pixels(const Grid<float>& sigma_px, glm::ivec2 painting_px,
                                   double limit_px) {
  Grid<std::uint8_t> out(painting_px.x, painting_px.y);
  for (int y = 0; y < painting_px.y; ++y)
    for (int x = 0; x < painting_px.x; ++x) {
      const int column = std::min(x * sigma_px.width() / painting_px.x, sigma_px.width() - 1);
      const int row = std::min(y * sigma_px.height() / painting_px.y, sigma_px.height() - 1);
      out(x, y) = static_cast<double>(sigma_px(column, row)) > limit_px ? 255 : 0;
    }
  return out;
}

int run(const RegisterOptions& options) {
  for (const std::string& file : options.dems)
    if (!fs::exists(file)) throw Error(ErrorKind::input, file, "no such file");
  check_output_folder(options.out);
  const auto in_folder = [&](const char* name) { return (fs::path(options.out) / name).string(); };
  for (const char* name : {"registered.toml", "exclude.png", "index.html"})
    check_not_read(in_folder(name), "--out", {options.painting, options.pairs});
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  const Grid<glm::vec3> painting = read_painting(options.painting, progress);
  const glm::ivec2 size(painting.width(), painting.height());
  const auto dem = std::make_shared<const Dem>(read_dem(dem_parameters(options), progress));
  RegisterReportInput input;
  input.painting = file_name(options.painting);
  input.pairs = read_control_pairs(options.pairs, size, *dem);
  progress.begin("registering", 0.0);
  input.registration = register_pairs(input.pairs, size, registration_parameters(options));
  if (!options.pairs_only)
    input.registration =
        register_by_paint(input.registration, input.pairs, painting, dem, progress).registration;
  const Scene registered = registered_scene(input.registration, size);
  progress.begin("drawing", 0.0);
  input.picture = reduced_picture(painting, register_report_px);
  input.ground = trace_registered(input.registration, registered, *dem,
                                  {input.picture.width(), input.picture.height()}, progress);
  Scene scene = scene_with_terrain(options, registered, *dem, input.ground.folded);
  input.light = light_of(scene, dem, input.picture, progress);
  light_scene(input.light, scene);
  write_text_file(in_folder("registered.toml"),
                  fmt::format("# {} registered to its terrain by belvedere exemplar register.\n{}",
                              input.painting, registered_sections(write_scene(scene))));
  image_io::write_grey_png(
      in_folder("exclude.png"),
      excluded_pixels(input.ground.sigma_px, size, trusted_px * input.registration.scale));
  input.command = fmt::format("belvedere exemplar register {} … --pairs {}", input.painting,
                              file_name(options.pairs));
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
  const auto options = std::make_shared<RegisterOptions>();
  command.add_option("PAINTING", options->painting, "A painted panorama or its scan")
      .required()
      .type_name("PICTURE");
  command.add_option("DEM", options->dems, "Elevation of the region that it shows")
      .required()
      .type_name("DEM");
  command
      .add_option(
          "--pairs", options->pairs,
          "Places that are recognized in it: a .csv with columns x_px, y_px, lon, lat, name "
          "and optionally sure")
      .required()
      .type_name("PAIRS");
  command
      .add_option("--out", options->out,
                  "Folder for registered.toml, exclude.png and the report; created if missing")
      .required()
      .type_name("DIR");
  command
      .add_option("--sigma", options->sigma_px,
                  "How exactly pixels were clicked: standard deviation in pixels. Default: "
                  "estimated")
      .type_name("PX")
      .range(0.1, 100.0);
  command
      .add_option("--projection", options->projection,
                  "As which projection the painting is fitted. Default: the one that fits best")
      .one_of({"auto", "perspective", "cylindrical", "panini"});
  command.add_flag("--cropped", options->cropped,
                   "The painting was cropped on one side: its middle is not that of the view");
  command.add_flag("--pairs-only", options->pairs_only,
                   "Do not look for the ground's relief in the paint");
  command.add_option("--crs", options->crs, "CRS of the elevation, where its files do not name it")
      .type_name("CRS");
  command
      .add_option("--cell", options->cell_m,
                  "Side of the ground's cells in metres. Default: that of the data")
      .type_name("M")
      .range(0.1, 10000.0);
  add_run_options(command, *options);
  command.footer(
      "Finds the place of every pixel of a painting from some forty places that a person\n"
      "recognizes in it, without a first estimate of the view: the view itself, where the\n"
      "painter moved the ground, and where the sun stands. Pairs that do not agree with the\n"
      "others are named. The result is a scene, whose guidance serves the painting as an\n"
      "exemplar.\n"
      "\n"
      "  belvedere exemplar register painting.jpg dem.tif --pairs pairs.csv --out registered");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
