#include "base/text/config_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ConfigReader, ReadsWhatIsThereAndLeavesTheRest) {
  const std::string name = "mine.toml";
  const ConfigValue value = parse_config(
      "a = 2\nb = true\nc = \"x\"\nd = [\"p\", \"q\"]\ne = \"#804000\"\nf = [1, 2.5]\ng = "
      "\"two\"\n",
      name);
  ConfigReader read(value, name);
  double a = 0.0;
  double missing = 7.0;
  bool b = false;
  std::string c;
  std::vector<std::string> d = {"before"};
  glm::vec3 e(0.F);
  glm::dvec2 f(0.0);
  int g = 0;
  read.number("a", a, 0.0, 2.0);
  read.number("missing", missing, 0.0, 1.0);
  read.flag("b", b);
  read.text("c", c);
  read.texts("d", d);
  read.colour("e", e);
  read.pair("f", f, 0.0, 3.0);
  read.word<int>("g", g, {{"one", 1}, {"two", 2}});
  read.end();
  EXPECT_EQ(a, 2.0);
  EXPECT_EQ(missing, 7.0);
  EXPECT_TRUE(b);
  EXPECT_EQ(c, "x");
  EXPECT_THAT(d, ElementsAre("p", "q"));
  EXPECT_EQ(e, glm::vec3(128.F / 255.F, 64.F / 255.F, 0.F));
  EXPECT_EQ(f, glm::dvec2(1.0, 2.5));
  EXPECT_EQ(g, 2);
}

TEST(ConfigReader, SaysWhereAndWhatIsAllowed) {
  const std::string name = "mine.toml";
  const auto message = [&](const std::string& text, const std::function<void(ConfigReader&)>& ask) {
    return test::usage_error([&] {
      const ConfigValue value = parse_config(text, name);
      ConfigReader read(value, name);
      ask(read);
      read.end();
    });
  };
  double number = 0.0;
  glm::dvec2 pair(0.0);
  glm::vec3 colour(0.F);
  int word = 0;
  EXPECT_THAT(message("\na = 3\n", [&](ConfigReader& r) { r.number("a", number, 0.0, 2.0); }),
              AllOf(HasSubstr("mine.toml:2"), HasSubstr("0 … 2")));
  EXPECT_THAT(message("a = nan\n", [&](ConfigReader& r) { r.number("a", number, 0.0, 2.0); }),
              HasSubstr("finite number"));
  EXPECT_THAT(message("a = [1]\n", [&](ConfigReader& r) { r.pair("a", pair, 0.0, 2.0); }),
              HasSubstr("two numbers"));
  EXPECT_THAT(message("a = [1, 3]\n", [&](ConfigReader& r) { r.pair("a", pair, 0.0, 2.0); }),
              HasSubstr("two numbers"));
  EXPECT_THAT(message("a = \"#12345g\"\n", [&](ConfigReader& r) { r.colour("a", colour); }),
              HasSubstr("#rrggbb"));
  EXPECT_THAT(message("a = \"three\"\n",
                      [&](ConfigReader& r) {
                        r.word<int>("a", word, {{"one", 1}, {"two", 2}});
                      }),
              HasSubstr("\"one\", \"two\""));
  EXPECT_THAT(message("other = 1\n", [&](ConfigReader& r) { r.number("a", number, 0.0, 2.0); }),
              HasSubstr("other"));
}

TEST(ConfigReader, NamedDocumentsAreBuiltInOrFiles) {
  const NamedConfig summer = read_named_config("palettes", "summer", "palette");
  EXPECT_EQ(summer.name, "palettes/summer.toml");
  EXPECT_NE(find(as_table(summer.root, summer.name), "classes"), nullptr);
  const test::Folder folder;
  const std::string path = folder.write("own.toml", "a = 1\n");
  const NamedConfig own = read_named_config("palettes", path, "palette");
  EXPECT_EQ(own.name, path);
  EXPECT_EQ(as_integer(required(own.root, "a", path, "a number"), path), 1);
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [] { read_named_config("palettes", "sumer", "palette"); }),
      HasSubstr("unknown palette \"sumer\"; did you mean \"summer\"?"));
  EXPECT_THAT(test::message_of(ErrorKind::input,
                               [] { read_named_config("palettes", "none.toml", "palette"); }),
              HasSubstr("none.toml"));
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [&] { required(own.root, "b", path, "a number"); }),
      HasSubstr("\"b\" is missing"));
}

}  // namespace
}  // namespace belvedere
