#include "texture/composite/composite_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/texture/composite/composite_crops.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

const std::string& text_of_small() {
  static const std::string text =
      composite_text(learn_composite(test::two_textures(200, 130).crop(), test::quick_learning()));
  return text;
}

std::string replaced(const std::string& what, const std::string& with) {
  std::string text = text_of_small();
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

std::string words(const std::string& text) {
  try {
    parse_composite(text, "x.composite");
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    return e.what();
  }
  return "nothing";
}

TEST(CompositeModelFile, ReadsBackToTheSameBits) {
  const CompositeModel model = parse_composite(text_of_small(), "x.composite");
  EXPECT_EQ(composite_text(model), text_of_small());
  EXPECT_EQ(model.labels.size(), 2U);
  EXPECT_TRUE(model.transition);
  EXPECT_LT(text_of_small().size(), 12000U);
  CompositeModel hard = model;
  hard.transition.reset();
  EXPECT_FALSE(parse_composite(composite_text(hard), "x.composite").transition);
}

TEST(CompositeModelFile, SharesKeepFourDigits) {
  const test::Composite two = test::two_textures(200, 130);
  const LabelMapModel exact = learn_label_map(two.labels, 2);
  const CompositeModel model = parse_composite(text_of_small(), "x.composite");
  ASSERT_EQ(model.map.pairs.size(), exact.pairs.size());
  for (std::size_t i = 0; i < exact.pairs.size(); ++i)
    EXPECT_NEAR(model.map.pairs[i], exact.pairs[i], 2e-4 * exact.pairs[i]);
  for (std::size_t i = 0; i < exact.rings.size(); ++i)
    EXPECT_NEAR(model.map.rings[i], exact.rings[i], 2e-4 * exact.rings[i]);
}

TEST(CompositeModelFile, DamageIsNamed) {
  EXPECT_THAT(words("a = 1\n"), HasSubstr("not a composite"));
  EXPECT_THAT(words(replaced("belvedere_composite = 1", "belvedere_composite = 7")),
              HasSubstr("version 7"));
  EXPECT_THAT(words(replaced("crop_hash", "crop_hush")), HasSubstr("crop_hush"));
  EXPECT_THAT(words(replaced("pairs = \"", "pairs = \"AAAA")), HasSubstr("\"pairs\" is damaged"));
  EXPECT_THAT(words(replaced("rings = \"AAAA", "rings = \"//8A")),
              HasSubstr("\"rings\" is damaged"));
  EXPECT_THAT(words(replaced("#808080", "#008000")), HasSubstr("given twice"));
  EXPECT_THAT(words(replaced("[map]", "[mop]")), HasSubstr("mop"));
  EXPECT_THAT(words(replaced("types = \"", "types = \"A")), HasSubstr("types are damaged"));
  EXPECT_THAT(words(replaced("crop_size = [200, 130]", "crop_size = [0, 130]")),
              HasSubstr("crop_size"));
  EXPECT_THAT(words(text_of_small().substr(0, text_of_small().find("[[labels]]"))),
              HasSubstr("\"labels\" is missing"));
  EXPECT_THROW(read_composite("/nowhere/x.composite"), Error);
}

}  // namespace
}  // namespace belvedere
