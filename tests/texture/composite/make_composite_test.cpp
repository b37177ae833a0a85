#include "texture/composite/make_composite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/grid.h"
#include "base/memory/sanitized.h"
#include "base/parallel.h"
#include "tests/counted_memory.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/texture/composite/composite_crops.h"
#include "texture/composite/learn_composite.h"
#include "texture/composite/make_label_map.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {
namespace {

using test::is_green;
using test::two_textures_model;

const TextureParameters quick_make{.rounds = 8, .sweeps = 3};

Grid<std::uint8_t> drawn(int width, int height) {
  return test::grid_of<std::uint8_t>(width, height, [&](int x, int y) {
    return (x - 50) * (x - 50) + (y - 40) * (y - 40) < 900 ? 1 : 0;
  });
}

TEST(MakeComposite, EveryLabelHasItsOwnTexture) {
  const Grid<std::uint8_t> labels = drawn(120, 90);
  const Grid<Rgb8> made = make_composite(two_textures_model(), labels, quick_make);
  const Grid<std::uint8_t> zone = near_borders(labels, remade_border_px);
  int wrong = 0;
  for (std::size_t i = 0; i < made.size(); ++i)
    wrong += zone[i] == 0 && is_green(made[i]) != (labels[i] == 0) ? 1 : 0;
  EXPECT_LE(wrong, 5);  // of ten thousand, at the tails of greens
}

// The negative control of the published composite: one texture of everything has no top and bottom,
// and distant pixels are related otherwise. No model contains either statistic; the map may be the
// crop's own or made.
TEST(MakeComposite, KeepsTheLayoutThatOneTextureLoses) {
  const test::Composite crop = test::two_textures(200, 150);
  const CliqueModel single = learn_texture(crop.picture, {}, test::quick_learning().learn).model;
  const LayoutFigures one =
      layout_figures(crop.picture, make_texture(single, 200, 150, quick_make));
  const Grid<std::uint8_t> made =
      make_label_map(two_textures_model().map, 200, 150, {.seed = 3, .effort = .3});
  EXPECT_NE(made, crop.labels);
  for (const Grid<std::uint8_t>& labels : {crop.labels, made}) {
    const LayoutFigures composite =
        layout_figures(crop.picture, make_composite(two_textures_model(), labels, quick_make));
    EXPECT_LT(composite.profile, .75 * one.profile) << one.profile;
    EXPECT_LT(composite.far_pairs, .9 * one.far_pairs) << one.far_pairs;
  }
}

TEST(MakeComposite, TheTransitionChangesBordersAlone) {
  const Grid<std::uint8_t> labels = drawn(110, 90);
  CompositeModel hard = two_textures_model();
  hard.transition.reset();
  const Grid<Rgb8> with = make_composite(two_textures_model(), labels, quick_make);
  const Grid<Rgb8> without = make_composite(hard, labels, quick_make);
  const Grid<std::uint8_t> zone = near_borders(labels, remade_border_px);
  int changed = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (zone[i] == 0) {
      EXPECT_EQ(with[i], without[i]);
    }
    changed += with[i] != without[i] ? 1 : 0;
  }
  EXPECT_GT(changed, 300);
}

TEST(MakeComposite, ThreadsChangeNothing) {
  const Grid<std::uint8_t> labels =
      make_label_map(two_textures_model().map, 90, 70, {.effort = .2});
  const Grid<Rgb8> many = make_composite(two_textures_model(), labels, quick_make);
  const ThreadLimit one(1);
  EXPECT_EQ(make_composite(two_textures_model(), labels, quick_make), many);
}

TEST(MakeComposite, ThinLabelsAreStillOfTheirTexture) {
  Grid<std::uint8_t> labels(100, 60);
  for (int x = 0; x < 100; ++x) labels(x, 30) = labels(x, 31) = 1;
  CompositeModel hard = two_textures_model();
  hard.transition.reset();
  const Grid<Rgb8> made = make_composite(hard, labels, quick_make);
  int grey = 0;
  int low = 255;
  int high = 0;
  for (int x = 0; x < 100; ++x) {
    grey += is_green(made(x, 30)) ? 0 : 1;
    low = std::min<int>(low, made(x, 30)[0]);
    high = std::max<int>(high, made(x, 30)[0]);
  }
  EXPECT_EQ(grey, 100);
  EXPECT_LT(low, 90);  // both shades of the stripes
  EXPECT_GT(high, 170);
}

