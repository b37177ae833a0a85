#include "tools/studio/request_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "base/config.h"
#include "base/error.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

using testing::HasSubstr;

// The TOML of one value.
std::string toml_of_json(const std::string& json) {
  const SetBody body = read_set_body(R"({"changes": [{"key": "a.b", "value": )" + json + "}]}");
  EXPECT_EQ(body.edits.size(), 1U);
  parse_config("v = " + body.edits[0].value.value_or(""), "value");
  return body.edits[0].value.value_or("");
}

TEST(RequestBody, ValuesOfEveryKindBecomeToml) {
  for (const auto& [json, toml] : std::initializer_list<std::pair<const char*, const char*>>{
           {"200", "200"},
           {"-3", "-3"},
           {"0.5", "0.5"},
           {"1.0", "1.0"},
           {"-1e-7", "-1e-07"},
           {"1e300", "1e+300"},
           {"9007199254740991", "9007199254740991"},
           {"true", "true"},
           {"false", "false"},
           {R"("summer")", R"("summer")"},
           {R"("")", R"("")"},
           {"\"Zürich \\u00e9\"", "\"Zürich é\""},
           {R"("a \"b\" \\ c\nd\te")", R"("a \"b\" \\ c\nd\te")"},
           {"\"\\u0001\"", "\"\\u0001\""},
           {"[]", "[]"},
           {"[1, 2.5, -3]", "[1, 2.5, -3]"},
           {R"([[1, 2], ["a"]])", R"([[1, 2], ["a"]])"},
           {R"({"rock": 2, "odd name": [1]})", R"({ "rock" = 2, "odd name" = [1] })"},
       })
    EXPECT_EQ(toml_of_json(json), toml);
  EXPECT_EQ(toml_of_json("{}"), "{  }");
}

TEST(RequestBody, ChangesAreEditsInTheirOrder) {
  const SetBody body = read_set_body(R"({"changes": [
    {"key": "sun.azimuth_deg", "value": 200},
    {"key": "sun.time", "remove": true},
    {"key": "deform.handles", "append": {"position": [1, 2], "radius_m": 3000}}],
    "step": "drag-7"})");
  ASSERT_EQ(body.edits.size(), 3U);
  EXPECT_EQ(body.step, "drag-7");
  EXPECT_EQ(body.edits[0].key, "sun.azimuth_deg");
  EXPECT_EQ(body.edits[0].value, "200");
  EXPECT_FALSE(body.edits[0].append);
  EXPECT_EQ(body.edits[1].key, "sun.time");
  EXPECT_FALSE(body.edits[1].value.has_value());
  EXPECT_TRUE(body.edits[2].append);
  EXPECT_EQ(body.edits[2].value, R"({ "position" = [1, 2], "radius_m" = 3000 })");
  EXPECT_EQ(read_set_body(R"({"changes": []})").edits.size(), 0U);
  EXPECT_EQ(read_set_body(R"({"changes": []})").step, "");
}

TEST(RequestBody, RefusesWhatItDoesNotUnderstand) {
  const std::string deep = R"({"changes": [{"key": "a", "value": )" + std::string(50000, '[') +
                           std::string(50000, ']') + "}]}";
  for (const std::string& body : {
           std::string("no JSON"),
           std::string("[1, 2]"),
           std::string("\"text\""),
           std::string("{"),
           std::string("{} {}"),
           std::string(R"({"changes": 1})"),
           std::string(R"({"changes": {"key": "a", "value": 1}})"),
           std::string(R"({"change": []})"),
           std::string(),
           std::string(R"({"changes": [1]})"),
           std::string(R"({"changes": [{"value": 1}]})"),
           std::string(R"({"changes": [{"key": 7, "value": 1}]})"),
           std::string(R"({"changes": [{"key": "a"}]})"),
           std::string(R"({"changes": [{"key": "a", "remove": false}]})"),
           std::string(R"({"changes": [{"key": "a", "value": null}]})"),
           std::string(R"({"changes": [{"key": "a", "value": [1, null]}]})"),
           std::string(R"({"changes": [{"key": "a", "append": null}]})"),
           std::string(R"({"changes": [], "step": 7})"),
           std::string("{\"changes\": [{\"key\": \"a\", \"value\": \"\xff\"}]}"),
           deep,
       }) {
    const Error error = test::error_of([&] { read_set_body(body); });
    EXPECT_EQ(error.kind(), ErrorKind::usage) << body.substr(0, 60);
    EXPECT_FALSE(error.allowed().empty());
  }
}

TEST(RequestBody, MembersThatAreTexts) {
  EXPECT_EQ(read_text_member(R"({"text": "a\nb"})", "text"), "a\nb");
  EXPECT_EQ(read_text_member("{}", "text", "none"), "none");
  EXPECT_EQ(read_text_member("", "text"), "") << "no body is an object without members";
  EXPECT_EQ(test::error_of([] { read_text_member(R"({"text": 1})", "text"); }).kind(),
            ErrorKind::usage);
}

TEST(RequestBody, MembersThatAreWholeNumbers) {
  EXPECT_EQ(read_number_member(R"({"width": 2400})", "width", 7), 2400);
  EXPECT_EQ(read_number_member("{}", "width", 7), 7);
  for (const char* body :
       {R"({"width": "2400"})", R"({"width": 2400.5})", R"({"width": null})",
        R"({"width": 4294967312})", R"({"width": -4294967280})", R"({"width": 1e99})"})
    EXPECT_THAT(test::error_of([&] { read_number_member(body, "width", 7); }).found(),
                HasSubstr("width"))
        << body;
}

TEST(RequestBody, PointsAndFlagsAreThereOrNot) {
  const std::string body = R"({"pixel": [1.5, -2], "sure": true, "one": [1], "text": "yes"})";
  EXPECT_EQ(read_point_member(body, "pixel"), glm::dvec2(1.5, -2.0));
  EXPECT_FALSE(read_point_member(body, "position"));
  EXPECT_EQ(read_flag_member(body, "sure"), true);
  EXPECT_FALSE(read_flag_member(body, "other"));
  for (const char* name : {"one", "sure", "text"})
    EXPECT_EQ(test::kind_of([&] { read_point_member(body, name); }), ErrorKind::usage) << name;
  for (const char* name : {"pixel", "text"})
    EXPECT_EQ(test::kind_of([&] { read_flag_member(body, name); }), ErrorKind::usage) << name;
}

}  // namespace
}  // namespace belvedere::tools
