#include "renderer/paint/composite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "base/error.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(Srgb, KnownValues) {
  // 8-bit code, linear value (IEC 61966-2-1, computed independently with 12 digits).
  const std::pair<double, double> known[] = {{0.0, 0.0},
                                             {10.0, 0.003035269835},
                                             {11.0, 0.003346535764},
                                             {128.0, 0.215860500500},
                                             {255.0, 1.0}};
  for (const auto& [code, linear] : known) {
    const Grid<glm::vec3> encoded(1, 1, glm::vec3(static_cast<float>(code / 255.0)));
    EXPECT_NEAR(decode_srgb(encoded)(0, 0).x, linear, 1e-7);
    EXPECT_NEAR(encode_srgb(Image(1, 1, glm::vec3(static_cast<float>(linear))))(0, 0).z,
                code / 255.0, 1e-7);
  }
}

TEST(Srgb, RoundTripKeepsEvery16BitStep) {
  Grid<glm::vec3> encoded(65536, 1);
  for (int i = 0; i < 65536; ++i) encoded(i, 0) = glm::vec3(static_cast<float>(i / 65535.0));
  const Grid<glm::vec3> again = encode_srgb(decode_srgb(encoded));
  for (int i = 0; i < 65536; ++i) ASSERT_EQ(std::lround(again(i, 0).y * 65535.0), i);
}

PaintedExemplar make_exemplar(bool with_base) {
  PaintedExemplar e;
  e.picture = Grid<glm::vec3>(3, 2, glm::vec3(0.5f, 0.6f, 0.7f));
  e.picture(2, 1) = glm::vec3(0.1f, 0.9f, 0.4f);
  if (with_base) e.base = Grid<glm::vec3>(3, 2, glm::vec3(0.4f));
  return e;
}

TEST(TransferResidual, AddsAPartOfTheDifferenceOfBases) {
  const std::vector<PaintedExemplar> exemplars = {make_exemplar(true), make_exemplar(false)};
  MatchField matches(4, 1);
  matches(0, 0) = {0, 0, 0};
  matches(1, 0) = {0, 2, 1};
  matches(2, 0) = {1, 2, 1};
  const Grid<glm::vec3> base(4, 1, glm::vec3(0.6f, 0.8f, 0.2f));
  const Grid<glm::vec3> out = transfer_residual(matches, exemplars, base, {}, 0.75);
  const glm::vec3 expected[] = {
      {0.65f, 0.9f, 0.55f},  // .5 + .75 (.6 - .4) …
      {0.25f, 1.0f, 0.25f},  // green would be 1.2
      {0.1f, 0.9f, 0.4f},    // a scan has no base
      {0.6f, 0.8f, 0.2f},    // no match
  };
  for (int x = 0; x < 4; ++x)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(out(x, 0)[c], expected[x][c], 1e-6) << x;
}

TEST(TransferResidual, SameBaseGivesTheTexel) {
  const std::vector<PaintedExemplar> exemplars = {make_exemplar(true)};
  const Grid<glm::vec3> out = transfer_residual(MatchField(1, 1, Match{0, 2, 1}), exemplars,
                                                Grid<glm::vec3>(1, 1, glm::vec3(0.4f)), {}, 0.75);
  EXPECT_EQ(out(0, 0), exemplars[0].picture(2, 1));
}

