#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/image_io.h"
#include "renderer/live/live_view.h"
#include "tests/tools/studio/studio_fixture.h"

namespace belvedere::tools {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

// ---- rungs

TEST_F(StudioTest, EveryRungHasItsPicture) {
  const json all = got("api/rungs");
  ASSERT_EQ(all.size(), rungs().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i]["rung"], i);
    EXPECT_EQ(all[i]["name"], rungs()[i].name);
    EXPECT_EQ(all[i]["without"], json(rungs()[i].without));
    const HttpAnswer answer = get("api/picture", {{"rung", std::to_string(i)}, {"revision", "1"}});
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.type, i + 1 == all.size() ? "image/png" : "image/jpeg");
    EXPECT_EQ(answer.headers.at("X-Belvedere-Revision"), "1");
    EXPECT_EQ(answer.headers.at("X-Belvedere-Without").empty(), rungs()[i].without.empty());
    EXPECT_EQ(answer.headers.at("X-Belvedere-Halved"), "0") << "synthetic terrain is small";
    EXPECT_GE(std::stod(answer.headers.at("X-Belvedere-Milliseconds")), 0.0);
    const Grid<glm::vec3> picture = decoded(answer);
    EXPECT_EQ(picture.width(), all[i]["width"]);
    EXPECT_EQ(picture.height(), all[i]["height"]);
  }
}

TEST_F(StudioTest, TheLastRungHasTheWidthOfThePage) {
  set("output.width", 480);
  const auto width = [&](const char* asked) {
    return got("api/rungs", {{"width", asked}}).back()["width"].get<int>();
  };
  EXPECT_EQ(width("300"), 300);
  EXPECT_EQ(width("10"), 64);
  EXPECT_EQ(width("9999"), 480) << "no wider than the sheet";
  EXPECT_EQ(got("api/rungs", {{"width", "100"}})[0]["width"], got("api/rungs")[0]["width"]);
  const std::string last = std::to_string(rungs().size() - 1);
  EXPECT_EQ(decoded(get("api/picture", {{"rung", last}, {"width", "300"}})).width(), 300);
  EXPECT_EQ(get("api/rungs", {{"width", "wide"}}).status, 422);
}

TEST_F(StudioTest, PicturesFollowTheScene) {
  const std::string before = get("api/picture", {{"rung", "0"}}).body;
  set("sun.azimuth_deg", 100);
  EXPECT_NE(get("api/picture", {{"rung", "0"}}).body, before);
  posted("api/undo");
  EXPECT_EQ(get("api/picture", {{"rung", "0"}}).body, before);
}

TEST_F(StudioTest, RefusesPicturesThatAreNotOrCannotBe) {
  const auto status = [&](const std::map<std::string, std::string>& query) {
    const HttpAnswer answer = get("api/picture", query);
    EXPECT_FALSE(json::parse(answer.body)["error"]["message"].get<std::string>().empty());
    return answer.status;
  };
  for (const char* rung : {"", "-1", "99", "x", "1e0", "0 ", "99999999999999"})
    EXPECT_EQ(status({{"rung", rung}}), 422) << rung;
  set("sun.azimuth_deg", 10);
  EXPECT_EQ(status({{"rung", "0"}, {"revision", "1"}}), 409) << "of a scene that is no more";
  EXPECT_EQ(status({{"rung", "0"}, {"revision", "3"}}), 409);
  set("camera.height_m", -500);
  set("camera.position", {6000, 5000});
  const HttpAnswer below = get("api/picture", {{"rung", "0"}});
  EXPECT_EQ(below.status, 422);
  EXPECT_THAT(below.body, HasSubstr("below the ground"));
  posted("api/undo");
  posted("api/undo");
  EXPECT_EQ(get("api/picture", {{"rung", "0"}}).status, 200) << "and goes on";
}

