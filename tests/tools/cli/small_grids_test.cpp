// Every command on grids that are as small as grids can be: a result or an error, never a signal, a
// bug or a value that is no number.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/tools/program.h"
#include "tools/cli/commands.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using Words = std::vector<std::string>;

struct GridSize {
  int width, height;
  bool flat;
};
// A flat one of an ordinary size is a division by nothing as well.
const std::vector<GridSize> grid_sizes = {
    {1, 1, false}, {1, 9, false}, {9, 1, false}, {2, 2, false}, {12, 12, true}};

// A command with its lines: the last is what is tested. SCENE, DEM, PICTURE, MASK and OUT are files
// of the size, and a folder.
struct SmallCase {
  std::string command;
  std::vector<Words> lines;
};
const std::vector<SmallCase> small_cases = {
    {"new", {{"DEM", "--out", "OUT/n.toml"}}},
    {"render", {{"SCENE", "--out", "OUT"}}},
    {"guidance", {{"SCENE", "--out", "OUT"}}},
    {"sweep", {{"SCENE", "--set", "air.haze=0.1,0.2", "--out", "OUT"}}},
    {"figure", {{"SCENE", "--out", "OUT"}}},
    {"plan", {{"SCENE", "--parts", "1", "--out", "OUT"}}},
    {"part", {{"plan", "SCENE", "--parts", "1", "--out", "OUT"}, {"OUT", "1"}}},
    {"join", {{"plan", "SCENE", "--parts", "1", "--out", "OUT"}, {"part", "OUT", "1"}, {"OUT"}}},
    {"generalize",
     {{"DEM", "OUT/g.tif", "--preset", "panorama", "--change-lakes", "--viewer",
       "680300,5258000"}}},
    {"synthesize", {{"--picture", "PICTURE", "--label", "MASK", "MASK", "--out", "OUT/s.png"}}},
    {"check", {{"SCENE"}}},
    {"lock", {{"SCENE"}}},
    {"verify", {{"lock", "SCENE"}, {"SCENE"}}},
    {"deform",
     {{"DEM", "OUT/d.tif", "--exaggeration", "2", "--bend", "2000:10,9000:0", "--viewer",
       "680300,5258000"}}},
    {"labels", {{"SCENE", "--summits", "3", "--out", "OUT"}}},
    {"features check", {{"FEATURED"}}},
    {"exemplar check", {{"--picture", "PICTURE", "--label", "MASK", "--target", "MASK"}}},
    {"exemplar paint", {{"SCENE", "--out", "OUT"}}},
    {"exemplar register", {{"PICTURE", "DEM", "--pairs", "PAIRS", "--out", "OUT"}}},
    {"exemplar segment", {{"PICTURE", "--out", "OUT/m.png"}}},
    {"style fit", {{"PICTURE", "--classes", "MASK", "--out", "OUT/s.toml"}}},
    {"layers fit",
     {{"--dem", "DEM", "--classes", "CLASSES", "--legend", "LEGEND", "--out",
       "OUT/l.layers.toml"}}},
    {"layers apply", {{"LAYERS", "--dem", "DEM", "--out", "OUT/c.tif", "--shares", "OUT/s.tif"}}},
    {"layers picture", {{"LAYERS", "--dem", "DEM", "--out", "OUT/p.tif"}}},
    {"texture learn", {{"PICTURE", "--types", "16", "--out", "OUT/m.model"}}},
    {"texture erode", {{"MASK", "--steps", "2", "--out", "OUT"}}},
    {"texture seam", {{"PICTURE", "PICTURE", "--out", "OUT/s.png"}}},
    {"texture fill", {{"PICTURE", "--hole", "MASK", "--model", "MODEL", "--out", "OUT/f.png"}}},
    {"texture correct", {{"PICTURE", "--to", "PICTURE", "--out", "OUT/c.png"}}},
    {"composite learn", {{"PICTURE", "--labels", "MASK", "--types", "16", "--out", "OUT/c"}}},
    {"composite make", {{"COMPOSITE", "--labels", "CLASSES", "--out", "OUT/m.png"}}},
    {"web", {{"RENDERED"}}},
    {"pdf", {{"PICTURE", "--width-mm", "100", "--out", "OUT/p.pdf"}}},
    {"proof", {{"PICTURE", "--profile", "PROFILE", "--out", "OUT"}}},
    {"info", {{"PICTURE", "--hash"}}},
    {"diff", {{"PICTURE", "PICTURE"}}},
};
// Commands that read no grid of cells or pixels, and pages that serve until they are interrupted.
const std::set<std::string> without_grids = {
    "fetch",        "features swatches", "cache list", "cache clear",
    "texture make", "palette check",     "schema",     "man",
    "completion"};