// The terrain's light over copied paint: strokes are lighter and darker than their base by equal
// amounts, guides match light to a few hundredths, and sunlit ground keeps the mean luminance of
// its base. Paint times light, the usual overlay of relief shading, gets dark.
TEST(TransferResidual, KeepsTheMeanLuminanceOfLitGround) {
  constexpr int width = 300;
  constexpr int height = 200;
  const auto light_at = [](std::uint64_t seed, int x, int y) {
    return static_cast<float>(0.45 + 0.4 * random_uniform(seed, x, y));
  };
  PaintedExemplar exemplar;
  exemplar.picture = exemplar.base = Grid<glm::vec3>(width, height);
  Grid<glm::vec3> target(width, height);
  MatchField matches(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const float light = light_at(1, x, y);
    exemplar.base(x, y) = glm::vec3(0.9F, 1.0F, 0.7F) * light;
    exemplar.picture(x, y) =
        exemplar.base(x, y) + glm::vec3(static_cast<float>(0.12 * (random_uniform(2, x, y) - 0.5)));
    const float asked = light + static_cast<float>(0.1 * (random_uniform(3, x, y) - 0.5));
    target(x, y) = glm::vec3(0.9F, 1.0F, 0.7F) * asked;
    matches(x, y) = {0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
  }
  const auto luminance = [](const Grid<glm::vec3>& encoded) {
    double sum = 0.0;
    for (const glm::vec3& linear : decode_srgb(encoded))
      sum += 0.2126 * linear.x + 0.7152 * linear.y + 0.0722 * linear.z;
    return sum / static_cast<double>(encoded.size());
  };
  const double base = luminance(target);
  EXPECT_NEAR(luminance(transfer_residual(matches, {exemplar}, target, {}, 0.75)) / base, 1.0,
              0.01);
  EXPECT_NEAR(luminance(transfer_residual(matches, {exemplar}, target, {}, 0.25)) / base, 1.0,
              0.01);
  Grid<glm::vec3> multiplied(width, height);
  for (std::size_t i = 0; i < multiplied.size(); ++i)
    multiplied[i] = exemplar.picture[i] * target[i].y;
  EXPECT_LT(luminance(multiplied) / base, 0.6);
}

// A painting that is darker and of another hue than the palette: with all of the lightness the
// picture is as light as its base, and a quarter of the hue stays.
TEST(TransferResidual, WholeLightnessKeepsThatOfTheBase) {
  PaintedExemplar exemplar;
  exemplar.picture = Grid<glm::vec3>(60, 40);
  exemplar.base = Grid<glm::vec3>(60, 40, glm::vec3(0.35F, 0.3F, 0.15F));
  MatchField matches(60, 40);
  for (const auto [x, y] : test::cells(60, 40)) {
    exemplar.picture(x, y) =
        exemplar.base(x, y) + glm::vec3(0.05F * static_cast<float>((x + y) % 2 == 0 ? 1 : -1));
    matches(x, y) = {0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
  }
  const glm::vec3 base(0.4F, 0.55F, 0.35F);
  const Grid<glm::vec3> target(60, 40, base);
  const auto mean = [&](const Residual& residual) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& colour : transfer_residual(matches, {exemplar}, target, {}, residual))
      sum += glm::dvec3(colour) / 2400.0;
    return sum;
  };
  const auto luma = [](const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; };
  EXPECT_NEAR(luma(mean({0.75, 1.0})), luma(base), 1e-4);
  EXPECT_LT(luma(mean(0.75)), 0.95 * luma(base)) << "a quarter of the painting's darkness";
  // Red minus green: -.15 of the base, .05 of the painting.
  EXPECT_NEAR(mean({0.75, 1.0}).x - mean({0.75, 1.0}).y, 0.75 * -0.15 + 0.25 * 0.05, 1e-4);
}

// Of a texel's own planes of rock only the strokes on them remain.
TEST(TransferResidual, RockAndSnowTakeAllOfTheLightOfTheirOwnPlace) {
  const std::vector<PaintedExemplar> exemplars = {make_exemplar(true)};
  const MatchField matches(2, 1, Match{0, 0, 0});
  Grid<LandCoverClass> shown(2, 1, LandCoverClass::scree);
  const auto painted = [&](LandCoverClass formed) {
    shown(1, 0) = formed;
    return transfer_residual(matches, exemplars, Grid<glm::vec3>(2, 1, glm::vec3(0.6F)), {}, 0.5,
                             shown);
  };
  EXPECT_NEAR(painted(LandCoverClass::rock)(0, 0).x, 0.5F + 0.5F * 0.2F, 1e-6F);
  EXPECT_NEAR(painted(LandCoverClass::rock)(1, 0).x, 0.5F + 0.2F, 1e-6F);
  // The texel's strokes are .1 lighter than its base: more than snow accepts.
  for (const LandCoverClass icy : {LandCoverClass::snow, LandCoverClass::glacier}) {
    EXPECT_GT(painted(icy)(1, 0).x, 0.6F + 0.5F * snow_strokes_max);
    EXPECT_LT(painted(icy)(1, 0).x, 0.6F + snow_strokes_max);
  }
}

