#include "renderer/scene/scene_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "renderer/image/provenance.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

SceneLock sample() {
  return {.program = "0.3.0",
          .scene = "0123",
          .width = 800,
          .height = 367,
          .settings = {"palette=\"winter\"", "seed=3"},
          .inputs = {{.file = "b \"quoted\".tif",
                      .absent = false,
                      .bytes = 1234567890123,
                      .hash = "abcd"},
                     {.file = "a.png", .absent = true, .bytes = 0, .hash = {}}},
          .products = {{.file = "panorama.tif", .channels = {{"R", "1"}, {"G", "2"}, {"B", "3"}}},
                       {.file = "guidance.exr", .channels = {{"P.X", "4"}, {"Z", "5"}}}}};
}

TEST(SceneLock, WrittenLocksReadBackAndAreSorted) {
  const std::string text = write_lock(sample());
  const SceneLock read = parse_lock(text, "x.lock");
  EXPECT_EQ(read.program, "0.3.0");
  EXPECT_EQ(read.scene, "0123");
  EXPECT_EQ(read.width, 800);
  EXPECT_EQ(read.height, 367);
  EXPECT_EQ(read.settings, sample().settings);
  ASSERT_THAT(read.inputs, SizeIs(2));
  EXPECT_EQ(read.inputs[0], sample().inputs[1]);
  EXPECT_EQ(read.inputs[1], sample().inputs[0]);
  EXPECT_THAT(compare_products(read.products, sample().products), IsEmpty());
  EXPECT_EQ(write_lock(read), text);
  SceneLock empty;
  empty.width = empty.height = 16;
  EXPECT_EQ(write_lock(parse_lock(write_lock(empty), "x.lock")), write_lock(empty));
}

TEST(SceneLock, WhatIsNoLockIsAnInputErrorWithItsPlace) {
  const std::string good = write_lock(sample());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(test::input_error([&] { parse_lock(with("version = 1", "version = 2"), "x.lock"); }),
              HasSubstr("format 2"));
  EXPECT_THAT(test::input_error([&] { parse_lock(with("width = 800", "widht = 800"), "x.lock"); }),
              HasSubstr("x.lock"));
  EXPECT_THAT(test::message_of(ErrorKind::input,
                               [&] { parse_lock(with("width = 800", "width = 0"), "x.lock"); }),
              HasSubstr("the number 0"));
  EXPECT_THAT(test::message_of(ErrorKind::input,
                               [&] { parse_lock(with("bytes = 1234567890123\n", ""), "x.lock"); }),
              HasSubstr("bytes"));
  EXPECT_THAT(test::input_error([&] { parse_lock("<<<<<<< ours\n" + good, "x.lock"); }),
              HasSubstr("x.lock:1"));
  EXPECT_THAT(test::input_error([] { read_lock("/nowhere/x.lock"); }),
              AllOf(HasSubstr("/nowhere/x.lock"), HasSubstr("belvedere lock")));
}

TEST(SceneLock, LiesBesideItsScene) {
  EXPECT_EQ(lock_path("scenes/alps.toml"), "scenes/alps.lock");
  EXPECT_EQ(lock_path("alps.v2.toml"), "alps.v2.lock");
  EXPECT_EQ(lock_path("alps"), "alps.lock");
}

TEST(SceneLock, ProductsAreComparedChannelByChannel) {
  std::vector<LockedProduct> now = sample().products;
  now[1].channels[1].hash = "6";
  now[1].channels.erase(now[1].channels.begin());
  now[1].channels.push_back({"flow.V", "7"});
  now.erase(now.begin());
  const std::string words = describe(compare_products(sample().products, now));
  EXPECT_EQ(
      words,
      "\n  guidance.exr P.X: 4 in the lock, now not made\n  guidance.exr Z: 5 in the lock, now 6"
      "\n  guidance.exr flow.V: not in the lock, now 7\n  panorama.tif: 3 channels in the lock, "
      "now not made");
  EXPECT_THAT(compare_products(now, sample().products), SizeIs(4));
}

