// Invalid input and failures: each case ends with its exit status and a message that names the file
// and what is allowed; existing files stay whole. Cases that other tests cover:
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/http_server.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Faults : public Program {
 protected:
  // Hills of 48 × 48 cells of 100 m in UTM zone 32.
  static constexpr int side = 48;
  static constexpr double east = 500000.0;
  static constexpr double north = 5200000.0;
  static float hill(int x, int y) {
    return static_cast<float>(1000.0 + 300.0 * std::sin(0.3 * x) * std::cos(0.2 * y));
  }
  static Raster<float> hills(double origin_x = east, const std::string& crs = "EPSG:32632") {
    Raster<float> raster{
        Grid<float>(side, side), {origin_x, north, 100.0, 100.0}, normalize_crs(crs)};
    for (const auto [x, y] : test::cells(side, side)) raster.cells(x, y) = hill(x, y);
    return raster;
  }
  // The same as ESRI ASCII without a CRS; `voids` cells in the third row and on hold `nodata`.
  std::string write_ascii(const std::string& name, int voids = 0, const std::string& nodata = "",
                          double cell = 100.0, double origin_x = east,
                          double origin_y = north - 4800.0, double scale = 1.0) const {
    std::string text =
        fmt::format("ncols {0}\nnrows {0}\nxllcorner {1}\nyllcorner {2}\ncellsize {3}\n", side,
                    origin_x, origin_y, cell);
    for (const auto [x, y] : test::cells(side, side))
      text += (y >= 2 && (y - 2) * side + x < voids ? nodata
                                                    : fmt::format("{:.2f}", hill(x, y) * scale)) +
              (x + 1 < side ? " " : "\n");
    return write(name, text);
  }
  // A scene of the terrain blocks given that looks at the hills from the south; `more` stands at
  // its end.
  std::string write_hills_scene(const std::string& terrain, const std::string& more = "") const {
    return write("scene.toml",
                 "version = 1\n" + terrain +
                     "\n[camera]\nposition = [502400, 5194000]\nheight_m = 4000\npitch_deg = -20\n"
                     "[sampling]\npixel_samples = 1\nshadow_rays = 1\nsky_directions = 0\n"
                     "[output]\nwidth = 96\nheight = 64\nsheet_width_mm = 100\n" +
                     more);
  }
  static std::string source(const std::string& file, const std::string& more = "") {
    return "[[terrain.sources]]\nfile = \"" + file + "\"\n" + more;
  }
  // check and render refuse the scene with this status and message, nothing is written.
  void expect_refusal(const std::string& scene, int status,
                      const ::testing::Matcher<const std::string&>& message,
                      const std::vector<std::string>& more = {}) const {
    for (const char* command : {"check", "render"}) {
      std::vector<std::string> arguments = {command, scene};
      arguments.insert(arguments.end(), more.begin(), more.end());
      if (command == std::string("render"))
        arguments.insert(arguments.end(), {"--out", path("result")});
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.status, status) << command << ": " << outcome.err;
      EXPECT_THAT(outcome.err, message) << command;
      EXPECT_THAT(outcome.out, IsEmpty()) << command;
    }
    EXPECT_TRUE(!fs::exists(path("result")) || fs::is_empty(path("result"))) << "something is left";
  }
};

constexpr const char* strokes_only = "[synthesis]\nenabled = false\n";

// ---- numbers

TEST_F(Faults, NumbersOutOfRangeNameKeyAndRange) {
  for (const auto& [setting, range] : std::vector<std::pair<std::string, std::string>>{
           {"camera.height_m=nan", "-12000 … 1000000"},
           {"camera.height_m=inf", "-12000 … 1000000"},
           {"output.width=-5", "16 … 65535"},
           {"output.height=1000000000", "16 … 65535"},
           {"output.width=1e9", "whole number"},
           {"camera.pitch_deg=-90.5", "-90 … 90"},
           {"air.scale_m=0", "more than 0"},
           {"terrain.synthetic.cell_m=-nan", "1 … 1000"}}) {
    EXPECT_THAT(run({"check", write_scene_file(), "--set", setting}),
                Ends(2, AllOf(HasSubstr(setting.substr(0, setting.find('='))), HasSubstr(range))))
        << setting;
  }
}

