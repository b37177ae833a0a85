// synthesize --report, as users meet it.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>

#include "base/random.h"
#include "tests/grids.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

int style_altitude(int x, int y) { return (x + 2 * y) % 200; }
int target_altitude(int x, int y) { return (2 * x + y) % 150; }

class SynthesisReport : public Program {
 protected:
  void SetUp() override {
    style_ = write_picture("style.png", 120, 96, [](int x, int y) {
      const auto grey = static_cast<float>(random_index(120, 4, x / 3, y)) / 255.F;
      return x < 60 ? glm::vec3(0.4F + grey, grey, grey) : glm::vec3(grey, 0.4F + grey, grey);
    });
    label_ = write_labels("style_class.tif", 120, 96, [](int x, int y) {
      return y < 2 ? 255 : x < 60 ? 1 : x < 64 ? 6 : 2;
    });
    target_ = write_labels("target_class.tif", 100, 90, [](int x, int y) {
      return x < 40 ? 2 : y < 60 ? 1 : x < 90 ? 6 : 7;
    });
    style_altitude_ = write_labels("style_altitude.tif", 120, 96, style_altitude);
    target_altitude_ = write_labels("target_altitude.tif", 100, 90, target_altitude);
  }
  Outcome report(const std::string& folder, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "synthesize", "--picture", style_,          "--label",        label_,    target_,
        "--guide",    "altitude",  style_altitude_, target_altitude_, "0.5",     "--fallback",
        "7",          "1",         "--out",         path("out.png"),  "--match", path("match.exr"),
        "--report",   path(folder)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  static double number(const std::string& json, const std::string& before) {
    std::smatch found;
    if (!std::regex_search(json, found, std::regex(before + "[^0-9-]*(-?[0-9.e+-]+)")))
      ADD_FAILURE() << before;
    return found.empty() ? 0.0 : std::stod(found[1].str());
  }
  std::string style_, label_, target_, style_altitude_, target_altitude_;
};

TEST_F(SynthesisReport, ShowsEverythingAndItsPicturesLieBesideThePage) {
  ASSERT_THAT(report("report"), Ends(0));
  const std::string page = read_bytes(path("report/index.html"));
  for (const char* id : {"overview", "figures", "classes", "costs", "field", "reuse", "worst"})
    EXPECT_THAT(page, HasSubstr(fmt::format("\"id\": \"{}\"", id)));
  EXPECT_THAT(page, AllOf(HasSubstr("belvedere synthesize --picture style.png --label "
                                    "style_class.tif target_class.tif --guide altitude"),
                          HasSubstr("altitude off"), HasSubstr("texels used often"),
                          Not(HasSubstr("http")), Not(HasSubstr("nan")), Not(HasSubstr(path("")))));
  const std::regex image("\"src\": \"([^\"]+)\",\\s+\"width\": ([0-9]+),\\s+\"height\": ([0-9]+)");
  std::set<std::string> shown;
  for (std::sregex_iterator i(page.begin(), page.end(), image); i != std::sregex_iterator(); ++i) {
    const ImageInfo info = read_image_info(path("report/" + (*i)[1].str()));
    EXPECT_EQ(info.width, std::stoi((*i)[2].str()));
    EXPECT_EQ(info.height, std::stoi((*i)[3].str()));
    EXPECT_TRUE(shown.insert((*i)[1].str()).second) << "shown twice";
  }
  EXPECT_GE(shown.size(), 20U);
  std::set<std::string> written;
  for (const auto& entry : fs::directory_iterator(path("report")))
    if (entry.path().extension() == ".png") written.insert(entry.path().filename().string());
  EXPECT_EQ(written, shown);
  // Each of the worst windows has a row of its own.
  const std::string worst = page.substr(page.find("\"id\": \"worst\""));
  const auto count = [&](const std::regex& what) {
    return std::distance(std::sregex_iterator(worst.begin(), worst.end(), what),
                         std::sregex_iterator());
  };
  const auto windows = count(std::regex("place_[A-Z]+_picture\\.png"));
  EXPECT_GT(windows, 1);
  EXPECT_EQ(count(std::regex("\"pictures\":")), windows);
}

// Counted again from the match field beside it.
TEST_F(SynthesisReport, NumbersAreThoseOfTheMatches) {
  ASSERT_EQ(report("report").status, 0);
  const std::string json = read_bytes(path("report/report.json"));
  const Grid<std::uint32_t> exemplar = read_id_channel(path("match.exr"), "exemplar");
  const Grid<std::uint32_t> xs = read_id_channel(path("match.exr"), "x");
  const Grid<std::uint32_t> ys = read_id_channel(path("match.exr"), "y");
  double error = 0.0;
  double squares = 0.0;
  std::size_t max = 0;
  Grid<std::size_t> uses(120, 96, 0);
  for (const auto [x, y] : test::cells(100, 90)) {
    ASSERT_EQ(exemplar(x, y), 0U);
    const int tx = static_cast<int>(xs(x, y));
    const int ty = static_cast<int>(ys(x, y));
    const double off = std::abs(style_altitude(tx, ty) - target_altitude(x, y));
    error += off;
    squares += off * off;
    max = std::max(max, ++uses(tx, ty));
  }
  const std::string guide = "\"name\": \"altitude\"[^}]*";
  EXPECT_NEAR(number(json, guide + "\"error_mean\""), error / 9000.0, 1e-9);
  EXPECT_NEAR(number(json, guide + "\"cost_mean\""), 270.0 * 0.5 * squares / 9000.0,
              1e-6 * squares);
  EXPECT_EQ(number(json, guide + "\"weight\""), 0.5);
  EXPECT_EQ(number(json, "\"most_used\",[^}]*\"value\": \\{[^}]*\"value\""),
            static_cast<double>(max));
  EXPECT_EQ(number(json, "\"without_texel\",[^}]*\"value\": \\{[^}]*\"value\""), 0.0);
  // 1500 pixels need class 6, whose 376 texels serve 1504; class 7 falls back to 1.
  EXPECT_THAT(json, AllOf(HasSubstr("\"texels\": 376"), HasSubstr("\"asked\": 1500"),
                          HasSubstr("\"asked\": 3900")));
  for (const char* letter : {"A", "B", "C", "D"}) {
    const std::string position = fmt::format("\"letter\": \"{}\"[^}}]*\"x\": ", letter);
    EXPECT_GE(number(json, position), 0.0);
    EXPECT_LE(number(json, position), 36.0);
  }
}

TEST_F(SynthesisReport, OfSeveralPaintingsTellsTheirSeams) {
  ASSERT_EQ(report("one").status, 0);
  EXPECT_THAT(read_bytes(path("one/report.json")), Not(HasSubstr("seams_between")));
  EXPECT_THAT(read_bytes(path("one/index.html")), Not(HasSubstr("\"id\": \"seams\"")));
  const Outcome outcome =
      run({"synthesize", "--picture", style_,    "--picture",     style_,    "--label",
           label_,       target_,     "--label", label_,          target_,   "--fallback",
           "7",          "1",         "--out",   path("out.png"), "--match", path("match.exr"),
           "--report",   path("two")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string json = read_bytes(path("two/report.json"));
  const Grid<std::uint32_t> exemplar = read_id_channel(path("match.exr"), "exemplar");
  std::size_t pairs = 0;
  for (const auto [x, y] : test::cells(100, 90)) {
    pairs += x < 99 && exemplar(x, y) != exemplar(x + 1, y) ? 1 : 0;
    pairs += y < 89 && exemplar(x, y) != exemplar(x, y + 1) ? 1 : 0;
  }
  EXPECT_GT(pairs, 0U);
  const std::string between = "\"seams\": \"from one painting to another\"[^}]*";
  EXPECT_EQ(number(json, between + "\"pairs\""), static_cast<double>(pairs));
  const double visibility =
      number(json, "\"key\": \"seams_between\"[^}]*\"value\": [^}]*\"value\"");
  EXPECT_GT(visibility, 0.0);
  EXPECT_EQ(number(json, between + "\"visibility\""), visibility);
  EXPECT_THAT(read_bytes(path("two/index.html")), HasSubstr("\"id\": \"seams\""));
}

TEST_F(SynthesisReport, HasTheSameBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(report(threads, {"--threads", threads, "--quiet"}).status, 0);
  for (const auto& entry : fs::directory_iterator(path("1")))
    EXPECT_EQ(read_bytes(entry.path().string()),
              read_bytes(path("2/" + entry.path().filename().string())))
        << entry.path();
}

TEST_F(SynthesisReport, AFolderThatCannotBeMadeIsFoundBeforeTheWork) {
  write("file", "in the way");
  EXPECT_EQ(report("file/report").status, 4);
  EXPECT_FALSE(fs::exists(path("out.png")));
}

}  // namespace
}  // namespace belvedere