class LockedScene : public testing::Test {
 protected:
  void SetUp() override {
    Raster<float> raster{
        Grid<float>(4, 4, 7.F), {500000.0, 5200000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    write_raster(folder_ / "data/a.tif", raster);
    folder_.write("data/tiles/b.asc",
                  "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 30\n1 2\n3 4\n");
    folder_.write("data/all.vrt",
                  "<VRTDataset rasterXSize=\"2\" "
                  "rasterYSize=\"2\"><GeoTransform>0,30,0,60,0,-30</GeoTransform><VRTRasterBand "
                  "dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename "
                  "relativeToVRT=\"1\">tiles/b.asc</SourceFilename>"
                  "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
    folder_.write("scene/alps.toml",
                  "version = 1\n[[terrain.sources]]\nfile = "
                  "\"a.tif\"\n[[land_cover.sources]]\nfile = \"all.vrt\"\n"
                  "[land_cover]\nlegend = \"nlcd\"\n[[exemplar]]\npicture = \"p.png\"\nclasses = "
                  "\"c.png\"\noptional = true\n");
  }
  LoadedScene scene() const {
    return read_scene(folder_ / "scene/alps.toml",
                      {.data_folders = {folder_ / "data"}, .settings = {}});
  }

  struct Folders : test::Folder {
    Folders() {
      std::filesystem::create_directories(*this / "data");
      std::filesystem::create_directories(*this / "scene");
    }
  } folder_;
};

TEST_F(LockedScene, InputsAreAllFilesByTheirNamesInTheScene) {
  const std::vector<LockedInput> found = find_inputs(scene());
  std::vector<std::string> names;
  for (const LockedInput& input : found) names.push_back(input.file);
  EXPECT_THAT(names, ElementsAre("a.tif", "all.vrt", "c.png", "p.png", "tiles/b.asc"));
  EXPECT_EQ(found[0].hash, hash_file(folder_ / "data/a.tif"));
  EXPECT_EQ(found[0].bytes, std::filesystem::file_size(folder_ / "data/a.tif"));
  EXPECT_TRUE(found[2].absent);
  EXPECT_FALSE(found[4].absent);
  EXPECT_EQ(hash_input(folder_ / "data/a.tif").hash, found[0].hash);
  EXPECT_EQ(test::error_of([&] { hash_input(folder_ / "data/none"); }).kind(), ErrorKind::input);
}

TEST_F(LockedScene, AnotherByteOfTheSameSizeIsFoundAlsoBehindAVrt) {
  SceneLock lock;
  lock.inputs = find_inputs(scene());
  EXPECT_NO_THROW(require_locked_inputs(scene(), lock, "alps.toml"));
  std::string bytes = test::read_bytes(folder_ / "data/tiles/b.asc");
  bytes[bytes.size() - 2] = '5';
  folder_.write("data/tiles/b.asc", bytes);
  const std::string message =
      test::input_error([&] { require_locked_inputs(scene(), lock, "alps.toml"); });
  EXPECT_THAT(
      message,
      AllOf(HasSubstr("tiles/b.asc"), HasSubstr(lock.inputs[4].hash), HasSubstr(hash_bytes(bytes)),
            HasSubstr("belvedere lock --update alps.toml"), Not(HasSubstr("a.tif"))));
  // An optional painting that is there now changes the picture as well.
  lock.inputs = find_inputs(scene());
  folder_.write("scene/p.png", "x");
  EXPECT_THAT(test::input_error([&] { require_locked_inputs(scene(), lock, "alps.toml"); }),
              AllOf(HasSubstr("p.png"), HasSubstr("no such file in the lock")));
}

TEST_F(LockedScene, FilesBesideAVectorFileAreInputs) {
  std::string database("SQLite format 3\0", 16);
  database.resize(100);
  folder_.write("data/r.gpkg", database);
  folder_.write("data/s.shp", "");
  folder_.write("data/s.dbf", "");
  folder_.write("scene/alps.toml", test::read_bytes(folder_ / "scene/alps.toml") +
                                       "[[features]]\nsource = \"r.gpkg\"\nkind = \"road\"\n"
                                       "[[features]]\nsource = \"s.shp\"\nkind = \"road\"\n");
  const std::vector<LockedInput> before = find_inputs(scene());
  folder_.write("data/r.gpkg-wal", "changes");
  folder_.write("data/s.dbf", "names");
  EXPECT_THAT(describe(compare_inputs(before, find_inputs(scene()))),
              AllOf(HasSubstr("r.gpkg-wal: not in the lock"), HasSubstr("s.dbf: "),
                    Not(HasSubstr("s.shp"))));
}

TEST_F(LockedScene, InputsMoreOrFewerAreNamed) {
  SceneLock lock;
  lock.inputs = find_inputs(scene());
  lock.inputs[0].file = "older.tif";
  EXPECT_THAT(test::input_error([&] { require_locked_inputs(scene(), lock, "alps.toml"); }),
              AllOf(HasSubstr("a.tif: not in the lock, now "), HasSubstr("older.tif: "),
                    HasSubstr("the scene does not need it")));
}

TEST(SceneLock, TheSceneIsItsSettingsNotItsText) {
  const auto hash = [](const std::string& text) {
    return hash_scene(parse_scene("version = 1\n" + text, "x.toml", ".", {}).scene);
  };
  const std::string scene =
      "[terrain.synthetic]\nwidth = 96\nheight = 96\n[camera]\nposition = [0, 0]\n";
  EXPECT_EQ(hash(scene), hash("# a comment\n" + scene));
  EXPECT_NE(hash(scene), hash(scene + "pitch_deg = -3\n"));
}

TEST(SceneServers, AreAskedOnlyForRastersAndOnlyWithLeave) {
  const auto refused = [](const std::string& text) {
    return test::usage_error([&] { parse_scene("version = 1\n" + text, "x.toml", ".", {}); });
  };
  EXPECT_THAT(refused("[[terrain.sources]]\nfile = \"https://example.org/a.tif\"\n"),
              AllOf(HasSubstr("x.toml:3:8"), HasSubstr("--allow-http")));
  EXPECT_THAT(refused("palette = \"https://example.org/a.toml\"\n"), HasSubstr("only rasters"));
}

}  // namespace
}  // namespace belvedere
