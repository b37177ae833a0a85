// `belvedere layers fit` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/random.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"
#include "terrain/layers/layers_file.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class LayersFitCommand : public Program {
 protected:
  static constexpr int size = 80;

  // A cone: its upper half is rock, its lower half meadow.
  void SetUp() override {
    Raster<float> dem;
    dem.transform = {680000.0, 5260000.0, 30.0, 30.0};
    dem.crs = normalize_crs("EPSG:32632");
    dem.cells = Grid<float>(size, size);
    Raster<std::uint8_t> classes;
    classes.transform = dem.transform;
    classes.crs = dem.crs;
    classes.cells = Grid<std::uint8_t>(size, size);
    for (int y = 0; y != size; ++y)
      for (int x = 0; x != size; ++x) {
        dem.cells(x, y) = static_cast<float>(2500.0 - 12.0 * std::hypot(x - 40.3, y - 39.7) +
                                             3.0 * random_normal(1, x, y));
        classes.cells(x, y) = dem.cells(x, y) > 2150.0F ? 2 : 1;
      }
    write_raster(path("dem.tif"), dem);
    write_raster(path("classes.tif"), classes);
    write("legend.toml", "name = \"test\"\n[codes]\n1 = \"pasture\"\n2 = \"rock\"\n");
    write_picture("picture.png", size, size, [&](int x, int y) {
      const float n = 0.01F * static_cast<float>(random_normal(2, x, y));
      return classes.cells(x, y) == 2 ? glm::vec3(0.55F + n, 0.40F + n, 0.28F + n)
                                      : glm::vec3(0.25F + n, 0.48F + n, 0.20F + n);
    });
  }
  Outcome fit(const std::vector<std::string>& more,
              const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> arguments = {"layers",        "fit",   "--dem",
                                          path("dem.tif"), "--out", path("out.layers.toml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, environment);
  }
  bool nothing_written() const { return !std::filesystem::exists(path("out.layers.toml")); }
  std::vector<std::string> by_map() const {
    return {"--classes", path("classes.tif"), "--legend", path("legend.toml")};
  }
};

TEST_F(LayersFitCommand, LearnsALandCoverMap) {
  ASSERT_THAT(fit(by_map()), Ends(0));
  const SurfaceLayers layers = read_surface_layers(path("out.layers.toml"));
  ASSERT_EQ(layers.layers.size(), 2U);
  // P13: the five inputs, without being asked for.
  std::vector<std::string> names;
  for (const LayerInput& input : layers.inputs) names.push_back(input.name);
  EXPECT_THAT(names, testing::ElementsAre("altitude", "slope", "temperature", "rain", "radiation"));
  // The larger is the ground that the other is painted on.
  EXPECT_EQ(layers.ground_painted_as, LandCoverClass::pasture);
  EXPECT_EQ(layers.layers[1].painted_as, LandCoverClass::rock);
  // Alone, rock's function of altitude is open at the top and shut at the foot.
  std::vector<std::string> alone = by_map();
  alone.insert(alone.end(), {"--inputs", "altitude"});
  ASSERT_THAT(fit(alone), Ends(0));
  const SurfaceLayers by_altitude = read_surface_layers(path("out.layers.toml"));
  const auto rock_at = [&](double altitude_m) {
    return layer_function_value(by_altitude.layers[1].functions[0], by_altitude.inputs[0],
                                by_altitude.model, altitude_m);
  };
  EXPECT_GT(rock_at(2400.0), 0.8);
  EXPECT_LT(rock_at(1950.0), 0.2);
  EXPECT_LT(std::filesystem::file_size(path("out.layers.toml")), 20'000U);
}

TEST_F(LayersFitCommand, LearnsAPictureAndSaysWhatItFound) {
  ASSERT_THAT(fit({"--image", path("picture.png"), "--model", "additive"}),
              Prints(AllOf(HasSubstr("lies on the cells of the DEM"), HasSubstr("no clouds"),
                           HasSubstr("green"), HasSubstr("brown"), HasSubstr("sun estimated"))));
  EXPECT_EQ(read_surface_layers(path("out.layers.toml")).model, LayerModel::additive);
}

// Classes by hand, through the command: the file has their names and classes, in the places of the
// picture; colours outside all regions are not learned from.
TEST_F(LayersFitCommand, RegionsDrawnByHandAreTheClasses) {
  write("regions.toml",
        "[[region]]\nname = \"stone\"\nclass = \"rock\"\nhue_deg = [10, 60]\n"
        "[[region]]\nname = \"meadow\"\nclass = \"pasture\"\nhue_deg = [80, 160]\n");
  ASSERT_THAT(fit({"--image", path("picture.png"), "--regions", path("regions.toml")}),
              Prints(AllOf(HasSubstr("2 classes by 2 regions drawn"), HasSubstr("texture: "))));
  const SurfaceLayers layers = read_surface_layers(path("out.layers.toml"));
  std::vector<std::string> roots;
  for (const SurfaceLayer& layer : layers.layers)
    if (layer.parent < 0) roots.push_back(layer.name);
  EXPECT_THAT(roots, ::testing::UnorderedElementsAre("stone", "meadow"));
  EXPECT_EQ(layers.ground_painted_as, LandCoverClass::pasture);
  const Outcome applied = run({"layers", "apply", path("out.layers.toml"), "--dem", path("dem.tif"),
                               "--out", path("c.tif")});
  ASSERT_EQ(applied.status, 0) << applied.err;
  RasterSource source;
  source.path = path("c.tif");
  const Grid<std::int32_t> classes = read_codes(source).cells;
  EXPECT_EQ(classes(40, 40), static_cast<int>(LandCoverClass::rock));
  EXPECT_EQ(classes(2, 2), static_cast<int>(LandCoverClass::pasture));
  EXPECT_NE(fit({"--image", path("picture.png"), "--regions", path("none.toml")}).status, 0);
}

TEST_F(LayersFitCommand, FunctionsAreAsSmoothAsAsked) {
  const auto steps = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = by_map();
    arguments.insert(arguments.end(), {"--inputs", "altitude"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_THAT(fit(arguments), Ends(0));
    const SurfaceLayers layers = read_surface_layers(path("out.layers.toml"));
    double squares = 0.0;
    for (const LayerFunction& function : layers.layers[1].functions)
      if (const auto* of = std::get_if<LayerSamples>(&function))
        for (std::size_t i = 1; i != 256; ++i)
          squares += std::pow(of->samples[i] - of->samples[i - 1], 2.0);
    return squares;
  };
  EXPECT_LT(steps({"--roughness", "0.1"}), 0.7 * steps({"--roughness", "0.0001"}));
  EXPECT_LT(steps({"--functions", "histogram", "--smoothing", "12"}),
            0.7 * steps({"--functions", "histogram", "--smoothing", "0.5"}));
  std::vector<std::string> arguments = by_map();
  arguments.insert(arguments.end(), {"--smoothing", "3"});
  EXPECT_THAT(fit(arguments), Ends(2, HasSubstr("--functions histogram")));
}

// Bands in another order than red, green, blue, and one of infrared.
TEST_F(LayersFitCommand, PicturesMayHaveOtherBandsAndHaze) {
  EXPECT_THAT(fit({"--image", path("picture.png"), "--bands", "3,2,1"}),
              Ends(2, HasSubstr("a GeoTIFF of more bands")));
  EXPECT_THAT(fit({"--image", path("picture.png"), "--bands", "3,2"}),
              Ends(2, HasSubstr("RED,GREEN,BLUE,INFRARED")));
  EXPECT_THAT(
      fit({"--image", path("picture.png"), "--haze", "--snow-from", "2400", "--grey-hue", "300"}),
      Prints(AllOf(HasSubstr("haze taken out"), HasSubstr("white below 2400 m"))));
  const ByteRasterLayout layout{
      .frame = {{680000.0, 5260000.0, 30.0, 30.0}, size, size, normalize_crs("EPSG:32632")},
      .bands = {{}, {}, {}, {}}};
  std::vector<Grid<std::uint8_t>> bands(4, Grid<std::uint8_t>(size, size, 60));
  for (int y = 0; y != size; ++y)
    for (int x = 0; x != size; ++x) {
      const bool rock = std::hypot(x - 40.3, y - 39.7) < 29.0;
      const auto noise = static_cast<int>(random_index(7, 2, x, y));
      bands[0](x, y) = static_cast<std::uint8_t>((rock ? 70 : 50) + noise);
      bands[1](x, y) = static_cast<std::uint8_t>((rock ? 100 : 120) + noise);
      bands[2](x, y) = static_cast<std::uint8_t>((rock ? 140 : 60) + noise);
    }
  ByteRasterRows image(path("bands.tif"), layout);
  image.write(0, bands);
  image.prepare();
  image.commit();
  EXPECT_THAT(fit({"--image", path("bands.tif"), "--bands", "3,2,1,4"}),
              Prints(AllOf(HasSubstr("brown"), HasSubstr("green"))));
  EXPECT_THAT(fit({"--image", path("bands.tif")}),
              Prints(AllOf(HasSubstr("blue"), Not(HasSubstr("brown")))));
  EXPECT_THAT(fit({"--image", path("bands.tif"), "--bands", "3,2,1,5"}),
              Ends(3, HasSubstr("band 5")));
}

TEST_F(LayersFitCommand, WritesTheSameFileForAnyThreads) {
  std::vector<std::string> arguments = {"--image", path("picture.png"), "--threads", "1"};
  ASSERT_EQ(fit(arguments).status, 0);
  const std::string one = read_bytes(path("out.layers.toml"));
  arguments.back() = "2";
  ASSERT_EQ(fit(arguments, without_cache()).status, 0);
  EXPECT_EQ(one, read_bytes(path("out.layers.toml")));
}

TEST_F(LayersFitCommand, ReportHoldsItsPage) {
  std::vector<std::string> arguments = by_map();
  arguments.insert(arguments.end(), {"--report", path("report")});
  ASSERT_EQ(fit(arguments).status, 0);
  const std::string page = read_bytes(path("report/index.html"));
  for (const char* part : {"judgement", "functions", "trace", "inputs", "reproduction",
                           "\"slider\": [", "\"file\": \"out.layers.toml\"", "{ values = ["})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(page, Not(HasSubstr(path(""))));
  EXPECT_TRUE(std::filesystem::exists(path("report/original.png")));
}

TEST_F(LayersFitCommand, FaultsAreSaidAndNothingIsWritten) {
  const auto fails = [&](const std::vector<std::string>& arguments, int status,
                         const std::string& words) {
    EXPECT_THAT(fit(arguments), Ends(status, HasSubstr(words))) << words;
    EXPECT_TRUE(nothing_written());
  };
  fails({}, 2, "--image");
  fails({"--classes", path("classes.tif")}, 2, "--legend");
  fails({"--image", path("picture.png"), "--model", "sum"}, 2, "product, additive");
  fails({"--image", path("picture.png"), "--inputs", "altitud"}, 2, "altitude");
  write_picture("small.png", 20, 20, [](int, int) { return glm::vec3(0.5F); });
  fails({"--image", path("small.png")}, 3, "20×20 pixels");
  write_picture("one.png", size, size, [](int, int) { return glm::vec3(0.5F, 0.4F, 0.2F); });
  fails({"--image", path("one.png")}, 3, "only one class");
  write_picture("cloud.png", size, size, [](int x, int y) {
    const float n = 0.02F * static_cast<float>(random_normal(3, x, y));
    return glm::vec3(0.92F + n, 0.92F + 0.9F * n, 0.93F + n);
  });
  fails({"--image", path("cloud.png")}, 3, "cloud everywhere");
  Raster<std::uint8_t> far;
  far.transform = {100000.0, 4000000.0, 30.0, 30.0};
  far.crs = normalize_crs("EPSG:32632");
  far.cells = Grid<std::uint8_t>(10, 10, 1);
  write_raster(path("far.tif"), far);
  fails({"--classes", path("far.tif"), "--legend", path("legend.toml")}, 3, "does not overlap");
}

TEST_F(LayersFitCommand, MaskedCellsAreNotLearnedFrom) {
  Raster<std::uint8_t> mask;
  mask.transform = {680000.0, 5260000.0, 30.0, 30.0};
  mask.crs = normalize_crs("EPSG:32632");
  mask.cells = Grid<std::uint8_t>(size, size, 0);
  for (int y = 0; y != size; ++y)
    for (int x = 0; x != size / 2; ++x) mask.cells(x, y) = 1;
  write_raster(path("mask.tif"), mask);
  std::vector<std::string> arguments = by_map();
  arguments.insert(arguments.end(), {"--mask", path("mask.tif")});
  ASSERT_THAT(fit(arguments), Prints(HasSubstr("50.0 % of the cells are masked")));
  const std::string layers = read_bytes(path("out.layers.toml"));
  // Fields of rock at the foot and meadows on the summit, below the mask: not one byte changes.
  RasterSource map;
  map.path = path("classes.tif");
  const Raster<std::int32_t> classes = read_codes(map);
  Raster<std::uint8_t> other{Grid<std::uint8_t>(size, size), classes.transform, classes.crs};
  for (int y = 0; y != size; ++y)
    for (int x = 0; x != size; ++x)
      other.cells(x, y) =
          static_cast<std::uint8_t>(x < size / 2 ? 3 - classes.cells(x, y) : classes.cells(x, y));
  write_raster(path("classes.tif"), other);
  ASSERT_EQ(fit(arguments).status, 0);
  EXPECT_EQ(read_bytes(path("out.layers.toml")), layers);
  arguments.resize(arguments.size() - 2);
  ASSERT_EQ(fit(arguments).status, 0);
  EXPECT_NE(read_bytes(path("out.layers.toml")), layers) << "without the mask they count";
}

// Sun and climate of fitting and applying are the same numbers: layers learned from sun alone
// reproduce its classes, and ranges, which leave out a thousandth at each end, match to the cell.
TEST_F(LayersFitCommand, AppliedToItsOwnGroundItFindsItsClasses) {
  Raster<std::uint8_t> sides;
  sides.transform = {680000.0, 5260000.0, 30.0, 30.0};
  sides.crs = normalize_crs("EPSG:32632");
  sides.cells = Grid<std::uint8_t>(size, size, 1);
  for (int y = size / 2; y != size; ++y)
    for (int x = 0; x != size; ++x) sides.cells(x, y) = 2;
  write_raster(path("classes.tif"), sides);
  std::vector<std::string> arguments = by_map();
  arguments.insert(arguments.end(),
                   {"--inputs", "radiation,temperature,rain,sky_view", "--model", "additive"});
  ASSERT_THAT(fit(arguments), Prints(HasSubstr("rain: from latitude")));
  const Outcome applied = run({"layers", "apply", path("out.layers.toml"), "--dem", path("dem.tif"),
                               "--out", path("c.tif"), "--shares", path("s.tif")});
  ASSERT_EQ(applied.status, 0) << applied.err;
  for (const char* name : {"radiation", "temperature", "rain", "sky_view"}) {
    const std::size_t at = applied.out.find(std::string("  ") + name, applied.out.find("outside"));
    ASSERT_NE(at, std::string::npos) << name;
    // 6400 cells: 6 or 7 at each end.
    EXPECT_NEAR(std::stod(applied.out.substr(at + 16)), 0.2, 0.051) << applied.out;
  }
  RasterSource source;
  source.path = path("c.tif");
  const Grid<std::int32_t> classes = read_codes(source).cells;
  int right = 0;
  for (std::size_t i = 0; i != classes.size(); ++i)
    right += classes[i] == static_cast<int>(sides.cells[i] == 1 ? LandCoverClass::pasture
                                                                : LandCoverClass::rock)
                 ? 1
                 : 0;
  EXPECT_GT(right, 0.9 * size * size);
}

TEST_F(LayersFitCommand, GroundWithoutCoordinateSystemNeedsItsLatitude) {
  Raster<float> dem;
  dem.transform = {0.0, 0.0, 30.0, 30.0};
  dem.cells = Grid<float>(size, size);
  for (int y = 0; y != size; ++y)
    for (int x = 0; x != size; ++x)
      dem.cells(x, y) = static_cast<float>(2500.0 - 12.0 * std::hypot(x - 40.3, y - 39.7));
  write_raster(path("dem.tif"), dem);
  EXPECT_THAT(fit({"--image", path("picture.png")}), Ends(2, HasSubstr("--latitude")));
  EXPECT_TRUE(nothing_written());
  EXPECT_EQ(fit({"--image", path("picture.png"), "--latitude", "47"}).status, 0);
  // Inputs that are not used are not computed.
  EXPECT_EQ(fit({"--image", path("picture.png"), "--inputs", "altitude,slope"}).status, 0);
}

}  // namespace
}  // namespace belvedere
