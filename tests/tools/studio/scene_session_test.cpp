#include "tools/studio/scene_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SceneSessionTest : public testing::Test {
 protected:
  SceneSessionTest() : path_(folder_.write("hills.toml", first_text())) {}
  static std::string first_text() {
    return std::string("# Hills.\n") + test::small_scene_text + "# The end.\n";
  }
  static void set(SceneSession& session, const std::string& key, const std::string& value,
                  const std::string& step = {}) {
    session.edit(std::vector<SceneEdit>{{.key = key, .value = value}}, step);
  }
  static double azimuth(const SceneSession& session) {
    return session.scene().scene.sun.azimuth_deg.value_or(-1.0);
  }
  // What nothing may change.
  struct State {
    explicit State(const SceneSession& session)
        : text(session.text()),
          scene(write_scene(session.scene().scene)),
          revision(session.revision()),
          can_undo(session.can_undo()),
          can_redo(session.can_redo()),
          saved(session.is_saved()) {}
    bool operator==(const State&) const = default;
    std::string text, scene;
    std::uint64_t revision;
    bool can_undo, can_redo, saved;
  };

  const test::Folder folder_;
  const std::string path_;
};

TEST_F(SceneSessionTest, BeginsWithTheFile) {
  const SceneSession session(path_, {});
  EXPECT_EQ(session.text(), first_text());
  EXPECT_EQ(session.path(), path_);
  EXPECT_EQ(session.scene().name, "hills");
  EXPECT_EQ(session.scene().folder, folder_.path());
  EXPECT_TRUE(session.is_saved());
  EXPECT_FALSE(session.can_undo() || session.can_redo() || session.is_changed_outside());
  EXPECT_EQ(test::error_of([&] { SceneSession(folder_ / "none.toml", {}); }).kind(),
            ErrorKind::input);
  const std::string broken = folder_.write("broken.toml", "version = 1\n[camera\n");
  EXPECT_EQ(test::error_of([&] { SceneSession(broken, {}); }).kind(), ErrorKind::usage);
}

TEST_F(SceneSessionTest, AnEditChangesTheSceneAndItsLineAlone) {
  SceneSession session(path_, {});
  const std::uint64_t revision = session.revision();
  set(session, "sun.azimuth_deg", "200");
  EXPECT_EQ(azimuth(session), 200.0);
  std::string expected = first_text();
  expected.replace(expected.find("azimuth_deg = 315"), 17, "azimuth_deg = 200");
  EXPECT_EQ(session.text(), expected);
  EXPECT_EQ(session.revision(), revision + 1);
  EXPECT_FALSE(session.is_saved());
  EXPECT_TRUE(session.can_undo());
  EXPECT_EQ(test::read_bytes(path_), first_text()) << "nothing is written before it is saved";
}

TEST_F(SceneSessionTest, AnEditWithoutEffectIsNoStep) {
  SceneSession session(path_, {});
  const State before(session);
  set(session, "sun.azimuth_deg", "315");
  EXPECT_EQ(State(session), before);
  session.edit({}, "");
  session.replace(first_text());
  EXPECT_EQ(State(session), before);
}

TEST_F(SceneSessionTest, UndoAndRedoGoThroughAllTexts) {
  SceneSession session(path_, {});
  std::vector<std::string> texts = {session.text()};
  for (const char* value : {"10", "20", "30"}) {
    set(session, "sun.azimuth_deg", value);
    texts.push_back(session.text());
  }
  std::uint64_t revision = session.revision();
  for (std::size_t i = texts.size() - 1; i-- > 0;) {
    session.undo();
    EXPECT_EQ(session.text(), texts[i]);
    EXPECT_EQ(session.revision(), ++revision) << "another state is another revision";
  }
  EXPECT_FALSE(session.can_undo());
  EXPECT_TRUE(session.is_saved());
  session.undo();  // nothing
  EXPECT_EQ(session.text(), texts[0]);
  EXPECT_EQ(session.revision(), revision);
  for (std::size_t i = 1; i < texts.size(); ++i) {
    session.redo();
    EXPECT_EQ(session.text(), texts[i]);
    EXPECT_EQ(azimuth(session), 10.0 * static_cast<double>(i));
  }
  EXPECT_FALSE(session.can_redo());
  session.redo();
  EXPECT_EQ(session.text(), texts.back());
}

