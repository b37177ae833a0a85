#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>

#include "base/text/text_encoding.h"
#include "tests/grids.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/tools/cli/bands.h"
#include "tests/tools/program.h"
#include "tests/tools/report/browser.h"

// `belvedere exemplar segment` as users meet it.
// The page on which groups are merged, split and named: its content, and, if there is a browser,
// the effect of clicks and keys.

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ExemplarSegment : public Program {
 protected:
  // Sky, wood and meadow.
  std::string write_painting(const std::string& name = "painting.png") const {
    return write_picture(name, 120, 90, test::band_colour);
  }
};

TEST_F(ExemplarSegment, WritesAMaskOfClassesThatAnExemplarTakes) {
  ASSERT_THAT(
      run({"exemplar", "segment", write_painting(), "--out", path("mask.png"), "--json", "-q"}),
      Prints(AllOf(HasSubstr("\"groups\""), HasSubstr("\"sky\""), HasSubstr("\"forest\""),
                   HasSubstr("\"pasture\""))));
  const Grid<std::uint16_t> mask = read_grey(path("mask.png"));
  EXPECT_EQ(mask(60, 10), 0);
  EXPECT_EQ(mask(20, 70), 4);
  EXPECT_EQ(mask(100, 70), 10);
  // In a scene.
  const std::string scene =
      write("scene.toml",
            "version = 1\n[[exemplar]]\npicture = \"painting.png\"\nclasses = \"mask.png\"\n" +
                test::small_mountains + "[output]\nwidth = 96\nheight = 64\n");
  ASSERT_THAT(
      run({"exemplar", "check", scene}),
      Prints(AllOf(HasSubstr("forest"), HasSubstr("pasture"), Not(HasSubstr("class 255")))));
}

// What the page saved beside the painting counts in the next run.
TEST_F(ExemplarSegment, WhatWasSaidOfPlacesIsKeptBesideThePainting) {
  const std::string painting = write_painting();
  const std::vector<std::string> segment = {"exemplar",    "segment",      painting, "--out",
                                            path("m.png"), "--max-groups", "3",      "-q"};
  const auto mask = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = segment;
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).status, 0);
    return read_grey(path("m.png"));
  };
  EXPECT_EQ(mask()(20, 70), 4);
  write("painting.names.toml", "[[named]]\nat = [0.2, 0.8]\nclass = \"shrub\"\n");
  EXPECT_EQ(mask()(20, 70), 11);
  EXPECT_EQ(mask()(100, 70), 10);
  const std::string other =
      write("other.toml", "[[named]]\nat = [0.2, 0.8]\nclass = \"not used\"\n");
  EXPECT_EQ(mask({"--names", other})(20, 70), 255);
  EXPECT_THAT(
      run({"exemplar", "segment", painting, "--out", path("m.png"), "--names", other, "--numbers"}),
      Ends(2, HasSubstr("--names")));
}

TEST_F(ExemplarSegment, NumbersOfGroupsAreAtMostThoseAskedFor) {
  ASSERT_EQ(run({"exemplar", "segment", write_painting(), "--out", path("m.png"), "--numbers",
                 "--max-groups", "3", "-q"})
                .status,
            0);
  const Grid<std::uint16_t> mask = read_grey(path("m.png"));
  EXPECT_EQ(std::set<std::uint16_t>(mask.begin(), mask.end()), (std::set<std::uint16_t>{0, 1, 2}));
  // The page shows the paint: group 0 is the sky.
  EXPECT_NEAR(read_picture(path("m.png"))(60, 10).z, .92, .03);
}

