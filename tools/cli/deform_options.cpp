#include "tools/cli/deform_options.h"

#include <fmt/core.h>

#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "base/text/json.h"
#include "base/text/parse_number.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

double number_given(std::string_view text, const std::string& option) {
  if (const std::optional<double> value = parse_number<double>(text)) return *value;
  throw Error(ErrorKind::usage, option, fmt::format("\"{}\"", text), "a number");
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

// "10000:25,40000:12,80000:0": distance and inclination.
void add_bend(const std::string& text, std::vector<std::string>& settings) {
  int i = 0;
  for (const std::string& point : split(text, ',')) {
    const std::vector<std::string> parts = split(point, ':');
    if (parts.size() != 2)
      throw Error(ErrorKind::usage, "--bend", fmt::format("\"{}\"", point),
                  "DISTANCE:INCLINATION, such as 10000:25,40000:12,80000:0");
    settings.push_back(
        fmt::format("deform.bend.points.{}.distance_m={}", i, number_given(parts[0], "--bend")));
    settings.push_back(fmt::format("deform.bend.points.{}.inclination_deg={}", i++,
                                   number_given(parts[1], "--bend")));
  }
}

// "672000,5250000 radius=6000 core=2000 rotate=50 move=500,0 scale=1.1 raise=100"
void add_handle(const std::string& text, std::size_t i, std::vector<std::string>& settings) {
  const char* allowed =
      "\"E,N radius=M\", optionally with core=M rotate=DEG move=E,N scale=F raise=M";
  const std::vector<std::string> words = split(text, ' ');
  if (words.empty()) throw Error(ErrorKind::usage, "--handle", "nothing", allowed);
  const auto set = [&](const char* key, const std::string& value) {
    settings.push_back(fmt::format("deform.handles.{}.{}={}", i, key, value));
  };
  const auto pair = [](const std::string& value) {
    const glm::dvec2 p = parse_pair(value, "--handle");
    return fmt::format("[{}, {}]", p.x, p.y);
  };
  set("position", pair(words[0]));
  for (std::size_t k = 1; k < words.size(); ++k) {
    const std::size_t equals = words[k].find('=');
    const std::string key = words[k].substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : words[k].substr(equals + 1);
    const auto number = [&] { return fmt::format("{}", number_given(value, "--handle " + key)); };
    if (key == "radius")
      set("radius_m", number());
    else if (key == "core")
      set("core_m", number());
    else if (key == "rotate")
      set("rotate_deg", number());
    else if (key == "scale")
      set("scale", number());
    else if (key == "raise")
      set("raise_m", number());
    else if (key == "move")
      set("move_m", pair(value));
    else
      throw Error(ErrorKind::usage, "--handle", fmt::format("\"{}\"", words[k]), allowed);
  }
}

}  // namespace

void add_deform_options(CommandOptions& command, DeformOptions& options) {
  add_scene_options(command, options.scene,
                    "A scene file, or a DEM (GeoTIFF, ESRI ASCII …). Default: the built-in demo");
  command
      .add_option(
          "OUT", options.dem_out,
          "Writes the deformed ground as a DEM: GeoTIFF, or ESRI ASCII for the extension .asc")
      .files(FileUse::writes, raster_files);
  command.add_option("--viewer E,N", options.viewer,
                     "Position that distances are measured from, instead of the scene's camera");
  command.add_option("--exaggeration FACTOR", options.exaggeration, "Vertical exaggeration");
  command.add_option("--bend M:DEG,M:DEG…", options.bend,
                     "A bend by distances (m) and inclinations (degrees) of level ground");
  command
      .add_option(
          "--handle HANDLE", options.handles,
          "A piece of ground to move: \"E,N radius=M core=M rotate=DEG move=E,N scale=F raise=M\"; "
          "may be repeated")
      .repeated();
  command
      .add_option(
          "--locate E,N|FILE", options.locate,
          "Locates a point in the picture and whether it is visible; for a file (.csv, .gpkg, "
          ".geojson, .shp, .fgb, .gpx) all its points, as a table; may be repeated")
      .repeated();
  command
      .add_option("--at X,Y", options.at,
                  "Locates a pixel of the picture on the ground; may be repeated")
      .repeated();
  command.add_flag("--search-bend", options.search_bend,
                   "Searches the bend that shows most valley floor, and prints its keys");
  command
      .add_option("--max-distortion DEG", options.max_distortion_deg,
                  "With --search-bend: maximum tilt of level ground, degrees")
      .show_default();
  command
      .add_option("--max-bending DEG", options.max_bending_deg,
                  "With --search-bend: maximum change of tilt, degrees in 10 km")
      .show_default();
  command.add_option("--points N", options.points, "With --search-bend: control points, 3 to 8")
      .show_default();
  command
      .add_option("--out FILE", options.out,
                  "With --search-bend: a small picture of the ground before (above) and after "
                  "(below). With "
                  "--locate FILE: the table, instead of printing it")
      .files(FileUse::writes);
}

glm::dvec2 parse_pair(const std::string& text, const char* option) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 2)
    throw Error(ErrorKind::usage, option, fmt::format("\"{}\"", text),
                "two numbers separated by a comma");
  return {number_given(parts[0], option), number_given(parts[1], option)};
}

bool is_scene(const DeformOptions& options) {
  return options.scene.scene.empty() || options.scene.scene.ends_with(".toml");
}

LoadedScene load(const DeformOptions& options) {
  SceneOptions scene = options.scene;
  std::vector<std::string> asked;
  if (!options.exaggeration.empty())
    asked.push_back(fmt::format("deform.exaggeration={}",
                                number_given(options.exaggeration, "--exaggeration")));
  if (!options.bend.empty()) {
    // Replaces the scene's own.
    asked.insert(asked.end(), {"deform.bend.points=[]", "deform.bend.radius_m=0",
                               "deform.bend.far_amount_per_m=0"});
    add_bend(options.bend, asked);
  }
  if (!options.handles.empty()) asked.push_back("deform.handles=[]");
  for (std::size_t i = 0; i < options.handles.size(); ++i) add_handle(options.handles[i], i, asked);
  if (!options.viewer.empty()) {
    const glm::dvec2 viewer = parse_pair(options.viewer, "--viewer");
    asked.push_back(fmt::format("camera.position=[{}, {}]", viewer.x, viewer.y));
  }
  scene.files.settings.insert(scene.files.settings.begin(), asked.begin(), asked.end());
  if (is_scene(options)) return load(scene);

  const std::filesystem::path dem(scene.scene);
  const std::string text = fmt::format("version = 1\n[[terrain.sources]]\nfile = {}\n",
                                       json_quoted(dem.filename().string()));
  LoadedScene loaded = parse_scene(text, scene.scene, dem.parent_path().string(), scene.files);
  guard_inputs(loaded);
  const DeformParameters ground = loaded.scene.deform.written();
  const bool by_distance = ground.bend.radius_m > 0.0 || ground.bend.far_amount_per_m > 0.0 ||
                           !ground.bend.points.empty() || ground.earth_curvature ||
                           ground.background_exaggeration;
  if (by_distance && !loaded.scene.camera.position && !loaded.scene.camera.position_lonlat)
    throw Error(ErrorKind::usage, "command line",
                "no viewer, which a deformation by distance needs", "--viewer E,N");
  if (!loaded.scene.camera.position && !loaded.scene.camera.position_lonlat)
    loaded.scene.camera.position = glm::dvec2(0.0);
  return loaded;
}

}  // namespace belvedere::tools