// ---- rasters

TEST_F(Faults, TruncatedGeoTiffLeavesNoOutput) {
  write_raster(path("hills.tif"), hills());
  EXPECT_EQ(run({"check", write_hills_scene(source("hills.tif"), strokes_only)}).status, 0);
  fs::resize_file(path("hills.tif"), fs::file_size(path("hills.tif")) / 2);
  expect_refusal(write_hills_scene(source("hills.tif"), strokes_only), 3, HasSubstr("hills.tif"));
}

TEST_F(Faults, HiddenAndBrokenVrtFilesAreRefused) {
  write_raster(path("hills.tif"), hills());
  const auto vrt = [&](const std::string& name, const std::string& file) {
    write(name,
          fmt::format("<VRTDataset rasterXSize=\"{0}\" rasterYSize=\"{0}\"><SRS>EPSG:32632</SRS>"
                      "<GeoTransform>500000,100,0,5200000,0,-100</GeoTransform><VRTRasterBand "
                      "dataType=\"Float32\" band=\"1\">"
                      "<SimpleSource><SourceFilename "
                      "relativeToVRT=\"1\">{1}</SourceFilename><SourceBand>1</SourceBand>"
                      "</SimpleSource></VRTRasterBand></VRTDataset>",
                      side, file));
    return write_hills_scene(source(name), strokes_only);
  };
  EXPECT_EQ(run({"check", vrt("good.vrt", "hills.tif")}).status, 0);
  expect_refusal(vrt("hidden.tif", "hills.tif"), 3,
                 AllOf(HasSubstr("hidden.tif"), HasSubstr("VRT")));
  // Not through another file either: the library would open it.
  expect_refusal(vrt("nested.vrt", "hidden.tif"), 3,
                 AllOf(HasSubstr("hidden.tif"), HasSubstr("VRT")));
  expect_refusal(vrt("holes.vrt", "none.tif"), 3, HasSubstr("none.tif"));
}

TEST_F(Faults, NodataIsFilledAndCountedUpToTheLimit) {
  const std::string crs = "crs = \"EPSG:32632\"\n";
  for (const char* nodata : {"-9999", "-32768", "32767", "nan"}) {
    write_ascii("dem.asc", 100, nodata);
    const std::string scene = write_hills_scene(source("dem.asc", crs), strokes_only);
    EXPECT_THAT(run({"check", scene}), Ends(0, HasSubstr("100 void cells"))) << nodata;
    expect_refusal(
        scene, 3,
        AllOf(HasSubstr("dem.asc"), HasSubstr("100 of 2304"), HasSubstr("max_void_share")),
        {"--set", "terrain.max_void_share=0.04"});  // 100 of 2304 are 4.3 %
  }
}

