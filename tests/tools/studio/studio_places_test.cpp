#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "base/error.h"
#include "tests/tools/studio/studio_fixture.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

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
