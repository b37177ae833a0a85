#include "base/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <clocale>
#include <filesystem>
#include <functional>
#include <locale>

#include "base/error.h"
#include "base/text/embedded.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using test::input_error;
using test::usage_error;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

double seconds(const std::function<void()>& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Config, KeepsOrderPlacesAndTypes) {
  const ConfigValue root = parse_config(
      "zebra = 1\n"
      "  apple = 2.5\n"
      "[table]\n"
      "flag = true\n"
      "list = [1, \"two\"]\n"
      "day = 2024-06-21T12:30:00+02:00\n",
      "x.toml");
  const ConfigTable& table = as_table(root, "x.toml");
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[0].key, "zebra");
  EXPECT_EQ(table[1].key, "apple");
  EXPECT_EQ(table[1].key_position.line, 2);
  EXPECT_EQ(table[1].key_position.column, 3);
  EXPECT_EQ(table[1].value.position.column, 11);
  EXPECT_EQ(as_integer(table[0].value, ""), 1);
  EXPECT_EQ(as_number(table[0].value, ""), 1.0);
  EXPECT_EQ(as_number(table[1].value, ""), 2.5);
  const ConfigTable& inner = as_table(table[2].value, "");
  EXPECT_TRUE(as_bool(*find(inner, "flag"), ""));
  EXPECT_EQ(as_string(as_array(*find(inner, "list"), "")[1], ""), "two");
  EXPECT_EQ(as_string(*find(inner, "day"), ""), "2024-06-21T12:30:00+02:00");
  EXPECT_EQ(find(inner, "absent"), nullptr);
}

TEST(Config, SyntaxErrorsNameThePlace) {
  EXPECT_THAT(usage_error([] { parse_config("a = 1\nb = = 2\n", "s.toml"); }),
              StartsWith("s.toml:2:5: "));
  EXPECT_THAT(usage_error([] { parse_config("a = 1\na = 2\n", "s.toml"); }),
              StartsWith("s.toml:2:"));
  EXPECT_THAT(usage_error([] { parse_config("a = 'open\n", "s.toml"); }), StartsWith("s.toml:1:"));
}

