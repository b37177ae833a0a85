#include "tools/studio/studio.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/grid_part.h"
#include "base/random.h"
#include "renderer/image/image_io.h"
#include "renderer/live/rungs.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

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
  json got(const std::string& path, const std::map<std::string, std::string>& query = {}) {
    return read(get(path, query), 200, path);
  }
  json posted(const std::string& path, const std::string& body = {}, int status = 200) {
    return read(post(path, body), status, path + " " + body);
  }
  static json read(const HttpAnswer& answer, int status, const std::string& what) {
    EXPECT_EQ(answer.status, status) << what << ": " << answer.body;
    EXPECT_EQ(answer.type, "application/json") << what;
    return json::parse(answer.body);
  }
  json set(const std::string& key, const json& value, int status = 200) {
    return posted("api/set", json{{"changes", {{{"key", key}, {"value", value}}}}}.dump(), status);
  }
  Grid<glm::vec3> decoded(const HttpAnswer& answer) {
    return read_picture(folder_.write("picture", answer.body));
  }
  // Until the job is no longer at work.
  json finished_job() {
    for (int i = 0; i < 6000; ++i) {
      const json report = got("api/render");
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

TEST_F(StudioTest, EndsWithItsPageUnlessAnotherOneAsks) {
  got("api/scene");
  EXPECT_FALSE(studio().is_left(0.0)) << "open";
  posted("api/close");
  EXPECT_TRUE(studio().is_left(0.0));
  EXPECT_FALSE(studio().is_left(60.0)) << "it may be loaded again";
  got("api/scene");
  EXPECT_FALSE(studio().is_left(0.0)) << "loaded again";
}

// ---- the scene

TEST_F(StudioTest, TellsTheScene) {
  const json scene = got("api/scene");
  EXPECT_EQ(scene["revision"], 1);
  EXPECT_EQ(scene["file"], path_);
  EXPECT_EQ(scene["name"], "hills");
  EXPECT_EQ(scene["title"], "");
  EXPECT_EQ(scene["text"], scene_text());
  EXPECT_EQ(scene["saved"], true);
  EXPECT_EQ(scene["can_undo"], false);
  EXPECT_EQ(scene["can_redo"], false);
  EXPECT_EQ(scene["outside"], false);
  EXPECT_TRUE(scene["error"].is_null());
  EXPECT_TRUE(scene["derived"].is_array());
  EXPECT_TRUE(scene["notes"].is_array());
  EXPECT_EQ(scene["values"]["sun.azimuth_deg"], 315);
  EXPECT_EQ(scene["values"]["camera.field_of_view_deg"], 50) << "a default";
  EXPECT_EQ(scene["values"]["camera.position"], json({6000, -4000}));
  EXPECT_FALSE(scene["values"].contains("sun.time")) << "unset, without a default";
}

TEST_F(StudioTest, ChangesGoIntoTheText) {
  const json after = posted("api/set", R"({"changes": [
      {"key": "sun.azimuth_deg", "value": 200},
      {"key": "air.from_m", "remove": true},
      {"key": "deform.handles", "append": {"position": [6000, 5000], "radius_m": 3000,
                                           "move_m": [0, 100]}}]})");
  EXPECT_EQ(after["revision"], 2);
  EXPECT_EQ(after["saved"], false);
  EXPECT_EQ(after["can_undo"], true);
  EXPECT_EQ(after["values"]["sun.azimuth_deg"], 200);
  EXPECT_FALSE(after["values"].contains("air.from_m")) << "the program chooses";
  EXPECT_EQ(after["values"]["deform.handles.0.move_m"], json({0, 100}));
  EXPECT_THAT(after["text"].get<std::string>(),
              AllOf(HasSubstr("# Hills."), HasSubstr("azimuth_deg = 200"),
                    Not(HasSubstr("from_m = 34000"))));
  const json without =
      posted("api/set", R"({"changes": [{"key": "deform.handles.0", "remove": true}]})");
  EXPECT_FALSE(without["values"].contains("deform.handles.0.move_m"));
  EXPECT_EQ(got("api/scene"), without);
}

