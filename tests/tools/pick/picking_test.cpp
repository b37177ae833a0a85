#include "tools/pick/picking.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "renderer/image/image_io.h"
#include "terrain/io/crs.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/tools/pick/picking_world.h"
#include "tests/tools/studio/connection.h"

namespace belvedere::tools {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// A server of a small painting, asked as its page asks.
class PickingTest : public testing::Test {
 protected:
  // With the first so many pairs in its file.
  void open(std::size_t count = 0) {
    const std::vector<ControlPair>& all = world().pairs;
    if (count > 0) test::write_bytes(path_, control_pairs_text(std::span(all).first(count)));
    PickingInput input;
    input.pairs = path_;
    input.painting_name = "painting.png";
    input.painting = Grid<glm::vec3>(1200, 550, glm::vec3(0.4F));
    input.dem = world().dem;
    input.named = {{"Cone of names", all.back().position + glm::dvec2(120.0, 0.0), true}};
    input.next = "belvedere exemplar register painting.png dem.tif --pairs pairs.csv --out r";
    picking_ = std::make_unique<Picking>(std::move(input), silent_progress());
  }
  static const test::PaintedCones& world() { return test::painted_cones(); }

  json asked(const char* method, const std::string& path,
             const std::map<std::string, std::string>& query, const std::string& body, int status) {
    const HttpAnswer answer =
        picking_->answer({.method = method, .path = path, .query = query, .body = body});
    EXPECT_EQ(answer.status, status) << path << " " << body << ": " << answer.body;
    EXPECT_EQ(answer.type, "application/json") << path;
    return json::parse(answer.body);
  }
  json got(const std::string& path, const std::map<std::string, std::string>& query = {},
           int status = 200) {
    return asked("GET", path, query, {}, status);
  }
  json posted(const std::string& path, const json& body = json::object(), int status = 200) {
    return asked("POST", path, {}, body.dump(), status);
  }
  json fit() { return got("api/fit", {{"revision", revision()}}); }
  std::string revision() { return fmt::format("{}", got("api/pairs")["revision"].get<int>()); }
  json place_near(glm::dvec2 position, double radius_m) {
    return got("api/place", {{"east", fmt::format("{}", position.x)},
                             {"north", fmt::format("{}", position.y)},
                             {"radius", fmt::format("{}", radius_m)}});
  }
  static json pair_of(const ControlPair& pair) {
    return {{"pixel", {pair.pixel.x, pair.pixel.y}},
            {"position", {pair.position.x, pair.position.y}},
            {"name", pair.name}};
  }

