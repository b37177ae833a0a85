#include "base/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace belvedere {
namespace {

using testing::ElementsAre;

// A stage as the library has them.
void work(Progress& progress) {
  progress.begin("tracing", 2.0);
  progress.advance(1.0);
  progress.note("a void is filled");
  progress.advance(1.0);
}

TEST(Progress, WhoListensHearsEverythingInItsOrder) {
  struct All : Progress {
    std::vector<std::string> heard;
    void begin(std::string_view stage, double total) override { heard.push_back(std::string(stage) + " " + std::to_string(total)); }
    void advance(double amount) override { heard.push_back(std::to_string(amount)); }
    void note(std::string_view text) override { heard.emplace_back(text); }
  } all;
  work(all);
  EXPECT_THAT(all.heard, ElementsAre("tracing 2.000000", "1.000000", "a void is filled", "1.000000"));
}

TEST(Progress, WhoListensToNotesNeedNotListenToMore) {
  struct Notes : Progress {
    std::vector<std::string> heard;
    void note(std::string_view text) override { heard.emplace_back(text); }
  } notes;
  work(notes);
  EXPECT_THAT(notes.heard, ElementsAre("a void is filled"));
}

// It is shared by all that have nobody to tell, so it must not remember anything: not even who asked for it.
TEST(Progress, TheSilentOneIsOneForAll) {
  EXPECT_EQ(&silent_progress(), &silent_progress());
  EXPECT_NO_THROW(work(silent_progress()));
}

}  // namespace
}  // namespace belvedere