TEST_F(Faults, CoordinateSystemsAndUnitsAreConvertedOrAskedFor) {
  write_ascii("dem.asc");
  expect_refusal(write_hills_scene(source("dem.asc"), strokes_only), 3,
                 AllOf(HasSubstr("dem.asc"), HasSubstr("`crs`")));

  // Degrees: UTM zone 32 at 9° east. 47° north is at 5205 km.
  write_ascii("degrees.asc", 0, "", 0.001, 9.0, 46.9);
  EXPECT_THAT(
      run({"check", write_hills_scene(source("degrees.asc", "crs = \"EPSG:4326\"\n"), strokes_only),
           "--json"}),
      Prints(HasSubstr("EPSG:32632")));

  // Feet: the same hills, so the same picture's depths.
  write_ascii("feet.asc", 0, "", 100.0, east, north - 4800.0, 1.0 / 0.3048);
  const std::string crs = "crs = \"EPSG:32632\"\n";
  ASSERT_EQ(
      run({"guidance", write_hills_scene(source("dem.asc", crs)), "--out", path("metres")}).status,
      0);
  ASSERT_EQ(run({"guidance", write_hills_scene(source("feet.asc", crs + "unit = \"ft\"\n")),
                 "--out", path("feet")})
                .status,
            0);
  const Grid<float> metres = read_channel(path("metres/guidance.exr"), "altitude.V");
  const Grid<float> feet = read_channel(path("feet/guidance.exr"), "altitude.V");
  int land = 0;
  for (std::size_t i = 0; i < metres.size(); ++i) {
    if (!std::isfinite(metres[i]) || metres[i] < 100.F) continue;
    ++land;
    ASSERT_NEAR(metres[i], feet[i], 0.5);
  }
  EXPECT_GT(land, 500);
}

TEST_F(Faults, TilesOfTwoCoordinateSystemsMeet) {
  write_raster(path("west.tif"), hills());
  // The next tile to the east, in zone 33: 504800 E in zone 32 is about 49 km E there.
  const glm::dvec2 corner = transform_point("EPSG:32632", "EPSG:32633", {east + 4800.0, north});
  Raster<float> other = hills(corner.x, "EPSG:32633");
  other.transform.origin_y = corner.y;
  write_raster(path("east.tif"), other);
  EXPECT_THAT(
      run({"check", write_hills_scene(source("west.tif") + source("east.tif"), strokes_only),
           "--json"}),
      Prints(HasSubstr("EPSG:32632")));
}

TEST_F(Faults, UnknownLandCoverCodesAreListedWithCounts) {
  write_raster(path("hills.tif"), hills());
  Raster<float> codes = hills();
  for (std::size_t i = 0; i < codes.cells.size(); ++i)
    codes.cells[i] = i < 7 ? 77.F : 10.F;  // WorldCover: 10 is tree cover
  write_raster(path("cover.tif"), codes);
  const std::string cover = "[land_cover]\nlegend = \"esa_worldcover\"\n";
  const std::string file = "[[land_cover.sources]]\nfile = \"cover.tif\"\n";
  expect_refusal(write_hills_scene(source("hills.tif"), strokes_only + cover + file), 3,
                 AllOf(HasSubstr("cover.tif"), HasSubstr("77 (7 cells)"), HasSubstr("`unknown`")));
  EXPECT_THAT(
      run({"check", write_hills_scene(source("hills.tif"),
                                      strokes_only + cover + "unknown = \"rock\"\n" + file)}),
      Ends(0, HasSubstr("77 (7 cells)")));
}

// ---- paintings

class PaintingFaults : public Faults {
 protected:
  // Forest everywhere, painted and in the scene.
  std::string write_painted_scene(const std::string& more = "", int label = 4) const {
    write_raster(path("hills.tif"), hills());
    Raster<float> codes = hills();
    for (float& code : codes.cells) code = 10.F;
    write_raster(path("cover.tif"), codes);
    if (!fs::exists(path("style.png")))
      write_picture("style.png", 64, 48, [](int x, int y) {
        return glm::vec3(0.2F, 0.01F * static_cast<float>((x * 7 + y * 5) % 40), 0.1F);
      });
    write_labels("classes.tif", 64, 48, [&](int, int) { return label; });
    return write_hills_scene(
        source("hills.tif"),
        "[land_cover]\nlegend = \"esa_worldcover\"\n[[land_cover.sources]]\nfile = \"cover.tif\"\n"
        "[[exemplar]]\npicture = \"style.png\"\nclasses = \"classes.tif\"\n" +
            more);
  }
};