// Paint of a model follows the formula of copies: the same texel and base give the same picture,
// for every class and through air.
TEST(LayModelPaint, IsTheLawOfCopies) {
  std::vector<PaintedExemplar> exemplars = {make_exemplar(true)};
  const int classes = static_cast<int>(land_cover_classes().size());
  MatchField matches(classes, 2);
  ModelPaint paint{Grid<std::uint8_t>(classes, 2), Grid<glm::vec3>(classes, 2),
                   Grid<glm::vec3>(classes, 2)};
  Grid<glm::vec3> base(classes, 2);
  Grid<LandCoverClass> shown(classes, 2);
  Grid<float> haze(classes, 2);
  for (const auto [x, y] : test::cells(classes, 2)) {
    matches(x, y) = {0, static_cast<std::uint16_t>(x % 3), static_cast<std::uint16_t>(y)};
    paint.made(x, y) = 1;
    paint.texel(x, y) = exemplars[0].picture(x % 3, y);
    paint.base(x, y) = exemplars[0].base(x % 3, y);
    base(x, y) = glm::vec3(0.05F * static_cast<float>(x), 0.5F, 0.3F);
    shown(x, y) = static_cast<LandCoverClass>(x);
    haze(x, y) = 0.3F * static_cast<float>(y);
  }
  const Grid<glm::vec3> copied = transfer_residual(matches, exemplars, base, haze, 0.75, shown);
  Grid<glm::vec3> made(classes, 2, glm::vec3(-1.F));
  paint.made(1, 1) = 0;
  lay_model_paint(made, paint, base, haze, 0.75, shown);
  EXPECT_EQ(made(1, 1), glm::vec3(-1.F)) << "what no model made stays";
  made(1, 1) = copied(1, 1);
  EXPECT_EQ(made, copied);
}

TEST(TransferResidual, RefusesMatchesOutside) {
  const std::vector<PaintedExemplar> exemplars = {make_exemplar(true)};
  const Grid<glm::vec3> base(1, 1);
  EXPECT_THROW(transfer_residual(MatchField(1, 1, Match{1, 0, 0}), exemplars, base, {}, 0.5),
               Error);
  EXPECT_THROW(transfer_residual(MatchField(1, 1, Match{0, 3, 0}), exemplars, base, {}, 0.5),
               Error);
  EXPECT_THROW(transfer_residual(MatchField(2, 1), exemplars, base, {}, 0.5), Error);
}

// Pasture left of x = 20, rock right of it.
Grid<LandCoverClass> two_classes() {
  Grid<LandCoverClass> classes(40, 30, LandCoverClass::pasture);
  for (const auto [x, y] : test::cells({20, 0, 40, 30})) classes(x, y) = LandCoverClass::rock;
  return classes;
}

Grid<LandCoverClass> shown_classes(const Painting& draft, const Grid<LandCoverClass>& land_cover) {
  Grid<LandCoverClass> shown = land_cover;
  for (std::size_t i = 0; i < shown.size(); ++i) shown[i] = land_cover[draft.sources[i]];
  return shown;
}

