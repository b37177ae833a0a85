#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/tools/program.h"

// Every command with a line that takes a moment, for tests that hold for all commands.
namespace belvedere::test {
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct GridSize {
  int width, height;
  bool flat;
};
// A command with its lines: the last is what is tested. SCENE, DEM, PICTURE, MASK and OUT are files
// of the size, and a folder.
struct SmallCase {
  std::string command;
  std::vector<Words> lines;
};
inline const std::vector<SmallCase> small_cases = {
    {"new", {{"DEM", "--out", "OUT/n.toml"}}},
    {"render", {{"SCENE", "--out", "OUT"}}},
    {"guidance", {{"SCENE", "--out", "OUT"}}},
    {"sweep", {{"SCENE", "--set", "air.haze=0.1,0.2", "--out", "OUT"}}},
    {"figure", {{"SCENE", "--out", "OUT"}}},
    {"plan", {{"SCENE", "--parts", "1", "--out", "OUT"}}},
    {"part", {{"plan", "SCENE", "--parts", "1", "--out", "OUT"}, {"OUT", "1"}}},
    {"join", {{"plan", "SCENE", "--parts", "1", "--out", "OUT"}, {"part", "OUT", "1"}, {"OUT"}}},
    {"generalize",
     {{"DEM", "OUT/g.tif", "--preset", "panorama", "--change-lakes", "--viewer", "680300,5258000",
       "--hillshade", "OUT/h.tif", "--contours", "OUT/c.shp", "--report", "OUT/report"}}},
    {"synthesize",
     {{"--picture", "PICTURE", "--label", "MASK", "MASK", "--out", "OUT/s.png", "--match",
       "OUT/m.exr", "--report", "OUT/report"}}},
    {"check", {{"SCENE"}}},
    {"lock", {{"SCENE"}}},
    {"verify",
     {{"lock", "SCENE"},
      {"SCENE", "--junit", "OUT/v.xml", "--report", "OUT/v.html", "--out", "OUT/kept"}}},
    {"deform",
     {{"DEM", "OUT/d.tif", "--exaggeration", "2", "--bend", "2000:10,9000:0", "--viewer",
       "680300,5258000"}}},
    {"labels", {{"SCENE", "--points", "NAMES", "--out", "OUT"}}},
    {"features check", {{"FEATURED"}}},
    {"features swatches", {{"--out", "OUT/swatches"}}},
    {"texture make", {{"MODEL", "--size", "64x64", "--out", "OUT/t.png", "--report", "OUT/r"}}},
    {"exemplar check", {{"--picture", "PICTURE", "--label", "MASK", "--target", "MASK"}}},
    {"exemplar paint", {{"SCENE", "--out", "OUT"}}},
    {"exemplar register", {{"PICTURE", "DEM", "--pairs", "PAIRS", "--out", "OUT"}}},
    {"exemplar segment", {{"PICTURE", "--out", "OUT/m.png", "--report", "OUT/p.html"}}},
    {"style fit",
     {{"PICTURE", "--classes", "CLASSES", "--out", "OUT/s.toml", "--report", "OUT/report"}}},
    {"layers fit",
     {{"--dem", "DEM", "--classes", "CLASSES", "--legend", "LEGEND", "--out",
       "OUT/l.layers.toml"}}},
    {"layers apply",
     {{"LAYERS", "--dem", "DEM", "--out", "OUT/c.tif", "--shares", "OUT/s.tif", "--colour",
       "OUT/colour.tif"}}},
    {"layers picture", {{"LAYERS", "--dem", "DEM", "--out", "OUT/p.tif"}}},
    {"texture learn", {{"PICTURE", "--types", "16", "--out", "OUT/m.model"}}},
    {"texture erode", {{"MASK", "--steps", "2", "--out", "OUT"}}},
    {"texture seam", {{"PICTURE", "PICTURE", "--out", "OUT/s.png"}}},
    {"texture fill", {{"PICTURE", "--hole", "MASK", "--model", "MODEL", "--out", "OUT/f.png"}}},
    {"texture remove", {{"PICTURE", "--mask", "MASK", "--out", "OUT/r.png"}}},
    {"texture plant",
     {{"PICTURE", "--mask", "MASK", "--from", "PICTURE", "--out", "OUT/p.png", "--as-it-is"}}},
    {"texture correct", {{"PICTURE", "--to", "PICTURE", "--out", "OUT/c.png"}}},
    {"composite learn", {{"PICTURE", "--labels", "CLASSES", "--types", "16", "--out", "OUT/c"}}},
    {"composite make", {{"COMPOSITE", "--labels", "CLASSES", "--out", "OUT/m.png"}}},
    {"web", {{"RENDERED"}}},
    {"pdf", {{"PICTURE", "--width-mm", "100", "--out", "OUT/p.pdf"}}},
    {"proof", {{"PICTURE", "--profile", "PROFILE", "--out", "OUT"}}},
    {"info", {{"PICTURE", "--hash"}}},
    {"diff", {{"PICTURE", "PICTURE"}}},
};
// Commands that read no grid of cells or pixels, and pages that serve until they are interrupted.
inline const std::set<std::string> without_grids = {
    "fetch", "cache list", "cache clear", "palette check", "schema", "man", "completion"};
inline const std::set<std::string> serving = {"studio", "exemplar pick"};

class SmallCommands : public Program {
 protected:
  // The files of one size; the folder OUT is new.
  void write_files(const GridSize& size) {
    const auto height_m = [&](int x, int y) {
      return size.flat ? 1200.F : 1200.F + 90.F * static_cast<float>((x * 7 + y * 5) % 4);
    };
    const auto frame = [](double cell_m) {
      return GeoTransform{680000.0, 5260000.0, cell_m, cell_m};
    };
    Raster<float> dem{Grid<float>(size.width, size.height), frame(250.0),
                      normalize_crs("EPSG:32632")};
    Raster<std::uint8_t> classes{Grid<std::uint8_t>(size.width, size.height), frame(250.0),
                                 dem.crs};
    for (const auto [x, y] : test::cells(size.width, size.height)) {
      dem.cells(x, y) = height_m(x, y);
      classes.cells(x, y) = static_cast<std::uint8_t>(1 + (x + y) % 2);
    }
    write_raster(path("dem.tif"), dem);
    write_raster(path("classes.tif"), classes);
    write("legend.toml", "name = \"test\"\n[codes]\n1 = \"pasture\"\n2 = \"rock\"\n");
    write_labels("mask.tif", size.width, size.height,
                 [](int x, int y) { return 255 * ((x + y) % 2); });
    write_picture("picture.png", size.width, size.height, [&](int x, int y) {
      return size.flat ? glm::vec3(0.5F) : glm::vec3(0.3F + 0.05F * static_cast<float>(x + y % 3));
    });
    const std::string scene =
        "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n"
        "[camera]\nposition = [680300, 5258000]\nheight_m = 2600\nlook_at = [680300, 5259700]\n"
        "[sampling]\npixel_samples = 1\nshadow_rays = 1\nsky_directions = 0\n"
        "[synthesis]\nenabled = false\n"
        "[output]\nwidth = 48\nheight = 24\nsheet_width_mm = 48\n";
    write("scene.toml", scene);
    write("featured.toml", scene + "[[features]]\nsource = \"track.geojson\"\nkind = \"path\"\n");
    fs::remove_all(path("out"));
    fs::create_directory(path("out"));
    fs::create_directories(path("rendered"));
    fs::copy_file(path("picture.png"), path("rendered/panorama.png"),
                  fs::copy_options::overwrite_existing);
  }
  // With the files of the folder in place of their names in capitals.
  Words filled_in(const Words& words) const {
    const std::vector<std::pair<std::string, std::string>> names = {
        {"SCENE", path("scene.toml")},
        {"DEM", path("dem.tif")},
        {"FEATURED", path("featured.toml")},
        {"PICTURE", path("picture.png")},
        {"MASK", path("mask.tif")},
        {"CLASSES", path("classes.tif")},
        {"LEGEND", path("legend.toml")},
        {"LAYERS", layers_},
        {"PAIRS", pairs_},
        {"NAMES", path("names.csv")},
        {"RENDERED", path("rendered")},
        {"PROFILE", test::press_file},
        {"MODEL", example("texture_model")},
        {"COMPOSITE", example("composite_model")},
        {"OUT", path("out")}};
    Words out = words;
    for (std::string& word : out)
      for (const auto& [name, file] : names)
        if (word.starts_with(name)) {
          word = file + word.substr(name.size());
          break;
        }
    return out;
  }
  void SetUp() override {
    layers_ = write("two.layers.toml",
                    "version = 1\nname = \"two\"\nground = { class = \"rock\", colour = "
                    "\"#804020\" }\n[[inputs]]\nname = \"altitude\"\nlow = 0\nhigh = "
                    "4000\n[[layers]]\nname = \"grass\"\nclass = \"pasture\"\ncolour = "
                    "\"#40c040\"\n[layers.functions]\naltitude = { high = 1300 }\n");
    std::string pairs = "x_px,y_px,lon,lat,name\n";
    for (int k = 0; k < 8; ++k)
      pairs += fmt::format("{:.1f},{:.1f},{:.4f},{:.4f},place {}\n", 0.1 * k, 0.1 * (k % 3),
                           11.39 + 0.001 * k, 47.46 + 0.002 * (k % 4), k);
    pairs_ = write("pairs.csv", pairs);
    write("names.csv", "name,east,north\nPeak,680300,5259800\n");
    write("track.geojson",
          "{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {\"type\": "
          "\"LineString\", \"coordinates\": [[11.39, 47.46], [11.40, 47.47]]}}");
  }

  // The i-th line of a case as the program takes it.
  Words line_of(const SmallCase& row, std::size_t i) const {
    Words line = filled_in(row.lines[i]);
    if (i + 1 < row.lines.size()) return line;
    const std::size_t space = row.command.find(' ');
    if (space != std::string::npos) line.insert(line.begin(), row.command.substr(space + 1));
    line.insert(line.begin(), row.command.substr(0, space));
    return line;
  }

 private:
  // The first good file of a reader's examples.
  static std::string example(const std::string& target) {
    std::set<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(test::source_folder() + "/tests/fuzz/" + target))
      files.insert(entry.path());
    return files.begin()->string();
  }
  std::string layers_, pairs_;
};

inline std::string name_of_case(const ::testing::TestParamInfo<SmallCase>& info) {
  std::string name;
  for (const char c : info.param.command) name += c == ' ' ? '_' : c;
  return name;
}

}  // namespace belvedere::test