TEST_F(PaintingFaults, TruncatedPaintingIsFoundBeforeTheWork) {
  const std::string scene = write_painted_scene();
  ASSERT_THAT(run({"check", scene}), Ends(0));
  fs::resize_file(path("style.png"), fs::file_size(path("style.png")) / 2);
  expect_refusal(scene, 3, AllOf(HasSubstr("style.png"), Not(HasSubstr(" s)"))));
}

TEST_F(PaintingFaults, HugeClaimOfATinyFileIsALimit) {
  test::write_bytes(path("style.png"), test::make_png(95000, 95000, 8, 2, ""));
  EXPECT_LT(fs::file_size(path("style.png")), 100U);
  expect_refusal(
      write_painted_scene(), 5,
      AllOf(HasSubstr("style.png"), HasSubstr("95000"), HasSubstr("MiB"), Not(HasSubstr(" s)"))));
}

TEST_F(PaintingFaults, GuidesOfAnotherSizeAreRefusedBeforeTheWork) {
  const std::string scene = write_painted_scene();
  write_labels("classes.tif", 63, 48, [](int, int) { return 4; });
  expect_refusal(scene, 3,
                 AllOf(HasSubstr("classes.tif"), HasSubstr("63×48"), Not(HasSubstr(" s)"))));
}

TEST_F(PaintingFaults, AClassThatNoPaintingHasNeedsAFallback) {
  const Outcome refused =
      run({"check", write_painted_scene("", 7)});  // rock is painted, forest is asked for
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("forest"), HasSubstr("fallback")));
  const Outcome named =
      run({"check", write_painted_scene("[synthesis]\nfallback = { forest = \"rock\" }\n", 7)});
  EXPECT_EQ(named.status, 0) << named.err;
}

// ---- colour files

TEST_F(Faults, BadColourFilesAreFoundBeforeTheWork) {
  const std::string profile = "profile = \"printer.icc\"\n";
  const std::string config = "ocio_config = \"show.ocio\"\n";
  write("printer.icc", "no profile");
  write("show.ocio", "no config: [");
  const auto scene = [&](const std::string& output) {
    return write("scene.toml", "version = 1\n" + test::small_mountains +
                                   "[synthesis]\nenabled = false\n[output]\nwidth = 64\nheight = "
                                   "48\nsheet_width_mm = 64\n" +
                                   output);
  };
  expect_refusal(scene(profile), 3, AllOf(HasSubstr("printer.icc"), Not(HasSubstr(" s)"))));
  expect_refusal(scene(config), 3, AllOf(HasSubstr("show.ocio"), Not(HasSubstr(" s)"))));
  // Beside the scene file, wherever the program is started.
  write("show.ocio",
        "ocio_profile_version: 1\nroles:\n  scene_linear: lin_srgb\ncolorspaces:\n  - "
        "!<ColorSpace>\n    name: lin_srgb\n"
        "  - !<ColorSpace>\n    name: srgb\n");
  EXPECT_THAT(run({"check", scene(config)}), Ends(0));
  fs::remove(path("show.ocio"));
  expect_refusal(scene(config), 3, HasSubstr("show.ocio"));
}

// ---- servers

