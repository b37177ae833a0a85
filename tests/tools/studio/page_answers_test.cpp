#include "tools/studio/page_answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere::tools {
namespace {

using testing::HasSubstr;

TEST(PageAnswers, FilesComeFromTheFirstFolderThatHasThem) {
  EXPECT_THAT(page_file({"pick", "studio"}, "").body, HasSubstr("Pairs"));
  EXPECT_THAT(page_file({"studio", "pick"}, "index.html").body, HasSubstr("studio"));
  const HttpAnswer shared = page_file({"pick", "studio"}, "dom.js");
  EXPECT_EQ(shared.type, "text/javascript");
  EXPECT_THAT(shared.headers.at("Content-Security-Policy"), HasSubstr("script-src 'self'"));
  EXPECT_EQ(page_file({"pick"}, "dom.js").status, 404);
  EXPECT_EQ(page_file({"pick", "studio"}, "index.toml").status, 404);
}

TEST(PageAnswers, ErrorsHaveTheirStatus) {
  EXPECT_EQ(error_answer(Error(ErrorKind::usage, "x", "wrong", "right")).status, 422);
  EXPECT_EQ(error_answer(Error(ErrorKind::interrupted, "x", "superseded")).status, 409);
  EXPECT_EQ(error_answer(Error(ErrorKind::bug, "x", "impossible")).status, 500);
  EXPECT_THAT(error_answer(Error(ErrorKind::usage, "x", "wrong", "right")).body,
              HasSubstr("\"allowed\": \"right\""));
}

TEST(PageAnswers, APageIsLeftOnceItSaysSoAndNothingElseIsAsked) {
  PageVisits visits;
  EXPECT_FALSE(visits.is_left(0.0)) << "nobody has come yet";
  visits.asked({.method = "POST", .path = "api/close", .query = {}, .body = {}});
  EXPECT_TRUE(visits.is_left(0.0));
  EXPECT_FALSE(visits.is_left(60.0));
  visits.asked({.method = "GET", .path = "", .query = {}, .body = {}});
  EXPECT_FALSE(visits.is_left(0.0));
}

}  // namespace
}  // namespace belvedere::tools
