// `belvedere studio` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/http_server.h"
#include "tests/renderer/compose/synthetic_region.h"
#include "tests/tools/program.h"
#include "tests/tools/studio/connection.h"
#include "tools/studio/http_server.h"

namespace belvedere {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class StudioCommand : public Program {
 protected:
  // What the program says at its start: {"address": "http://127.0.0.1:PORT/TOKEN/"}.
  std::string address() const {
    for (int i = 0; i < 4000; ++i) {
      const std::string said = read_bytes(path("stdout"));
      const std::size_t at = said.find("http://127.0.0.1:");
      if (at != std::string::npos && said.find('"', at) != std::string::npos)
        return said.substr(at, said.find('"', at) - at);
      std::this_thread::sleep_for(5ms);
    }
    ADD_FAILURE() << "no address: " << read_bytes(path("stderr"));
    return {};
  }
  static int port_of(const std::string& address) { return std::stoi(address.substr(17)); }
  static std::string path_of(const std::string& address) {
    return address.substr(address.find('/', 17));
  }
};

TEST_F(StudioCommand, HelpSaysWhatItDoes) {
  EXPECT_THAT(run({"studio", "--help"}),
              Prints(AllOf(HasSubstr("--port"), HasSubstr("--headless"), HasSubstr("SCENE"),
                           HasSubstr("belvedere studio my_dem.tif"))));
}

TEST_F(StudioCommand, RefusesWhatItCannotOpen) {
  const Outcome none = run({"studio", path("none.toml"), "--headless"});
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("none.toml"));
  EXPECT_EQ(run({"studio", path("none.tif"), "--headless"}).status, 3);
  EXPECT_THAT(run({"studio", "--headless"}), Ends(2, HasSubstr("SCENE")));
  const Outcome wrong =
      run({"studio", write("wrong.toml", "version = 1\n[camera\n"), "--headless"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("wrong.toml:2:"));
  EXPECT_EQ(run({"studio", write_scene_file(), "--port", "70000"}).status, 2);
}

TEST_F(StudioCommand, APortInUseIsAnError) {
  const tools::HttpServer other({.port = 0, .token = "x"},
                                [](const tools::HttpRequest&) { return tools::HttpAnswer{}; });
  EXPECT_THAT(
      run({"studio", write_scene_file(), "--headless", "--port", std::to_string(other.port())}),
      Ends(2, AllOf(HasSubstr("--port"), HasSubstr("in use"))));
}

TEST_F(StudioCommand, ServesTheSceneUntilItIsInterrupted) {
  const std::string scene = write_scene_file();
  const pid_t child = start({"studio", scene, "--headless", "--quiet"});
  const std::string where = address();
  ASSERT_FALSE(where.empty());
  const int port = port_of(where);
  const test::Reply reply =
      test::ask_port(port, test::http_request("GET", path_of(where) + "api/scene", port));
  EXPECT_EQ(reply.status, 200);
  EXPECT_THAT(reply.body, AllOf(HasSubstr("\"revision\": 1"), HasSubstr("scene.toml")));
  EXPECT_EQ(test::ask_port(port, test::http_request("GET", "/api/scene", port)).status, 403);
  kill(child, SIGINT);
  EXPECT_THAT(finish(child), Ends(0));
  EXPECT_FALSE(test::Connection(port).is_open()) << "nothing is left running";
}

TEST_F(StudioCommand, OfADemASceneIsMadeBesideIt) {
  write_raster(path("my_dem.tif"), test::synthetic_raster(60.0, test::cone));
  const pid_t child = start({"studio", path("my_dem.tif"), "--headless", "--quiet"});
  EXPECT_FALSE(address().empty());
  kill(child, SIGINT);
  EXPECT_EQ(finish(child).status, 0);
  EXPECT_THAT(read_bytes(path("my_dem.toml")), HasSubstr("file = \"my_dem.tif\""));
  EXPECT_FALSE(std::filesystem::exists("my_dem.toml")) << "not where the program was started";
}

// The whole way, against a server of the test's own: the maps, and a scene of them that is drawn.
TEST_F(StudioCommand, FetchesAPlaceAndProposesItsScene) {
  if (!test::has_python()) GTEST_SKIP() << "there is no python3 to serve files";
  constexpr int side = 200;
  constexpr double cell = 1.0 / side;
  Raster<float> dem{Grid<float>(side, side), {11.0, 48.0, cell, cell}, normalize_crs("EPSG:4326")};
  for (const auto [x, y] : test::cells(side, side))
    dem.cells(x, y) = static_cast<float>(1200.0 + 600.0 * std::sin(0.1 * x) * std::cos(0.08 * y));
  std::filesystem::create_directories(path("served"));
  write_raster(path("served/N47E011.tif"), dem);
  const std::string heights = write(
      "heights.toml",
      "name = \"Heights\"\nkind = \"elevation\"\nurl = \"https://example.org/{lat}{lon}.tif\"\n"
      "credit = \"© Surveyors\"\ncell_m = 500\nmissing = \"error\"\nlicence = \"free\"\n"
      "[grid]\ncrs = \"EPSG:4326\"\ntile_deg = [1, 1]\nrows = 200\ncolumns = [[0, 200]]\n"
      "cells = \"between the lines\"\n");
  const test::HttpServer server(path("served"));
  const pid_t child = start({"studio", write_scene_file(), "--headless", "--quiet", "--source",
                             heights, "--mirror", server.address(""), "--http-retries", "0"});
  const std::string where = address();
  ASSERT_FALSE(where.empty());
  const int port = port_of(where);
  const auto ask = [&](const char* method, const std::string& name, const std::string& body = {}) {
    return test::ask_port(port, test::http_request(method, path_of(where) + name, port, body));
  };
  const std::string place = R"({"place": "11.5,47.5", "size": "60", "land_cover": "no"})";
  EXPECT_EQ(ask("POST", "api/fetch", place).status, 202);
  std::string report;
  for (int i = 0; i < 4000; ++i) {
    report = ask("GET", "api/fetch").body;
    if (report.find("\"running\"") == std::string::npos) break;
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_THAT(report, AllOf(HasSubstr("\"done\""), HasSubstr("place_11.5000_47.5000_60x60/"),
                            HasSubstr("© Surveyors")));
  EXPECT_TRUE(std::filesystem::exists(path("place_11.5000_47.5000_60x60/elevation.tif")));
  const std::string began = "\"text\": ";
  const std::size_t text = report.find(began) + began.size();
  const std::string body = "{\"text\": " + report.substr(text, report.rfind('"') + 1 - text) + "}";
  EXPECT_EQ(ask("POST", "api/text", body).status, 200);
  EXPECT_EQ(ask("GET", "api/picture?rung=0").status, 200);
  kill(child, SIGINT);
  EXPECT_EQ(finish(child).status, 0);
}

}  // namespace
}  // namespace belvedere