TEST_F(Faults, ServersThatFailAreAskedAgainAndThoseThatStallAreInputErrors) {
  if (!test::has_python()) GTEST_SKIP() << "there is no python3 to serve files";
  write_raster(path("hills.tif"), hills());
  const auto scene = [&](const test::HttpServer& server) {
    return write_hills_scene(source(server.address("hills.tif")), strokes_only);
  };
  const test::HttpServer fails(folder_.path(), {"fail=2"});
  expect_refusal(scene(fails), 2, AllOf(HasSubstr("scene.toml:3:8"), HasSubstr("--allow-http")));
  EXPECT_THAT(run({"guidance", scene(fails), "--out", path("served"), "--allow-http"}),
              Ends(0, AllOf(HasSubstr("note: "), HasSubstr("503"), HasSubstr("Retrying"))));
  ASSERT_EQ(
      run({"guidance", write_hills_scene(source("hills.tif")), "--out", path("local")}).status, 0);
  EXPECT_EQ(read_channel(path("served/guidance.exr"), "altitude.V"),
            read_channel(path("local/guidance.exr"), "altitude.V"));
  // The header knows the file by its bytes, wherever it lies.
  const std::string hash =
      read_image_info(path("local/guidance.exr")).notes.at("belvedere:inputs").substr(0, 32);
  EXPECT_EQ(read_image_info(path("served/guidance.exr")).notes.at("belvedere:inputs"),
            hash + "  " + fails.address("hills.tif") + "\n");

  const test::HttpServer stalls(folder_.path(), {"stall"});
  expect_refusal(scene(stalls), 3, HasSubstr(stalls.address("hills.tif")),
                 {"--allow-http", "--http-silence", "1"});
  // What fits into the first answer, 16 KiB, needs no parts; rough ground does not.
  Raster<float> rough{
      Grid<float>(240, 240), {east, north, 20.0, 20.0}, normalize_crs("EPSG:32632")};
  std::uint32_t state = 1;
  for (float& z : rough.cells)
    z = 1000.F + static_cast<float>((state = state * 1664525U + 1013904223U) >> 8U) * 1e-5F;
  write_raster(path("rough.tif"), rough);
  const test::HttpServer whole(folder_.path(), {"no-ranges"});
  expect_refusal(write_hills_scene(source(whole.address("rough.tif")), strokes_only), 3,
                 AllOf(HasSubstr(whole.address("rough.tif")), HasSubstr("range requests")),
                 {"--allow-http"});
}

// The pieces of a stopped run, and another file under its address before it is resumed: the sheet
// would show two grounds.
TEST_F(Faults, DataThatChangedOnItsServerIsNotGoneOnWith) {
  if (!test::has_python()) GTEST_SKIP() << "there is no python3 to serve files";
  write_raster(path("hills.tif"), hills());
  fs::copy_file(path("hills.tif"), path("first.tif"));
  const test::HttpServer server(folder_.path());
  const std::string scene = write_hills_scene(source(server.address("hills.tif")), strokes_only);
  ASSERT_THAT(run({"plan", scene, "--out", path("sheet"), "--parts", "1", "-q", "--allow-http"}),
              Ends(0));
  Raster<float> others = hills();
  others.cells(20, 20) += 50.F;
  write_raster(path("hills.tif"), others);
  const std::vector<std::vector<std::string>> lines = {
      {"part", path("sheet"), "1", "-q"},
      {"render", scene, "--resume", "--out", path("sheet"), "-q", "--allow-http"}};
  for (const auto& line : lines) {
    EXPECT_THAT(run(line), Ends(3, AllOf(HasSubstr("other data"), HasSubstr("without --resume"))))
        << line[0];
  }
  fs::copy_file(path("first.tif"), path("hills.tif"), fs::copy_options::overwrite_existing);
  EXPECT_THAT(run(lines[1]), Ends(0));
}

// ---- two runs

