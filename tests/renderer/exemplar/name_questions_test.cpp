#include "renderer/exemplar/name_questions.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/land_cover_class.h"
#include "base/matrix/matrix.h"
#include "base/random.h"
#include "renderer/image/image_io.h"
#include "renderer/image/label_image.h"
#include "renderer/style/fit/style_painting.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using testing::ElementsAre;

std::uint8_t class_number(LandCoverClass one) { return static_cast<std::uint8_t>(one); }

TEST(SkyProbability, IsTheLogisticFunctionOfTheLook) {
  const PartLook look{{0.8, 0.0, -0.05}, 0.1, 0.5, 1.0, 1.0, 1.0};
  // -4.538 + 6.687 · .8 + 17.659 · .05 - 3.247 · .1 + 7.03 · .3 = 3.47885
  EXPECT_NEAR(sky_probability(look), 1.0 / (1.0 + std::exp(-3.47885)), 1e-9);
  PartLook flat = look, flatter = look;
  flat.rough = 0.4;
  flatter.rough = 0.01;
  EXPECT_EQ(sky_probability(flat), sky_probability(flatter));
  EXPECT_GT(sky_probability(flat), sky_probability(look));
}

// Two woods far apart, a meadow and the sky: nodes 0 … 3 of a tree.
PaintingSegments four_parts() {
  const PartLook wood{{0.3, -0.03, 0.04}, 0.7, 0.0, 1.0, 1.0, 1.0};
  PartLook other_wood = wood;
  other_wood.oklab.x = 0.31;
  const PartLook meadow{{0.7, -0.05, 0.1}, 0.7, 0.0, 1.0, 1.0, 1.0};
  const PartLook blue{{0.8, -0.02, -0.06}, 0.15, 1.0, 1.0, 1.0, 0.5};
  PaintingSegments out;
  out.pieces = Grid<std::uint16_t>(4, 1);
  for (int x = 0; x < 4; ++x) out.pieces(x, 0) = static_cast<std::uint16_t>(x);
  out.tree = {4, {{0, 1}, {2, 3}, {4, 5}}};
  out.looks = {wood, meadow, other_wood, blue, wood, meadow, wood};
  out.pixels = {100.0, 150.0, 120.0, 300.0, 250.0, 420.0, 670.0};
  out.inferred = {class_number(forest), class_number(rock), class_number(forest), class_number(sky),
                  class_number(rock),   class_number(sky),  class_number(rock)};
  return out;
}

TEST(NameQuestions, WhatLooksAlikeIsOneQuestionAndTheSkyIsNone) {
  const PaintingSegments segments = four_parts();
  const NameQuestions two = ask_names(segments, {0, 1, 2, 3}, 2);
  EXPECT_EQ(two.count, 2U);
  // The woods are 220 pixels, the meadow 150.
  EXPECT_THAT(two.of_group, ElementsAre(0, 1, 0, no_question));
  const NameQuestions all = ask_names(segments, {0, 1, 2, 3}, 9);
  EXPECT_EQ(all.count, 3U);
  EXPECT_THAT(all.of_group, ElementsAre(2, 0, 1, no_question));
}

TEST(NameQuestions, WhatMayBeSkyIsAskedFor) {
  PaintingSegments segments = four_parts();
  segments.looks[3].upper_edge = 0.0;  // a lake is as blue
  segments.looks[3].height = 0.9;
  EXPECT_NE(ask_names(segments, {0, 1, 2, 3}).of_group[3], no_question);
}

TEST(NamedGroups, AnAnswerCountsForTheWholeGroupAndDifferentOnesDivideIt) {
  const PaintingSegments segments = four_parts();
  const NamedGroups silent = name_groups(segments, 2, {});
  ASSERT_EQ(silent.nodes.size(), 2U);
  EXPECT_THAT(silent.named, ElementsAre(0, 0));
  EXPECT_EQ(silent.of_pieces[0], silent.of_pieces[1]);
  EXPECT_EQ(silent.classes[silent.of_pieces[0]], class_number(rock));
  EXPECT_EQ(silent.classes[silent.of_pieces[3]], class_number(sky));

  const NamedGroups once = name_groups(segments, 2, {{0.3, 0.5, class_number(shrub)}});
  ASSERT_EQ(once.nodes.size(), 2U);
  EXPECT_EQ(once.classes[once.of_pieces[0]], class_number(shrub));
  EXPECT_EQ(once.named[once.of_pieces[0]], 1);
  EXPECT_EQ(once.named[once.of_pieces[2]], 0);

  const NamedGroups twice =
      name_groups(segments, 2, {{0.1, 0.5, class_number(shrub)}, {0.3, 0.5, unused_label}});
  ASSERT_EQ(twice.nodes.size(), 3U);
  EXPECT_EQ(twice.classes[twice.of_pieces[0]], class_number(shrub));
  EXPECT_EQ(twice.classes[twice.of_pieces[1]], unused_label);
  EXPECT_EQ(twice.of_pieces[2], twice.of_pieces[3]);
}