TEST_F(ExemplarSegment, SaysHowWellItAgreesWithAMaskDrawnByHand) {
  const std::string painting = write_painting();
  const auto drawn = [&](const std::string& name, int horizon) {
    return write_labels(name, 120, 90, [&](int x, int y) {
      return y < horizon ? 7 : x < 60 ? 8 : 9;
    });
  };
  const auto number = [](const Outcome& outcome, const std::string& key) {
    const std::size_t at = outcome.out.find("\"" + key + "\":");
    return at == std::string::npos ? -1.0 : std::stod(outcome.out.substr(at + key.size() + 3));
  };
  const std::vector<std::string> segment = {"exemplar",    "segment",      painting, "--out",
                                            path("m.png"), "--max-groups", "3",      "--json",
                                            "-q",          "--compare"};
  const auto compared = [&](const std::string& mask) {
    std::vector<std::string> arguments = segment;
    arguments.push_back(mask);
    return run(arguments);
  };
  const Outcome right = compared(drawn("right.tif", 30));
  ASSERT_EQ(right.status, 0) << right.err;
  for (const char* key : {"merged", "one_to_one", "named_one_to_one"})
    EXPECT_GT(number(right, key), .94) << key;
  const Outcome wrong = compared(drawn("wrong.tif", 50));
  EXPECT_NEAR(number(wrong, "merged"), (.6 + 2. / 3. + 2. / 3.) / 3., .03);
  EXPECT_THAT(compared(write_labels("size.tif", 60, 90, [](int x, int) { return x / 20; })),
              Ends(3, HasSubstr("60 × 90")));
}

// Groups of one thing are merged by clicks, a group of two things must be split first: there are as
// many as were asked for.
TEST_F(ExemplarSegment, ThereAreAsManyGroupsAsTheMostUnlessToldHowUnlike) {
  const auto groups = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {
        "exemplar", "segment", write_painting(), "--out", path("m.png"), "--numbers", "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run(arguments).status, 0);
    const Grid<std::uint16_t> mask = read_grey(path("m.png"));
    return std::set<std::uint16_t>(mask.begin(), mask.end()).size();
  };
  EXPECT_EQ(groups({}), 60U);
  EXPECT_EQ(groups({"--max-groups", "7"}), 7U);
  EXPECT_LT(groups({"--groups", "3"}), 7U);
}

