#include "tools/cli/commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/program.h"
#include "tools/cli/program.h"

namespace belvedere::tools {
namespace {

using ::testing::HasSubstr;

TEST(Commands, EachHasANameOfItsOwnAndALineOfHelp) {
  std::set<std::string> names;
  for (const Command& row : all_commands()) {
    const std::string name = std::string(row.group) + " " + row.name;
    EXPECT_TRUE(names.insert(name).second) << name << " stands twice";
    const std::string meaning = row.meaning;
    EXPECT_GT(meaning.size(), 10U) << name;
    EXPECT_FALSE(meaning.ends_with('.')) << name << ": a heading, not a sentence";
    EXPECT_EQ(meaning.find('\n'), std::string::npos) << name;
  }
}

TEST(Commands, GroupsAreThoseOfTheTable) {
  std::set<std::string> used;
  for (const Command& row : all_commands())
    if (*row.group != '\0') used.insert(row.group);
  std::set<std::string> known;
  for (const CommandGroup& group : command_groups()) known.insert(group.name);
  EXPECT_EQ(used, known);
}

// The help of a command shows its usage.
TEST(Commands, EachShowsAnExample) {
  const auto look = [](const CommandDescription& command, const auto& again) -> void {
    for (const CommandDescription& one : command.commands) again(one, again);
    if (command.commands.empty()) {
      EXPECT_THAT(command.footer, HasSubstr("  " + command.name)) << command.name;
    }
  };
  look(describe_program(), look);
}

TEST(FileNames, NameIsWithoutFolders) {
  EXPECT_EQ(file_name("/a/b/c.tif"), "c.tif");
  EXPECT_EQ(file_name("c.tif"), "c.tif");
}

// Options that name inputs are refused with their name before any work, and nothing is written.
class MissingInputs : public Program {};

TEST_F(MissingInputs, AreNamedWithTheirOptionBeforeTheWork) {
  const std::string here = write("here.tif", "x");
  const std::string none = path("none.tif");
  const std::string out = path("out");
  const std::vector<std::string> fit = {"layers", "fit",      "--dem", here,    "--classes",
                                        here,     "--legend", "nlcd",  "--out", out + ".toml"};
  const std::vector<std::string> apply = {"layers", "apply", here,        "--dem",
                                          here,     "--out", out + ".tif"};
  const auto with = [&](std::vector<std::string> words, const std::string& option) {
    words.insert(words.end(), {option, none});
    return std::pair(option, std::move(words));
  };
  using Words = std::vector<std::string>;
  std::vector<std::pair<std::string, Words>> all = {
      with({"labels", "--out", out}, "--under"),
      with({"labels", "--out", out}, "--points"),
      with({"labels", "--out", out}, "--shapes"),
      with({"labels", "--out", out}, "--tracks"),
      with({"generalize", here, out + ".tif", "--global", "1,1"}, "--mask"),
      with({"exemplar", "segment", here, "--out", out + ".png"}, "--compare"),
      with({"exemplar", "register", here, here, "--out", out}, "--pairs"),
      with({"exemplar", "pick", here, here, "--pairs", out + ".csv"}, "--names"),
      {"PAINTING", {"exemplar", "segment", none, "--out", out + ".png"}},
      {"DEM", {"exemplar", "register", here, none, "--pairs", here, "--out", out}},
      {"MASK", {"texture", "erode", none, "--out", out}},
      {"IN", {"generalize", none, out + ".tif", "--global", "1,1"}},
      {"LAYERS", {"layers", "picture", none, "--dem", here, "--out", out + ".tif"}}};
  for (const char* option : {"--mask", "--stations", "--temperature", "--rain", "--sky-view"})
    all.push_back(with(fit, option));
  for (const char* option : {"--stations", "--radiation"}) all.push_back(with(apply, option));
  for (const auto& [option, words] : all) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 3) << option << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(option + ": " + none + ": file not found"), std::string::npos)
        << outcome.err;
    for (const char* extension : {"", ".tif", ".toml", ".png", ".csv"})
      EXPECT_FALSE(std::filesystem::exists(out + extension)) << option;
  }
  // A scene with a style or legend that does not exist is not written.
  for (const Words& more : {Words{"--style", path("none.toml")}, Words{"--style", "bruegl"},
                            Words{"--land-cover", here, "--legend", path("none.toml")}}) {
    Words words = {"new", here, "--out", out + ".toml"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_TRUE(outcome.status == 2 || outcome.status == 3) << outcome.err;
    EXPECT_NE(outcome.err.find(more.back()), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(out + ".toml"));
  }
}

}  // namespace
}  // namespace belvedere::tools
