#include "tools/options/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "tests/files.h"
#include "tests/tools/read_options.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;

// The value of one option --x, and of an argument REST behind it.
template <class T>
struct One {
  T value{};
  std::vector<std::string> rest;
};
using Say = void (*)(Option option);

template <class T>
One<T> read_one(
    const std::string& line, Say say = [](Option) {}) {
  return test::read_options<One<T>>(
      [say](CommandOptions& command, One<T>& one) {
        say(command.add_option("--x X", one.value, "A value"));
        command.add_option("REST", one.rest, "Words");
      },
      line);
}
template <class T>
T value_of(
    const std::string& line, Say say = [](Option) {}) {
  return read_one<T>(line, say).value;
}
template <class T>
std::string refusal_of(
    const std::string& line, Say say = [](Option) {}) {
  return test::usage_error([&] { read_one<T>(line, say); });
}

TEST(OptionValues, AreReadAsTheirType) {
  EXPECT_EQ(value_of<std::string>("--x a.tif"), "a.tif");
  EXPECT_EQ(value_of<std::string>("--x=a.tif"), "a.tif");
  EXPECT_EQ(value_of<int>("--x -7"), -7);
  EXPECT_EQ(value_of<std::uint64_t>("--x 18446744073709551615"), 18446744073709551615U);
  EXPECT_EQ(value_of<float>("--x 0.5"), 0.5F);
  EXPECT_EQ(value_of<double>("--x 1e-3"), 0.001);
  EXPECT_EQ(value_of<std::vector<std::string>>("--x a b"), (std::vector<std::string>{"a", "b"}));
  EXPECT_THAT(value_of<std::vector<int>>("--x 1 --x 2"), ElementsAre(1, 2));
  EXPECT_THAT(value_of<std::vector<float>>("--x 1.5 2.5"), ElementsAre(1.5F, 2.5F));
  EXPECT_THAT(value_of<std::vector<double>>("--x 1.5 2.5"), ElementsAre(1.5, 2.5));
}

TEST(OptionValues, OfSeveralWordsAreRepeated) {
  const Say repeated = [](Option option) { option.repeated(); };
  EXPECT_THAT((value_of<std::vector<std::pair<int, int>>>("--x 1 2 --x 3 4", repeated)),
              ElementsAre(Pair(1, 2), Pair(3, 4)));
  EXPECT_THAT((value_of<std::vector<std::pair<std::string, std::string>>>("--x a b", repeated)),
              ElementsAre(Pair("a", "b")));
  EXPECT_THAT(
      (value_of<std::vector<std::tuple<std::string, std::string>>>("--x a b --x c d", repeated)),
      ElementsAre(std::tuple("a", "b"), std::tuple("c", "d")));
  EXPECT_THAT((value_of<std::vector<std::tuple<int, int, double>>>("--x 1 2 0.5", repeated)),
              ElementsAre(std::tuple(1, 2, 0.5)));
  EXPECT_THAT((value_of<std::vector<std::tuple<std::string, std::string, std::string, double>>>(
                  "--x a b c 2 --x d e f 3", repeated)),
              ElementsAre(std::tuple("a", "b", "c", 2.0), std::tuple("d", "e", "f", 3.0)));
  const auto fours = value_of<std::vector<std::vector<double>>>(
      "--x 1 2 3 4 --x 5 6 7 8", [](Option option) { option.words(4).repeated(); });
  EXPECT_THAT(fours, ElementsAre(ElementsAre(1, 2, 3, 4), ElementsAre(5, 6, 7, 8)));
}

TEST(OptionValues, OptionalOnesTellWhetherTheyWereGiven) {
  EXPECT_FALSE(value_of<std::optional<int>>(""));
  EXPECT_EQ(value_of<std::optional<int>>("--x 0"), 0);
  EXPECT_EQ(value_of<std::optional<double>>("--x 0.5"), 0.5);
  EXPECT_EQ(value_of<std::optional<std::uint64_t>>("--x 3"), 3U);
  EXPECT_EQ(value_of<std::optional<std::string>>("--x a"), "a");
}

