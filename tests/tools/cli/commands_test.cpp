#include "tools/cli/commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

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

}  // namespace
}  // namespace belvedere::tools
