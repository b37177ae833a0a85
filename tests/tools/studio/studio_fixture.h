#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "base/grid.h"
#include "renderer/image/image_io.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/scenes.h"
#include "tools/studio/studio.h"

namespace belvedere::tools {

// A studio of a small scene, asked as its page asks.
class StudioTest : public testing::Test {
 protected:
  StudioTest() : path_(folder_.write("hills.toml", scene_text())) {}
  // Hills of 12 × 11 km, painted in a moment.
  static std::string scene_text() {
    std::string text = std::string("# Hills.\n") + test::small_scene_text;
    const auto replace = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("width = 120\nheight = 120\ncell_m = 100", "width = 30\nheight = 28\ncell_m = 400");
    replace("width = 96\nheight = 80\nsheet_width_mm = 96",
            "width = 48\nheight = 40\nsheet_width_mm = 48");
    return text + "[synthesis]\nenabled = false  # no paintings\n";
  }
  // The same hills as a file with a coordinate system, 680 km east and 5260 km north.
  void put_on_earth() {
    Raster<float> raster{
        Grid<float>(30, 28), {680000.0, 5271200.0, 400.0, 400.0}, normalize_crs("EPSG:32632")};
    for (int y = 0; y < 28; ++y)
      for (int x = 0; x < 30; ++x)
        raster.cells(x, y) =
            600.F + 500.F * static_cast<float>(std::sin(.7 * x) * std::cos(.5 * y));
    write_raster(folder_ / "hills.tif", raster);
    posted("api/set", R"({"changes": [{"key": "terrain.synthetic", "remove": true},
      {"key": "terrain.sources", "append": {"file": "hills.tif"}},
      {"key": "camera.position", "value": [686000, 5256000]}]})");
  }
  void open() { studio_ = std::make_unique<Studio>(StudioParameters{path_, {}, 0}, run_); }
  Studio& studio() {
    if (studio_ == nullptr) open();
    return *studio_;
  }
  void close() { studio_.reset(); }

  HttpAnswer get(const std::string& path, const std::map<std::string, std::string>& query = {}) {
    return studio().answer({.method = "GET", .path = path, .query = query, .body = {}});
  }
  HttpAnswer post(const std::string& path, const std::string& body = {},
                  const std::map<std::string, std::string>& query = {}) {
    return studio().answer({.method = "POST", .path = path, .query = query, .body = body});
  }
  // Answers that are in order.
  nlohmann::json got(const std::string& path,
                     const std::map<std::string, std::string>& query = {}) {
    return read(get(path, query), 200, path);
  }
  nlohmann::json posted(const std::string& path, const std::string& body = {}, int status = 200) {
    return read(post(path, body), status, path + " " + body);
  }
  static nlohmann::json read(const HttpAnswer& answer, int status, const std::string& what) {
    EXPECT_EQ(answer.status, status) << what << ": " << answer.body;
    EXPECT_EQ(answer.type, "application/json") << what;
    return nlohmann::json::parse(answer.body);
  }
  nlohmann::json set(const std::string& key, const nlohmann::json& value, int status = 200) {
    return posted("api/set", nlohmann::json{{"changes", {{{"key", key}, {"value", value}}}}}.dump(),
                  status);
  }
  Grid<glm::vec3> decoded(const HttpAnswer& answer) {
    return read_picture(folder_.write("picture", answer.body));
  }
  // Until the job is no longer at work.
  nlohmann::json finished_job() {
    for (int i = 0; i < 6000; ++i) {
      const nlohmann::json report = got("api/render");
      if (report["state"] != "running") return report;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "the job does not end";
    return {};
  }

  const belvedere::Run run_;
  const test::Folder folder_;
  const std::string path_;
  std::unique_ptr<Studio> studio_;
};

}  // namespace belvedere::tools