TEST(MixBorders, GivesTheBordersOfThePaintingItself) {
  GuidanceBuffers g;
  g.land_cover = two_classes();
  g.depth_m = Grid<float>(40, 30, 1000.F);
  g.tone = Grid<float>(40, 30, 0.5F);
  // Slanting dry strokes over the border, white where they are grass, black where they are rock.
  std::vector<Stroke> strokes;
  for (int k = 0; k < 60; ++k) {
    Stroke s;
    const glm::vec2 at(40.F * static_cast<float>(random_uniform(1, k, 0)),
                       30.F * static_cast<float>(random_uniform(1, k, 1)));
    s.points = {at - glm::vec2(5.F, 2.F), at + glm::vec2(5.F, 2.F)};
    s.point_count = 2;
    s.start_width = s.end_width = 3.F;
    s.alpha = 0.3F + 0.6F * static_cast<float>(random_uniform(1, k, 2));
    s.bristle = 0.5F;
    s.depth_m = 1000.F;
    s.seed = static_cast<std::uint32_t>(k);
    s.source =
        static_cast<std::uint32_t>(g.depth_m.index(static_cast<int>(at.x), static_cast<int>(at.y)));
    s.colour = glm::vec3(g.land_cover[s.source] == LandCoverClass::pasture ? 1.F : 0.F);
    strokes.push_back(s);
  }
  Grid<glm::vec3> canvas(40, 30, glm::vec3(0.F));
  for (std::size_t i = 0; i < canvas.size(); ++i)
    canvas[i] = glm::vec3(g.land_cover[i] == LandCoverClass::pasture ? 1.F : 0.F);
  Painting draft = begin_painting(canvas);
  paint_in_order(draft, g, strokes, 1.0, silent_progress());
  // A picture of whole pixels, each of its most frequent class: looks like torn paper.
  const Grid<LandCoverClass> shown = shown_classes(draft, g.land_cover);
  Grid<glm::vec3> copied = canvas;
  for (std::size_t i = 0; i < copied.size(); ++i)
    copied[i] = glm::vec3(shown[i] == LandCoverClass::pasture ? 1.F : 0.F);
  const Grid<glm::vec3> out = mix_borders(copied, draft, shown, g.land_cover, canvas);
  int mixed = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    ASSERT_NEAR(out[i].x, draft.picture[i].x, 0.5 / 255 + 1e-5) << i;
    mixed += out[i].x > 0.1F && out[i].x < 0.9F ? 1 : 0;
  }
  EXPECT_GT(mixed, 100);
}

TEST(MixBorders, TakesTheColourOfWhereTheStrokeGrew) {
  const Grid<LandCoverClass> land_cover = two_classes();
  Grid<glm::vec3> copied(40, 30, glm::vec3(0.2F));
  Painting draft = begin_painting(copied);
  const std::size_t grass = copied.index(3, 3);
  copied[grass] = glm::vec3(0.8F, 0.4F, 0.6F);
  Grid<glm::vec3> base(40, 30, glm::vec3(0.F));
  base[grass] = glm::vec3(1.F, 0.5F, 0.F);
  const std::size_t here = copied.index(30, 7);
  draft.under[here] = static_cast<std::uint32_t>(grass);
  draft.under_share[here] = 51;  // a fifth
  const Grid<glm::vec3> out = mix_borders(copied, draft, land_cover, land_cover, base);
  EXPECT_NEAR(out[here].x, 0.8 * 0.2 + 0.2 * 0.8, 1e-6);
  EXPECT_NEAR(out[here].z, 0.8 * 0.2 + 0.2 * 0.6, 1e-6);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (i != here) {
      ASSERT_EQ(out[i], copied[i]) << "one class alone";
    }
  // At the stroke's origin rock has been painted over the grass: its colour there is not that of
  // grass.
  Grid<LandCoverClass> shown = land_cover;
  shown[grass] = LandCoverClass::rock;
  const Grid<glm::vec3> hidden = mix_borders(copied, draft, shown, land_cover, base);
  EXPECT_NEAR(hidden[here].x, 0.8 * 0.2 + 0.2 * 1.0, 1e-6);
  EXPECT_NEAR(hidden[here].z, 0.8 * 0.2, 1e-6);
}

TEST(MixBorders, RefusesGridsOfDifferentSize) {
  const Painting draft = begin_painting(Grid<glm::vec3>(4, 3));
  const Grid<LandCoverClass> classes(4, 3);
  EXPECT_THROW(mix_borders(Grid<glm::vec3>(3, 3), draft, classes, classes, Grid<glm::vec3>(4, 3)),
               Error);
}

// Share of pixel x, y (centre at whole numbers) below the line v = slope u + offset, from 64 × 64
// samples: accurate to 1e-3.
double covered(int x, int y, double slope, double offset) {
  int inside = 0;
  for (const auto [i, j] : test::cells(64, 64)) {
    const double u = x - 0.5 + (i + 0.5) / 64;
    const double v = y - 0.5 + (j + 0.5) / 64;
    inside += v > slope * u + offset ? 1 : 0;
  }
  return inside / 4096.0;
}

