#include "tools/cli/shell_completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "tests/files.h"
#include "tools/cli/program.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

class BashCompletion : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists("/bin/bash")) GTEST_SKIP() << "no bash here";
    folder_.write("belvedere.bash", shell_completion(describe_program(), "bash"));
    folder_.write("here/alps.toml", "");
    folder_.write("here/dem.tif", "");
    folder_.write("here/scenes/rainier.toml", "");
  }
  // Completions of bash for the last of the words, in the folder "here". Words that bash splits, as
  // at "=", are given apart.
  std::vector<std::string> completed(const std::string& words) const {
    const std::string script =
        "cd '" + (folder_ / "here") + "'; . ../belvedere.bash; COMP_WORDS=(belvedere " + words +
        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _belvedere; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const std::string file = folder_.write("ask.sh", script);
    EXPECT_EQ(
        std::system(("bash --norc '" + file + "' > '" + (folder_ / "answer") + "' 2>&1").c_str()),
        0);
    std::istringstream lines(test::read_bytes(folder_ / "answer"));
    std::vector<std::string> out;
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) out.push_back(line);
    return out;
  }
  test::Folder folder_;
};

TEST_F(BashCompletion, IsAScript) {
  EXPECT_EQ(std::system(("bash -n '" + (folder_ / "belvedere.bash") + "'").c_str()), 0);
}

TEST_F(BashCompletion, CompletesCommands) {
  EXPECT_THAT(completed("ren"), ElementsAre("render"));
  EXPECT_THAT(completed("\"\""),
              AllOf(Contains("render"), Contains("exemplar"), Not(Contains("paint"))));
  EXPECT_THAT(completed("exemplar pa"), ElementsAre("paint"));
  EXPECT_THAT(completed("exemplar \"\""),
              UnorderedElementsAre("check", "paint", "pick", "register", "segment"));
}

TEST_F(BashCompletion, CompletesOptionsOfTheCommandThatStandsThere) {
  EXPECT_THAT(completed("render --t"), UnorderedElementsAre("--threads", "--tile"));
  EXPECT_THAT(completed("generalize --mask"), UnorderedElementsAre("--mask", "--mask-slope"));
  // `check` and `exemplar check` are two commands.
  EXPECT_THAT(completed("exemplar check --tar"),
              UnorderedElementsAre("--target", "--target-guide"));
  EXPECT_THAT(completed("check --tar"), IsEmpty());
}

TEST_F(BashCompletion, CompletesValues) {
  EXPECT_THAT(completed("synthesize --harmonize \"\""),
              UnorderedElementsAre("off", "common", "first", "regions"));
  EXPECT_THAT(completed("synthesize --harmonize = c"), ElementsAre("common"));
  EXPECT_THAT(completed("synthesize --harmonize ="),
              UnorderedElementsAre("off", "common", "first", "regions"));
  EXPECT_THAT(completed("generalize --preset b"), ElementsAre("bold_ridges"));
  EXPECT_THAT(completed("completion z"), ElementsAre("zsh"));
  EXPECT_THAT(completed("render --threads \"\""), IsEmpty());
  EXPECT_THAT(completed("render --data \"\""), ElementsAre("scenes")) << "folders only";
}

TEST_F(BashCompletion, CompletesSceneFilesAndOthers) {
  EXPECT_THAT(completed("render \"\""), UnorderedElementsAre("alps.toml", "scenes"));
  EXPECT_THAT(completed("check scenes/"), ElementsAre("scenes/rainier.toml"));
  EXPECT_THAT(completed("deform d"), ElementsAre("dem.tif")) << "no scene begins like that";
  EXPECT_THAT(completed("info \"\""), UnorderedElementsAre("alps.toml", "dem.tif", "scenes"));
}

TEST(ShellCompletion, OfEveryShellNamesEveryCommandAndOption) {
  const CommandDescription program = describe_program();
  for (const std::string& shell : completed_shells()) {
    const std::string script = shell_completion(program, shell);
    const auto look = [&](const CommandDescription& command, const auto& again) -> void {
      for (const CommandDescription& one : command.commands) again(one, again);
      EXPECT_THAT(script, HasSubstr(command.word())) << shell;
      for (const OptionDescription& option : command.options)
        for (const std::string& name : option.names)
          if (name.starts_with("--")) {
            EXPECT_THAT(script, HasSubstr(shell == "fish" ? "-l " + name.substr(2) : name))
                << shell << " " << command.name;
          }
    };
    look(program, look);
  }
}

// zsh and fish check themselves whether they can read them.
TEST(ShellCompletion, IsReadByItsShell) {
  const test::Folder folder;
  bool any = false;
  for (const char* shell : {"zsh", "fish"}) {
    const std::string program = std::string("/usr/bin/") + shell;
    if (!std::filesystem::exists(program)) continue;
    any = true;
    const std::string script = folder.write(shell, shell_completion(describe_program(), shell));
    EXPECT_EQ(std::system((program + " -n '" + script + "'").c_str()), 0) << shell;
  }
  if (!any) GTEST_SKIP() << "neither zsh nor fish here";
}

TEST(ShellCompletion, RefusesOtherShells) {
  EXPECT_THAT(test::usage_error([] { shell_completion({}, "csh"); }), HasSubstr("bash, fish, zsh"));
}

}  // namespace
}  // namespace belvedere::tools