TEST_F(StudioTest, UndoRedoAndTheText) {
  const json first = got("api/scene");
  set("sun.azimuth_deg", 10);
  set("sun.azimuth_deg", 20);
  EXPECT_EQ(posted("api/undo")["values"]["sun.azimuth_deg"], 10);
  EXPECT_EQ(posted("api/undo")["text"], first["text"]);
  EXPECT_EQ(posted("api/redo")["values"]["sun.azimuth_deg"], 10);
  std::string text = scene_text();
  text.replace(text.find("315"), 3, "77 ");
  const json typed = posted("api/text", json{{"text", text}}.dump());
  EXPECT_EQ(typed["values"]["sun.azimuth_deg"], 77);
  EXPECT_EQ(typed["text"], text);
  EXPECT_EQ(typed["can_redo"], false);
  // Two calls of one step.
  for (const int value : {1, 2})
    posted("api/set",
           json{{"changes", {{{"key", "sun.azimuth_deg"}, {"value", value}}}}, {"step", "drag-1"}}
               .dump());
  EXPECT_EQ(posted("api/undo")["values"]["sun.azimuth_deg"], 77);
}

TEST_F(StudioTest, SavesAndReadsAgain) {
  const json changed = set("sun.azimuth_deg", 10);
  EXPECT_EQ(test::read_bytes(path_), scene_text());
  EXPECT_EQ(posted("api/save")["saved"], true);
  EXPECT_EQ(test::read_bytes(path_), changed["text"].get<std::string>());
  const std::string theirs = scene_text() + "# Another hand.\n";
  test::write_bytes(path_, theirs);
  EXPECT_EQ(got("api/scene")["outside"], true);
  posted("api/save", "", 422);
  EXPECT_EQ(test::read_bytes(path_), theirs);
  const json reloaded = posted("api/reload");
  EXPECT_EQ(reloaded["text"], theirs);
  EXPECT_EQ(reloaded["outside"], false);
  EXPECT_EQ(posted("api/undo")["values"]["sun.azimuth_deg"], 10);
  test::write_bytes(path_, "# Yet another.\n" + scene_text());
  EXPECT_EQ(posted("api/save", R"({"over": "yes"})")["saved"], true);
  EXPECT_EQ(test::read_bytes(path_), changed["text"].get<std::string>());
}

TEST_F(StudioTest, RefusedChangesSayWhatIsWrongAndChangeNothing) {
  set("sun.azimuth_deg", 10);
  const json before = got("api/scene");
  const auto refused = [&](const std::string& path, const std::string& body) {
    const json answer = posted(path, body, 422);
    EXPECT_FALSE(answer["error"]["message"].get<std::string>().empty());
    EXPECT_EQ(got("api/scene"), before) << path << " " << body;
    return answer["error"];
  };
  const json range =
      refused("api/set", R"({"changes": [{"key": "sun.altitude_deg", "value": 900}]})");
  EXPECT_EQ(range["key"], "sun.altitude_deg");
  EXPECT_FALSE(range["allowed"].get<std::string>().empty());
  refused("api/set", R"({"changes": [{"key": "sun.altitude_deg", "value": 20},
                                     {"key": "no.such_key", "value": 1}]})");
  refused("api/set", R"({"changes": [{"key": "exemplar.3.seed", "value": 1}]})");
  refused("api/set", "no JSON");
  refused("api/set", R"({"changes": [{"key": "sun.altitude_deg", "value": null}]})");
  refused("api/text", R"({"text": 7})");
  std::string text = scene_text();
  text.replace(text.find("altitude_deg = 30"), 17, "altitude_deg = 900");
  const json line = refused("api/text", json{{"text", text}}.dump());
  EXPECT_THAT(line["where"].get<std::string>(), HasSubstr("hills.toml:"));
  EXPECT_EQ(
      line["line"],
      1 + std::count(text.begin(),
                     text.begin() + static_cast<std::ptrdiff_t>(text.find("altitude_deg = 900")),
                     '\n'));
  EXPECT_GT(line["column"], 0);
  refused("api/text", json{{"text", "version = 1\n[camera\n"}}.dump());
  refused("api/text", "{}");
}