std::string names_file(const std::string& text) {
  const std::string path = testing::TempDir() + "painting.names.toml";
  std::ofstream(path) << text;
  return path;
}

TEST(PlaceNames, AreReadFromTheirFile) {
  const std::vector<PlaceName> places =
      read_place_names(names_file("[[named]]\nat = [0.25, 0.5]\nclass = \"forest\"\n"
                                  "[[named]]\nat = [1, 0]\nclass = \"not used\"\n"));
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].across, 0.25);
  EXPECT_EQ(places[0].down, 0.5);
  EXPECT_EQ(places[0].class_id, class_number(forest));
  EXPECT_EQ(places[1].class_id, unused_label);
  EXPECT_TRUE(read_place_names(names_file("named = []\n")).empty());
}

TEST(PlaceNames, WhatIsWrongIsSaidWithItsPlace) {
  const auto said = [](const std::string& text) {
    try {
      read_place_names(names_file(text));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(said("[[named]]\nat = [0.2, 0.5]\nclass = \"moor\"\n"),
              testing::AllOf(testing::HasSubstr("names.toml:3"), testing::HasSubstr("moor")));
  EXPECT_THAT(said("[[named]]\nat = [0.2, 1.5]\nclass = \"rock\"\n"),
              testing::HasSubstr("names.toml:2"));
  EXPECT_THAT(said("[[named]]\nat = [0.2]\nclass = \"rock\"\n"), testing::HasSubstr("names.toml"));
  EXPECT_THAT(said("[[places]]\n"), testing::HasSubstr("places"));
}

using DrawnMask = Grid<std::uint8_t>;

bool was_drawn(std::uint8_t label) { return label < land_cover_classes().size(); }

// Intersection over union, mean of the classes that a hand drew (.5 % of what it drew at least).
double mean_overlap(const DrawnMask& found, const DrawnMask& drawn) {
  std::map<std::uint8_t, std::array<double, 3>> of;  // drawn, found, both
  double all = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (!was_drawn(drawn[i])) continue;
    all += 1.0;
    of[drawn[i]][0] += 1.0;
    of[found[i]][1] += 1.0;
    if (found[i] == drawn[i]) of[drawn[i]][2] += 1.0;
  }
  double sum = 0.0, classes = 0.0;
  for (const auto& [id, pixels] : of) {
    if (pixels[0] < 0.005 * all) continue;
    sum += pixels[2] / (pixels[0] + pixels[1] - pixels[2]);
    classes += 1.0;
  }
  return sum / std::max(classes, 1.0);
}

// Pixels of each class drawn in each group.
std::vector<std::map<std::uint8_t, double>> drawn_in(const PaintingSegments& segments,
                                                     const Partition& groups, std::size_t count,
                                                     const DrawnMask& drawn) {
  std::vector<std::map<std::uint8_t, double>> out(count);
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (was_drawn(drawn[i])) out[groups[segments.pieces[i]]][drawn[i]] += 1.0;
  return out;
}

struct NamedByHand {
  double overlap = 0.0;    // after all questions are answered
  double unasked = 0.0;    // as inferred, without an answer
  double sky_wrong = 0.0;  // share of what is surely sky and was drawn as something else
  double sky_found = 0.0;  // share of the drawn sky that is not asked for
  std::size_t questions = 0;
};

// Whoever answers says what most of a question's paint was drawn as.
NamedByHand named_by_hand(const PaintingSegments& segments, const DrawnMask& drawn,
                          const SkyModel& model) {
  const NamedGroups groups = name_groups(segments, 60, {});
  const NameQuestions questions = ask_names(segments, groups.nodes, usual_questions, model);
  const auto shown = drawn_in(segments, groups.of_pieces, groups.nodes.size(), drawn);
  NamedByHand out;
  out.questions = questions.count;
  out.unasked = mean_overlap(class_mask(segments, groups.of_pieces, groups.classes), drawn);
  std::vector<std::map<std::uint8_t, double>> of_question(questions.count);
  double sure = 0.0, right = 0.0, all_sky = 0.0;
  for (std::size_t k = 0; k < shown.size(); ++k)
    for (const auto& [id, pixels] : shown[k]) {
      if (id == class_number(sky)) all_sky += pixels;
      if (questions.of_group[k] != no_question) {
        of_question[questions.of_group[k]][id] += pixels;
        continue;
      }
      sure += pixels;
      if (id == class_number(sky)) right += pixels;
    }
  out.sky_wrong = sure > 0.0 ? 1.0 - right / sure : 0.0;
  out.sky_found = right / std::max(all_sky, 1.0);
  std::vector<std::uint8_t> classes = groups.classes;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    if (questions.of_group[k] == no_question) continue;
    const auto& seen = of_question[questions.of_group[k]];
    const auto most = std::max_element(
        seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most != seen.end()) classes[k] = most->first;
  }
  out.overlap = mean_overlap(class_mask(segments, groups.of_pieces, classes), drawn);
  return out;
}

