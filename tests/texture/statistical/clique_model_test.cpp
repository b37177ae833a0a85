#include "texture/statistical/clique_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

BandSpace even_bands() {
  BandSpace bands;
  bands.low = {-50.F, -20.F, -10.F};
  bands.high = {50.F, 20.F, 10.F};
  return bands;
}

TEST(CliqueModel, KnotSharesRiseAndMirror) {
  EXPECT_EQ(clique_knot_share(0), 0.F);
  EXPECT_EQ(clique_knot_share(clique_knots - 1), 1.F);
  for (int k = 1; k < clique_knots; ++k) {
    EXPECT_GT(clique_knot_share(k), clique_knot_share(k - 1));
    EXPECT_FLOAT_EQ(clique_knot_share(k) + clique_knot_share(clique_knots - 1 - k), 1.F);
  }
}

TEST(CliqueModel, RangesHoldEveryDifference) {
  const DifferenceRange pair = difference_range(even_bands(), {0, 1, 0, 0, 1});
  EXPECT_EQ(pair.low, -70.F);
  EXPECT_EQ(pair.high, 70.F);
  const DifferenceRange single = difference_range(even_bands(), {0, 0, 0, 1, 1});
  EXPECT_EQ(single.low, -20.F);
  EXPECT_EQ(single.high, 20.F);
}

// Mu-law: small differences keep fine steps; codes are what is stored, so a second conversion
// changes nothing.
TEST(CliqueModel, CodesKeepKnotsToTheirStep) {
  const BandSpace bands = even_bands();
  const CliqueType type{0, 1, 0, 0, 0};
  CliqueKnots knots{};
  for (int k = 0; k < clique_knots; ++k)
    knots[static_cast<std::size_t>(k)] = -80.F + 160.F * static_cast<float>(k) / (clique_knots - 1);
  const Clique clique{type, encode_knots(bands, type, knots)};
  const CliqueKnots back = decode_knots(bands, clique);
  for (std::size_t k = 0; k < knots.size(); ++k)
    EXPECT_NEAR(back[k], knots[k], .03F * std::abs(knots[k]) + .05F) << k;
  EXPECT_EQ(encode_knots(bands, type, back), clique.codes);
}

TEST(CliqueModel, KnotsNeverFall) {
  const CliqueType type{0, 1, 0, 0, 0};
  CliqueKnots knots{};
  knots.fill(3.F);
  knots[5] = -7.F;
  const auto codes = encode_knots(even_bands(), type, knots);
  for (std::size_t k = 1; k < codes.size(); ++k) EXPECT_GE(codes[k], codes[k - 1]);
}

TEST(CliqueModel, ShareAndValueAreInverse) {
  CliqueKnots knots{};
  for (int k = 0; k < clique_knots; ++k)
    knots[static_cast<std::size_t>(k)] =
        10.F * clique_knot_share(k) - 4.F;  // evenly spread over -4…6
  for (const float share : {0.F, .01F, .25F, .5F, .77F, .999F, 1.F}) {
    EXPECT_NEAR(value_at_share(knots, share), 10.F * share - 4.F, 1e-5F);
    EXPECT_NEAR(share_below(knots, 10.F * share - 4.F), share, 1e-5F);
  }
  EXPECT_EQ(share_below(knots, -5.F), 0.F);
  EXPECT_EQ(share_below(knots, 7.F), 1.F);
}

TEST(LabelBorders, MasksAreWidenedByASquare) {
  Grid<std::uint8_t> mask(20, 15);
  mask(6, 7) = 1;
  mask(19, 0) = 5;
  const Grid<std::uint8_t> wide = widened(mask, 3);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x) {
      const bool first = std::abs(x - 6) <= 3 && std::abs(y - 7) <= 3;
      const bool second = x >= 16 && y <= 3;
      EXPECT_EQ(wide(x, y), first || second ? 1 : 0) << x << " " << y;
    }
  EXPECT_EQ(widened(mask, 0)(19, 0), 1);
}

TEST(LabelBorders, LieOnBothSidesAndNotAtWhatIsUnknown) {
  Grid<std::uint8_t> labels(30, 10, 1);
  for (int y = 0; y < 10; ++y) {
    for (int x = 15; x < 30; ++x) labels(x, y) = 4;
    for (int x = 25; x < 30; ++x) labels(x, y) = no_label;
  }
  for (const int px : {1, 3, 6}) {
    const Grid<std::uint8_t> near = near_borders(labels, px);
    for (int x = 0; x < 30; ++x)
      EXPECT_EQ(near(x, 5), x >= 15 - px && x < 15 + px ? 1 : 0) << px << " " << x;
  }
}

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
