// exemplar check, and the notes of synthesize and render about too few texels, as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "base/random.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ExemplarCheck : public Program {
 protected:
  // Class 1 on the left, 2 on the right, four columns of 5 between; class 2 is painted with more
  // contrast below. A white frame is excluded.
  void SetUp() override {
    style_ = write_picture("style.png", 160, 120, [](int x, int y) {
      const auto grey = static_cast<float>(random_index(101, 4, x, y)) / 255.F;
      return x < 80 && x >= 40 ? glm::vec3(3.F * grey / 2.F) : glm::vec3(0.3F + grey / 3.F);
    });
    label_ = write_labels("label.tif", 160, 120, [](int x, int y) {
      return y < 4 ? 255 : x < 80 ? 1 : x < 84 ? 5 : 2;
    });
    altitude_ =
        write_labels("altitude.tif", 160, 120, [](int, int y) { return y < 60 ? y : 100 + y; });
  }
  Outcome check(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"exemplar", "check", "--picture", style_,
                                          "--label",  label_,  "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  std::string style_, label_, altitude_;
};

TEST_F(ExemplarCheck, TellsWhatEachClassServes) {
  ASSERT_THAT(check({"--guide", "altitude", altitude_}),
              Prints(AllOf(HasSubstr("style.png: 160 × 120 texels, 3.3 % of them never copied"),
                           HasSubstr("37 120"), HasSubstr("class 5: only 464 texels"),
                           HasSubstr("class 5: no texel is farther than 8 texels"),
                           HasSubstr("class 2: no texels at altitudes 60 to 159"),
                           Not(HasSubstr("for this picture")))));
}

TEST_F(ExemplarCheck, TellsWhatATargetAsksFor) {
  const std::string target = write_labels("target.tif", 400, 200, [](int x, int y) {
    return x < 100 ? 1 : x < 110 ? 7 : x < 115 ? 8 : y < 100 ? 2 : 5;
  });
  const std::string target_altitude =
      write_labels("target_altitude.tif", 400, 200, [](int x, int) { return x % 200; });
  const Outcome outcome =
      check({"--guide", "altitude", altitude_, "--target", target, "--target-guide", "altitude",
             target_altitude, "--fallback", "7", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("class 1: enough: 22 000 pixels need it, 37 120 can be served; only 58 %"),
            HasSubstr("class 5: too few, strokes will repeat: 28 500 pixels need it, 1 856 can be "
                      "served; 7 125 texels would be needed, there are 464"),
            HasSubstr("altitude costs most"), HasSubstr("guides explain of the paint's variance"),
            HasSubstr("class 7: no texels of its own, 2 000 pixels copy from class 1"),
            HasSubstr("class 8: no texels at all, but 1 000 pixels need it")));
  const std::string json = check({"--target", target, "--json"}).out;
  EXPECT_THAT(json, AllOf(HasSubstr("\"texels_needed\": 7125"), HasSubstr("\"enough\": false"),
                          HasSubstr("\"guides\": []"), HasSubstr("\"stand_ins\": []"),
                          HasSubstr("\"excluded_texels\": 640"), HasSubstr("\"checkerboard\": {")));
}

TEST_F(ExemplarCheck, ThePageShowsPaintsAndWhereTheyAreMissing) {
  const std::string target = write_labels("target.tif", 128, 20, [](int, int) { return 2; });
  const std::string target_altitude =
      write_labels("target_altitude.tif", 128, 20, [](int x, int) { return x; });
  ASSERT_THAT(check({"--guide", "altitude", altitude_, "--target", target, "--target-guide",
                     "altitude", target_altitude, "--report", path("report")}),
              Ends(0));
  const std::string page = read_bytes(path("report/index.html"));
  EXPECT_THAT(page,
              AllOf(HasSubstr("\"id\": \"verdict\""), HasSubstr("class 5: only 464 texels"),
                    HasSubstr("swatch_1_5.png"),
                    HasSubstr("belvedere exemplar check --picture style.png --label label.tif"),
                    Not(HasSubstr(path("")))));
  // The second class's row: texels up to 59, asked for up to 127.
  const std::string json = read_bytes(path("report/report.json"));
  const auto values_of = [&](const std::string& key) {
    const std::size_t row = json.find("\"name\": \"class 2\"", json.find("\"coverage\": {"));
    const std::size_t from = json.find('[', json.find("\"" + key + "\":", row)) + 1;
    std::istringstream numbers(json.substr(from, json.find(']', from) - from));
    std::vector<int> values;
    for (std::string number; std::getline(numbers, number, ',');)
      values.push_back(std::stoi(number));
    values.resize(256, -1);
    return values;
  };
  const std::vector<int> texels = values_of("counts");
  const std::vector<int> asked = values_of("asked");
  for (const std::size_t value : {5, 30, 59, 160, 219}) EXPECT_GT(texels[value], 0) << value;
  for (const std::size_t value : {0, 60, 100, 159, 220}) EXPECT_EQ(texels[value], 0) << value;
  for (const std::size_t value : {0, 30, 127}) EXPECT_GT(asked[value], 0) << value;
  for (const std::size_t value : {128, 255}) EXPECT_EQ(asked[value], 0) << value;
  EXPECT_THAT(json, HasSubstr("\"covered\": 0."));
}

