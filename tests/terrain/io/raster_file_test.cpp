#include "terrain/io/raster_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "base/error.h"
#include "base/random.h"
#include "terrain/io/block_means.h"
#include "terrain/io/dem_levels.h"
#include "terrain/io/features.h"
#include "terrain/io/points.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

TEST(HeightEncoding, HeightsOfThePublishedFormulas) {
  const HeightEncoding terrarium = *height_encoding("terrarium");
  EXPECT_EQ(terrarium.metres(128, 0, 0), 0.F);
  EXPECT_EQ(terrarium.metres(132, 210, 128), 1234.5F);
  EXPECT_EQ(terrarium.metres(127, 255, 0), -1.F);
  const HeightEncoding mapbox = *height_encoding("mapbox");
  EXPECT_EQ(mapbox.metres(0, 0, 0), -10000.F);
  EXPECT_NEAR(mapbox.metres(1, 134, 160), 0.F, 1e-3F);     // 100000 steps
  EXPECT_NEAR(mapbox.metres(2, 224, 72), 8848.8F, 1e-3F);  // 188488 steps
  EXPECT_FALSE(height_encoding("Terrarium"));
}

class EncodedRaster : public RasterFiles {
 protected:
  static constexpr int width = 60, height = 40;
  // A slope that crosses steps of the middle byte of both encodings; a hole at (7, 5).
  static float slope(double x, double y) { return static_cast<float>(500.0 + 4.0 * x + 7.5 * y); }

  static DemParameters dem_of(const RasterSource& source) {
    DemParameters parameters;
    parameters.sources = {source};
    return parameters;
  }
  RasterSource write(const std::string& encoding) const {
    ByteRasterLayout layout{
        .frame = {{500000, 5200000, 30, 30}, width, height, normalize_crs("EPSG:32632")},
        .bands = {{"r"}, {"g"}, {"b"}},
        .is_colour = true};
    std::vector<Grid<std::uint8_t>> bands(3, Grid<std::uint8_t>(width, height, 0));
    for (const auto [x, y] : test::cells(width, height)) {
      if (x == 7 && y == 5) continue;
      const double z = static_cast<double>(slope(x, y));
      const auto steps = static_cast<std::uint32_t>(
          std::lround(encoding == "mapbox" ? (z + 10000.0) * 10.0 : (z + 32768.0) * 256.0));
      bands[0](x, y) = static_cast<std::uint8_t>(steps >> 16);
      bands[1](x, y) = static_cast<std::uint8_t>(steps >> 8 & 255U);
      bands[2](x, y) = static_cast<std::uint8_t>(steps & 255U);
    }
    ByteRasterRows file(path("tiles.tif"), layout);
    file.write(0, bands);
    file.commit();
    RasterSource source;
    source.path = path("tiles.tif");
    source.encoding = encoding;
    return source;
  }
};

TEST_F(EncodedRaster, HeightsComeBackInMetresBlackIsVoid) {
  for (const char* encoding : {"terrarium", "mapbox"}) {
    const Dem dem = read_dem(dem_of(write(encoding)), silent_progress());
    for (const auto [x, y] : test::cells(width, height))
      ASSERT_NEAR(dem.altitude_m(x, y), slope(x, y), 0.06F) << encoding << ' ' << x << ' ' << y;
    EXPECT_EQ(dem.filled(7, 5), 1);
    EXPECT_EQ(dem.filled(8, 5), 0);
  }
}

