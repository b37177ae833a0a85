#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "terrain/fetch/fetch_area.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/http_server.h"
#include "tests/notes.h"

namespace belvedere {

// Services of synthetic tiles, served by tests/http_server.py from a folder of the test's own.
class ServedTiles : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_python()) GTEST_SKIP() << "there is no python3 to serve files";
  }
  // A source in the manner of Copernicus: tiles of 1° and `rows` rows, on the lines, wider cells
  // from 50° on.
  static std::string elevation_toml(
      int rows = 120, const std::string& missing = "missing = \"sea\"\nsea_value = 0") {
    return fmt::format(
        "name = \"Test heights\"\nkind = \"elevation\"\nurl = "
        "\"https://heights.example.org/dem/{{lat}}_00_{{lon}}_00_DEM.tif\"\n"
        "date = \"2021\"\ncell_m = {}\n{}\ncredit = \"© who measured\"\nlicence = \"free with "
        "credit\"\n"
        "[grid]\ncrs = \"EPSG:4326\"\ntile_deg = [1, 1]\nrows = {}\ncolumns = [[0, {}], [50, "
        "{}]]\ncells = \"on the lines\"\n",
        111000 / rows, missing, rows, rows, rows * 2 / 3);
  }
  static std::string cover_toml() {
    return "name = \"Test cover\"\nkind = \"land_cover\"\nurl = "
           "\"https://cover.example.org/v1/{lat}{lon}_Map.tif\"\nlegend = "
           "\"esa_worldcover\"\n"
           "cell_m = 300\nmissing = \"sea\"\nsea_value = 80\ncredit = \"© who looked\"\nlicence = "
           "\"CC BY 4.0\"\n"
           "[grid]\ncrs = \"EPSG:4326\"\ntile_deg = [3, 3]\nlatitudes = [-60, 84]\nrows = "
           "1200\ncolumns = [[0, 1200]]\n"
           "cells = \"between the lines\"\n";
  }
  std::string write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::string path(const std::string& name) const { return folder_ / name; }
  MapSource elevation_source(int rows = 120) const {
    return parse_map_source(elevation_toml(rows), "test_heights.toml");
  }

  // The tile whose south-west corner is given, of a function of longitude (as given, perhaps beyond
  // 180) and latitude. Where it lies on disk.
  std::string serve_tile(const MapSource& source, int west, int south,
                         const std::function<double(double, double)>& value) const {
    const MapTile tile{static_cast<int>((west - source.origin_deg.x) / source.tile_deg.x),
                       static_cast<int>((source.origin_deg.y - south) / source.tile_deg.y) - 1};
    const int columns = tile_columns(source, tile.row);
    const double dx = source.tile_deg.x / columns;
    const double dy = source.tile_deg.y / source.rows;
    const double shift = source.on_lines ? 0.5 : 0.0;
    const double corner = tile_corner(source, tile).x;
    Raster<float> raster{Grid<float>(columns, source.rows),
                         {corner - shift * dx, south + source.tile_deg.y + shift * dy, dx, dy},
                         normalize_crs("EPSG:4326")};
    for (const auto [x, y] : test::cells(columns, source.rows)) {
      const glm::dvec2 at = raster.transform.to_crs(x, y);
      raster.cells(x, y) = static_cast<float>(value(at.x + (west - corner), at.y));
    }
    const std::string address = tile_address(source, tile, "http://x");
    const std::string file = path("served/" + address.substr(9));
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    if (source.kind == MapSourceKind::elevation) {
      write_raster(file, raster);
    } else {
      Raster<std::uint8_t> codes{Grid<std::uint8_t>(columns, source.rows), raster.transform,
                                 raster.crs};
      for (std::size_t i = 0; i < codes.cells.size(); ++i)
        codes.cells[i] = static_cast<std::uint8_t>(raster.cells[i]);
      write_raster(file, codes);
    }
    return file;
  }
  // Starts a server for the files written. Each request is a line of requests().
  void serve(std::vector<std::string> modes = {}) {
    server_.reset();
    modes.push_back("log=" + path("requests"));
    std::filesystem::create_directories(path("served"));
    server_ = std::make_unique<test::HttpServer>(path("served"), modes);
  }
  std::string mirror() const { return server_->address(""); }
  std::vector<std::string> requests() const {
    std::vector<std::string> lines;
    std::istringstream text(test::read_bytes(path("requests")));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  // Short timeouts, so that failures take no time.
  HttpOptions http_options() const {
    return {.connect_s = 2,
            .silence_s = 1,
            .answer_s = 20,
            .retries = 3,
            .wait_s = 0.01,
            .pause_s = 0.0};
  }
  FetchParameters parameters(glm::dvec2 at, double size_km, bool with_cover = false) const {
    return {.at_lonlat = at,
            .size_km = glm::dvec2(size_km),
            .elevation = write("test_heights.toml", elevation_toml()),
            .land_cover = with_cover ? write("test_cover.toml", cover_toml()) : std::string(),
            .mirror = mirror(),
            .now_unix_s = now_,
            .http_options = http_options()};
  }
  FetchedArea fetch(const FetchParameters& parameters, const std::string& out = "out") {
    return fetch_area(parameters, path(out), cache_, progress_);
  }
  Raster<float> elevation(const std::string& out = "out") const {
    RasterSource source;
    source.path = path(out + "/elevation.tif");
    return read_raster(source);
  }
  // The largest difference between the cells of a raster and a function of longitude and latitude.
  static double largest_error(const Raster<float>& raster,
                              const std::function<double(double, double)>& value) {
    const PointTransform to_degrees(raster.crs, "EPSG:4326");
    double worst = 0.0;
    for (const auto [x, y] : test::cells(raster.cells)) {
      const glm::dvec2 at = to_degrees.apply(raster.transform.to_crs(x, y));
      const double error = std::abs(raster.cells(x, y) - value(at.x, at.y));
      worst = std::isnan(error) ? 1e9 : std::max(worst, error);
    }
    return worst;
  }

  test::Folder folder_;
  Cache cache_{{.folder = folder_ / "cache", .limit_bytes = 0}};
  test::Notes progress_;
  std::unique_ptr<test::HttpServer> server_;
  std::int64_t now_ = 1'800'000'000;  // 2027-01-15
};

}  // namespace belvedere