TEST(MakeComposite, OneLabelAloneAndUnknownOnes) {
  EXPECT_EQ(make_composite(two_textures_model(), Grid<std::uint8_t>(40, 30), quick_make).width(),
            40);
  EXPECT_THROW(make_composite(two_textures_model(), Grid<std::uint8_t>(40, 30, 2), quick_make),
               Error);
}

// Red left, blue right, green far away: a violet between red and blue becomes one of the two,
// whichever is nearer, a reddish one stays.
TEST(SnapColours, TakesColoursOfTheTwoSides) {
  constexpr Rgb8 red{200, 20, 20};
  constexpr Rgb8 blue{20, 20, 200};
  constexpr Rgb8 green{100, 120, 100};
  Grid<std::uint8_t> labels(60, 20);
  Grid<Rgb8> picture(60, 20);
  for (const auto [x, y] : test::cells(60, 20)) {
    labels(x, y) = static_cast<std::uint8_t>(x / 20);
    picture(x, y) = x < 20 ? red : x < 40 ? blue : green;
  }
  Grid<std::uint8_t> zone(60, 20);
  zone(19, 10) = zone(20, 10) = zone(18, 4) = zone(21, 4) = 1;
  picture(19, 10) = {105, 110, 120};  // nearest to green, which is not nearby
  picture(20, 10) = {90, 20, 140};
  picture(18, 4) = {205, 16, 22};  // within a cell of red
  picture(21, 4) = {130, 20, 90};
  const Grid<Rgb8> before = picture;
  snap_colours(picture, labels, zone, 3);
  EXPECT_TRUE(picture(19, 10) == red || picture(19, 10) == blue);
  EXPECT_EQ(picture(20, 10), blue);
  EXPECT_EQ(picture(18, 4), before(18, 4));
  EXPECT_EQ(picture(21, 4), red);
  EXPECT_EQ(picture(5, 5), red);
}

const TextureParameters quick_window{.rounds = 3, .sweeps = 1};

const CompositeRecord& record() {
  static const CompositeRecord r = record_composite(two_textures_model(), quick_window);
  return r;
}

// Discs on a ground.
Grid<std::uint8_t> discs(int width, int height) {
  Grid<std::uint8_t> labels(width, height);
  for (const auto [x, y] : test::cells(labels)) {
    const int u = x % 160 - 80;
    const int v = y % 140 - 70;
    labels(x, y) = u * u + v * v < 2500 ? 1 : 0;
  }
  return labels;
}

TEST(CompositeWindow, AnyWindowIsAPartOfTheWhole) {
  const Grid<std::uint8_t> labels = discs(560, 140);  // two tiles
  const Grid<Rgb8> whole =
      make_composite_window(two_textures_model(), record(), labels, {0, 0, 560, 140}, quick_window);
  {
    const ThreadLimit threads(3);
    for (const PixelRect window : {PixelRect{480, 90, 560, 140}, PixelRect{530, 0, 560, 40}})
      EXPECT_EQ(make_composite_window(two_textures_model(), record(), labels, window, quick_window),
                part_of(whole, window));
    // One tile above the other.
    const Grid<std::uint8_t> tall = discs(60, 540);
    const Grid<Rgb8> column =
        make_composite_window(two_textures_model(), record(), tall, {0, 0, 60, 540}, quick_window);
    const PixelRect below{10, 515, 50, 540};
    EXPECT_EQ(make_composite_window(two_textures_model(), record(), tall, below, quick_window),
              part_of(column, below));
  }
  // Each label in its texture.
  const Grid<std::uint8_t> zone = near_borders(labels, 6);
  int wrong = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
    wrong += zone[i] == 0 && is_green(whole[i]) != (labels[i] == 0) ? 1 : 0;
  EXPECT_LT(wrong, static_cast<int>(whole.size() / 500));
  // No step where tiles meet: that column's step is like its neighbours'.
  const auto step = [&](int x) {
    double sum = 0.0;
    for (int y = 0; y < 140; ++y)
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(whole(x, y)[c] - whole(x - 1, y)[c]);
    return sum;
  };
  double around = 0.0;
  for (const int x : {504, 506, 508, 510, 514, 516, 518, 520}) around += step(x) / 8.0;
  EXPECT_LT(step(512), 1.25 * around);
}

