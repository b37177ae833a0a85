#include "renderer/scene/edit/toml_layout.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace belvedere {
namespace {

using testing::ElementsAre;

// "path: value" of every part that has a path.
std::vector<std::string> layout_of(std::string_view text) {
  std::vector<std::string> out;
  for (const TomlPart& part : toml_layout(text)) {
    if (part.path.empty()) continue;
    std::string path;
    for (const std::string& name : part.path) path += (path.empty() ? "" : "|") + name;
    const std::string_view value = text.substr(part.value.begin, part.value.end - part.value.begin);
    out.push_back(value.empty() ? path : fmt::format("{}: {}", path, value));
  }
  return out;
}

TEST(TomlLayout, PathsCountTheElementsOfLists) {
  EXPECT_THAT(layout_of("a.b = 1 # c\n[ t . \"u.v\" ]\n'w x' = 2\n[[l]]\nk = 3\n[l.m]\nk = 4\n"
                        "[[l]]\n[[l.n]]\n[[l.n]]\nk=5"),
              ElementsAre("a|b: 1", "t|u.v", "t|u.v|w x: 2", "l|0", "l|0|k: 3", "l|0|m",
                          "l|0|m|k: 4", "l|1", "l|1|n|0", "l|1|n|1", "l|1|n|1|k: 5"));
}

TEST(TomlLayout, ValuesEndWhereTheyEnd) {
  EXPECT_THAT(layout_of("a = \"x # ] \\\" y\" # c\r\nb = 1979-05-27 07:32:00  \r\nc = '\\'\n"),
              ElementsAre("a: \"x # ] \\\" y\"", "b: 1979-05-27 07:32:00", "c: '\\'"));
  EXPECT_THAT(layout_of("a = \"\"\"\nx = 1\n\\\"\"\"\"\"\"\nb = ''\nc = '''x'''''\nd = 1"),
              ElementsAre("a: \"\"\"\nx = 1\n\\\"\"\"\"\"\"", "b: ''", "c: '''x'''''", "d: 1"));
}

TEST(TomlLayout, ItemsOfArraysAndInlineTables) {
  EXPECT_THAT(layout_of("a = [ 1, # ]\n  [2, 3],\n]\nb = { c.d = 1, 'e' = [ { f = 2 } ] }\n"),
              ElementsAre("a: [ 1, # ]\n  [2, 3],\n]", "a|0: 1", "a|1: [2, 3]", "a|1|0: 2",
                          "a|1|1: 3", "b: { c.d = 1, 'e' = [ { f = 2 } ] }", "b|c|d: 1",
                          "b|e: [ { f = 2 } ]", "b|e|0: { f = 2 }", "b|e|0|f: 2"));
}

// Every byte belongs to one line, whatever the text.
TEST(TomlLayout, LinesCoverTheText) {
  const std::string text =
      "\n# c\r\n[a]\nb = [\n1,\n2]\n\n[[c]] # d\ne = \"\"\"\n\n\"\"\"\n  # f\nwrong wrong [\n{\"";
  for (std::size_t length = 0; length <= text.size(); ++length) {
    std::size_t end = 0;
    for (const TomlPart& part : toml_layout(std::string_view(text).substr(0, length))) {
      if (part.kind == TomlPart::Kind::item) continue;
      EXPECT_EQ(part.whole.begin, end) << length;
      end = part.whole.end;
    }
    EXPECT_EQ(end, length);
  }
}

TEST(TomlLayout, WritesKeysAndValues) {
  EXPECT_EQ(toml_key("a-b_1"), "a-b_1");
  EXPECT_EQ(toml_key("a.b"), "\"a.b\"");
  EXPECT_EQ(toml_key(""), "\"\"");
  const std::string text = "{ a = [1, 2.5, \"x\\n\"], \"b c\" = { d = true } }";
  EXPECT_EQ(toml_text(parse_config_value(text, "")), text);
}

}  // namespace
}  // namespace belvedere