TEST_F(SceneSessionTest, AnEditAfterUndoEndsWhatCouldBeRedone) {
  SceneSession session(path_, {});
  set(session, "sun.azimuth_deg", "10");
  session.undo();
  EXPECT_TRUE(session.can_redo());
  set(session, "sun.azimuth_deg", "20");
  EXPECT_FALSE(session.can_redo());
  session.undo();
  EXPECT_EQ(session.text(), first_text());
}

TEST_F(SceneSessionTest, EditsOfOneStepAreUndoneTogether) {
  SceneSession session(path_, {});
  for (const char* value : {"10", "20", "30"}) set(session, "sun.azimuth_deg", value, "drag-1");
  for (const char* value : {"40", "50"}) set(session, "sun.azimuth_deg", value, "drag-2");
  set(session, "sun.azimuth_deg", "60");
  set(session, "sun.azimuth_deg", "70");
  for (const double expected : {60.0, 50.0, 30.0, 315.0}) {
    session.undo();
    EXPECT_EQ(azimuth(session), expected);
  }
  EXPECT_FALSE(session.can_undo());
  session.redo();
  EXPECT_EQ(azimuth(session), 30.0);
  // After undo, redo or a text the same name is another step.
  set(session, "sun.azimuth_deg", "35", "drag-1");
  session.undo();
  EXPECT_EQ(azimuth(session), 30.0);
}

TEST_F(SceneSessionTest, SeveralEditsAreOneChange) {
  SceneSession session(path_, {});
  const std::uint64_t revision = session.revision();
  session.edit(
      std::vector<SceneEdit>{
          {.key = "sun.azimuth_deg", .value = "10"},
          {.key = "deform.handles",
           .value = "{ position = [6000, 5000], radius_m = 3000, raise_m = 300 }",
           .append = true},
          {.key = "air.from_m", .value = {}}},
      "");
  EXPECT_EQ(session.revision(), revision + 1);
  EXPECT_EQ(session.scene().scene.deform.handles.size(), 1U);
  EXPECT_THAT(session.text(), Not(HasSubstr("from_m = 34000")));
  session.undo();
  EXPECT_EQ(session.text(), first_text());
}

TEST_F(SceneSessionTest, WhatIsRefusedChangesNothing) {
  SceneSession session(path_, {});
  set(session, "sun.azimuth_deg", "10", "drag-1");
  set(session, "sun.azimuth_deg", "20");
  session.undo();
  const State before(session);
  const auto refused = [&](const std::vector<SceneEdit>& edits) {
    const Error error = test::error_of([&] { session.edit(edits, "drag-1"); });
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_TRUE(State(session) == before) << error.what();
    EXPECT_EQ(test::error_of([&] { static_cast<void>(session.edited(edits)); }).kind(),
              ErrorKind::usage);
    return std::string(error.what());
  };
  EXPECT_THAT(refused({{.key = "sun.altitude_deg", .value = "900"}}),
              HasSubstr("sun.altitude_deg"));
  EXPECT_THAT(refused({{.key = "sun.altitud_deg", .value = "30"}}), HasSubstr("altitude_deg"));
  refused({{.key = "sun.azimuth_deg", .value = "\"north\""}});
  refused({{.key = "sun.azimuth_deg", .value = "= 3"}});
  refused({{.key = "exemplar.7.seed", .value = "1"}});
  refused({{.key = "sun.azimuth_deg", .value = "99"}, {.key = "palette", .value = "\"no such\""}});
  refused({{.key = "", .value = "1"}});
  for (const char* text : {"", "version = 2\n", "version = 1\n[camera\n", "no = toml = \n"}) {
    EXPECT_EQ(test::error_of([&] { session.replace(text); }).kind(), ErrorKind::usage) << text;
    EXPECT_TRUE(State(session) == before) << text;
  }
}