// A backslash in "…" begins an escape: what fails on it or contains what it stands for says so.
TEST(Config, BackslashesInPathsAreExplained) {
  for (const char* text : {R"(a = "C:\data\dem.tif")", R"(a = "C:\users")", R"(a = "C:\xfer")",
                           "a = \"new\\\"\nb = 1\n", R"(a = """\d""")"}) {
    const Error error = test::error_of([&] { parse_config(text, "s.toml"); });
    EXPECT_EQ(error.where().substr(0, 9), "s.toml:1:") << text;
    EXPECT_THAT(error.allowed(), HasSubstr("single quotation marks")) << text;
  }
  EXPECT_THAT(usage_error([] { parse_config("a = \"open\n", "s.toml"); }),
              testing::Not(HasSubstr("single quotation")));
  const ConfigValue root = parse_config("a = \"C:\\new\\tab.tif\"\nb = 'C:\\new'\n", "s.toml");
  const ConfigTable& table = as_table(root, "s.toml");
  const Error error = test::error_of([&] { as_path(*find(table, "a"), "s.toml"); });
  EXPECT_EQ(error.where(), "s.toml:1:5");
  EXPECT_EQ(error.found(), R"("C:\new\tab.tif" was read as C:, a line feed, ew, a tab, ab.tif)");
  EXPECT_EQ(as_path(*find(table, "b"), "s.toml"), R"(C:\new)");
  EXPECT_EQ(misread_path("\x01\x7f"), R"("\u0001\u007f" was read as a control character, )"
                                      "a control character");
}

TEST(Config, TextIsUtf8WithOrWithoutAMark) {
  EXPECT_EQ(as_table(parse_config("\xef\xbb\xbf"
                                  "a = 1\r\nb = 2\r\n",
                                  "s.toml"),
                     "s.toml")
                .size(),
            2U);
  EXPECT_THAT(usage_error([] { parse_config("a = 1\n# W\xf6rner\n", "s.toml"); }),
              testing::AllOf(StartsWith("s.toml:2:4: "), HasSubstr("iconv")));
  EXPECT_THAT(usage_error([] {
                parse_config(std::string("\xff\xfe"
                                         "a\0=\0",
                                         6),
                             "s.toml");
              }),
              HasSubstr("UTF-16LE"));
}

// Headers without a key trigger an assertion inside the library: reported like any other error.
TEST(Config, BrokenHeadersAreSyntaxErrors) {
  for (const char* header : {"[=a]", "[[[a]]]", "[[ ]]", "[,]", "[\n", "[[\na]]"})
    for (const std::string before : {"", "b = 1\nc = \"\"\"\n\"\"\"\n"})
      EXPECT_THAT(usage_error([&] { parse_config(before + header + "\nd = 2\n", "s.toml"); }),
                  StartsWith(before.empty() ? "s.toml:1:" : "s.toml:4:"))
          << header;
  EXPECT_EQ(as_string(parse_config_value("=a", "--set"), "--set"), "=a");
}

// Letters beyond ASCII outside of quotation marks, and after a line that goes on: the library's
// undefined behaviour, which sanitizers find.
TEST(Config, LettersBeyondAsciiBelongIntoQuotationMarks) {
  for (const char* text : {"h\u00f6he = 3", "a = [1, \u00a9 2]", "[[regio\u01e2\n]]",
                           "a = 1 \u00e9", "\u3001 = 1", "a = \uff01"}) {
    const Error error = test::error_of([&] { parse_config(text, "x.toml"); });
    EXPECT_EQ(error.kind(), ErrorKind::usage) << text;
    EXPECT_EQ(error.where().substr(0, 8), "x.toml:1") << text;
  }
  const ConfigValue root =
      parse_config("\"h\u00f6he\" = \"\"\"a\\\n   \u00f6\u3000\u0416\"\"\"", "x.toml");
  EXPECT_EQ(as_string(*find(as_table(root, "x.toml"), "h\u00f6he"), "x.toml"),
            "a\u00f6\u3000\u0416");
}

TEST(Config, BrokenUtf8NamesThePlace) {
  EXPECT_THAT(usage_error([] { parse_config("a = 1\nb = \"\xff\xfe\"\n", "s.toml"); }),
              StartsWith("s.toml:2:"));
  EXPECT_THAT(usage_error([] { parse_config(std::string("a = \"\0\"\n", 8), "s.toml"); }),
              StartsWith("s.toml:1:"));
}

// Every form of nesting, 10,000 and 300,000 deep, gives a message at once and does not exhaust the
// stack.
TEST(Config, DeepNestingIsRefused) {
  for (const int depth : {10'000, 300'000}) {
    const auto times = [&](const std::string& text) {
      std::string out;
      for (int i = 0; i < depth && out.size() + 20 < (1U << 20); ++i) out += text;
      return out;
    };
    for (const std::string& text :
         {"a = " + times("["), "a = " + times("{a="), times("a.") + "a = 1",
          "[" + times("a.") + "a]\n", times("["), "a = [" + times("{a.b=["),
          "a = [1,\n# [[[\n \"]\", '''\n]''', " + times("[")}) {
      std::string message;
      EXPECT_LT(seconds([&] { message = usage_error([&] { parse_config(text, "deep.toml"); }); }),
                1.0);
      EXPECT_THAT(message, AllOf(StartsWith("deep.toml:"), HasSubstr("100 levels")))
          << text.substr(0, 20);
    }
  }
}

TEST(Config, NestingUpToTheLimitIsRead) {
  const auto nested = [](int depth) {
    return "a = " + std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_NO_THROW(parse_config(nested(99), "x"));
  EXPECT_THAT(usage_error([&] { parse_config(nested(101), "x"); }), HasSubstr("nested too deeply"));
  // Breadth is not depth: dots of numbers, many tables, brackets in strings and comments.
  std::string broad = "a = [";
  for (int i = 0; i < 5000; ++i) broad += "1.5, ";
  broad += "]\n";
  for (int i = 0; i < 500; ++i)
    broad += "[t" + std::to_string(i) +
             ".u.v]\nx.y = { p.q = 1.5, r.s = [1.5, 2.5] } # [[[[\ns = '[[[['\n";
  EXPECT_NO_THROW(parse_config(broad, "x"));
}

TEST(Config, HugeTextIsRefusedUnread) {
  const test::Folder folder;
  const std::string path = folder.write("huge.toml", "\n");
  std::filesystem::resize_file(path, 100'000'000);  // sparse: takes no disk
  std::string message;
  EXPECT_LT(seconds([&] { message = usage_error([&] { read_config(path); }); }), 0.5);
  EXPECT_THAT(message, AllOf(HasSubstr("huge.toml"), HasSubstr("1 MiB")));
  EXPECT_THAT(usage_error([&] { read_config("/dev/zero"); }), HasSubstr("1 MiB"));
  EXPECT_THAT(input_error([] { read_config("/nowhere/x.toml"); }), HasSubstr("/nowhere/x.toml"));
  EXPECT_THAT(input_error([] { read_config("/tmp"); }), HasSubstr("folder"));
}

// A program with a German locale: decimal commas, thousands separated by dots, in C++ streams and,
// if that locale is installed, in C.
struct GermanNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Config, LocaleChangesNothing) {
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new GermanNumbers));
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  const ConfigValue root =
      parse_config("a = 1.5\nb = 1_000.25e-2\nc = 1234\nd = 2024-06-21\n", "x");
  const std::string words = describe(as_table(root, "x")[0].value);
  const ConfigValue set = parse_config_value("-20.5", "--set");
  std::locale::global(before);
  std::setlocale(LC_NUMERIC, "C");
  EXPECT_EQ(as_number(*find(as_table(root, "x"), "a"), "x"), 1.5);
  EXPECT_EQ(as_number(*find(as_table(root, "x"), "b"), "x"), 10.0025);
  EXPECT_EQ(as_integer(*find(as_table(root, "x"), "c"), "x"), 1234);
  EXPECT_EQ(as_string(*find(as_table(root, "x"), "d"), "x"), "2024-06-21");
  EXPECT_EQ(as_number(set, "x"), -20.5);
  EXPECT_EQ(words, "the number 1.5");
}

TEST(Config, CommandLineValues) {
  const auto text = [](const char* value) {
    return as_string(parse_config_value(value, "--set"), "--set");
  };
  EXPECT_EQ(as_number(parse_config_value("-20.5", "--set"), ""), -20.5);
  EXPECT_TRUE(as_bool(parse_config_value("true", "--set"), ""));
  EXPECT_EQ(as_array(parse_config_value("[1, 2, 3]", "--set"), "").size(), 3U);
  EXPECT_EQ(text("winter"), "winter");
  EXPECT_EQ(text("EPSG:32632"), "EPSG:32632");
  EXPECT_EQ(text("my dem.tif"), "my dem.tif");
  EXPECT_EQ(text("\"quoted\""), "quoted");
  EXPECT_EQ(text("1.2.3"), "1.2.3");
  EXPECT_EQ(text(""), "");
  EXPECT_EQ(parse_config_value("3", "--set").position.line, 0);
  EXPECT_THAT(usage_error([] { parse_config_value("[1, 2", "--set x"); }), StartsWith("--set x: "));
  EXPECT_THAT(usage_error([] { parse_config_value("1\nother = 2", "--set x"); }),
              HasSubstr("one value"));
}

TEST(Config, StrictAccessNamesFindingAndWhatIsAllowed) {
  const ConfigValue root = parse_config("n = \"abc\"\nx = nan\ni = 1.5\n", "p.toml");
  const ConfigTable& table = as_table(root, "p.toml");
  EXPECT_THAT(
      usage_error([&] { as_number(*find(table, "n"), "p.toml"); }),
      AllOf(StartsWith("p.toml:1:5: "), HasSubstr("the string \"abc\""), HasSubstr("a number")));
  EXPECT_THAT(usage_error([&] { as_number(*find(table, "x"), "p.toml"); }), HasSubstr("finite"));
  EXPECT_THAT(usage_error([&] { as_integer(*find(table, "i"), "p.toml"); }),
              HasSubstr("whole number"));
  EXPECT_THAT(usage_error([&] {
                allow_only(table, {"name", "x", "i"}, "p.toml");
              }),
              AllOf(StartsWith("p.toml:1:1: "), HasSubstr("name, x, i")));
}

TEST(Config, NearestWord) {
  const std::vector<std::string> keys = {"azimuth_deg", "altitude_deg", "time"};
  EXPECT_EQ(nearest_word("azimut_deg", keys), "azimuth_deg");
  EXPECT_EQ(nearest_word("Altitude_Deg", keys), "altitude_deg");
  EXPECT_EQ(nearest_word("tmie", keys), "time");
  EXPECT_EQ(nearest_word("itme", {"ixxe", "time"}), "time")
      << "letters are swapped at the start too";
  EXPECT_EQ(nearest_word("time_utc", keys), "time");
  EXPECT_EQ(nearest_word("azimuth", keys), "azimuth_deg");
  EXPECT_EQ(nearest_word("palette", keys), "");
  EXPECT_EQ(nearest_word(std::string(100'000, 'a'), keys), "");
}

TEST(Config, EveryEmbeddedFileParses) {
  for (const std::string folder : {"palettes", "legends", "layers"})
    for (const std::string& name : embedded_names(folder)) {
      const std::string file = folder + "/" + name + ".toml";
      EXPECT_NO_THROW(parse_config(embedded_file(file), file)) << file;
    }
}

}  // namespace
}  // namespace belvedere
