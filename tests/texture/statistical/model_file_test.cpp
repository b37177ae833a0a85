#include "texture/statistical/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

CliqueModel small_model() {
  CliqueModel model =
      learn_texture(test::meadow_crop(64, 64), {}, {.types = 16, .levels = 1}).model;
  model.seed = TextureSeed::streaks;
  model.seed_px = 12.5F;
  model.direction_deg = 33.25F;
  model.direction_spread = .1F;
  return model;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

std::string words(const std::string& text) {
  try {
    parse_model(text, "x.model");
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    return e.what();
  }
  return {};
}

TEST(ModelFile, ReadsBackToTheSameBits) {
  const CliqueModel model = small_model();
  const std::string text = model_text(model);
  EXPECT_LT(text.size(), 1500U);
  const CliqueModel back = parse_model(text, "x.model");
  EXPECT_EQ(model_text(back), text);
  EXPECT_EQ(back.bands.low, model.bands.low);
  EXPECT_EQ(back.bands.axes, model.bands.axes);
  const TextureParameters quick{.rounds = 6, .sweeps = 2};
  EXPECT_EQ(make_texture(back, 40, 40, quick), make_texture(model, 40, 40, quick));
}

TEST(ModelFile, DamageIsNamedWithItsLine) {
  const std::string text = model_text(small_model());
  EXPECT_THAT(words("a = 1\n"), HasSubstr("not a texture model"));
  EXPECT_THAT(words(replaced(text, "belvedere_texture = 1", "belvedere_texture = 2")),
              HasSubstr("version 2"));
  EXPECT_THAT(words(replaced(text, "levels = 1", "levels = 9")), HasSubstr("9"));
  EXPECT_THAT(words(replaced(text, "levels = 1", "level = 1")), HasSubstr("level"));
  EXPECT_THAT(words(replaced(text, "streaks", "lines")), HasSubstr("lines"));
  EXPECT_THAT(words(replaced(text, "types = \"", "types = \"A")), HasSubstr("damaged"));
  EXPECT_THAT(words(replaced(text, "types = \"", "types = \"AAAA")), HasSubstr("damaged"));
  EXPECT_THAT(words(replaced(text, "types = \"", "types = \"CQAA")), HasSubstr("x.model:"));
  EXPECT_THAT(words(replaced(text, "levels = 1", "method = \"paper\"\nlevels = 1")),
              HasSubstr("1 levels"));
  EXPECT_THAT(words(replaced(text, "levels = 1", "method = \"stone\"\nlevels = 1")),
              HasSubstr("stone"));
  EXPECT_THROW(read_model("/nowhere/x.model"), Error);
}

}  // namespace
}  // namespace belvedere