TEST_F(StudioTest, FeaturesAreSwitchedOffAndOn) {
  const std::string rung = std::to_string(rungs().size() - 1);
  put_on_earth();
  const auto picture = [&] {
    const HttpAnswer answer = get("api/picture", {{"rung", rung}});
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.body;
  };
  const std::string bare = picture();
  folder_.write("roads.geojson",
                R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
                   "geometry": {"type": "LineString",
                                "coordinates": [[11.41, 47.49], [11.45, 47.51], [11.50, 47.50]]}}]})");
  posted("api/set", R"({"changes": [{"key": "features", "append":
                        {"source": "roads.geojson", "kind": "motorway", "width_mm": 4}}]})");
  const std::string drawn = picture();
  EXPECT_NE(drawn, bare);
  EXPECT_EQ(got("api/scene")["values"]["features.0.enabled"], true);
  EXPECT_EQ(set("features.0.enabled", false)["values"]["features.0.enabled"], false);
  EXPECT_EQ(picture(), bare);
  posted("api/undo");
  EXPECT_EQ(picture(), drawn);
}

// ---- tiles

struct TileRecord {
  json header;
  std::string bytes;
};
std::vector<TileRecord> records_of(const std::string& stream) {
  std::vector<TileRecord> records;
  std::size_t at = 0;
  while (at + 4 <= stream.size()) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i) length = 256 * length + static_cast<unsigned char>(stream[at++]);
    TileRecord& record = records.emplace_back();
    record.header = json::parse(stream.substr(at, length));
    at += length;
    const std::size_t bytes = record.header["bytes"].get<std::size_t>();
    record.bytes = stream.substr(at, bytes);
    at += bytes;
  }
  EXPECT_EQ(at, stream.size());
  return records;
}

TEST_F(StudioTest, TilesAreTheLastRung) {
  set("output.width", 600);
  set("output.height", 60);
  const HttpAnswer answer = get("api/tiles", {{"revision", "3"}});
  ASSERT_EQ(answer.status, 200);
  ASSERT_TRUE(answer.stream);
  std::string stream;
  answer.stream([&](std::string_view bytes) {
    stream += bytes;
    return true;
  });
  Grid<glm::vec3> whole(600, 60, glm::vec3(-1.F));
  double done = 0.0;
  int tiles = 0;
  int stages = 0;
  const std::vector<TileRecord> records = records_of(stream);
  for (const TileRecord& record : records) {
    EXPECT_GE(record.header["done"].get<double>(), 0.9 * done);
    done = record.header["done"];
    stages += record.header.contains("stage") ? 1 : 0;
    if (record.bytes.empty()) continue;
    ++tiles;
    const Grid<glm::vec3> tile = read_picture(folder_.write("tile.png", record.bytes));
    EXPECT_EQ(tile.width(), record.header["width"]);
    EXPECT_EQ(tile.height(), record.header["height"]);
    copy_part(whole, tile, record.header["x"].get<int>(), record.header["y"].get<int>());
  }
  EXPECT_EQ(done, 1.0);
  EXPECT_TRUE(records.back().bytes.empty());
  EXPECT_EQ(tiles, 3);
  EXPECT_GT(stages, 0);
  const std::string last = std::to_string(rungs().size() - 1);
  EXPECT_TRUE(decoded(get("api/picture", {{"rung", last}})) == whole);
}

TEST_F(StudioTest, TilesEndWhenTheReaderGoesAndWhenTheSceneChanges) {
  set("output.width", 600);
  const HttpAnswer gone = get("api/tiles");
  int parts = 0;
  gone.stream([&](std::string_view) { return ++parts < 3; });
  EXPECT_EQ(parts, 3) << "nothing is sent to one that is gone";
  const HttpAnswer changed = get("api/tiles");
  std::string stream;
  changed.stream([&](std::string_view bytes) {
    if (stream.empty()) set("sun.azimuth_deg", 10);
    stream += bytes;
    return true;
  });
  const json last = records_of(stream).back().header;
  EXPECT_EQ(last["error"]["message"], "superseded");
  EXPECT_EQ(get("api/tiles", {{"revision", "1"}}).status, 409);
}

