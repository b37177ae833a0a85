#include "texture/quality/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "tests/grids.h"
#include "texture/quality/quality_parts.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

Rgb8 grey(int value) {
  const std::uint8_t v = static_cast<std::uint8_t>(value);
  return {v, v, v};
}

// Horizontal dashes of `length` pixels, each with its own brightness.
Grid<Rgb8> dashes(int width, int height, int length, std::uint64_t seed) {
  return test::grid_of<Rgb8>(width, height, [&](int x, int y) {
    return grey(40 + static_cast<int>(random_index(160, seed, (x + 7 * y) / length, y)));
  });
}

Exemplar exemplar_of(const Grid<Rgb8>& picture) {
  Exemplar exemplar;
  exemplar.name = "test";
  exemplar.picture = picture;
  exemplar.guides.label = Grid<std::uint8_t>(picture.width(), picture.height(), 1);
  Grid<std::uint8_t> altitude(picture.width(), picture.height());
  for (const auto [x, y] : test::cells(picture)) {
    if (x >= picture.width() / 2) exemplar.guides.label(x, y) = 2;
    altitude(x, y) = static_cast<std::uint8_t>(y);
  }
  exemplar.guides.guides = {{"altitude", altitude}};
  return exemplar;
}

MatchField identity(int width, int height) {
  MatchField field(width, height);
  for (const auto [x, y] : test::cells(width, height))
    field(x, y) = {0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
  return field;
}

TEST(Quality, AnExemplarAgainstItselfIsFaultless) {
  const Exemplar exemplar = exemplar_of(dashes(120, 90, 6, 1));
  const SynthesisQuality q =
      measure_quality(identity(120, 90), {exemplar}, exemplar.guides, {.repeat_samples = 20});
  EXPECT_EQ(q.label_agreement, 1.0);
  EXPECT_EQ(q.guide_error_mean, 0.0);
  EXPECT_EQ(q.max_used, 1);
  EXPECT_EQ(q.texels_used, 1.0);
  EXPECT_EQ(q.largest_piece, 120U * 90U);
  EXPECT_EQ(q.coherence, 1.0);
  EXPECT_EQ(q.without_texel, 0U);
  EXPECT_EQ(q.excluded_used, 0U);
  EXPECT_EQ(q.self_repeat, 1.0);
  EXPECT_EQ(q.specks_inside, 1.0);
  ASSERT_EQ(q.classes.size(), 2U);
  for (const ClassQuality& c : q.classes) {
    EXPECT_EQ(c.pixels, c.texels);
    EXPECT_EQ(c.sharpness, 1.0);
    EXPECT_EQ(c.stroke_run, 1.0);
    EXPECT_EQ(c.clique_distance, 0.0);
    EXPECT_NEAR(c.clique_floor, 0.0, 1e-12);
    EXPECT_NEAR(c.clique_beyond_floor, 0.0, 1e-12);
    EXPECT_EQ(c.colour_distance, 0.0);
    EXPECT_EQ(c.colour_floor, 0.0);
    EXPECT_EQ(c.colour_beyond_floor, 0.0);
  }
}

TEST(Quality, CountsWhatACopyDoes) {
  Exemplar exemplar = exemplar_of(dashes(40, 30, 6, 1));
  exemplar.guides.label(3, 3) = unused_label;
  GuideStack target = exemplar.guides;
  target.label(3, 3) = 1;
  MatchField field = identity(40, 30);
  // A column shifted by 5 cuts the picture in three; one pixel has no match; one row copies one
  // texel throughout.
  for (int y = 0; y < 30; ++y) field(20, y) = {0, 25, static_cast<std::uint16_t>(y)};
  field(0, 0) = Match{};
  for (int x = 21; x < 40; ++x) field(x, 29) = {0, 30, 20};
  const SynthesisQuality q = measure_quality(field, {exemplar}, target, {.repeat_samples = 0});
  EXPECT_EQ(q.without_texel, 1U);
  EXPECT_EQ(q.excluded_used, 1U);
  EXPECT_EQ(q.max_used, 20);
  EXPECT_EQ(q.largest_piece, 20U * 30U - 1U);
  const std::vector<std::size_t> sizes = piece_sizes(field);
  EXPECT_EQ(sizes.size(),
            3U + 19U);  // left, column, right; each pixel of the repeated row by itself
  EXPECT_NEAR(q.guide_error_mean, 19.0 * 9.0 / (40.0 * 30.0 - 1.0), 1e-12);
  EXPECT_EQ(q.label_agreement, 1.0 - 1.0 / (40.0 * 30.0 - 1.0));
  EXPECT_EQ(q.self_repeat, 0.0) << "left out";
}

TEST(Quality, SilhouettesCountPairsAcrossJumpsOnly) {
  const Exemplar exemplar = exemplar_of(dashes(40, 30, 6, 1));
  GuideStack target = exemplar.guides;
  target.depth_m = Grid<float>(40, 30, 1000.0F);
  for (const auto [x, y] : test::cells({10, 0, 40, 30}))
    target.depth_m(x, y) = x < 30 ? 1100.0F : std::numeric_limits<float>::infinity();
  MatchField field = identity(40, 30);
  EXPECT_EQ(measure_quality(field, {exemplar}, target, {.repeat_samples = 0}).across_silhouettes,
            1.0);
  for (int y = 0; y < 15; ++y) field(10, y).x = 13;
  EXPECT_EQ(measure_quality(field, {exemplar}, target, {.repeat_samples = 0}).across_silhouettes,
            0.75);
  EXPECT_EQ(measure_quality(field, {exemplar}, target, {.depth_ratio = 1.2F, .repeat_samples = 0})
                .across_silhouettes,
            1.0)
      << "only the sky";
}

TEST(Quality, StrokeRunTellsLongStrokesFromShort) {
  const Grid<std::uint8_t> labels(200, 200, 1);
  const auto run = [&](int length) {
    return stroke_run(dashes(200, 200, length, 3), labels, border_distance_squared(labels), 1, 3);
  };
  // A run through a random pixel of a dash is the dash; a neighbour of the same grey is rare (about
  // 3 of 160 each side).
  EXPECT_NEAR(run(8), 8.0, 0.8);
  EXPECT_NEAR(run(16), 16.0, 1.6);
  EXPECT_NEAR(run(40), 40.0, 4.0);
  // The same rotated by 90°.
  const Grid<Rgb8> lying = dashes(200, 200, 16, 3);
  Grid<Rgb8> standing(200, 200);
  for (const auto [x, y] : test::cells(200, 200)) standing(x, y) = lying(y, x);
  EXPECT_NEAR(stroke_run(standing, labels, border_distance_squared(labels), 1, 3), run(16), 0.5);
  EXPECT_TRUE(std::isnan(stroke_run(lying, labels, border_distance_squared(labels), 2, 3)));
}

TEST(Quality, ToleranceIsHalfTheLocalDeviation) {
  Grid<Rgb8> board(60, 60);
  for (const auto [x, y] : test::cells(60, 60)) board(x, y) = grey((x + y) % 2 == 0 ? 100 : 120);
  // 25 of one and 24 of the other, 60 apart in r + g + b: deviation 29.99.
  EXPECT_EQ(stroke_tolerance(board, Grid<std::uint8_t>(60, 60, 1), 1), 14);
}

TEST(Quality, ShiftAndBlurShowInTheirFigures) {
  // The output is brighter by 7 everywhere, or the mean of neighbours: made by copying from a
  // second layer of the exemplar.
  const Grid<Rgb8> picture = dashes(160, 120, 6, 1);
  Exemplar exemplar = exemplar_of(picture);
  Exemplar brighter = exemplar;
  Exemplar blurred = exemplar;
  for (const auto [x, y] : test::cells(160, 120)) {
    brighter.picture(x, y) = grey(picture(x, y)[0] + 7);
    blurred.picture(x, y) = grey((picture.clamped(x, y - 1)[0] + picture(x, y)[0]) / 2);
  }
  quality::Histogram plain{};
  quality::Histogram shifted{};
  for (std::size_t i = 0; i < picture.size(); ++i) {
    ++plain[picture[i][0]];
    ++shifted[brighter.picture[i][0]];
  }
  EXPECT_NEAR(quality::wasserstein(plain, shifted), 7.0, 1e-9);
  const Grid<std::uint8_t> one_class(160, 120, 1);
  EXPECT_LT(mean_gradient(blurred.picture, one_class, border_distance_squared(one_class), 1),
            0.8 * mean_gradient(picture, one_class, border_distance_squared(one_class), 1));
  exemplar.guides.label = blurred.guides.label = one_class;
  EXPECT_GT(quality::clique_distances(blurred.picture, one_class, {exemplar},
                                      {Grid<float>(160, 120, 1.0F)}, 1)
                .distance,
            0.05);
  // Weights for the upper half only: the lower bound is the difference of the upper half itself.
  Grid<float> upper(160, 120, 0.0F);
  for (const auto [x, y] : test::cells(160, 60)) upper(x, y) = 1.0F;
  const quality::CliqueDistances same =
      quality::clique_distances(picture, one_class, {exemplar}, {upper}, 1);
  EXPECT_EQ(same.distance, 0.0);
  EXPECT_GT(same.floor, 0.0);
  EXPECT_LT(same.floor, 0.1);
  EXPECT_EQ(same.floor, same.beyond_floor);
}

TEST(Quality, GradientOfARampIsItsSlope) {
  const Grid<Rgb8> ramp = test::grid_of<Rgb8>(80, 40, [&](int x, int) { return grey(3 * x); });
  EXPECT_NEAR(
      mean_gradient(ramp, Grid<std::uint8_t>(80, 40, 1), Grid<std::uint8_t>(80, 40, 255), 1), 3.0,
      1e-12);
}

TEST(Quality, FloorIsWhatOtherAltitudesMakeByThemselves) {
  // Brightness is altitude. The target contains only the upper half of it, copied without faults:
  // all its distance is the lower bound.
  const Grid<Rgb8> picture = test::grid_of<Rgb8>(100, 200, [&](int, int y) { return grey(y); });
  Exemplar exemplar = exemplar_of(picture);
  GuideStack target;
  target.label = Grid<std::uint8_t>(100, 96);
  target.guides = {{"altitude", Grid<std::uint8_t>(100, 96)}};
  MatchField field(100, 96);
  for (const auto [x, y] : test::cells(100, 96)) {
    target.label(x, y) = exemplar.guides.label(x, y + 96);
    target.guides[0].values(x, y) = static_cast<std::uint8_t>(y + 96);
    field(x, y) = {0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y + 96)};
  }
  const SynthesisQuality q = measure_quality(field, {exemplar}, target, {.repeat_samples = 0});
  for (const ClassQuality& c : q.classes) {
    EXPECT_NEAR(c.colour_distance, 44.0, 1.5);  // means 143.5 and 99.5
    EXPECT_NEAR(c.colour_floor, c.colour_distance, 1.0);
    EXPECT_LT(c.colour_beyond_floor, 1.0);
  }
}