TEST_F(StudioTest, TellsWhatMayBeChosen) {
  const json schema = got("api/schema");
  EXPECT_TRUE(schema.contains("allOf") || schema.contains("properties"));
  const json choices = got("api/choices");
  EXPECT_THAT(choices["palettes"], Contains(json("summer")));
  EXPECT_THAT(choices["styles"], Contains(json("segantini")));
  EXPECT_THAT(choices["projections"], Contains(json("perspective")));
}

// ---- pictures

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
    EXPECT_GE(std::stod(answer.headers.at("X-Belvedere-Milliseconds")), 0.0);
    const Grid<glm::vec3> picture = decoded(answer);
    EXPECT_EQ(picture.width(), all[i]["width"]);
    EXPECT_EQ(picture.height(), all[i]["height"]);
  }
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
  const auto picture = [&] { return get("api/picture", {{"rung", rung}}).body; };
  const std::string bare = picture();
  folder_.write("roads.geojson",
                R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
                   "geometry": {"type": "LineString",
                                "coordinates": [[2000, 3000], [6000, 5000], [10000, 4000]]}}]})");
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

// ---- the page, and what is no request

TEST_F(StudioTest, ServesItsPageAndNothingElse) {
  EXPECT_EQ(get("").type, "text/html; charset=utf-8");
  EXPECT_THAT(get("index.html").body, HasSubstr("<!doctype html>"));
  EXPECT_EQ(get("main.js").type, "text/javascript");
  EXPECT_EQ(get("studio.css").type, "text/css");
  EXPECT_EQ(get("icon.svg").type, "image/svg+xml");
  for (const char* path : {"none.html", "../hills.toml", "hills.toml", "../palettes/summer.toml",
                           "studio/main.js", "main", "/etc/passwd", "..", "main.js/..", ".js"})
    EXPECT_EQ(get(path).status, 404) << path;
  for (const char* path : {"api/", "api/none", "api/set", "api/undo", "api/../hills.toml"})
    EXPECT_EQ(get(path).status, 404) << path;
  for (const char* path : {"api/none", "api/scene", "api/picture", "api/render/none"})
    EXPECT_EQ(post(path).status, 404) << path;
  EXPECT_EQ(got("api/scene")["revision"], 1) << "GET changes nothing";
}

// ---- jobs

TEST_F(StudioTest, RendersThePrintAndItsPage) {
  EXPECT_EQ(got("api/render")["state"], "idle");
  EXPECT_EQ(get("render/index.html").status, 404) << "not yet";
  const json begun = posted("api/render", R"({"width": 64})", 202);
  EXPECT_EQ(begun["state"], "running");
  const json report = finished_job();
  ASSERT_EQ(report["state"], "done") << report.dump();
  EXPECT_EQ(report["done"], 1);
  EXPECT_EQ(report["page"], "render/index.html");
  EXPECT_TRUE(report["error"].is_null());
  const std::string folder = report["folder"];
  EXPECT_EQ(folder, folder_ / "hills_rendered");
  EXPECT_EQ(read_image_info(folder + "/panorama.png").width, 64);
  const HttpAnswer page = get("render/index.html");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  for (const char* path : {"render/", "render/none.html", "render/../panorama.png",
                           "render/../../hills.toml", "render//etc/passwd", "render/.."})
    EXPECT_EQ(get(path).status, 404) << path;
  EXPECT_EQ(got("api/scene")["values"]["output.width"], 48) << "the scene keeps its size";
}

TEST_F(StudioTest, OneJobAtATimeWhichCanBeCancelled) {
  for (const char* body : {R"({"width": 15})", R"({"width": 70000})", R"({"width": "a"})", "x"})
    posted("api/render", body, 422);
  set("output.width", 1500);
  set("output.height", 1000);
  posted("api/render", "", 202);
  EXPECT_THAT(posted("api/render", "{}", 422)["error"]["message"].get<std::string>(),
              HasSubstr("running"));
  EXPECT_EQ(get("api/picture", {{"rung", "0"}}).status, 200) << "composing goes on";
  EXPECT_EQ(get("api/tiles").status, 409) << "but for what the job itself paints";
  posted("api/render/cancel");
  EXPECT_EQ(finished_job()["state"], "cancelled");
  EXPECT_EQ(get("render/index.html").status, 404);
}