struct Edge {
  Grid<glm::vec3> picture;
  GuidanceBuffers guidance;
  Grid<float> coverage;  // of the near surface
};

// A near surface below a slanted line in front of something else; every pixel is painted for the
// surface that fills most of it.
Edge make_edge(double slope, float far_depth, glm::vec3 near_colour, glm::vec3 far_colour) {
  constexpr int size = 40;
  Edge e{Grid<glm::vec3>(size, size), {}, Grid<float>(size, size)};
  e.guidance.depth_m = Grid<float>(size, size);
  e.guidance.front = Grid<float>(size, size);
  for (const auto [x, y] : test::cells(size, size)) {
    const double part = covered(x, y, slope, 12.3);
    const bool near = part >= 0.5;
    e.coverage(x, y) = static_cast<float>(part);
    e.picture(x, y) = near ? near_colour : far_colour;
    e.guidance.depth_m(x, y) = near ? 5000.0f : far_depth;
    e.guidance.front(x, y) = static_cast<float>(near ? part : 1.0 - part);
  }
  return e;
}

TEST(BlendEdges, GivesTheLightOfTheCoveredArea) {
  const glm::vec3 near_colour(0.2f, 0.3f, 0.1f);
  const glm::vec3 far_colour(0.7f, 0.8f, 0.95f);
  for (const double slope : {0.0, 0.37, 0.9})
    for (const float far_depth : {5300.0f, 40000.0f, infinity}) {
      const Edge e = make_edge(slope, far_depth, near_colour, far_colour);
      const Image out = decode_srgb(blend_edges(e.picture, e.guidance));
      const Image pure = decode_srgb(Grid<glm::vec3>(2, 1, near_colour));
      const Image sky = decode_srgb(Grid<glm::vec3>(2, 1, far_colour));
      double largest = 0.0;
      for (const auto [x, y] : test::cells(out)) {
        const float part = e.coverage(x, y);
        const glm::vec3 expected = part * pure(0, 0) + (1.0f - part) * sky(0, 0);
        for (int c = 0; c < 3; ++c)
          largest = std::max(
              largest, static_cast<double>(std::abs(out(x, y)[c] - expected[c]) / sky(0, 0)[c]));
      }
      EXPECT_LT(largest, 0.05) << slope << " " << far_depth;
    }
}

TEST(BlendEdges, LeavesWholePixelsAlone) {
  Edge e = make_edge(0.37, infinity, glm::vec3(0.2f), glm::vec3(0.9f));
  for (const auto [x, y] : test::cells(40, 40))
    e.picture(x, y) += static_cast<float>(0.05 * random_uniform(4, x, y));
  const Grid<glm::vec3> out = blend_edges(e.picture, e.guidance);
  int changed = 0;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (e.guidance.front[i] == 1.0f) {
      ASSERT_EQ(out[i], e.picture[i]);
    } else {
      changed += out[i] != e.picture[i] ? 1 : 0;
    }
  EXPECT_GT(changed, 30);
}

TEST(BlendEdges, OneSurfaceIsNotBlurred) {
  // front < 1 for another reason, and depths that change by less than 3 % from pixel to pixel.
  GuidanceBuffers guidance;
  guidance.depth_m = Grid<float>(8, 8);
  guidance.front = Grid<float>(8, 8, 0.6f);
  Grid<glm::vec3> picture(8, 8);
  for (const auto [x, y] : test::cells(8, 8)) {
    guidance.depth_m(x, y) = 1000.0f + 10.0f * static_cast<float>(x + y);
    picture(x, y) = glm::vec3(static_cast<float>(random_uniform(4, x, y)));
  }
  EXPECT_EQ(blend_edges(picture, guidance), picture);
  guidance.depth_m = Grid<float>(8, 8, infinity);
  EXPECT_EQ(blend_edges(picture, guidance), picture) << "sky next to sky";
  guidance.front = {};
  EXPECT_THROW(blend_edges(picture, guidance), Error) << "no depths and no front";
}

}  // namespace
}  // namespace belvedere