// Half a cell aside, heights are resampled; of colours resampled first they would be off by up to
// 256 m where the middle byte changes.
TEST_F(EncodedRaster, HeightsAreResampledNotColours) {
  const RasterSource source = write("terrarium");
  RasterFrame frame{{500315, 5199685, 30, 30}, 40, 20, normalize_crs("EPSG:32632")};
  const Raster<float> aside = warp_rasters({source}, frame, silent_progress());
  for (const auto [x, y] : test::cells(40, 20))
    ASSERT_NEAR(aside.cells(x, y), slope(x + 10.5, y + 10.5), 0.02F) << x << ' ' << y;
  const std::optional<Raster<float>> thin = read_thinned(source, 20);
  ASSERT_TRUE(thin);
  for (const auto [x, y] : test::cells({3, 1, 20, thin->cells.height()}))
    ASSERT_NEAR(thin->cells(x, y), slope(3.0 * x + 1.0, 3.0 * y + 1.0), 12.F) << x << ' ' << y;
}

TEST_F(EncodedRaster, GroundLargerThanMemoryIsDecodedToo) {
  const DemParameters parameters = dem_of(write("mapbox"));
  const RasterFrame frame = choose_frame(parameters.sources, "", 0.0, {});
  DemLevels levels(parameters, frame, 2, 0.0, silent_progress());
  const Dem whole = levels.whole();
  EXPECT_NEAR(whole.altitude_m(8, 5), slope(32, 20), 0.1F);
  EXPECT_NEAR(levels.window(0, {20, 10, 30, 20}, whole).altitude_m(3, 4), slope(23, 14), 0.06F);
}

TEST_F(EncodedRaster, WhatIsNotEncodedIsRefused) {
  RasterSource source = write("mapbox");
  source.encoding = "mapzen";
  EXPECT_THAT(error_of([&] { read_raster(source); }).what(), HasSubstr("\"terrarium\""));
  write_ascii("plain.asc", 4, 4, 0, 0, 30, [](int, int) { return "7"; });
  source.path = path("plain.asc");
  source.encoding = "mapbox";
  EXPECT_THAT(error_of([&] { read_raster(source); }).what(), HasSubstr("three bands of 8 bits"));
  source = write("mapbox");
  source.encoding.clear();
  const Error plain = error_of([&] { read_dem(dem_of(source), silent_progress()); });
  EXPECT_THAT(plain.what(), HasSubstr("`encoding = \"terrarium\"`"));
}

namespace fs = std::filesystem;
using testing::ElementsAre;

std::uint32_t big_endian_at(const std::string& bytes, std::size_t at, int count = 4) {
  std::uint32_t out = 0;
  for (int i = 0; i < count; ++i)
    out = out << 8 | static_cast<std::uint8_t>(bytes[at + static_cast<std::size_t>(i)]);
  return out;
}

std::string word(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}

std::size_t page_bytes(const std::string& database) { return big_endian_at(database, 16, 2); }

// Bytes 18 and 19 of a database say by which format it is written and read: 2 is WAL.
std::string in_wal_mode(std::string database) {
  database[18] = database[19] = 2;
  return database;
}

// A "-wal" whose one transaction makes another database of any: sqlite.org/fileformat2.html, 4.1,
// with checksums of big-endian words (4.2).
std::string wal_to(const std::string& database) {
  std::array<std::uint32_t, 2> sum{};
  const auto add = [&](const std::string& bytes) {
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
      sum[0] += big_endian_at(bytes, i) + sum[1];
      sum[1] += big_endian_at(bytes, i + 4) + sum[0];
    }
    return word(sum[0]) + word(sum[1]);
  };
  const std::size_t bytes = page_bytes(database);
  const std::string salt = word(17) + word(18);
  std::string out =
      word(0x377f0683) + word(3007000) + word(static_cast<std::uint32_t>(bytes)) + word(0) + salt;
  out += add(out);
  const std::size_t pages = database.size() / bytes;
  for (std::size_t i = 0; i < pages; ++i) {
    const std::string head =
        word(static_cast<std::uint32_t>(i + 1)) +
        word(i + 1 == pages ? static_cast<std::uint32_t>(pages) : 0);  // the last one commits
    const std::string page = database.substr(i * bytes, bytes);
    const std::string check = add(head + page);
    out += head + salt + check + page;
  }
  return out;
}