// ---- beside the picture

TEST_F(StudioTest, TellsWhatIsUnderThePointer) {
  EXPECT_EQ(get("api/pointer", {{"x", "0.5"}, {"y", "0.5"}}).status, 422) << "no picture yet";
  get("api/picture", {{"rung", "0"}});
  const json sky = got("api/pointer", {{"x", "0.5"}, {"y", "0"}, {"revision", "1"}});
  const json ground = got("api/pointer", {{"x", "0.5"}, {"y", "0.7"}, {"revision", "1"}});
  EXPECT_EQ(ground["sky"], false);
  EXPECT_NEAR(ground["position"][0].get<double>(), 6000.0, 400.0) << "the camera looks north";
  EXPECT_GT(ground["position"][1], 0.0);
  EXPECT_GT(ground["distance_m"], 4000.0);
  EXPECT_GT(ground["altitude_m"], -100.0);
  EXPECT_TRUE(ground["class"].is_string());
  EXPECT_FALSE(ground.contains("lonlat")) << "of a terrain without coordinate system";
  if (sky["sky"] == true) {
    EXPECT_EQ(sky.size(), 1U);
  }
  for (const char* x : {"", "-0.1", "1.1", "nan", "x"})
    EXPECT_EQ(get("api/pointer", {{"x", x}, {"y", "0.5"}}).status, 422) << x;
  got("api/pointer", {{"x", "1"}, {"y", "1"}});
}

TEST_F(StudioTest, NamesLieOverThePictureInPixelsOfThePrint) {
  folder_.write("names.csv", "name,kind,east,north\nHill,summit,6000,5000\n");
  posted("api/set", R"({"changes": [{"key": "labels.points", "append": {"file": "names.csv"}}]})");
  EXPECT_EQ(get("api/names", {{"revision", "2"}}).status, 409) << "nothing is drawn yet";
  get("api/picture", {{"rung", "1"}, {"revision", "2"}});
  const json sheet = got("api/names", {{"revision", "2"}});
  EXPECT_EQ(sheet["width"], 48);
  ASSERT_EQ(sheet["names"].size(), 1U);
  const json& name = sheet["names"][0];
  EXPECT_EQ(name["name"], "Hill");
  EXPECT_EQ(name["kind"], "summit");
  EXPECT_NEAR(name["mark"][0].get<double>(), 24.0, 2.0) << "the camera looks north at it";
  EXPECT_FALSE(sheet.contains("margin"));
  set("margin.title", "Hills");
  get("api/picture", {{"rung", "1"}});
  EXPECT_THAT(got("api/names")["margin"]["svg"].get<std::string>(), testing::HasSubstr("Hills"));
}

TEST_F(StudioTest, TheLoupeShowsAPieceOfThePrint) {
  const HttpAnswer answer =
      get("api/loupe", {{"x", "0.5"}, {"y", "0.9"}, {"width", "16"}, {"height", "20"}});
  ASSERT_EQ(answer.status, 200) << answer.body;
  const Grid<glm::vec3> part = decoded(answer);
  const Grid<glm::vec3> whole =
      decoded(get("api/picture", {{"rung", std::to_string(rungs().size() - 1)}}));
  EXPECT_EQ(answer.headers.at("X-Belvedere-Left"), "16");
  EXPECT_EQ(answer.headers.at("X-Belvedere-Top"), "20") << "it stays inside the print";
  EXPECT_EQ(part, part_of(whole, {16, 20, 32, 40}));
  EXPECT_EQ(get("api/loupe", {{"x", "2"}, {"y", "0"}, {"width", "16"}, {"height", "16"}}).status,
            422);
  EXPECT_EQ(get("api/loupe", {{"x", "0"}, {"y", "0"}, {"width", "9999"}, {"height", "16"}}).status,
            422);
}