TEST_F(Faults, TheSecondRunIntoAFolderEndsAtOnceAndLeavesTheFirstAlone) {
  const std::string scene = write_large_scene();
  const std::vector<std::string> line = {"guidance",     scene,       "--out",
                                         path("result"), "--threads", "1"};
  const pid_t first = start(line);
  for (int i = 0;
       i < 1000 && read_bytes(path("stderr")).find("building the ray tracer") == std::string::npos;
       ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_THAT(run(line), Ends(4, AllOf(HasSubstr(path("result")), HasSubstr("another run"))));
  EXPECT_EQ(kill(first, 0), 0) << "the first one runs on";
  kill(first, SIGINT);
  EXPECT_EQ(finish(first).status, 75);
}

// ---- light

TEST_F(Faults, SunBelowTheHorizonIsAWarning) {
  EXPECT_THAT(run({"check", write_scene_file(), "--set", "sun.altitude_deg=-3"}),
              Ends(0, AllOf(HasSubstr("below the horizon"), HasSubstr("sky"))));
}

// ---- the machine

TEST_F(Faults, APinnedInstructionSetThatTheProcessorLacksIsALimit) {
  const std::string scene = write_scene_file("[sampling]\ninstruction_set = \"avx2\"\n");
  const std::vector<std::string> older_machine = {"BELVEDERE_INSTRUCTION_SET=sse4.2",
                                                  "BELVEDERE_CACHE="};
  for (const char* command : {"check", "render", "guidance"}) {
    std::vector<std::string> arguments = {command, scene};
    if (command != std::string("check"))
      arguments.insert(arguments.end(), {"--out", path("result")});
    const Outcome refused = run(arguments, older_machine);
    EXPECT_EQ(refused.status, 5) << command;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("sampling.instruction_set"), HasSubstr("AVX2"),
                                   HasSubstr("\"sse4.2\""), Not(HasSubstr(" s)"))));
    EXPECT_TRUE(!fs::exists(path("result")) || fs::is_empty(path("result"))) << "something is left";
  }
  EXPECT_THAT(run({"check", scene, "--set", "sampling.instruction_set=mmx"}),
              Ends(2, AllOf(HasSubstr("mmx"), HasSubstr("sse4.2"))));

  // Both have this one: the same picture, and its header says why.
  const std::vector<std::string> pinned = {"guidance", scene, "--set",
                                           "sampling.instruction_set=sse4.2", "--out"};
  const auto with_folder = [&](const std::string& folder) {
    std::vector<std::string> arguments = pinned;
    arguments.push_back(path(folder));
    return arguments;
  };
  ASSERT_EQ(run(with_folder("here")).status, 0);
  ASSERT_EQ(run(with_folder("there"), older_machine).status, 0);
  EXPECT_TRUE(read_bytes(path("here/guidance.exr")) == read_bytes(path("there/guidance.exr")));
  const ImageInfo info = read_image_info(path("here/guidance.exr"));
  EXPECT_THAT(info.notes.at("belvedere:instruction_set"), HasSubstr("SSE4.2 pinned"));
  EXPECT_THAT(info.notes.at("belvedere:scene"), HasSubstr("instruction_set = \"sse4.2\""));
}

// ---- output

TEST_F(Faults, FullDiskKeepsTheOldResultWhole) {
  const std::string scene = write_scene_file();
  ASSERT_EQ(run({"render", scene, "--out", path("result"), "--quiet"}).status, 0);
  const std::vector<const char*> files = {"panorama.tif", "panorama.png", "panorama.exr",
                                          "guidance.exr"};
  std::vector<std::string> old;
  for (const char* file : files) old.push_back(read_bytes(fs::path(path("result")) / file));
  // A limit of file sizes stands for the full disk: here every file is too large for it.
  EXPECT_THAT(run_prepared({"render", scene, "--out", path("result"), "--set", "seed=5"},
                           [] {
                             const rlimit bytes{8000, 8000};
                             setrlimit(RLIMIT_FSIZE, &bytes);
                           }),
              Ends(4, HasSubstr("guidance")));
  for (std::size_t i = 0; i < files.size(); ++i)
    EXPECT_TRUE(read_bytes(fs::path(path("result")) / files[i]) == old[i]) << files[i];
  EXPECT_EQ(std::distance(fs::directory_iterator(path("result")), {}), 5)
      << "a temporary file is left beside four files and their record";
}

TEST_F(Faults, AFolderThatCannotBeWrittenIsRefusedBeforeTheWork) {
  for (const std::string& folder :
       {std::string("/proc/self"), write("file", "in the way") + "/below"}) {
    EXPECT_THAT(run({"render", write_scene_file(), "--out", folder}),
                Ends(4, AllOf(HasSubstr(folder), Not(HasSubstr(" s)")))));
  }
}