const std::set<std::string> serving = {"studio", "exemplar pick"};

class SmallGrids : public Program, public ::testing::WithParamInterface<SmallCase> {
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
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
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
        "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n[land_cover]\nrivers = \"none\"\n"
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
                    "\"#804020\" }\n[[layers]]\nname = \"grass\"\nclass = \"pasture\"\ncolour = "
                    "\"#40c040\"\n[layers.functions]\naltitude = { high = 1300 }\n");
    std::string pairs = "x_px,y_px,lon,lat,name\n";
    for (int k = 0; k < 8; ++k)
      pairs += fmt::format("{:.1f},{:.1f},{:.4f},{:.4f},place {}\n", 0.1 * k, 0.1 * (k % 3),
                           11.39 + 0.001 * k, 47.46 + 0.002 * (k % 4), k);
    pairs_ = write("pairs.csv", pairs);
    write("track.geojson",
          "{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {\"type\": "
          "\"LineString\", \"coordinates\": [[11.39, 47.46], [11.40, 47.47]]}}");
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

std::string name_of_case(const ::testing::TestParamInfo<SmallCase>& info) {
  std::string name;
  for (const char c : info.param.command) name += c == ' ' ? '_' : c;
  return name;
}

TEST_P(SmallGrids, EndWithAResultOrAnError) {
  for (const GridSize& size : grid_sizes) {
    write_files(size);
    const std::string label =
        fmt::format("{} of {} x {}", GetParam().command, size.width, size.height);
    for (std::size_t i = 0; i < GetParam().lines.size(); ++i) {
      Words line = filled_in(GetParam().lines[i]);
      if (i + 1 == GetParam().lines.size()) {
        const std::string& command = GetParam().command;
        const std::size_t space = command.find(' ');
        if (space != std::string::npos) line.insert(line.begin(), command.substr(space + 1));
        line.insert(line.begin(), command.substr(0, space));
      }
      const Outcome outcome = run(line, without_cache());
      EXPECT_THAT(outcome.status, AnyOf(0, 2, 3, 5)) << label << ": " << outcome.err;
      EXPECT_THAT(outcome.out + outcome.err, Not(ContainsRegex("(^|[^a-z])-?nan([^a-z]|$)")))
          << label;
      if (outcome.status != 0) {
        EXPECT_THAT(outcome.err, HasSubstr("belvedere: ")) << label;
        EXPECT_THAT(outcome.out, testing::IsEmpty()) << label;
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Commands, SmallGrids, ::testing::ValuesIn(small_cases), name_of_case);

TEST(SmallGridsTable, HasEveryCommand) {
  std::set<std::string> covered = without_grids;
  covered.insert(serving.begin(), serving.end());
  for (const SmallCase& row : small_cases) covered.insert(row.command);
  std::set<std::string> known;
  for (const tools::Command& row : tools::all_commands())
    known.insert(*row.group == '\0' ? row.name : std::string(row.group) + " " + row.name);
  EXPECT_EQ(covered, known) << "a command is missing in the table, or is no longer there";
}

}  // namespace
}  // namespace belvedere