// Sky, a cliff, two woods in a meadow and a lake, in uneven strokes.
LandCoverClass made_class(int x, int y) {
  if (y < 45) return sky;
  if (y < 75) return rock;
  if (y > 140) return water;
  const int dx = x % 110 - 55, dy = y - 108;
  return dx * dx + dy * dy < 26 * 26 ? forest : pasture;
}

TEST(NameQuestions, FewAnswersNameAMadePainting) {
  constexpr int width = 220, height = 180;
  const std::map<LandCoverClass, glm::vec3> colours = {{sky, {0.6F, 0.75F, 0.95F}},
                                                       {rock, {0.5F, 0.45F, 0.45F}},
                                                       {forest, {0.15F, 0.3F, 0.15F}},
                                                       {pasture, {0.6F, 0.7F, 0.3F}},
                                                       {water, {0.2F, 0.4F, 0.6F}}};
  Grid<glm::vec3> picture(width, height);
  DrawnMask drawn(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const LandCoverClass id = made_class(x, y);
      const double stroke = (id == sky ? 0.02 : 0.08) * (random_uniform(1, x / 3, y) - 0.5);
      picture(x, y) = colours.at(id) + static_cast<float>(stroke);
      drawn(x, y) = class_number(id);
    }
  const NamedByHand named =
      named_by_hand(segment_painting(picture, {}, usual_theta, "made"), drawn, SkyModel());
  EXPECT_GT(named.overlap, 0.9);
  EXPECT_LT(named.sky_wrong, 0.02);
  EXPECT_LE(named.questions, usual_questions);
}

// The paintings whose classes were drawn by hand.
struct DrawnPainting {
  std::string name;
  PaintingSegments segments;
  DrawnMask drawn;
};

constexpr std::array<std::array<const char*, 2>, 6> drawn_paintings = {
    {{"bruegel_harvesters.png", "bruegel"},
     {"gogh.jpg", "gogh"},
     {"monet_etretat.jpg", "monet"},
     {"rubens_het_steen.jpg", "rubens"},
     {"segantini_alps.jpg", "segantini"},
     {"turner_lake_of_zug.jpg", "turner"}}};

std::array<double, 6> terms_of(const PartLook& look) {
  return {1.0,
          look.oklab.x,
          look.oklab.z,
          look.height,
          std::min(look.upper_edge, 0.3),
          std::log(std::clamp(look.rough, 0.4, 3.0))};
}