// As on the command line, so that an editor can show the line.
TEST_F(SceneSessionTest, ErrorsOfATextNameFileAndLine) {
  SceneSession session(path_, {});
  std::string text = first_text();
  text.replace(text.find("altitude_deg = 30"), 17, "altitude_deg = 900");
  const Error error = test::error_of([&] { session.replace(text); });
  const auto line =
      1 + std::count(text.begin(),
                     text.begin() + static_cast<std::ptrdiff_t>(text.find("altitude_deg")), '\n');
  EXPECT_THAT(error.where(), HasSubstr("hills.toml:" + std::to_string(line) + ":"));
  EXPECT_THAT(test::error_of([&] { session.replace("version = 1\n[camera\n"); }).where(),
              HasSubstr("hills.toml:2:"));
}

TEST_F(SceneSessionTest, EditedIsTheSceneAsItWouldBe) {
  const SceneSession session(path_, {});
  const State before(session);
  const LoadedScene scene =
      session.edited(std::vector<SceneEdit>{{.key = "sun.azimuth_deg", .value = "10"}});
  EXPECT_EQ(scene.scene.sun.azimuth_deg, 10.0);
  EXPECT_EQ(scene.name, "hills");
  EXPECT_TRUE(State(session) == before);
}

TEST_F(SceneSessionTest, SavesTheTextToTheByte) {
  SceneSession session(path_, {});
  set(session, "sun.azimuth_deg", "10");
  session.save(false);
  EXPECT_EQ(test::read_bytes(path_), session.text());
  EXPECT_TRUE(session.is_saved());
  EXPECT_TRUE(session.can_undo()) << "saving is no step";
  session.undo();
  EXPECT_FALSE(session.is_saved());
  session.save(false);
  EXPECT_EQ(test::read_bytes(path_), first_text());
  EXPECT_EQ(folder_.count(), 1U) << "nothing else is left there";
}

TEST_F(SceneSessionTest, AChangeByAnotherProgramIsNoticedAndNotOverwritten) {
  SceneSession session(path_, {});
  set(session, "sun.azimuth_deg", "10");
  const std::string mine = session.text();
  const std::string theirs = first_text() + "# Another hand.\n";
  test::write_bytes(path_, theirs);
  EXPECT_TRUE(session.is_changed_outside());
  EXPECT_EQ(test::error_of([&] { session.save(false); }).kind(), ErrorKind::output);
  EXPECT_EQ(test::read_bytes(path_), theirs);
  session.save(true);
  EXPECT_EQ(test::read_bytes(path_), mine);
  EXPECT_FALSE(session.is_changed_outside());
  session.save(false);
}

TEST_F(SceneSessionTest, ReloadTakesTheFileAndCanBeUndone) {
  SceneSession session(path_, {});
  set(session, "sun.azimuth_deg", "10");
  const std::string mine = session.text();
  const std::string theirs = first_text() + "# Another hand.\n";
  test::write_bytes(path_, theirs);
  session.reload();
  EXPECT_EQ(session.text(), theirs);
  EXPECT_TRUE(session.is_saved());
  EXPECT_FALSE(session.is_changed_outside());
  session.undo();
  EXPECT_EQ(session.text(), mine);
  // A file that is no scene is told, and the scene stays.
  test::write_bytes(path_, "version = 1\n[camera\n");
  const State before(session);
  EXPECT_EQ(test::error_of([&] { session.reload(); }).kind(), ErrorKind::usage);
  EXPECT_TRUE(State(session) == before);
  std::filesystem::remove(path_);
  EXPECT_EQ(test::error_of([&] { session.reload(); }).kind(), ErrorKind::input);
  EXPECT_TRUE(State(session) == before);
  session.save(false);
  EXPECT_EQ(test::read_bytes(path_), mine) << "a file that is gone is written again";
}

