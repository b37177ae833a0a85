// The page on which groups are merged, split and named: its content, and, if there is a browser,
// the effect of clicks and keys.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "base/random.h"
#include "base/text/base64.h"
#include "tests/tools/program.h"
#include "tests/tools/report/browser.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SegmentPage : public Program {
 protected:
  // Sky above, wood and meadow below; made in a few groups.
  std::string made_page() const {
    write_picture("painting.png", 120, 90, [](int x, int y) {
      const glm::vec3 colour =
          y < 30 ? glm::vec3(.55F, .7F, .9F)
                 : (x < 60 ? glm::vec3(.12F, .25F, .1F) : glm::vec3(.6F, .75F, .35F));
      return colour + glm::vec3(static_cast<float>(random_index(20, 5, x / 2, y / 2)) / 400.F);
    });
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
                          HasSubstr("\"joins\""), HasSubstr("\"alpine_grass\"")));
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
       {"begins with 3: sky,pasture,forest.", "click: group 3: forest, marked true, chosen row 3.",
        "shift: 2: sky,forest.", "undone: 3: sky,pasture,forest.", "done again: 2.",
        "m: 2: sky,pasture.", "split of what was merged: 3: sky,pasture,pasture.",
        "split of the sky: 4.", "and again: 5.", "arrow: row 2.", "named: not used,glacier,forest.",
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