TEST(OptionValues, ThatAreNoneAreRefused) {
  EXPECT_THAT(refusal_of<int>("--x 1.5"),
              AllOf(HasSubstr("command line"), HasSubstr("--x"), HasSubstr("1.5")));
  EXPECT_THAT(refusal_of<double>("--x much"), HasSubstr("much"));
  EXPECT_THAT(refusal_of<std::uint64_t>("--x 1e3"), HasSubstr("1e3"));
  EXPECT_THAT(refusal_of<int>("--x"), HasSubstr("--x: 1 required X missing"));
  EXPECT_THAT(refusal_of<int>("--y 1"),
              AllOf(HasSubstr("--y"), HasSubstr("allowed: see test --help")));
}

TEST(OptionLists, StandInOneWord) {
  EXPECT_THAT(value_of<std::vector<float>>("--x 1,0.5,0", [](Option option) { option.list(','); }),
              ElementsAre(1.F, 0.5F, 0.F));
  const Say size = [](Option option) { option.list('x', 2); };
  EXPECT_THAT(value_of<std::vector<int>>("--x 300x200", size), ElementsAre(300, 200));
  EXPECT_THAT(refusal_of<std::vector<int>>("--x 300", size),
              HasSubstr("--x: At least 2 required but received 1"));
}

TEST(OptionLists, TakeWordsUpToTheNextOptionUnlessRepeated) {
  using Texts = std::vector<std::string>;
  EXPECT_THAT(read_one<Texts>("--x a b").rest, IsEmpty());
  const One<Texts> one = read_one<Texts>("--x a b --x c", [](Option option) { option.repeated(); });
  EXPECT_THAT(one.value, ElementsAre("a", "c"));
  EXPECT_THAT(one.rest, ElementsAre("b"));
}

TEST(OptionLists, TellOfAnOptionThatComesTooEarly) {
  const Say pair = [](Option option) { option.takes("a painting and a target").repeated(); };
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  EXPECT_THAT((value_of<Pairs>("--x a b", pair)), ElementsAre(Pair("a", "b")));
  EXPECT_THAT(refusal_of<Pairs>("--x a --out", pair),
              HasSubstr("needs a painting and a target, but --out follows"));
}

TEST(OptionChecks, RangesHoldTheirEnds) {
  const Say whole = [](Option option) { option.range(8, 4096); };
  EXPECT_EQ(value_of<int>("--x 8", whole), 8);
  EXPECT_EQ(value_of<int>("--x 4096", whole), 4096);
  EXPECT_THAT(refusal_of<int>("--x 7", whole), HasSubstr("--x: Value 7 not in range 8 to 4096"));
  const Say real = [](Option option) { option.range(0.5, 1.5); };
  EXPECT_EQ(value_of<double>("--x 0.5", real), 0.5);
  EXPECT_THAT(refusal_of<double>("--x 1.6", real), HasSubstr("Value 1.6 not in range"));
  EXPECT_THAT(refusal_of<std::vector<double>>("--x 1 --x 2", real),
              HasSubstr("Value 2 not in range"));
  const Say seed = [](Option option) {
    option.range(std::uint64_t{0}, std::uint64_t{9007199254740992});
  };
  EXPECT_EQ(value_of<std::uint64_t>("--x 9007199254740992", seed), 9007199254740992U);
  EXPECT_THAT(refusal_of<std::uint64_t>("--x 9007199254740993", seed),
              HasSubstr("not in range 0 to 9007199254740992"));
}