// A part of an unbounded map, left of and above its origin, is made as it is in a larger part.
TEST(CompositeWindow, KnowsWhereItsMapLies) {
  const TextureParameters twice{.rounds = 2, .sweeps = 0};
  const CompositeRecord tables = record_composite(two_textures_model(), twice);
  constexpr int margin = composite_margin_px;
  constexpr int side = endless_tile_px + 2 * margin;
  // Labels of a position on the lattice.
  const auto map_at = [](TexturePosition at, int width) {
    return test::grid_of<std::uint8_t>(width, side, [&](int x, int y) {
      const int u = x + at.x + 300;
      const int v = y + at.y + 260;
      return u * u + v * v < 1600 ? 1 : 0;
    });
  };
  const TexturePosition small{-endless_tile_px - margin, -endless_tile_px - margin};
  const TexturePosition large{small.x - 160, small.y};
  const PixelRect window{-350, -300, -250, -200};
  const Grid<Rgb8> one = make_composite_window(two_textures_model(), tables, map_at(small, side),
                                               window, twice, silent_progress(), small);
  EXPECT_EQ(make_composite_window(two_textures_model(), tables, map_at(large, side + 160), window,
                                  twice, silent_progress(), large),
            one);
  int green = 0;
  int inside = 0;
  for (const auto [x, y] : test::cells(100, 100)) {
    const bool disc = (x - 50) * (x - 50) + (y - 40) * (y - 40) < 1200;
    inside += disc && is_green(one(x, y)) ? 1 : 0;
    green += is_green(one(x, y)) ? 1 : 0;
  }
  EXPECT_LT(inside, 600) << "of 3800 pixels of the disc";
  EXPECT_GT(green, 3500) << "of 5000 around it";
}

// A strip of a map of any height takes the memory of its tiles.
TEST(CompositeWindow, TakesNoMoreMemoryOfALargerMap) {
#ifdef BELVEDERE_SANITIZED
  GTEST_SKIP() << "sanitizers have memory of their own";
#endif
  const TextureParameters once{.rounds = 1, .sweeps = 0};
  const CompositeRecord tables = record_composite(two_textures_model(), once);
  const auto peak = [&](int height) {
    const ThreadLimit one(1);
    const Grid<std::uint8_t> labels = discs(64, height);
    const test::CountedMemory memory;
    make_composite_window(two_textures_model(), tables, labels, {0, 0, 64, 100}, once);
    return static_cast<double>(memory.peak_bytes());
  };
  peak(600);
  const double small = peak(600);
  EXPECT_NEAR(peak(60000), small, .01 * small);
}

TEST(CompositeWindow, RefusesWhatIsBeyondTheMap) {
  EXPECT_THROW(make_composite_window(two_textures_model(), record(), discs(560, 60),
                                     {500, 0, 600, 40}, quick_window),
               Error);
}

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
  return test::usage_error([&] { parse_composite(text, "x.composite"); });
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
  const LabelMapModel exact = learn_label_map(test::two_textures(200, 130).labels, 2);
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
              HasSubstr("two numbers"));
  EXPECT_THAT(words(text_of_small().substr(0, text_of_small().find("[[labels]]"))),
              HasSubstr("\"labels\" is missing"));
  EXPECT_THROW(read_composite("/nowhere/x.composite"), Error);
}

}  // namespace
}  // namespace belvedere
