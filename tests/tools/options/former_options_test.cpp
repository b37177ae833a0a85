#include "tools/options/former_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(FormerOptions, AreReadAsThePresentOnesWithANote) {
  std::vector<std::string> notes;
  EXPECT_THAT(with_present_names({"diff", "a.png", "b.png", "--max-max", "3"}, notes),
              ElementsAre("diff", "a.png", "b.png", "--max-difference", "3"));
  EXPECT_THAT(with_present_names({"exemplar", "segment", "p.png", "--most=7"}, notes),
              ElementsAre("exemplar", "segment", "p.png", "--max-groups=7"));
  EXPECT_THAT(with_present_names({"texture", "knit", "knit"}, notes),
              ElementsAre("texture", "seam", "knit"));
  EXPECT_THAT(notes,
              ElementsAre(HasSubstr("--max-max is now called --max-difference (belvedere diff)"),
                          HasSubstr("--max-groups"), HasSubstr("seam (belvedere texture)")));
}

TEST(FormerOptions, OtherCommandsKeepTheirWords) {
  std::vector<std::string> notes;
  EXPECT_THAT(with_present_names({"web", "out", "--page"}, notes),
              ElementsAre("web", "out", "--page"));
  EXPECT_THAT(with_present_names({"diff"}, notes), ElementsAre("diff"));
  EXPECT_THAT(notes, IsEmpty());
}

}  // namespace
}  // namespace belvedere::tools