TEST_F(ExemplarCheck, RefusesWhatCannotBeMeant) {
  const auto refused = [&](int status, const std::vector<std::string>& arguments,
                           const std::string& words) {
    EXPECT_THAT(run(arguments), Ends(status, HasSubstr(words)));
  };
  refused(2, {"exemplar"},
          "missing subcommand of belvedere exemplar\n  allowed: check, paint, pick, register, "
          "segment;");
  refused(2, {"exemplar", "check", "--label", label_}, "--picture is missing");
  refused(2, {"exemplar", "check", "--picture", style_}, "1 --picture but 0 --label");
  refused(2, {"exemplar", "check", "scene.toml", "--picture", style_, "--label", label_},
          "either a scene");
  refused(
      2,
      {"exemplar", "check", "--picture", style_, "--label", label_, "--target-guide", "a", label_},
      "without --target");
  refused(2,
          {"exemplar", "check", "--picture", style_, "--label", label_, "--target", label_,
           "--target-guide", "a", label_},
          "without --guide a");
  refused(2,
          {"exemplar", "check", "--picture", style_, "--label",
           write_labels("small.tif", 9, 9, [](int, int) { return 1; })},
          "9 × 9");
  refused(2, {"exemplar", "check", style_}, "is a picture, not a scene");
  refused(3, {"exemplar", "check", path("none.toml")}, "none.toml");
  refused(
      4,
      {"exemplar", "check", "--picture", style_, "--label", label_, "--report", label_ + "/report"},
      "label.tif");
}

// A painting with as many texels of each class: 96 × 96, columns of 8.
class SceneExemplarCheck : public Program {
 protected:
  std::string write_scene() const {
    write_picture("painting.png", 96, 96, [](int x, int y) {
      return glm::vec3(static_cast<float>(random_index(101, 4, x, y)) / 255.F);
    });
    write_labels("classes.tif", 96, 96, [](int x, int) { return x / 8; });
    write_labels("altitude.tif", 96, 96, [](int, int y) { return y; });
    return write_scene_file(
        "[[exemplar]]\npicture = \"painting.png\"\nclasses = \"classes.tif\"\naltitude = "
        "\"altitude.tif\"\n"
        "altitude_range_m = [0, 5100]\n");
  }
};

TEST_F(SceneExemplarCheck, ASceneIsJudgedByItsOwnNames) {
  const Outcome outcome =
      run({"exemplar", "check", write_scene(), "--set", "synthesis.enabled=true", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  // Rows are 20 m apart, as wide as a step of the guide.
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("painting.png: 96 × 96 texels"),
                                 HasSubstr("forest: only 768 texels"), HasSubstr("80 m … 1820 m"),
                                 HasSubstr("for this picture"), Not(HasSubstr("class 4"))));
  // 96 × 64 pixels are few; a hundred times as many are not.
  EXPECT_THAT(outcome.out, Not(HasSubstr("too few, strokes")));
  const Outcome large =
      run({"exemplar", "check", path("scene.toml"), "--set", "synthesis.enabled=true", "--set",
           "output.width=960", "--set", "output.height=640", "--quiet"});
  EXPECT_THAT(large.out, HasSubstr("forest: too few, strokes will repeat"));
  // Both are counted on small traces, of 96 and of 480 pixels, but reported for the picture.
  const auto forest = [](const std::string& text) {
    std::smatch found;
    const bool there =
        std::regex_search(text, found, std::regex("forest: [^:]*: ([0-9 ]+) pixels"));
    std::string digits = there ? found[1].str() : "0";
    digits.erase(std::remove(digits.begin(), digits.end(), ' '), digits.end());
    return std::stod(digits);
  };
  EXPECT_NEAR(forest(large.out) / forest(outcome.out), 100.0, 10.0);
}

TEST_F(SceneExemplarCheck, RenderSaysWhichClassHasTooFewTexels) {
  ASSERT_THAT(run({"render", write_scene(), "--set", "synthesis.enabled=true", "--set",
                   "output.width=240", "--set", "output.height=160", "--out", path("result")}),
              Ends(0, AllOf(HasSubstr("too few texels, so strokes will repeat: "),
                            HasSubstr("forest (each texel serves "),
                            HasSubstr("768 are available)"), Not(HasSubstr("class 4")))));
}

// ---- the note before the work

TEST_F(ExemplarCheck, SynthesizeSaysWhichClassHasTooFewTexels) {
  const std::string target =
      write_labels("target.tif", 100, 60, [](int x, int) { return x < 50 ? 1 : 5; });
  ASSERT_THAT(
      run({"synthesize", "--picture", style_, "--label", label_, target, "--out", path("out.png")}),
      Ends(0, AllOf(HasSubstr("too few texels"),
                    HasSubstr("class 5 (each texel serves 6 pixels; 750 texels are needed"),
                    Not(HasSubstr("class 1")))));
  const std::string small = write_labels("small.tif", 40, 20, [](int, int) { return 5; });
  EXPECT_THAT(
      run({"synthesize", "--picture", style_, "--label", label_, small, "--out", path("out.png")})
          .err,
      Not(HasSubstr("too few texels")));
}

}  // namespace
}  // namespace belvedere