TEST(Quality, FloorIsWhatOtherDistancesFromBordersMakeByThemselves) {
  // The exemplar's brightness is the distance from borders: within 2, 4, 8, 15 pixels, and beyond.
  // The target has other shares of each, copied without faults.
  const auto step_of = [](std::uint8_t squared) {
    const double distance = std::sqrt(static_cast<double>(squared));
    return distance <= 2.0   ? 0
           : distance <= 4.0 ? 1
           : distance <= 8.0 ? 2
           : distance < 15.0 ? 3
                             : 4;
  };
  // Class 1 in stripes, 40 pixels apart, that end halfway down: corners have diagonal distances.
  const auto stripes = [](const std::vector<int>& widths, int height) {
    int width = 40;
    for (const int w : widths) width += w + 40;
    Grid<std::uint8_t> labels(width, height, 2);
    int x0 = 40;
    for (const int w : widths) {
      for (int y = 0; y < height / 2; ++y)
        std::fill_n(labels.row(y) + x0, w, static_cast<std::uint8_t>(1));
      x0 += w + 40;
    }
    return labels;
  };
  Exemplar exemplar;
  exemplar.guides.label = stripes({80}, 60);
  const Grid<std::uint8_t> offered = border_distance_squared(exemplar.guides.label);
  exemplar.picture = Grid<Rgb8>(offered.width(), offered.height());
  std::array<std::array<Match, 5>, 3> texel{};  // one of each class and distance
  for (const auto [x, y] : test::cells(offered)) {
    const int label = exemplar.guides.label(x, y);
    const int step = step_of(offered(x, y));
    exemplar.picture(x, y) = grey(120 * (label - 1) + 20 * step);
    texel.at(static_cast<std::size_t>(label)).at(static_cast<std::size_t>(step)) = {
        0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
  }
  GuideStack target;
  target.label = stripes({4, 8, 16, 28, 40}, 100);
  const Grid<std::uint8_t> requested = border_distance_squared(target.label);
  MatchField field(requested.width(), requested.height());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = texel.at(target.label[i]).at(static_cast<std::size_t>(step_of(requested[i])));
  const SynthesisQuality q = measure_quality(field, {exemplar}, target, {.repeat_samples = 0});
  ASSERT_EQ(q.classes.size(), 2U);
  for (const ClassQuality& c : q.classes) {
    EXPECT_GT(c.colour_distance, 0.5);
    EXPECT_NEAR(c.colour_floor, c.colour_distance, 1e-4);
    EXPECT_NEAR(c.colour_beyond_floor, 0.0, 1e-4);
  }
}

TEST(Quality, BorderDistanceEqualsASearch) {
  const Grid<std::uint8_t> labels = test::grid_of<std::uint8_t>(
      60, 50, [&](int x, int y) { return random_index(2, 4, x / 23, y / 17); });
  const Grid<std::uint8_t> fast = border_distance_squared(labels);
  for (const auto [x, y] : test::cells(60, 50)) {
    int min = 255;
    for (const auto [i, j] : test::cells(60, 50)) {
      const bool border = (i > 0 && labels(i, j) != labels(i - 1, j)) ||
                          (j > 0 && labels(i, j) != labels(i, j - 1));
      if (border) min = std::min(min, (i - x) * (i - x) + (j - y) * (j - y));
    }
    if (min < 225) {
      ASSERT_EQ(fast(x, y), min) << x << ", " << y;
    } else {
      ASSERT_GE(fast(x, y), 225);
    }
  }
}

TEST(Quality, SpecksAreSinglePixels) {
  Grid<Rgb8> picture(60, 60, grey(100));
  for (const auto [x, y] : test::cells({3, 3, 60, 60}, 6)) picture(x, y) = grey(140);
  const Grid<std::uint8_t> one_class(60, 60, 1);
  EXPECT_NEAR(speck_shares(picture, border_distance_squared(one_class)).inside, 1.0 / 36.0, 1e-9);
  for (const auto [x, y] : test::cells({3, 3, 60, 60}, 6)) {
    for (int i = 0; i < 4; ++i)
      picture(x - 1 + (i & 1), y - 1 + (i >> 1)) = grey(140);  // 2 × 2: still outliers
    for (int i = -2; i <= 2; ++i)
      picture(x + i, y) = picture(x + i, y - 1) = grey(140);  // a stroke
  }
  EXPECT_LT(speck_shares(picture, border_distance_squared(one_class)).inside, 1.0 / 36.0 * 4.0);
  EXPECT_EQ(speck_shares(Grid<Rgb8>(60, 60, grey(9)), border_distance_squared(one_class)).inside,
            0.0);
}

TEST(Quality, QuantileIsLinearBetweenNeighbours) {
  const std::size_t counts[] = {1, 0, 2, 1};  // 0 2 2 3
  EXPECT_DOUBLE_EQ(quality::quantile(counts, 4, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(quality::quantile(counts, 4, 0.25), 1.5);
  EXPECT_DOUBLE_EQ(quality::quantile(counts, 4, 0.95), 2.85);
}

// A picture of two classes side by side, each of one grey.
Exemplar two_flats(int width, int height, std::uint8_t left, int left_grey, std::uint8_t right,
                   int right_grey) {
  Exemplar exemplar;
  exemplar.picture = Grid<Rgb8>(width, height);
  exemplar.guides.label = Grid<std::uint8_t>(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    exemplar.picture(x, y) = grey(x < width / 2 ? left_grey : right_grey);
    exemplar.guides.label(x, y) = x < width / 2 ? left : right;
  }
  return exemplar;
}

// Left half from the first exemplar, right half from the second, all from their own positions.
MatchField halves(int width, int height) {
  MatchField field = identity(width, height);
  for (const auto [x, y] : test::cells({width / 2, 0, width, height})) field(x, y).exemplar = 1;
  return field;
}

TEST(Quality, SeamsOfFlatColoursStepAsReckoned) {
  // Class 1 of grey 40 from one painting meets class 2 of grey 70 from another: a step of 30.
  // Inside the paintings the steps are 20 and 30.
  const std::vector<Exemplar> both{two_flats(20, 10, 1, 40, 2, 60),
                                   two_flats(20, 10, 1, 100, 2, 70)};
  const SeamsOfKinds seams = seam_visibility(halves(20, 10), both, {}, 1.04F);
  EXPECT_EQ(seams.between.pairs, 10U);
  EXPECT_EQ(seams.between.compared, 10U);
  EXPECT_DOUBLE_EQ(seams.between.step, 30.0);
  EXPECT_DOUBLE_EQ(seams.between.visibility, 30.0 / 25.0);
  EXPECT_EQ(seams.within.pairs, 0U);
  EXPECT_EQ(seams.within.visibility, 0.0);

  // Class 1 next to class 3 is in neither. By chance they are 70 apart; borders step by 20 and 30
  // where chance makes 30 and 30.
  std::vector<Exemplar> strangers{two_flats(20, 10, 1, 40, 2, 60),
                                  two_flats(20, 10, 2, 70, 3, 100)};
  for (const auto [x, y] : test::cells(5, 10)) strangers[0].picture(x, y) = grey(20);
  const SeamVisibility strange = seam_visibility(halves(20, 10), strangers, {}, 1.04F).between;
  EXPECT_EQ(strange.compared, 10U);
  EXPECT_NEAR(strange.visibility, 60.0 / (70.0 * 50.0 / 60.0), 1e-12);

  // With one class each, or flat colour throughout, there is no reference.
  const std::vector<Exemplar> single{two_flats(20, 10, 1, 40, 1, 40),
                                     two_flats(20, 10, 2, 70, 2, 70)};
  const SeamVisibility alone = seam_visibility(halves(20, 10), single, {}, 1.04F).between;
  EXPECT_EQ(alone.pairs, 10U);
  EXPECT_EQ(alone.compared, 0U);
  EXPECT_DOUBLE_EQ(alone.step, 30.0);
  EXPECT_EQ(alone.visibility, 0.0);
  const std::vector<Exemplar> flat{two_flats(20, 10, 1, 40, 1, 40),
                                   two_flats(20, 10, 1, 70, 1, 70)};
  EXPECT_EQ(seam_visibility(halves(20, 10), flat, {}, 1.04F).between.visibility, 0.0);
}

TEST(Quality, SeamsAreJudgedByTheirClassAndKind) {
  // A board of 100 and 110 and one brighter by d: across the seam steps alternate between d + 10
  // and d − 10, in the paintings they are 10.
  const auto board = [](int add) {
    Exemplar exemplar = two_flats(20, 10, 1, 0, 1, 0);
    for (const auto [x, y] : test::cells(20, 10))
      exemplar.picture(x, y) = grey(100 + add + (x + y) % 2 * 10);
    return exemplar;
  };
  for (const int d : {0, 10, 40})
    EXPECT_DOUBLE_EQ(
        seam_visibility(halves(20, 10), {board(0), board(d)}, {}, 1.04F).between.visibility,
        std::max(d, 10) / 10.0)
        << d;
  // A row moved by two texels: a seam to the rows above and below, inside the painting, that steps
  // as before.
  MatchField field = halves(20, 10);
  for (int x = 0; x < 8; ++x) field(x, 5).x = static_cast<std::uint16_t>(x + 2);
  const SeamsOfKinds moved = seam_visibility(field, {board(0), board(40)}, {}, 1.04F);
  EXPECT_EQ(moved.within.pairs, 8U + 8U + 1U);
  EXPECT_DOUBLE_EQ(moved.within.visibility, 1.0);
  EXPECT_EQ(moved.between.pairs, 10U);
  // Pixels without a texel have no seam; silhouettes are not seams.
  field(9, 0) = Match{};
  EXPECT_EQ(seam_visibility(field, {board(0), board(40)}, {}, 1.04F).between.pairs, 9U);
  Grid<float> depth(20, 10, 1000.0F);
  for (const auto [x, y] : test::cells({10, 0, 20, 5})) depth(x, y) = 1100.0F;
  EXPECT_EQ(seam_visibility(field, {board(0), board(40)}, depth, 1.04F).between.pairs, 5U);
  EXPECT_EQ(seam_visibility(field, {board(0), board(40)}, depth, 1.2F).between.pairs, 9U);
}

TEST(Quality, SeamsBetweenCopiesOfOnePaintingAreItsNeighbours) {
  const Exemplar exemplar = exemplar_of(dashes(40, 30, 6, 1));
  MatchField field = identity(40, 30);
  for (const auto [x, y] : test::cells(40, 30))
    field(x, y).exemplar = static_cast<std::uint16_t>((x + y) % 2);  // every pair is a seam
  const SynthesisQuality q =
      measure_quality(field, {exemplar, exemplar}, exemplar.guides, {.repeat_samples = 0});
  EXPECT_EQ(q.exemplars, 2U);
  EXPECT_EQ(q.seams.between.pairs, 39U * 30U + 40U * 29U);
  EXPECT_NEAR(q.seams.between.visibility, 1.0, 1e-12);
  EXPECT_EQ(q.seams.within.pairs, 0U);
  const SynthesisQuality one =
      measure_quality(identity(40, 30), {exemplar}, exemplar.guides, {.repeat_samples = 0});
  EXPECT_EQ(one.seams.between.pairs + one.seams.within.pairs, 0U);
  EXPECT_EQ(one.seams.between.visibility, 0.0);
}

TEST(Quality, SynthesisKnitsPaintingsAndPaintingsOfAnotherToneShow) {
  // Class 1 only in the first, class 2 only in the second, class 3 in both: classes come from
  // different paintings.
  const auto painting = [](std::uint64_t seed, std::uint8_t own, int add) {
    Exemplar exemplar = exemplar_of(dashes(96, 80, 6, seed));
    for (const auto [x, y] : test::cells(96, 80)) {
      exemplar.picture(x, y) = grey(exemplar.picture(x, y)[0] / 2 + add);
      exemplar.guides.label(x, y) = (x / 24 + y / 20) % 2 == 0 ? own : 3;
    }
    exemplar.guides.guides.clear();
    return exemplar;
  };
  GuideStack target;
  target.label = Grid<std::uint8_t>(90, 70);
  for (const auto [x, y] : test::cells(90, 70))
    target.label(x, y) = static_cast<std::uint8_t>(1 + (x / 15 + y / 14) % 3);
  const auto seams = [&](const std::vector<Exemplar>& exemplars, const MatchField& field) {
    return measure_quality(field, exemplars, target, {.repeat_samples = 0}).seams;
  };
  const std::vector<Exemplar> alike{painting(1, 1, 0), painting(2, 2, 0)};
  const std::vector<Exemplar> dissimilar{painting(1, 1, 0), painting(2, 2, 120)};
  // Random texels of the right class: every pair is a seam, the worst case.
  MatchField chance(90, 70);
  for (std::size_t i = 0; i < chance.size(); ++i)
    for (std::uint64_t draw = 0; chance[i].exemplar == Match::none; ++draw) {
      const auto e = static_cast<std::uint16_t>(random_index(2, 7, i, draw));
      const auto x = static_cast<std::uint16_t>(random_index(96, 8, i, draw));
      const auto y = static_cast<std::uint16_t>(random_index(80, 9, i, draw));
      if (alike[e].guides.label(x, y) == target.label[i]) chance[i] = {e, x, y};
    }
  const double worst = seams(alike, chance).between.visibility;
  const SeamsOfKinds similar = seams(alike, synthesize(alike, target, {}, silent_progress()));
  const SeamsOfKinds other =
      seams(dissimilar, synthesize(dissimilar, target, {}, silent_progress()));
  // Measured: 1.67 by chance; 1.258 between and 1.262 within; with the second brighter by 120, 1.97
  // and 1.33.
  EXPECT_NEAR(worst, 12.0 / 7.0, 0.1);  // in a painting of dashes of 6, rows are independent, and
                                        // one of six along them: 1/2 + 1/12 of pairs
  EXPECT_GT(similar.between.pairs, 200U);
  EXPECT_GT(similar.between.visibility, 1.0);
  EXPECT_LT(similar.between.visibility, 0.8 * worst);
  EXPECT_NEAR(similar.between.visibility, similar.within.visibility, 0.1);
  EXPECT_GT(other.between.visibility, worst);
  EXPECT_LT(other.within.visibility, 0.85 * worst);
}

TEST(Quality, RefusesWhatDoesNotFit) {
  const Exemplar exemplar = exemplar_of(dashes(40, 30, 6, 1));
  EXPECT_THROW(measure_quality(identity(40, 30), {}, exemplar.guides), Error);
  EXPECT_THROW(measure_quality(identity(41, 30), {exemplar}, exemplar.guides), Error);
}

}  // namespace
}  // namespace belvedere
