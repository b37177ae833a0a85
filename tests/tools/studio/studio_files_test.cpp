#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

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

}  // namespace
}  // namespace belvedere::tools