TEST_F(StudioTest, ThumbnailsShowOtherScenesAndChangeNothing) {
  const std::string rest = get("api/picture", {{"rung", "0"}}).body;
  const HttpAnswer dark = post(
      "api/thumbnail", R"({"changes": [{"key": "sun.azimuth_deg", "value": 100}], "width": 64})");
  ASSERT_EQ(dark.status, 200) << dark.body;
  EXPECT_EQ(decoded(dark).width(), 48) << "no wider than the print";
  EXPECT_NE(dark.body, rest);
  EXPECT_EQ(post("api/thumbnail", R"({"changes": []})").body, rest);
  EXPECT_EQ(got("api/scene")["revision"], 1);
  EXPECT_EQ(post("api/thumbnail", R"({"changes": [], "width": 9})").status, 422);
}

// The ground of each pixel, as the page reads it.
TEST_F(StudioTest, TellsTheGroundSeenAsOneBinary) {
  get("api/picture", {{"rung", "0"}, {"revision", "1"}});
  const std::string bytes = get("api/seen", {{"revision", "1"}}).body;
  std::uint32_t size[2];
  std::memcpy(size, bytes.data(), sizeof(size));
  EXPECT_EQ(size[0], 48U);
  EXPECT_EQ(size[1], 40U);
  EXPECT_EQ(bytes.size(), 8U + 16U + 4U * 4U * 48U * 40U);
  const json ground = got("api/pointer", {{"x", "0.5"}, {"y", "0.7"}});
  float east = 0.F;
  double origin = 0.0;
  std::memcpy(&origin, bytes.data() + 8, sizeof(origin));
  std::memcpy(&east, bytes.data() + 24 + 4 * (28 * 48 + 24), sizeof(east));
  EXPECT_NEAR(origin + static_cast<double>(east), ground["position"][0].get<double>(), 1e-6);
}

// What resorts ask for every summer.
TEST_F(StudioTest, ANewLiftChangesItsOwnPixelsAlone) {
  const std::string last = std::to_string(rungs().size() - 1);
  put_on_earth();
  const Grid<glm::vec3> before = decoded(get("api/picture", {{"rung", last}}));
  const json state = posted("api/draw", R"({"features": {"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {"kind": "lift", "name": "7"},
       "geometry": {"type": "LineString", "coordinates": [[11.44, 47.49], [11.47, 47.52]]}}]},
      "changes": [{"key": "features",
                   "append": {"source": "hills_drawn.geojson", "kind_of": "kind"}}]})");
  EXPECT_EQ(state["drawn"]["features"].size(), 1U);
  EXPECT_EQ(state["drawn_file"], "hills_drawn.geojson");
  const HttpAnswer drawn = get("api/picture", {{"rung", last}});
  ASSERT_EQ(drawn.status, 200) << drawn.body;
  const Grid<glm::vec3> after = decoded(drawn);
  int changed = 0;
  for (int y = 0; y < after.height(); ++y)
    for (int x = 0; x < after.width(); ++x) {
      if (after(x, y) == before(x, y)) continue;
      ++changed;
      const json ground = got("api/pointer", {{"x", std::to_string((x + .5) / after.width())},
                                              {"y", std::to_string((y + .5) / after.height())}});
      if (ground["sky"] == true) continue;
      // Degrees of longitude are two thirds as long as those of latitude here.
      const glm::dvec2 at(ground["lonlat"][0].get<double>() * .676, ground["lonlat"][1]);
      const glm::dvec2 from(11.44 * .676, 47.49);
      const glm::dvec2 along = glm::normalize(glm::dvec2(.03 * .676, .03));
      const double aside_m =
          111200.0 * std::abs(along.x * (at.y - from.y) - along.y * (at.x - from.x));
      EXPECT_LT(aside_m, 1000.0) << x << ", " << y;
    }
  EXPECT_GT(changed, 0);
  EXPECT_LT(changed, 48 * 40 / 8);
  EXPECT_EQ(posted("api/undo")["drawn"], nullptr);
  EXPECT_EQ(post("api/draw", R"({"features": 3, "changes": []})").status, 422);
}