  const test::Folder folder_;
  const std::string path_ = folder_ / "pairs.csv";
  std::unique_ptr<Picking> picking_;
};

TEST_F(PickingTest, TellsThePaintingTheMapAndTheKnownPlaces) {
  open();
  const json setup = got("api/setup");
  EXPECT_EQ(setup["painting"]["width"], 1200);
  EXPECT_EQ(setup["painting"]["name"], "painting.png");
  EXPECT_EQ(setup["map"]["width"], 180);
  EXPECT_EQ(setup["map"]["origin"], json({666000.0, 5274000.0}));
  EXPECT_EQ(setup["map"]["px_m"], json({200.0, 200.0}));
  EXPECT_EQ(setup["map"]["crs"], "EPSG:32632");
  EXPECT_EQ(setup["min_fitted"], min_fitted_pairs);
  EXPECT_EQ(setup["min_pairs"], min_control_pairs);
  EXPECT_GE(setup["places"].size(), 40U);
  EXPECT_EQ(setup["places"].size(), setup["names"].size());
  EXPECT_THAT(setup["names"].dump(), HasSubstr("Cone of names"));
  EXPECT_THAT(setup["next"].get<std::string>(), HasSubstr("exemplar register"));
  const HttpAnswer tile =
      picking_->answer({.method = "GET", .path = "painting/0/2_1.jpg", .query = {}, .body = {}});
  EXPECT_EQ(tile.type, "image/jpeg");
  const Grid<glm::vec3> read = read_picture(folder_.write("tile.jpg", tile.body));
  EXPECT_EQ(read.width(), 1200 - 2 * 512);
  EXPECT_EQ(read.height(), 550 - 512);
}

TEST_F(PickingTest, EachPairIsInTheFileAtOnce) {
  open();
  EXPECT_EQ(got("api/pairs")["pairs"].size(), 0U);
  const ControlPair& first = world().pairs[0];
  const json added = posted("api/add", pair_of(first));
  EXPECT_EQ(added["revision"], 2);
  EXPECT_EQ(added["can_undo"], true);
  EXPECT_EQ(added["pairs"][0]["name"], first.name);
  EXPECT_NEAR(added["pairs"][0]["pixel"][0].get<double>(), first.pixel.x, 0.051);
  EXPECT_NEAR(added["pairs"][0]["position"][0].get<double>(), first.position.x, 0.11);
  EXPECT_NEAR(added["pairs"][0]["altitude_m"].get<double>(), first.altitude_m, 0.1);
  EXPECT_THAT(test::read_bytes(path_), HasSubstr("," + first.name + ","));
  posted("api/change", {{"pair", 0}, {"sure", true}, {"name", "Spitze\n2"}});
  EXPECT_THAT(test::read_bytes(path_), HasSubstr(",Spitze 2,1\n"));
  const json moved = posted("api/change", {{"pair", 0}, {"pixel", {10.04, 20.06}}});
  EXPECT_EQ(moved["pairs"][0]["pixel"], json({10.0, 20.1}));
  EXPECT_EQ(moved["pairs"][0]["sure"], true);
  EXPECT_EQ(posted("api/remove", {{"pair", 0}})["pairs"].size(), 0U);
  EXPECT_EQ(posted("api/undo")["pairs"][0]["pixel"], json({10.0, 20.1}));
  posted("api/undo");
  posted("api/undo");
  EXPECT_EQ(posted("api/undo")["pairs"].size(), 0U);
  EXPECT_EQ(posted("api/redo")["pairs"][0]["name"], first.name);
}

TEST_F(PickingTest, RefusedChangesSayWhyAndChangeNothing) {
  open(3);
  const std::string before = test::read_bytes(path_);
  const auto refused = [&](const std::string& path, const json& body, int status = 422) {
    return posted(path, body, status)["error"]["message"].get<std::string>();
  };
  EXPECT_THAT(refused("api/add", {{"pixel", {1, 2}}}), HasSubstr("lacks"));
  EXPECT_THAT(refused("api/add", {{"pixel", {1, 2}}, {"position", {0, 0}}}), HasSubstr("no data"));
  json outside = pair_of(world().pairs[5]);
  outside["pixel"] = {1201, 5};
  EXPECT_THAT(refused("api/add", outside), HasSubstr("x_px is \"1201\""));
  EXPECT_THAT(refused("api/add", {{"moved", {680000, 5260000}}, {"position", {680000, 5260000}}}),
              HasSubstr("no view is fitted"));
  EXPECT_THAT(refused("api/change", {{"pair", 3}}), HasSubstr("3"));
  EXPECT_THAT(refused("api/change", {{"pair", 0}, {"sure", "yes"}}), HasSubstr("sure"));
  EXPECT_THAT(refused("api/change", {{"pair", 0}, {"pixel", {1}}}), HasSubstr("two numbers"));
  EXPECT_THAT(refused("api/remove", {{"pair", -1}}), HasSubstr("-1"));
  refused("api/remove", {{"pair", 0}, {"revision", 77}}, 409);
  EXPECT_EQ(test::read_bytes(path_), before);
  EXPECT_EQ(got("api/pairs")["revision"], 1);
  for (const char* path : {"api/none", "api/pairs", "api/setup"}) posted(path, {}, 404);
  for (const char* path : {"api/none", "api/add", "api/undo"}) got(path, {}, 404);
  got("api/place", {{"east", "x"}}, 422);
  got("api/places", {{"x", "5000"}, {"y", "1"}}, 422);
  got("api/fit", {}, 422);
}

TEST_F(PickingTest, PlacesAndPixelsProposeEachOther) {
  open(14);
  const ControlPair& other = world().pairs[20];
  // The map: the summit near by, and where it is painted.
  const json place = place_near(other.position + glm::dvec2(90.0, -50.0), 300.0);
  EXPECT_NEAR(place["position"][0].get<double>(), other.position.x, 0.1);
  EXPECT_NEAR(place["altitude_m"].get<double>(), other.altitude_m, 0.1);
  EXPECT_TRUE(place["pair"].is_null());
  fit();
  got("api/terrain", {{"revision", revision()}});
  const json painted = place_near(other.position, 300.0)["painted"];
  EXPECT_NEAR(painted["pixel"][0].get<double>(), other.pixel.x, 1.0);
  EXPECT_NEAR(painted["pixel"][1].get<double>(), other.pixel.y, 1.0);
  EXPECT_EQ(place_near(world().pairs[3].position, 300.0)["pair"], 3);
  // Exactly there.
  const json ground = place_near(other.position + glm::dvec2(300.0, 0.0), 0.0);
  EXPECT_TRUE(ground["known"].is_null());
  EXPECT_LT(ground["altitude_m"].get<double>(), other.altitude_m - 20.0);
  // The painting: the summit that is painted near by, if the view does not hide it.
  int proposed = 0, seen = 0;
  for (std::size_t i = 14; i < world().pairs.size(); ++i) {
    const ControlPair& pair = world().pairs[i];
    if (!place_near(pair.position, 1.0)["seen"].get<bool>()) continue;
    ++seen;
    const json places =
        got("api/places", {{"x", fmt::format("{}", std::clamp(pair.pixel.x + 2.0, 0.0, 1200.0))},
                           {"y", fmt::format("{}", pair.pixel.y)}});
    const json& all = places["proposals"];
    proposed +=
        !all.empty() && std::abs(all[0]["position"][0].get<double>() - pair.position.x) < 1.0 ? 1
                                                                                              : 0;
  }
  EXPECT_GT(seen, 5);
  EXPECT_GE(proposed, seen - 1);
  const json at_pair = got("api/places", {{"x", fmt::format("{}", world().pairs[3].pixel.x)},
                                          {"y", fmt::format("{}", world().pairs[3].pixel.y)}});
  for (const json& proposal : at_pair["proposals"])
    EXPECT_GT(std::hypot(proposal["position"][0].get<double>() - world().pairs[3].position.x,
                         proposal["position"][1].get<double>() - world().pairs[3].position.y),
              1.0)
        << "it has its pair already";
}

// A handle that is dropped on the map says where its ground stands: the view shows it there.
TEST_F(PickingTest, GroundThatStandsElsewhereIsPaintedThere) {
  open(14);
  fit();
  const auto other = std::find_if(world().pairs.begin() + 14, world().pairs.end(),
                                  [](const ControlPair& p) { return p.pixel.x < 1000.0; });
  ASSERT_NE(other, world().pairs.end());
  json dropped = pair_of(*other);
  dropped.erase("pixel");
  dropped["moved"] = {other->position.x, other->position.y};
  const json still = posted("api/add", dropped)["pairs"][14]["pixel"];
  EXPECT_NEAR(still[0].get<double>(), other->pixel.x, 1.0);
  EXPECT_NEAR(still[1].get<double>(), other->pixel.y, 1.0);
  fit();
  dropped = {{"pair", 14}, {"moved", {other->position.x + 1000.0, other->position.y}}};
  const json east = posted("api/change", dropped)["pairs"][14]["pixel"];
  EXPECT_GT(east[0].get<double>(), other->pixel.x + 10.0) << "the viewer looks north";
}

TEST_F(PickingTest, TheNameOfAPlaceComesWithIt) {
  open();
  const json place = place_near(world().pairs.back().position, 300.0);
  EXPECT_EQ(place["name"], "Cone of names");
  EXPECT_TRUE(place["painted"].is_null()) << "no pairs yet";
  EXPECT_TRUE(got("api/places", {{"x", "600"}, {"y", "300"}})["proposals"].empty());
}

TEST_F(PickingTest, PairsAreJudgedOnceThereAreEnough) {
  open(4);
  EXPECT_EQ(fit()["state"], "few");
  posted("api/add", pair_of(world().pairs[4]));
  const json rough = fit();
  EXPECT_EQ(rough["state"], "rough");
  EXPECT_FALSE(rough.contains("findings"));
  EXPECT_GT(rough["places"].size(), 5U);
  for (std::size_t i = 5; i < 16; ++i) posted("api/add", pair_of(world().pairs[i]));
  json wrong = pair_of(world().pairs[16]);
  wrong["pixel"] = {world().pairs[16].pixel.x > 600 ? 300 : 900, 200};
  posted("api/add", wrong);
  const json judged = fit();
  EXPECT_EQ(judged["state"], "judged");
  EXPECT_EQ(judged["projection"], "cylindrical");
  ASSERT_EQ(judged["findings"].size(), 17U);
  EXPECT_EQ(judged["findings"][16]["wrong"], true);
  EXPECT_EQ(judged["findings"][16]["verdict"], "thrown out");
  EXPECT_GT(judged["findings"][16]["residual_px"].get<double>(), 100.0);
  EXPECT_EQ(judged["wrong"], 1);
  EXPECT_EQ(judged["findings"][2]["verdict"], "fits");
  EXPECT_LT(judged["findings"][2]["residual_px"].get<double>(), 1.0);
  const json terrain = got("api/terrain", {{"revision", revision()}});
  EXPECT_GT(terrain["lines"].size(), 3U);
  EXPECT_EQ(terrain["lines"][0]["points"].size() % 2, 0U);
  got("api/fit", {{"revision", "2"}}, 409);
}

TEST_F(PickingTest, ServesItsPageAndWhatItSharesWithTheStudio) {
  open();
  const auto type = [&](const char* path) {
    const HttpAnswer answer =
        picking_->answer({.method = "GET", .path = path, .query = {}, .body = {}});
    return answer.status == 200 ? answer.type : fmt::format("{}", answer.status);
  };
  EXPECT_EQ(type(""), "text/html; charset=utf-8");
  for (const char* path : {"main.js", "viewer.js", "dom.js", "api.js", "keys.js"})
    EXPECT_EQ(type(path), "text/javascript") << path;
  for (const char* path : {"pick.css", "studio.css"}) EXPECT_EQ(type(path), "text/css") << path;
  for (const char* path :
       {"none.js", "../pairs.csv", "pairs.csv", "painting/9/0_0.jpg", "map/../0"})
    EXPECT_EQ(type(path), "404") << path;
}

TEST_F(PickingTest, AnswersThisMachineAloneUntilItIsStopped) {
  open();
  const std::string address = picking_->address();
  const int port = std::stoi(address.substr(17));
  const std::string token = address.substr(address.find('/', 17));
  std::thread server([&] { picking_->run(); });
  const auto ask = [&](const std::string& path, const std::string& more = {}) {
    return test::ask_port(port, test::http_request("GET", path, port, {}, more)).status;
  };
  EXPECT_EQ(ask(token + "api/pairs"), 200);
  EXPECT_EQ(ask("/api/pairs"), 403) << "without its token";
  EXPECT_EQ(ask(token + "api/pairs", "Origin: http://example.org\r\n"), 403) << "another origin";
  picking_->stop();
  server.join();
  posted("api/close");
  EXPECT_TRUE(picking_->is_left(0.0));
}

TEST_F(PickingTest, AFileChangedByAnotherProgramIsToldAndKept) {
  open(3);
  test::write_bytes(path_, control_pairs_text(std::span(world().pairs).first(5)));
  EXPECT_EQ(got("api/pairs")["outside"], true);
  EXPECT_THAT(posted("api/undo", {}, 200)["revision"].dump(), "1") << "there is no step";
  posted("api/remove", {{"pair", 0}}, 422);
  EXPECT_EQ(posted("api/reload")["pairs"].size(), 5U);
  test::write_bytes(path_, "x_px,y_px,lon,lat,name\n");
  EXPECT_EQ(posted("api/save")["outside"], false);
  EXPECT_EQ(test::read_bytes(path_), control_pairs_text(std::span(world().pairs).first(5)));
}

float brightness(glm::vec3 colour) { return (colour.x + colour.y + colour.z) / 3.F; }

// A ridge from south to north, with low ground west of it at the same altitudes as east of it.
Dem ridge() {
  return make_dem(
      {test::grid_of(60, 40, [](int x, int) { return 2000.0 - 40.0 * std::abs(x - 30); }),
       {0.0, 4000.0, 100.0, 100.0},
       normalize_crs("EPSG:32632")});
}

TEST(ReliefMap, IsLitFromTheWestAndGreenInTheValleys) {
  const ReliefMap map = relief_map(ridge());
  EXPECT_EQ(map.cells_per_px, 1);
  EXPECT_EQ(map.picture.width(), 60);
  EXPECT_GT(brightness(map.picture(20, 20)), brightness(map.picture(40, 20)) + 0.15F);
  const glm::vec3 low = map.picture(2, 20), high = map.picture(28, 20);
  EXPECT_GT(low.y, low.x) << "green";
  EXPECT_LT(std::abs(high.x - high.z), std::abs(low.y - low.z)) << "pale";
}

TEST(ReliefMap, HasNoReliefWithoutDataAndIsReduced) {
  Dem dem = ridge();
  dem.filled = Grid<std::uint8_t>(60, 40);
  for (const auto [x, y] : test::cells(10, 40)) dem.filled(x, y) = 1;
  const ReliefMap map = relief_map(dem, 30);
  EXPECT_EQ(map.cells_per_px, 2);
  EXPECT_EQ(map.picture.width(), 30);
  EXPECT_EQ(map.picture.height(), 20);
  EXPECT_EQ(map.picture(0, 0), map.picture(4, 19)) << "grey";
  EXPECT_NE(map.picture(5, 0), map.picture(4, 0));
}

TEST(PictureTiles, AreThoseOfTheFiles) {
  Grid<glm::vec3> picture(150, 90);
  for (const auto [x, y] : test::cells(150, 90))
    picture(x, y) = {static_cast<float>(x) / 150.F, static_cast<float>(y) / 90.F, 0.5F};
  const test::Folder folder;
  write_png8(folder / "a.png", picture, {});
  Progress progress;
  const TilePyramid written =
      write_tile_pyramid(folder / "a.png", folder / "tiles", {64, 90}, progress);
  // What the file has, to the bit.
  const PictureTiles tiles = picture_tiles(read_picture(folder / "a.png"), {64, 90});
  EXPECT_EQ(tiles.pyramid.width, 150);
  EXPECT_EQ(tiles.pyramid.height, 90);
  EXPECT_EQ(tiles.pyramid.levels, written.levels);
  EXPECT_EQ(tiles.files.size(), 6U + 2U + 1U) << "150 × 90, 75 × 45, 38 × 23";
  for (const auto& [name, bytes] : tiles.files)
    EXPECT_EQ(bytes, test::read_bytes(folder / ("tiles/" + name))) << name;
}

}  // namespace
}  // namespace belvedere::tools
