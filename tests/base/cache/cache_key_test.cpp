#include "base/cache/cache_key.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/cache/cache.h"

namespace belvedere {
namespace {

template <class T>
std::string text(const T& value) {
  return CacheKeyText().add("value", value).str();
}

TEST(CacheKeyText, OtherNumbersAreOtherTexts) {
  const std::set<std::string> texts = {
      text(0.1), text(std::nextafter(0.1, 1.0)), text(0.0), text(-0.0), text(0.1F), text(1),
      text(true)};
  EXPECT_EQ(texts.size(), 7U);
  EXPECT_EQ(text(0.1), "value=0x1.999999999999ap-4\n") << "as C prints %a";
  EXPECT_EQ(text(std::uint64_t{18446744073709551615U}), "value=18446744073709551615\n");
}

// No value can look like two values, or like part of its neighbour.
TEST(CacheKeyText, TextsAndListsKeepTheirEnds) {
  using Texts = std::vector<std::string>;
  const std::set<std::string> texts = {text(Texts{"a", "b"}), text(Texts{"ab"}),
                                       text(Texts{"a\",1\"b"}), text(Texts{"a,", "b"}),
                                       text(Texts{})};
  EXPECT_EQ(texts.size(), 5U);
  EXPECT_NE(CacheKeyText().add("a", "x\nb=1\"y\"").str(),
            CacheKeyText().add("a", "x").add("b", "y").str());
  using Settings = std::vector<std::pair<std::string, double>>;
  EXPECT_NE(text(Settings{{"a", 1.0}, {"b", 2.0}}), text(Settings{{"b", 2.0}, {"a", 1.0}}));
  EXPECT_NE(text(std::optional<double>()), text(std::optional<double>(0.0)));
  EXPECT_NE(text(glm::dvec2(1.0, 2.0)), text(glm::dvec2(2.0, 1.0)));
}

TEST(CacheKeyText, OneCellMakesAnotherGrid) {
  Grid<float> grid(40, 30, 2.F);
  const std::string before = text(grid);
  EXPECT_EQ(text(Grid<float>(40, 30, 2.F)), before);
  EXPECT_NE(text(Grid<float>(30, 40, 2.F)), before);
  grid(39, 29) = std::nextafter(2.F, 3.F);
  EXPECT_NE(text(grid), before);
}

}  // namespace
}  // namespace belvedere