TEST_F(StudioTest, AJobThatFailsSaysWhy) {
  set("camera.height_m", -500);
  set("camera.position", {6000, 5000});
  posted("api/render", R"({"width": 64})", 202);
  const json report = finished_job();
  EXPECT_EQ(report["state"], "failed");
  EXPECT_THAT(report["error"]["message"].get<std::string>(), HasSubstr("below the ground"));
}

// ---- places

// What fetching does is given by the command.
class StudioOfPlaces : public StudioTest {
 protected:
  StudioOfPlaces() {
    studio_ = std::make_unique<Studio>(
        StudioParameters{path_,
                         {},
                         0,
                         [this](const WantedPlace& place, const belvedere::Run& run) {
                           fs::create_directories(place.folder);
                           asked_ = place;
                           run.progress.begin("fetching", 4.0);
                           while (waits_) {
                             run.progress.advance(0.0);
                             std::this_thread::sleep_for(std::chrono::milliseconds(2));
                           }
                           if (fails_) throw Error(ErrorKind::input, "example.org", "is away");
                           test::write_bytes(place.folder + "/elevation.tif", "heights");
                           return scene_text() + "# Of that place.\n";
                         }},
        run_);
  }
  json finished_fetch() {
    for (int i = 0; i < 2000; ++i) {
      const json report = got("api/fetch");
      if (report["state"] != "running") return report;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ADD_FAILURE() << "the job does not end";
    return {};
  }
  std::atomic<bool> waits_ = false;
  std::atomic<bool> fails_ = false;
  WantedPlace asked_;
};

TEST_F(StudioOfPlaces, FetchesBelowTheScenesFolderAndChangesNothing) {
  EXPECT_EQ(got("api/fetch")["state"], "idle");
  posted("api/fetch", R"({"place": " 11.4 , -47.35", "size": "80x50.5", "land_cover": "no"})", 202);
  const json report = finished_fetch();
  ASSERT_EQ(report["state"], "done") << report.dump();
  EXPECT_EQ(report["folder"], folder_ / "place_11.4000_-47.3500_80x50.5");
  EXPECT_EQ(report["text"], scene_text() + "# Of that place.\n");
  EXPECT_EQ(asked_.at_lonlat, glm::dvec2(11.4, -47.35));
  EXPECT_EQ(asked_.size_km, glm::dvec2(80.0, 50.5));
  EXPECT_FALSE(asked_.land_cover);
  EXPECT_EQ(got("api/scene")["revision"], 1);
  posted("api/fetch", R"({"place": "11.4,47.35"})", 202);
  finished_fetch();
  EXPECT_EQ(asked_.size_km, glm::dvec2(60.0, 60.0));
  EXPECT_TRUE(asked_.land_cover);
}

TEST_F(StudioOfPlaces, RefusesWhatIsNoPlaceAndWritesNothing) {
  const std::size_t count = folder_.count();
  for (const char* place :
       {"", "11.4", "11.4,", ",47", "11.4,47,3", "11.4;47", "nan,47", "inf,0", "11.4,91", "181,0",
        "../up,0", "11.4,47/../..", "0,90", "1e999,0", "Innsbruck"})
    posted("api/fetch", json{{"place", place}}.dump(), 422);
  for (const char* size : {"", "0", "-5", "401", "60x", "60x500", "1x2x3", "nan", "1e9", "../60"})
    posted("api/fetch", json{{"place", "11,47"}, {"size", size}}.dump(), 422);
  for (const char* body : {"x", R"({"place": 7})", R"({"place": ["a"]})", "[]"})
    posted("api/fetch", body, 422);
  fs::create_symlink(folder_ / "elsewhere", folder_ / "place_11.0000_47.0000_60x60");
  posted("api/fetch", R"({"place": "11,47"})", 422);
  EXPECT_EQ(got("api/fetch")["state"], "idle");
  EXPECT_EQ(folder_.count(), count + 1);
  close();
  EXPECT_THAT(
      posted("api/fetch", R"({"place": "11,47"})", 422)["error"]["message"].get<std::string>(),
      HasSubstr("does not fetch"));
}

TEST_F(StudioOfPlaces, OneAtATimeWhichCanBeCancelledAndSaysWhyItFails) {
  waits_ = true;
  posted("api/fetch", R"({"place": "11,48"})", 202);
  EXPECT_THAT(
      posted("api/fetch", R"({"place": "11,47"})", 422)["error"]["message"].get<std::string>(),
      HasSubstr("running"));
  EXPECT_EQ(get("api/picture", {{"rung", "0"}}).status, 200) << "composing goes on";
  posted("api/fetch/cancel");
  EXPECT_EQ(finished_fetch()["state"], "cancelled");
  EXPECT_FALSE(fs::exists(folder_ / "place_11.0000_48.0000_60x60"));
  waits_ = false;
  fails_ = true;
  posted("api/fetch", R"({"place": "11,48"})", 202);
  const json report = finished_fetch();
  EXPECT_EQ(report["state"], "failed");
  EXPECT_THAT(report["error"]["message"].get<std::string>(), HasSubstr("is away"));
  EXPECT_FALSE(report.contains("text"));
}

// ---- files

TEST_F(StudioTest, FilesAreWrittenBesideTheSceneAndNeverOverAnother) {
  const auto upload = [&](const std::string& name, const std::string& bytes) {
    return post("api/files", bytes, {{"name", name}});
  };
  const std::string bytes("\0\xff a track \n", 12);
  const HttpAnswer answer = upload("tour.gpx", bytes);
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(json::parse(answer.body), (json{{"file", "tour.gpx"}, {"kind", "track"}}));
  EXPECT_EQ(test::read_bytes(folder_ / "tour.gpx"), bytes);
  for (const char* name : {"tour.gpx", "hills.toml"}) EXPECT_EQ(upload(name, "other").status, 422);
  EXPECT_EQ(test::read_bytes(folder_ / "tour.gpx"), bytes);
  EXPECT_EQ(test::read_bytes(path_), scene_text());
  for (const auto& [name, kind] :
       std::initializer_list<std::pair<const char*, const char*>>{{"a.tif", "terrain"},
                                                                  {"a b (1).TIF", "terrain"},
                                                                  {"b.geojson", "features"},
                                                                  {"c.jpg", "painting"},
                                                                  {"d.toml", "scene"},
                                                                  {"Zürich.xyz", "other"}})
    EXPECT_EQ(json::parse(upload(name, "x").body)["kind"], kind) << name;
}

TEST_F(StudioTest, FilesNeverLeaveTheFolder) {
  fs::create_directories(folder_ / "inner");
  const std::string inner = folder_.write("inner/hills.toml", scene_text());
  Studio studio({inner, {}, 0}, run_);
  const auto upload = [&](const std::string& name) {
    return studio
        .answer({.method = "POST", .path = "api/files", .query = {{"name", name}}, .body = "x"})
        .status;
  };
  const std::size_t count = folder_.count();
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string("../up.gpx"),
        std::string("/tmp/up.gpx"), std::string("a/b.gpx"), std::string("a\\b.gpx"),
        std::string(".hidden"), std::string("a\0b.gpx", 7), std::string(201, 'a'),
        std::string("inner/../up.gpx")})
    EXPECT_EQ(upload(name), 422) << name;
  EXPECT_EQ(folder_.count(), count);
  // A link to nowhere is a file too: what it names would be written.
  fs::create_symlink(folder_ / "elsewhere.gpx", folder_ / "inner/link.gpx");
  EXPECT_EQ(upload("link.gpx"), 422);
  EXPECT_FALSE(fs::exists(folder_ / "elsewhere.gpx"));
}