TEST(OptionChecks, SignsAndChoices) {
  EXPECT_EQ(value_of<double>("--x 0", [](Option option) { option.not_negative(); }), 0.0);
  EXPECT_THAT(refusal_of<double>("--x -0.1", [](Option option) { option.not_negative(); }),
              HasSubstr("-0.1"));
  const Say words = [](Option option) { option.one_of({"lit", "shaded"}); };
  EXPECT_EQ(value_of<std::string>("--x shaded", words), "shaded");
  EXPECT_THAT(refusal_of<std::string>("--x dark", words),
              HasSubstr("--x: dark not in {lit,shaded}"));
  const Say numbers = [](Option option) { option.one_of({8, 16}); };
  EXPECT_EQ(value_of<int>("--x 16", numbers), 16);
  EXPECT_THAT(refusal_of<int>("--x 12", numbers), HasSubstr("12 not in {8,16}"));
}

struct Several {
  std::string out, mask, legend;
  bool quiet = false;
};
void add_several(CommandOptions& command, Several& several) {
  command.add_option("--out", several.out, "A file").required();
  const Option mask = command.add_option("--mask", several.mask, "A mask");
  command.add_option("--legend", several.legend, "What its numbers mean").needs(mask);
  command.add_flag("--quiet,-q", several.quiet, "No notes").excludes({mask});
}
std::string several_refused(const std::string& line) {
  return test::usage_error([&] { test::read_options<Several>(add_several, line); });
}

TEST(OptionsTogether, AreRequiredNeededAndExcluded) {
  EXPECT_TRUE(test::read_options<Several>(add_several, "--out a -q").quiet);
  EXPECT_FALSE(test::read_options<Several>(add_several, "--out a").quiet);
  EXPECT_EQ(test::read_options<Several>(add_several, "--mask m --legend l --out a").legend, "l");
  EXPECT_THAT(several_refused("--quiet"), HasSubstr("--out is required"));
  EXPECT_THAT(several_refused("--out a --legend l"), HasSubstr("--legend requires --mask"));
  EXPECT_THAT(several_refused("--out a --mask m -q"), HasSubstr("excludes"));
  EXPECT_THAT(several_refused("--out a b"), HasSubstr("b"));
}

TEST(OptionsTogether, AreAmendedByName) {
  const auto without = [](CommandOptions& command, Several& several) {
    add_several(command, several);
    EXPECT_TRUE(command.has_option("--out"));
    EXPECT_FALSE(command.has_option("--in"));
    command.option("--out").required(false);
  };
  EXPECT_EQ(test::read_options<Several>(without, "--mask m").mask, "m");
}

TEST(OptionsTogether, AValueMayComeFromTheEnvironment) {
  const Say mirror = [](Option option) { option.environment("BELVEDERE_TEST_OPTION"); };
  setenv("BELVEDERE_TEST_OPTION", "there", 1);
  EXPECT_EQ(value_of<std::string>("", mirror), "there");
  EXPECT_EQ(value_of<std::string>("--x here", mirror), "here");
  unsetenv("BELVEDERE_TEST_OPTION");
  EXPECT_EQ(value_of<std::string>("", mirror), "");
}

class Tree : public ::testing::Test {
 protected:
  Tree() {
    line_.options().footer("Below all.");
    info_.add_option("FILE", file_, "A file").required();
    paint_.add_option("--size,-s PX", size_, "Side in pixels").show_default().range(256, 16384);
    paint_.add_option("--season NAME", season_, "Palette").one_of({"summer", "winter"});
    paint_.add_flag("--json", json_, "As JSON");
    paint_.footer("Paints.");
  }
  std::string refusal(const std::vector<std::string>& words) {
    return test::usage_error([&] { line_.read(words); });
  }

  CommandLine line_{"program", "What it is for", "program 7"};
  CommandOptions info_ = line_.options().add_command("info", "Says what a file holds");
  CommandOptions exemplar_ = line_.options().add_command("exemplar", "About paintings");
  CommandOptions paint_ = exemplar_.add_command("paint", "Paints one");
  std::string file_, season_;
  int size_ = 4096;
  bool json_ = false;
};