TEST_F(StudioTest, HasAMap) {
  posted("api/set", R"({"changes": [{"key": "deform.handles", "append":
                        {"position": [6000, 5000], "radius_m": 3000, "raise_m": 100}}]})");
  const json map = got("api/map");
  EXPECT_EQ(map["revision"], 2);
  EXPECT_EQ(map["width"], 30);
  EXPECT_EQ(map["height"], 28);
  EXPECT_EQ(map["extent"], json({0.0, 0.0, 12000.0, 11200.0}));
  EXPECT_EQ(map["crs"], "");
  EXPECT_EQ(map["viewer"], json({6000, -4000}));
  EXPECT_EQ(map["azimuth_deg"], 0);
  EXPECT_EQ(map["field_of_view_deg"], 50);
  EXPECT_EQ(map["handles"][0]["position"], json({6000, 5000}));
  EXPECT_EQ(map["handles"][0]["radius_m"], 3000);
  EXPECT_FALSE(map.contains("target"));
  const HttpAnswer picture = get("api/map.png", {{"revision", "2"}});
  EXPECT_EQ(picture.type, "image/png");
  EXPECT_EQ(decoded(picture).width(), 30);
  EXPECT_EQ(get("api/map.png", {{"revision", "1"}}).status, 409);
}

TEST_F(StudioTest, JudgesTheView) {
  const json check = got("api/check");
  EXPECT_EQ(check["revision"], 1);
  ASSERT_FALSE(check["items"].empty());
  for (const json& item : check["items"]) {
    EXPECT_FALSE(item["name"].get<std::string>().empty());
    EXPECT_FALSE(item["value"].get<std::string>().empty());
    EXPECT_THAT((std::vector<json>{"good", "note", "bad"}), Contains(item["verdict"]));
    EXPECT_EQ(item["verdict"] == "good", item["advice"] == "");
  }
}

TEST_F(StudioTest, ProposalsAreChangesThatCanBeMade) {
  const HttpAnswer answer = get("api/proposals");
  if (answer.status == 422) GTEST_SKIP() << "no region for views: " << answer.body;
  const json proposals = json::parse(answer.body)["proposals"];
  ASSERT_FALSE(proposals.empty());
  for (std::size_t i = 0; i < std::min<std::size_t>(proposals.size(), 2); ++i) {
    const json& proposal = proposals[i];
    EXPECT_FALSE(proposal["name"].get<std::string>().empty());
    EXPECT_FALSE(proposal["why"].get<std::string>().empty());
    posted("api/set", json{{"changes", proposal["changes"]}}.dump());
    EXPECT_EQ(get("api/picture", {{"rung", "0"}}).status, 200) << proposal.dump();
    posted("api/undo");
  }
  const HttpAnswer picture = get("api/proposals/0.jpg");
  EXPECT_EQ(picture.type, "image/jpeg");
  EXPECT_LE(decoded(picture).width(), 240);
  EXPECT_EQ(get("api/proposals/99.jpg").status, 404);
  EXPECT_EQ(get("api/proposals/x.jpg").status, 422);
}

TEST_F(StudioTest, PlacesOfTheMapHaveGround) {
  const json here = got("api/place", {{"east", "4500"}, {"north", "4500"}});
  EXPECT_FALSE(here["sky"].get<bool>()) << here.dump();
  EXPECT_EQ(here["position"], json::parse("[4500, 4500]"));
  EXPECT_TRUE(here["altitude_m"].is_number());
  EXPECT_TRUE(got("api/place", {{"east", "-1e6"}, {"north", "0"}})["sky"].get<bool>());
  EXPECT_EQ(get("api/place", {{"east", "x"}, {"north", "0"}}).status, 422);
}

}  // namespace
}  // namespace belvedere::tools