// ---- two studios

TEST_F(StudioTest, ASecondStudioOnTheSceneIsRefused) {
  open();
  const auto second = [&] {
    return test::error_of([&] { const Studio other({path_, {}, 0}, run_); });
  };
  EXPECT_EQ(second().kind(), ErrorKind::usage);
  EXPECT_THAT(second().found(), HasSubstr("another studio"));
  // The file is another one after it is saved.
  set("sun.azimuth_deg", 10);
  posted("api/save");
  EXPECT_THAT(second().found(), HasSubstr("another studio"));
  close();
  open();
  EXPECT_EQ(got("api/scene")["values"]["sun.azimuth_deg"], 10);
  EXPECT_EQ(test::error_of([&] {
              const Studio none({folder_ / "none.toml", {}, 0}, run_);
            }).kind(),
            ErrorKind::input);
}

// ---- many changes

class RandomChanges : public StudioTest {
 protected:
  std::uint32_t draw(std::uint32_t count) { return random_index(count, 11, ++drawn_, 0); }
  double number(double from, double to) {
    return std::round(from + (to - from) * random_uniform(11, ++drawn_, 1));
  }
  // One change of somebody who composes; what is refused is one as well.
  void change() {
    switch (draw(12)) {
      case 0:
        return ask("sun.azimuth_deg", number(0, 360));
      case 1:
        return ask("camera.azimuth_deg", number(-40, 40));
      case 2:
        return ask("camera.position", {number(4000, 8000), number(-6000, -2000)});
      case 3:
        return ask("deform.exaggeration", 1.0 + 0.1 * number(0, 8));
      case 4:
        return ask("deform.bend.radius_m", number(0, 3) * 20000.0);
      case 5:
        return ask("generalize.foreground", {1, 1, 0.1 * number(5, 15), 0.5, 0.1, 0});
      case 6:
        return ask("palette", draw(2) == 0 ? "autumn" : "winter");
      case 7:
        post("api/set", R"({"changes": [{"key": "deform.handles", "append": {"position": [)" +
                            std::to_string(3000 + 500 * draw(10)) +
                            R"(, 5000], "radius_m": 2000, "raise_m": 150}}]})");
        return;
      case 8:
        post("api/set", R"({"changes": [{"key": "deform.handles.0", "remove": true}]})");
        return;
      case 9:
        post("api/undo");
        return;
      case 10:
        post(draw(2) == 0 ? "api/undo" : "api/redo");
        return;
      default:
        const std::string text = got("api/scene")["text"];
        post("api/text",
             json{{"text", text + "# note " + std::to_string(draw(100)) + "\n"}}.dump());
    }
  }
  void ask(const std::string& key, const json& value) {
    post("api/set",
         json{{"changes", {{{"key", key}, {"value", value}}}}, {"step", draw(2) == 0 ? "drag" : ""}}
             .dump());
  }
  // Page, file and picture are one scene.
  void expect_agreement(int changes) {
    for (int i = 0; i < changes; ++i) {
      change();
      if (i % 10 == 0) get("api/picture", {{"rung", "0"}});
    }
    const std::string picture = get("api/picture", {{"rung", "0"}}).body;
    const json saved = posted("api/save");
    EXPECT_GT(saved["revision"], changes / 2);
    EXPECT_EQ(saved["text"], test::read_bytes(path_));
    EXPECT_THAT(saved["text"].get<std::string>(),
                AllOf(HasSubstr("# Hills."), HasSubstr("# no paintings")));
    close();
    const json fresh = got("api/scene");
    EXPECT_EQ(fresh["text"], saved["text"]);
    EXPECT_EQ(fresh["values"], saved["values"]);
    EXPECT_EQ(get("api/picture", {{"rung", "0"}}).body, picture);
    EXPECT_EQ(got("api/scene")["derived"], saved["derived"]);
  }

 private:
  std::int64_t drawn_ = 0;
};

TEST_F(RandomChanges, SixtyInARowLeavePageFileAndPictureInAgreement) { expect_agreement(60); }

using RandomChangesLong = RandomChanges;
TEST_F(RandomChangesLong, TwoHundredInARow) { expect_agreement(200); }

}  // namespace
}  // namespace belvedere::tools