TEST_F(Tree, OfCommandsOneIsNamed) {
  EXPECT_EQ(line_.read({"exemplar", "paint", "-s", "512"}), "");
  EXPECT_TRUE(paint_.is_named());
  EXPECT_TRUE(exemplar_.is_named());
  EXPECT_FALSE(info_.is_named());
  EXPECT_EQ(size_, 512);
  EXPECT_EQ(line_.read({"info", "a.tif"}), "");
  EXPECT_TRUE(info_.is_named());
  EXPECT_FALSE(paint_.is_named());
  EXPECT_EQ(file_, "a.tif");
}

TEST_F(Tree, WithoutACommandNothingCanBeMeant) {
  EXPECT_THAT(refusal({}), HasSubstr("allowed: see program --help, or program COMMAND --help"));
  EXPECT_THAT(refusal({"exemplar"}), HasSubstr("required"));
  EXPECT_THAT(refusal({"info"}), HasSubstr("FILE is required"));
}

TEST_F(Tree, HelpAndVersionAreTexts) {
  EXPECT_EQ(line_.read({"--version"}), "program 7\n");
  EXPECT_EQ(line_.read({"exemplar", "paint", "--help"}),
            "Paints one\n"
            "Usage: program exemplar paint [OPTIONS]\n\n"
            "Options:\n"
            "  -h,--help                       Print this help message and exit\n"
            "  -s,--size PX:INT in [256 - 16384]=4096\n"
            "                                  Side in pixels\n"
            "  --season NAME:{summer,winter}   Palette\n"
            "  --json                          As JSON\n\n"
            "Paints.\n");
  EXPECT_THAT(line_.read({"--help"}), AllOf(HasSubstr("What it is for"), HasSubstr("Below all."),
                                            Not(HasSubstr("Paints."))));
}

TEST_F(Tree, IsDescribed) {
  const CommandDescription program = line_.options().describe();
  EXPECT_EQ(program.name, "program");
  EXPECT_EQ(program.meaning, "What it is for");
  EXPECT_EQ(program.footer, "Below all.");
  ASSERT_EQ(program.commands.size(), 2U);
  const OptionDescription& file = program.commands[0].options.back();
  EXPECT_THAT(file.names, ElementsAre("FILE"));
  EXPECT_TRUE(file.positional);
  EXPECT_TRUE(file.required);
  ASSERT_EQ(program.commands[1].commands.size(), 1U);
  const CommandDescription& paint = program.commands[1].commands[0];
  EXPECT_EQ(paint.name, "program exemplar paint");
  EXPECT_EQ(paint.word(), "paint");
  ASSERT_EQ(paint.options.size(), 4U);  // the first is --help
  EXPECT_THAT(paint.options[1].names, ElementsAre("--size", "-s"));
  EXPECT_EQ(paint.options[1].value, "PX");
  EXPECT_EQ(paint.options[1].range, "256 … 16384");
  EXPECT_EQ(paint.options[1].preset, "4096");
  EXPECT_FALSE(paint.options[1].required);
  EXPECT_EQ(paint.options[2].value, "NAME");
  EXPECT_THAT(paint.options[2].choices, ElementsAre("summer", "winter"));
  EXPECT_EQ(paint.options[3].value, "");
}

RunOptions read_run_options(const std::string& line) {
  return test::read_options<RunOptions>(
      [](CommandOptions& command, RunOptions& options) { add_run_options(command, options); },
      line);
}

TEST(RunOptions, AreThreadsQuietAndJson) {
  const RunOptions none = read_run_options("");
  EXPECT_EQ(none.threads, 0);
  EXPECT_FALSE(none.quiet || none.json);
  const RunOptions all = read_run_options("--threads 3 -q --json");
  EXPECT_EQ(all.threads, 3);
  EXPECT_TRUE(all.quiet && all.json);
  EXPECT_TRUE(read_run_options("--quiet").quiet);
  EXPECT_THAT(test::usage_error([] { read_run_options("--threads -1"); }),
              testing::HasSubstr("--threads"));
}

}  // namespace
}  // namespace belvedere::tools