TEST_F(Faults, KilledAtAnyMomentLeavesTheOldOrTheNewFile) {
  const std::string scene = write_scene_file();
  const auto arguments = [&](const std::string& folder, const char* pitch) {
    return std::vector<std::string>{"guidance",         scene,   "--out", path(folder), "--set",
                                    "output.width=240", "--set", pitch};
  };
  ASSERT_EQ(run(arguments("old", "camera.pitch_deg=-25")).status, 0);
  ASSERT_EQ(run(arguments("new", "camera.pitch_deg=-30")).status, 0);
  const std::string old_bytes = read_bytes(path("old/guidance.exr"));
  const std::string new_bytes = read_bytes(path("new/guidance.exr"));
  ASSERT_NE(old_bytes, new_bytes);
  int old_ones = 0;
  for (const int after_ms : {-1, 0, 3, 10, 30, 60, 100, 200}) {
    fs::create_directories(path("result"));
    for (const char* name : {"/guidance.exr", "/.belvedere_results"})
      fs::copy_file(path("old") + name, path("result") + name,
                    fs::copy_options::overwrite_existing);
    fs::remove(path("stderr"));
    const pid_t child = start(arguments("result", "camera.pitch_deg=-30"));
    // Counted from where the file is begun: what comes before takes most of the time and touches
    // nothing. -1 is before all that.
    for (int i = 0; after_ms >= 0 && i < 20'000 &&
                    read_bytes(path("stderr")).find("building the ray tracer") == std::string::npos;
         ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
    kill(child, SIGKILL);
    finish(child);
    const std::string bytes = read_bytes(path("result/guidance.exr"));
    EXPECT_TRUE(bytes == old_bytes || bytes == new_bytes)
        << "after " << after_ms << " ms, " << bytes.size() << " bytes";
    old_ones += bytes == old_bytes ? 1 : 0;
  }
  EXPECT_GT(old_ones, 2) << "most came too late to see anything";
  // Leftovers do not block it.
  ASSERT_EQ(run(arguments("result", "camera.pitch_deg=-30")).status, 0);
  EXPECT_TRUE(read_bytes(path("result/guidance.exr")) == new_bytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(path("result")), {}), 2) << "it and its record";
}

TEST_F(Faults, ASheetBeyondTheMemoryIsRefusedWithTheEstimate) {
  const std::vector<std::string> sheet = {"--memory",           "2048",  "--set",
                                          "output.width=60000", "--set", "output.height=20000"};
  std::vector<std::string> arguments = {"render", write_scene_file(), "--out", path("result")};
  arguments.insert(arguments.end(), sheet.begin(), sheet.end());
  EXPECT_THAT(run(arguments), Ends(5, AllOf(HasSubstr("60000×20000"), HasSubstr("MiB"),
                                            HasSubstr("2048 MiB"), Not(HasSubstr(" s)")))));
  EXPECT_FALSE(fs::exists(path("result")));
}

TEST_F(Faults, GuidanceStreamsInTheMemoryThereIs) {
  const std::string scene = write_scene_file();
  const auto guidance = [&](const std::string& folder, const std::string& memory) {
    return run({"guidance", scene, "--out", path(folder), "--memory", memory, "--set",
                "output.width=64", "--set", "output.height=700", "--set",
                "output.sheet_width_mm=32", "--set", "sampling.pixel_samples=1", "--set",
                "sampling.sky_directions=0"});
  };
  ASSERT_EQ(guidance("whole", "1000").status, 0);
  const Outcome small = guidance("small", "24");
  ASSERT_EQ(small.status, 0) << small.err;
  EXPECT_TRUE(read_bytes(path("whole/guidance.exr")) == read_bytes(path("small/guidance.exr")));
  EXPECT_THAT(guidance("none", "1"),
              Ends(5, AllOf(HasSubstr("output.width"), Not(HasSubstr(" s)")))));
}

}  // namespace
}  // namespace belvedere