// A "-journal" of a program that ended in the middle of a change: what the pages were before (3).
std::string journal_to(const std::string& database) {
  const std::size_t bytes = page_bytes(database);
  const auto pages = static_cast<std::uint32_t>(database.size() / bytes);
  std::string out = std::string("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7") + word(pages) + word(7) +
                    word(pages) + word(512) + word(static_cast<std::uint32_t>(bytes));
  out.resize(512);
  for (std::uint32_t i = 0; i < pages; ++i) {
    const std::string page = database.substr(i * bytes, bytes);
    std::uint32_t sum = 7;
    for (std::size_t at = bytes - 200; at < bytes && at > 0; at -= 200) {
      sum += static_cast<std::uint8_t>(page[at]);
      if (at < 200) break;
    }
    out += word(i + 1) + page + word(sum);
  }
  return out;
}

class InputParts : public RasterFiles {
 protected:
  using Files = std::map<std::string, std::size_t>;  // by name, a hash of the bytes
  Files files() const {
    Files out;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      out[entry.path().filename().string()] =
          std::hash<std::string>()(test::read_bytes(entry.path()));
    return out;
  }
  Raster<float> ground() const {
    return make_hills(24, 20, {500000, 5200000, 50, 50}, "EPSG:32632");
  }
  // A GeoPackage of contour lines, taken away from the folder.
  std::string contours(double interval_m) const {
    write_contours(path("c.gpkg"), ground(), {.interval_m = interval_m, .base_m = 0.0});
    std::string bytes = read_text("c.gpkg");
    fs::remove(path("c.gpkg"));
    return bytes;
  }
  std::size_t lines_in(const std::string& name) const {
    return read_map_features(path(name), {.layer = {}, .where = {}, .columns = {}},
                             normalize_crs("EPSG:32632"))
        .features.size();
  }
  void write_changed() const {
    const std::string few = contours(100.0);
    const std::string many = contours(10.0);
    write_text("few.gpkg", few);
    write_text("many.gpkg", many);
    write_text("a.gpkg", in_wal_mode(few));
    write_text("a.gpkg-wal", wal_to(in_wal_mode(many)));
  }
};

TEST_F(InputParts, ChangesBesideADatabaseAreReadAndStayThere) {
  write_changed();
  ASSERT_LT(lines_in("few.gpkg"), lines_in("many.gpkg"));
  const Files before = files();
  EXPECT_EQ(lines_in("a.gpkg"), lines_in("many.gpkg"));
  EXPECT_EQ(files(), before);
  EXPECT_THAT(vector_parts(path("a.gpkg")), ElementsAre(path("a.gpkg"), path("a.gpkg-wal")));
  EXPECT_THAT(vector_parts(path("few.gpkg")), ElementsAre(path("few.gpkg")));
}

// SQLite has the changes beside the file itself.
TEST_F(InputParts, ALinkToADatabaseHasItsChanges) {
  write_changed();
  fs::create_directory(path("links"));
  fs::create_symlink(path("a.gpkg"), path("links/b.gpkg"));
  EXPECT_EQ(lines_in("links/b.gpkg"), lines_in("many.gpkg"));
  EXPECT_THAT(vector_parts(path("links/b.gpkg")),
              ElementsAre(path("links/b.gpkg"), path("a.gpkg-wal")));
}

// In WAL mode even a reader makes files beside the database, where it may.
TEST_F(InputParts, ADatabaseInWalModeIsLeftAlone) {
  write_text("a.gpkg", in_wal_mode(contours(10.0)));
  const auto check = [&] {
    const auto made = fs::last_write_time(folder_.path());
    const Files before = files();
    EXPECT_GT(lines_in("a.gpkg"), 0U);
    EXPECT_EQ(files(), before);
    EXPECT_EQ(fs::last_write_time(folder_.path()), made) << "files came and went";
    EXPECT_THAT(vector_parts(path("a.gpkg")), ElementsAre(path("a.gpkg")));
  };
  check();
  write_text("a.gpkg-wal", "");  // nothing has changed yet
  write_text("a.gpkg-shm", std::string(32768, '\0'));
  check();
}