// The program as it comes, on a painting whose mask was drawn by hand.
TEST_F(ExemplarSegment, TheGroupsOfMonetsCoastAreMergedToItsMask) {
  const std::string monet = test::data_folder() + "/paintings/monet_etretat";
  if (!std::filesystem::exists(monet + ".jpg")) GTEST_SKIP() << monet << ".jpg is missing";
  const Outcome outcome = run({"exemplar", "segment", monet + ".jpg", "--out", path("m.png"),
                               "--compare", monet + "_labels.png", "--json", "-q"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::size_t at = outcome.out.find("\"merged\":");
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(std::stod(outcome.out.substr(at + 9)), .80);
}

TEST_F(ExemplarSegment, SameBytesForAnyThreads) {
  const std::string painting = write_painting();
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(run({"exemplar", "segment", painting, "--out", path(std::string(threads) + ".png"),
                   "--report", path(std::string(threads) + ".html"), "--threads", threads, "-q"})
                  .status,
              0);
  EXPECT_EQ(read_bytes(path("1.png")), read_bytes(path("2.png")));
}

TEST_F(ExemplarSegment, BadInputIsNamed) {
  const auto refused = [&](const std::vector<std::string>& arguments, int status,
                           const std::string& word) {
    EXPECT_THAT(run(arguments), Ends(status, HasSubstr(word)));
  };
  const std::string painting = write_painting();
  refused({"exemplar", "segment", path("gone.png"), "--out", path("m.png")}, 3, "gone.png");
  refused({"exemplar", "segment", painting, "--out", path("m.tif")}, 2, ".png");
  refused({"exemplar", "segment", painting, "--out", path("m.png"), "--report", path("p.txt")}, 2,
          ".html");
  refused({"exemplar", "segment", painting, "--out", path("m.png"), "--max-groups", "255"}, 2,
          "--max-groups");
  refused({"exemplar", "segment", painting, "--out", painting}, 2, "is also an input");
  const std::string flat =
      write_picture("flat.png", 64, 64, [](int, int) { return glm::vec3(.5F); });
  refused({"exemplar", "segment", flat, "--out", path("m.png")}, 3, "single colour");
  const std::string tiny = write_picture(
      "tiny.png", 64, 16, [](int x, int) { return glm::vec3(static_cast<float>(x) / 64.F); });
  refused({"exemplar", "segment", tiny, "--out", path("m.png")}, 3, "64 × 16");
  EXPECT_FALSE(std::filesystem::exists(path("m.png")));
}

// Cut-out pictures that differ by the colour under their transparency alone.
TEST_F(ExemplarSegment, HiddenColoursAreNotSeen) {
  const Grid<glm::vec3> picture = read_picture(write_painting());
  std::vector<std::string> results;
  for (const std::string& hidden : test::hidden_colours) {
    write("cut.png", test::cut_out(picture, hidden));
    const Outcome outcome = run({"exemplar", "segment", path("cut.png"), "--out", path("m.png"),
                                 "--report", path("m.html"), "-q"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    results.push_back(read_bytes(path("m.png")) + read_bytes(path("m.html")));
  }
  EXPECT_EQ(results[0], results[1]);
}

class SegmentPage : public Program {
 protected:
  // Sky above, wood and meadow below; made in a few groups.
  std::string made_page() const {
    write_picture("painting.png", 120, 90, test::band_colour);
    const Outcome outcome =
        run({"exemplar", "segment", path("painting.png"), "--out", path("mask.png"), "--report",
             path("page.html"), "--max-groups", "3", "-q"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_bytes(path("page.html"));
  }
};

TEST_F(SegmentPage, HoldsPaintingPiecesTreeAndClassesAndNeedsNoNetwork) {
  const std::string page = made_page();
  EXPECT_THAT(page, AllOf(HasSubstr("\"width\": 120"), HasSubstr("\"height\": 90"),
                          HasSubstr("\"mask\": \"mask.png\""), HasSubstr("data:image/png;base64,"),
                          HasSubstr("\"joins\""), HasSubstr("\"alpine_grass\""),
                          HasSubstr("\"questions\""), HasSubstr("painting.names.toml")));
  EXPECT_EQ(page.find("http"), std::string::npos) << "the page must need no network";
}

constexpr const char* segment_clicks = R"(<pre id="clicked"></pre><script>
(async () => {
  const lines = [];
  const say = (line) => { lines.push(line); document.getElementById("clicked").textContent = lines.join("\n"); };
  while (document.getElementById("rows").rows.length === 0) await new Promise((done) => setTimeout(done, 1));
  const click = (x, y, shiftKey = false) => {
    const box = canvas.getBoundingClientRect();
    canvas.dispatchEvent(new MouseEvent("click", { clientX: box.left + (x + .5) / 120 * box.width, clientY: box.top + (y + .5) / 90 * box.height, shiftKey, bubbles: true }));
  };
  const key = (name, more = {}) => document.dispatchEvent(new KeyboardEvent("keydown", { key: name, ...more, bubbles: true }));
  Object.defineProperty(KeyboardEvent.prototype, "target", { get() { return document.body; } });
  const rows = () => [...document.getElementById("rows").rows];
  const names = () => rows().map((row) => row.querySelector("select").selectedOptions[0].text).join();
  const picture = () => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.join();
  const told = () => document.getElementById("says").textContent;
  const press = (id) => document.getElementById(id).click();

  say(`begins with ${rows().length}: ${names()}.`);
  const question = () => document.getElementById("asked").textContent;
  const asks = question();
  const shows = document.getElementById("shows");
  shows.value = [...shows.options].find((option) => option.text === "shrub").value;
  press("answer");
  say(`answered: ${question() !== asks}, ${names().includes("shrub")}, ${namesFile(groups, pieces, 120, 90, () => "shrub").includes('class = "shrub"')}.`);
  press("undo");
  say(`asks again: ${question() === asks}.`);
  const plain = picture();
  click(20, 70);
  say(`click: ${told()}, marked ${picture() !== plain}, chosen row ${rows().findIndex((row) => row.className === "chosen") + 1}.`);
  click(100, 70, true);
  say(`shift: ${rows().length}: ${names()}.`);
  key("u");
  say(`undone: ${rows().length}: ${names()}.`);
  key("r");
  say(`done again: ${rows().length}.`);
  key("z", { ctrlKey: true });
  click(100, 70);
  key("m");
  click(20, 70);
  say(`m: ${rows().length}: ${names()}.`);
  press("split");
  say(`split of what was merged: ${rows().length}: ${names()}.`);
  press("undo");
  press("undo");
  click(60, 10);
  press("split");
  say(`split of the sky: ${rows().length}.`);
  key("s");
  say(`and again: ${rows().length}.`);
  press("undo");
  press("undo");
  key("ArrowRight");
  say(`arrow: row ${rows().findIndex((row) => row.className === "chosen") + 1}.`);
  const rename = (x, y, name) => {
    click(x, y);
    const select = rows().find((row) => row.className === "chosen").querySelector("select");
    select.value = [...select.options].find((option) => option.text === name).value;
    select.dispatchEvent(new Event("change"));
  };
  rename(100, 70, "glacier");
  rename(60, 10, "not used");
  say(`named: ${names()}.`);
  const bytes = await maskFile();
  say(`mask:${btoa(String.fromCharCode(...bytes))}:`);
  const stream = window.CompressionStream;
  window.CompressionStream = undefined;
  CompressionStream = undefined;
  say(`stored:${btoa(String.fromCharCode(...await maskFile()))}:`);
  let saved = "";
  HTMLAnchorElement.prototype.click = function () { saved = `${this.download} ${this.href.slice(0, 5)}`; };
  await actions.save();
  say(`saved ${saved}`);
  for (let k = 0; k < 99; ++k) press("undo");
  say(`all undone: ${rows().length}: ${names()}, ${document.getElementById("undo").disabled}.`);
  say("done");
})().catch((error) => { document.getElementById("clicked").textContent += `\nfailed: ${error}`; });
</script></body>)";

TEST_F(SegmentPage, ClicksAndKeysMergeSplitNameAndUndo) {
  if (!std::filesystem::exists(test::browser)) GTEST_SKIP() << "no browser at " << test::browser;
  std::string text = made_page();
  const std::size_t end = text.rfind("</body>");
  ASSERT_NE(end, std::string::npos);
  text.replace(end, 7, segment_clicks);
  const std::string page = test::opened_page(write("clicked.html", text), path("profile"));
  const std::size_t from = page.find("<pre id=\"clicked\">");
  ASSERT_NE(from, std::string::npos) << page.substr(0, 2000);
  const std::string said = page.substr(from, page.find("</pre>", from) - from);
  for (const char* line :
       {"begins with 3: sky,pasture,forest.", "answered: true, true, true.", "asks again: true.",
        "click: group 3: forest, marked true, chosen row 3.", "shift: 2: sky,forest.",
        "undone: 3: sky,pasture,forest.", "done again: 2.", "m: 2: sky,pasture.",
        "split of what was merged: 3: sky,pasture,pasture.", "split of the sky: 4.",
        "and again: 5.", "arrow: row 2.", "named: not used,glacier,forest.",
        "saved mask.png blob:", "all undone: 3: sky,pasture,forest, true.", "done"})
    EXPECT_THAT(said, HasSubstr(line));
  // The masks of the page, packed and stored, are read back unchanged.
  for (const std::string& name : {std::string("mask:"), std::string("stored:")}) {
    const std::size_t begin = said.find(name);
    ASSERT_NE(begin, std::string::npos);
    const std::size_t letters = begin + name.size();
    const std::optional<std::string> bytes =
        base64_bytes(said.substr(letters, said.find(':', letters) - letters));
    ASSERT_TRUE(bytes.has_value());
    write("saved.png", *bytes);
    const Grid<std::uint16_t> mask = read_grey(path("saved.png"));
    const Grid<std::uint16_t> before = read_grey(path("mask.png"));
    ASSERT_TRUE(mask.same_size(before));
    for (std::size_t i = 0; i < mask.size(); ++i)
      EXPECT_EQ(mask[i], before[i] == 0 ? 255 : (before[i] == 10 ? 9 : 4));
    EXPECT_EQ(read_picture(path("saved.png"))(100, 70), read_picture(path("saved.png"))(100, 71));
  }
}

}  // namespace
}  // namespace belvedere
