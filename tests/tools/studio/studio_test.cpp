#include "tools/studio/studio.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "tests/tools/studio/studio_fixture.h"

namespace belvedere::tools {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

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