TEST_F(InputParts, AnUnfinishedChangeIsUndoneInTheCopy) {
  const std::string few = contours(100.0);
  std::string changed = few;
  for (std::size_t i = changed.size() - page_bytes(few); i < changed.size(); ++i) changed[i] = 0;
  write_text("few.gpkg", few);
  write_text("a.gpkg", changed);
  write_text("a.gpkg-journal", journal_to(few));
  const Files before = files();
  EXPECT_EQ(lines_in("a.gpkg"), lines_in("few.gpkg"));
  EXPECT_EQ(files(), before);
}

TEST_F(InputParts, WhatCannotBeCopiedIsAnErrorThatNamesIt) {
  write_changed();
  const char* const old = std::getenv("TMPDIR");
  const std::string kept = old != nullptr ? old : "";
  setenv("TMPDIR", path("none").c_str(), 1);
  const Error error = error_of([&] { lines_in("a.gpkg"); });
  old != nullptr ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_THAT(error.where() + error.found() + error.allowed(), HasSubstr("TMPDIR"));
  fs::remove(path("a.gpkg-wal"));
  fs::create_directory(path("a.gpkg-wal"));
  write_text("a.gpkg-wal/x", "x");
  EXPECT_GT(lines_in("a.gpkg"), 0U) << "a folder is no changes";
}

TEST_F(InputParts, AVrtOfADatabaseInUseIsRefused) {
  write_text("a.gpkg", in_wal_mode(contours(100.0)));
  write_text("v.vrt",
             "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Byte\" "
             "band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">a.gpkg"
             "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>");
  const Files before = files();
  EXPECT_EQ(test::kind_of([&] { read_raster_info(source_of(path("v.vrt"))); }), ErrorKind::input);
  EXPECT_EQ(files(), before);
}

// Every format that is read: the folder has the same files afterwards, to the byte.
TEST_F(InputParts, ReadersLeaveTheFolderAsItWas) {
  const Raster<float> dem = ground();
  write_raster(path("d.tif"), dem);
  write_raster(path("d.asc"), dem);
  write_text("v.vrt",
             "<VRTDataset rasterXSize=\"24\" rasterYSize=\"20\"><GeoTransform>500000,50,0,5201000,"
             "0,-50</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
             "<SourceFilename relativeToVRT=\"1\">d.tif</SourceFilename></SimpleSource>"
             "</VRTRasterBand></VRTDataset>");
  std::string grid;
  for (const auto [x, y] : test::cells(4, 4))
    grid += std::to_string(x) + " " + std::to_string(9 - y) + " " + std::to_string(x * y) + "\n";
  write_text("d.xyz", grid);
  std::vector<std::string> rasters = {"d.tif", "d.asc", "v.vrt", "d.xyz"};
  const std::pair<const char*, const char*> others[] = {
      {"HFA", "d.img"},  {"ENVI", "d.bin"},         {"EHdr", "d.bil"},          {"netCDF", "d.nc"},
      {"GSAG", "d.grd"}, {"PNG -ot Byte", "d.png"}, {"GPKG -ot Byte", "r.gpkg"}};
  for (const auto& [format, name] : others)
    if (std::system(("gdal_translate -q -of " + std::string(format) + " '" + path("d.tif") + "' '" +
                     path(name) + "' 2> /dev/null")
                        .c_str()) == 0)
      rasters.emplace_back(name);
  for (const char* name : {"c.gpkg", "c.shp", "c.geojson"})
    write_contours(path(name), dem, {.interval_m = 50.0, .base_m = 0.0});
  write_text("t.gpx",
             "<gpx version=\"1.1\" creator=\"t\"><trk><trkseg><trkpt lat=\"47\" lon=\"9\"/>"
             "<trkpt lat=\"47.01\" lon=\"9\"/></trkseg></trk></gpx>");
  write_text("o.osm",
             "<osm version=\"0.6\"><node id=\"1\" lat=\"47\" lon=\"9\"><tag k=\"natural\" "
             "v=\"peak\"/></node></osm>");
  write_text("p.csv", "name,longitude,latitude\nA,9,47\n");
  const Files before = files();
  for (const std::string& name : rasters) {
    const RasterSource source = source_of(path(name), "EPSG:32632");
    EXPECT_NO_THROW(read_raster_info(source)) << name;
    EXPECT_GT(read_raster(source).cells.size(), 0U) << name;
    EXPECT_FALSE(read_codes(source).cells.empty()) << name;
    EXPECT_FALSE(raster_parts(path(name)).empty()) << name;
    EXPECT_EQ(files(), before) << name;
  }
  for (const char* name : {"c.gpkg", "c.shp", "c.geojson", "t.gpx", "o.osm"}) {
    EXPECT_GT(lines_in(name), 0U) << name;
    EXPECT_EQ(files(), before) << name;
  }
  EXPECT_THAT(vector_parts(path("c.shp")), testing::Contains(path("c.dbf")));
}