TEST_F(SceneSessionTest, WhatIsDrawnFollowsUndoAsAFileBesideTheScene) {
  SceneSession session(path_, {});
  EXPECT_EQ(session.drawn_file(), "hills_drawn.geojson");
  const std::string file = folder_ / session.drawn_file();
  const std::string one = std::string("{") + drawn_mark + ", \"one\": 1}\n";
  const std::string two = std::string("{") + drawn_mark + ", \"two\": 2}\n";
  const std::vector<SceneEdit> block = {
      {.key = "features",
       .value = "{source = \"hills_drawn.geojson\", kind = \"road\"}",
       .append = true}};
  session.draw(one, block, "");
  EXPECT_EQ(test::read_bytes(file), one);
  session.draw(two, {}, "");
  EXPECT_FALSE(session.is_saved());
  session.undo();
  EXPECT_EQ(test::read_bytes(file), one);
  EXPECT_EQ(session.scene().scene.features.size(), 1U);
  session.undo();
  EXPECT_FALSE(std::filesystem::exists(file)) << "as it was before";
  EXPECT_TRUE(session.is_saved());
  session.redo();
  session.save(false);
  session.draw(two, {}, "");
  session.revert();
  EXPECT_EQ(SceneSession(path_, {}).drawn(), one) << "it is there in the next session";
  EXPECT_TRUE(session.is_saved());
  EXPECT_TRUE(session.can_undo());
}

TEST_F(SceneSessionTest, NoFileOfAnotherProgramIsReplacedByWhatIsDrawn) {
  const std::string file = folder_.write("hills_drawn.geojson", "{\"mine\": 1}\n");
  SceneSession session(path_, {});
  EXPECT_EQ(session.drawn(), "");
  const std::string one = std::string("{") + drawn_mark + "}\n";
  EXPECT_EQ(test::error_of([&] { session.draw(one, {}, ""); }).kind(), ErrorKind::output);
  EXPECT_EQ(test::read_bytes(file), "{\"mine\": 1}\n");
  std::filesystem::remove(file);
  session.draw(one, {}, "");
  folder_.write("hills_drawn.geojson", "{\"changed\": 1}\n");
  EXPECT_EQ(test::error_of([&] { session.undo(); }).kind(), ErrorKind::output);
  EXPECT_EQ(test::read_bytes(file), "{\"changed\": 1}\n") << "nor removed";
  EXPECT_EQ(session.drawn(), one);
}

TEST_F(SceneSessionTest, OfTwoSessionsTheSecondLearnsOfTheFirst) {
  SceneSession one(path_, {});
  SceneSession two(path_, {});
  set(one, "sun.azimuth_deg", "10");
  EXPECT_FALSE(two.is_changed_outside());
  one.save(false);
  EXPECT_TRUE(two.is_changed_outside());
  set(two, "sun.azimuth_deg", "20");
  EXPECT_EQ(test::error_of([&] { two.save(false); }).kind(), ErrorKind::output);
  two.reload();
  EXPECT_EQ(two.text(), one.text());
  EXPECT_FALSE(one.is_changed_outside());
}

TEST_F(SceneSessionTest, SettingsOfTheCommandLineStayInEffect) {
  SceneSession session(path_, {.data_folders = {}, .settings = {"output.width=64"}});
  EXPECT_EQ(session.scene().scene.output.width, 64);
  set(session, "sun.azimuth_deg", "10");
  EXPECT_EQ(session.scene().scene.output.width, 64);
  EXPECT_THAT(session.text(), HasSubstr("width = 96")) << "and are not written";
}

}  // namespace
}  // namespace belvedere::tools
