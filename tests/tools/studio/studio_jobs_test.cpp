#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "base/error.h"
#include "renderer/image/image_io.h"
#include "tests/tools/studio/studio_fixture.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// ---- results of jobs

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
                                                                  {"e.csv", "names"},
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

// ---- paintings and places

// What is done with paintings is given by the command.
class StudioOfPaintings : public StudioTest {
 protected:
  StudioOfPaintings() {
    folder_.write("cliffs.jpg", "paint");
    StudioParameters parameters{path_, {}, 0};
    parameters.fit_style = [](const std::string& painting, const std::string& style,
                              const belvedere::Run&) {
      test::write_bytes(style, "of " + fs::path(painting).filename().string());
    };
    parameters.open_picking = [](const LoadedScene&, const std::string&, const std::string& pairs,
                                 const belvedere::Run&) -> Room {
      return [pairs](const HttpRequest& request) {
        return HttpAnswer{.type = "text/plain",
                          .body = request.path + " of " + fs::path(pairs).filename().string()};
      };
    };
    studio_ = std::make_unique<Studio>(parameters, run_);
  }
  json finished() {
    for (int i = 0; i < 2000; ++i) {
      const json report = got("api/painting");
      if (report["state"] != "running") return report;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ADD_FAILURE() << "the job does not end";
    return {};
  }
};

TEST_F(StudioOfPaintings, AStyleIsWrittenBesideTheSceneAndReplacesNothing) {
  posted("api/style", R"({"painting": "cliffs.jpg"})", 202);
  EXPECT_EQ(finished()["result"], "cliffs_style.toml");
  EXPECT_EQ(test::read_bytes(folder_ / "cliffs_style.toml"), "of cliffs.jpg");
  posted("api/style", R"({"painting": "cliffs.jpg"})", 422);
  posted("api/style", R"({"painting": "gone.jpg"})", 422);
  posted("api/style", R"({"painting": "../hills.jpg"})", 422);
}

TEST_F(StudioOfPaintings, TheRoomForPairsIsOpenedBelowThePage) {
  EXPECT_EQ(get("pick/api/pairs").status, 404);
  posted("api/pick", R"({"painting": "cliffs.jpg"})", 202);
  EXPECT_EQ(finished()["result"], "pick/");
  EXPECT_EQ(get("pick/api/pairs").body, "api/pairs of cliffs_pairs.csv");
  EXPECT_EQ(get("pick/").body, " of cliffs_pairs.csv");
}

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

}  // namespace
}  // namespace belvedere::tools