ByteRasterLayout layout(int bands) {
  ByteRasterLayout made{
      .frame = {{1000.0, 2000.0, 5.0, 4.0}, 300, 550, normalize_crs("EPSG:32632")}};
  for (int i = 0; i < bands; ++i) made.bands.push_back({"band " + std::to_string(i), 1.0});
  return made;
}
std::uint8_t value(int band, int x, int y) {
  return static_cast<std::uint8_t>(random_bits(static_cast<std::uint64_t>(band), x, y) % 200 + 1);
}

std::vector<Grid<std::uint8_t>> rows(int bands, int y0, int count) {
  std::vector<Grid<std::uint8_t>> out;
  for (int b = 0; b < bands; ++b) {
    Grid<std::uint8_t>& grid = out.emplace_back(300, count);
    for (const auto [x, y] : test::cells(300, count)) grid(x, y) = value(b, x, y0 + y);
  }
  return out;
}

TEST(ByteRasterRows, RowsComeBackAsTheyWere) {
  const test::Folder folder;
  ByteRasterRows file(folder / "a.tif", layout(3));
  for (int y0 = 0; y0 < 550; y0 += 200) file.write(y0, rows(3, y0, std::min(200, 550 - y0)));
  file.commit();
  EXPECT_EQ(folder.count(), 1U);
  for (int b = 0; b < 3; ++b) {
    RasterSource source;
    source.path = folder / "a.tif";
    source.band = b + 1;
    const Raster<std::int32_t> back = read_codes(source);
    EXPECT_EQ(back.transform, (GeoTransform{1000.0, 2000.0, 5.0, 4.0}));
    for (const auto [x, y] : test::cells(300, 550)) ASSERT_EQ(back.cells(x, y), value(b, x, y));
  }
}

TEST(ByteRasterRows, WithoutCommitTheOldFileStays) {
  const test::Folder folder;
  folder.write("a.tif", "old");
  {
    ByteRasterRows file(folder / "a.tif", layout(1));
    file.write(0, rows(1, 0, 550));
    file.prepare();
  }
  EXPECT_EQ(test::read_bytes(folder / "a.tif"), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(ByteRasterRows, RefusesGapsAndPlacesThatAreNone) {
  const test::Folder folder;
  ByteRasterRows file(folder / "a.tif", layout(1));
  EXPECT_THROW(file.write(10, rows(1, 10, 5)), Error);
  EXPECT_THROW(file.commit(), Error);
  EXPECT_THROW(ByteRasterRows(folder / "no/such/a.tif", layout(1)), Error);
  EXPECT_THROW(ByteRasterRows(folder / "a.png", layout(1)), Error);
}

}  // namespace
}  // namespace belvedere
