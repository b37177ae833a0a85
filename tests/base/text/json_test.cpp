#include "base/text/json.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace belvedere {
namespace {

TEST(Json, NestsInTheOrderAdded) {
  const Json json = Json::object()
                        .add("b", Json::number(1.5))
                        .add("a", Json::array({Json::boolean(true), Json::text("x")}))
                        .add("none", Json::array())
                        .add("empty", Json::object())
                        .add("raw", Json::raw("[1, 2]"));
  EXPECT_EQ(json.str(),
            "{\n  \"b\": 1.5,\n  \"a\": [\n    true,\n    \"x\"\n  ],\n  \"none\": [],\n  "
            "\"empty\": {},\n  \"raw\": [1, 2]\n}");
}

TEST(Json, ListsOfNumbersStandOnOneLine) {
  EXPECT_EQ(Json::object()
                .add("n", Json::numbers(std::vector<float>{1.F, 0.5F}))
                .add("none", Json::numbers(std::vector<int>()))
                .str(),
            "{\n  \"n\": [1, 0.5],\n  \"none\": []\n}");
}

TEST(Json, EscapesWhatMustBe) {
  EXPECT_EQ(json_quoted("a\"b\\c\nd\te\x01\x7f ü"), "\"a\\\"b\\\\c\\nd\\te\\u0001\\u007f ü\"");
  EXPECT_EQ(Json::object().add("k\"", Json::texts({"v\n"})).str(),
            "{\n  \"k\\\"\": [\n    \"v\\n\"\n  ]\n}");
}

TEST(Json, NumbersReadBackAndInfinitiesAreTexts) {
  EXPECT_EQ(Json::number(0.1).str(), "0.1");
  EXPECT_EQ(Json::number(2400.0).str(), "2400");
  EXPECT_EQ(Json::number(std::numeric_limits<double>::infinity()).str(), "\"inf\"");
  EXPECT_EQ(Json::number(std::numeric_limits<double>::quiet_NaN()).str(), "\"nan\"");
}

}  // namespace
}  // namespace belvedere