// A regression with a ridge of .1 on terms of variance 1 (none on the constant), by Newton steps,
// on groups of three sizes; each painting has the weight 1.
SkyModel fit_sky(std::span<const DrawnPainting* const> paintings) {
  struct Row {
    std::array<double, 6> terms;
    double sky, weight;
  };
  std::vector<Row> rows;
  for (const DrawnPainting* painting : paintings)
    for (const std::size_t count : {16, 30, 60}) {
      const NamedGroups groups = name_groups(painting->segments, count, {});
      const auto shown =
          drawn_in(painting->segments, groups.of_pieces, groups.nodes.size(), painting->drawn);
      double all = 0.0;
      for (const auto& group : shown)
        for (const auto& [id, pixels] : group) all += pixels;
      for (std::size_t k = 0; k < shown.size(); ++k) {
        double pixels = 0.0;
        for (const auto& [id, of] : shown[k]) pixels += of;
        if (pixels < 0.0002 * all) continue;
        const auto found = shown[k].find(class_number(sky));
        rows.push_back({terms_of(painting->segments.looks[groups.nodes[k]]),
                        found == shown[k].end() ? 0.0 : found->second / pixels,
                        pixels / (3.0 * all)});
      }
    }
  std::array<double, 6> mean{}, spread{}, values{};
  double weight = 0.0;
  for (const Row& row : rows) weight += row.weight;
  for (std::size_t a = 1; a < 6; ++a) {
    for (const Row& row : rows) mean[a] += row.weight * row.terms[a] / weight;
    for (const Row& row : rows)
      spread[a] += row.weight * (row.terms[a] - mean[a]) * (row.terms[a] - mean[a]) / weight;
    spread[a] = std::sqrt(spread[a]);
    for (Row& row : rows) row.terms[a] = (row.terms[a] - mean[a]) / spread[a];
  }
  for (int round = 0; round < 60; ++round) {
    Matrix normal(6, 6);
    std::array<double, 6> right{};
    for (std::size_t a = 0; a < 6; ++a) {
      normal(a, a) = a == 0 ? 1e-6 : 0.1;
      right[a] = -normal(a, a) * values[a];
    }
    for (const Row& row : rows) {
      double sum = 0.0;
      for (std::size_t a = 0; a < 6; ++a) sum += values[a] * row.terms[a];
      const double p = 1.0 / (1.0 + std::exp(-sum));
      for (std::size_t a = 0; a < 6; ++a) {
        right[a] -= row.weight * row.terms[a] * (p - row.sky);
        for (std::size_t b = 0; b < 6; ++b)
          normal(a, b) += row.weight * p * (1.0 - p) * row.terms[a] * row.terms[b];
      }
    }
    const std::optional<Cholesky> factors = Cholesky::of(normal);
    if (!factors) break;
    const std::vector<double> step = factors->solve(right);
    for (std::size_t a = 0; a < 6; ++a) values[a] += step[a];
  }
  for (std::size_t a = 1; a < 6; ++a) {
    values[a] /= spread[a];
    values[0] -= values[a] * mean[a];
  }
  return {values[0], values[1], values[2], values[3], values[4], values[5]};
}

// Each of six paintings in turn, with what was learnt on the other five.
TEST(NameQuestionsLong, OnePaintingIsNamedAfterTheOthers) {
  const std::string masks = test::data_folder() + "/../look/manner/masks/";
  std::vector<DrawnPainting> paintings;
  for (const auto& [file, mask] : drawn_paintings) {
    const std::string path = test::data_folder() + "/paintings/" + file;
    for (const std::string& needed : {path, masks + mask + ".png"})
      if (!std::filesystem::exists(needed)) GTEST_SKIP() << needed << " is missing";
    paintings.push_back({mask, segment_painting(read_picture(path), {}, usual_theta, path),
                         read_class_mask(masks + mask + ".png", {far_air_label})});
  }
  double overlap = 0.0;
  for (const DrawnPainting& left_out : paintings) {
    std::vector<const DrawnPainting*> others;
    for (const DrawnPainting& other : paintings)
      if (&other != &left_out) others.push_back(&other);
    const NamedByHand named = named_by_hand(left_out.segments, left_out.drawn, fit_sky(others));
    fmt::print(
        "{}: overlap {:.2f} after {} questions, {:.2f} without; {:.0f} % of the sky is "
        "sure, {:.1f} % of that wrong\n",
        left_out.name, named.overlap, named.questions, named.unasked, 100.0 * named.sky_found,
        100.0 * named.sky_wrong);
    EXPECT_GE(named.overlap, 0.55) << left_out.name;
    EXPECT_LE(named.sky_wrong, 0.1) << left_out.name;
    overlap += named.overlap / static_cast<double>(paintings.size());
  }
  EXPECT_GE(overlap, 0.6);
  // The defaults are those of all six.
  std::vector<const DrawnPainting*> all;
  for (const DrawnPainting& one : paintings) all.push_back(&one);
  const SkyModel fitted = fit_sky(all), model;
  fmt::print("all: {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f}\n", fitted.constant, fitted.lightness,
             fitted.yellow, fitted.height, fitted.upper_edge, fitted.log_rough);
  EXPECT_NEAR(fitted.lightness, model.lightness, 0.7);
  EXPECT_NEAR(fitted.yellow, model.yellow, 2.0);
  EXPECT_NEAR(fitted.upper_edge, model.upper_edge, 1.0);
}

}  // namespace
}  // namespace belvedere
