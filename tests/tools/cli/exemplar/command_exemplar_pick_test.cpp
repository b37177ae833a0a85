// `belvedere exemplar pick` as users meet it.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "terrain/io/crs.h"
#include "tests/tools/pick/picking_world.h"
#include "tests/tools/program.h"
#include "tests/tools/studio/connection.h"
#include "tools/studio/http_server.h"

namespace belvedere {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ExemplarPick : public Program {
 protected:
  void SetUp() override {
    const Dem& dem = test::painted_cones().dem;
    write_raster(path("dem.tif"), Raster<float>{dem.altitude_m, dem.transform, dem.crs});
    write_picture("it's a painting.png", 1200, 550, [](int, int) { return glm::vec3(0.5F); });
    write("names.csv", "name,kind,lon,lat\n" + name_of(3, "Summit three"));
  }
  static std::string name_of(std::size_t pair, const std::string& name) {
    const glm::dvec2 at = test::painted_cones().pairs[pair].lonlat;
    return name + ",summit," + std::to_string(at.x) + "," + std::to_string(at.y) + "\n";
  }
  std::vector<std::string> words(std::vector<std::string> more = {}) const {
    std::vector<std::string> out = {"exemplar",      "pick",    path("it's a painting.png"),
                                    path("dem.tif"), "--pairs", path("pairs.csv"),
                                    "--headless",    "-q"};
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
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
};

TEST_F(ExemplarPick, ServesItsPageUntilItIsInterrupted) {
  const pid_t child = start(words({"--names", path("names.csv")}));
  const std::string where = address();
  ASSERT_FALSE(where.empty());
  const int port = std::stoi(where.substr(17));
  const std::string token = where.substr(where.find('/', 17));
  const auto ask = [&](const char* method, const std::string& name, const std::string& body = {}) {
    return test::ask_port(port, test::http_request(method, token + name, port, body)).body;
  };
  EXPECT_THAT(ask("GET", "api/setup"),
              AllOf(HasSubstr("Summit three"), HasSubstr("it'\\\\''s a painting.png' "),
                    HasSubstr("dem.tif --pairs ")));
  const ControlPair& pair = test::painted_cones().pairs[3];
  ask("POST", "api/add",
      "{\"pixel\": [100.5, 200], \"name\": \"Summit three\", \"position\": [" +
          std::to_string(pair.position.x) + ", " + std::to_string(pair.position.y) + "]}");
  EXPECT_THAT(read_bytes(path("pairs.csv")), HasSubstr("\n100.5,200,"));
  kill(child, SIGINT);
  EXPECT_THAT(finish(child), Ends(0));
  EXPECT_FALSE(test::Connection(port).is_open()) << "nothing is left running";
  // What was picked is what `register` reads.
  const Outcome outcome = run({"exemplar", "register", path("it's a painting.png"), path("dem.tif"),
                               "--pairs", path("pairs.csv"), "--out", path("r")});
  EXPECT_THAT(outcome.err, HasSubstr("1 pairs"));
}

TEST_F(ExemplarPick, RefusesWhatItCannotOpen) {
  const auto refused = [&](const std::vector<std::string>& more, int status) {
    const Outcome outcome = run(words(more));
    EXPECT_EQ(outcome.status, status) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refused({"--names", path("none.csv")}, 3), HasSubstr("none.csv"));
  EXPECT_FALSE(std::filesystem::exists(path("pairs.csv"))) << "nothing is begun";
  const tools::HttpServer other({.port = 0, .token = "x"},
                                [](const tools::HttpRequest&) { return tools::HttpAnswer{}; });
  EXPECT_THAT(refused({"--port", std::to_string(other.port())}, 2), HasSubstr("in use"));
  write("pairs.csv", "x_px,y_px,lon,lat,name,who\n");
  EXPECT_THAT(refused({}, 2), HasSubstr("column who"));
}

}  // namespace
}  // namespace belvedere
