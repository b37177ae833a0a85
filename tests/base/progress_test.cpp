#include "base/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/notes.h"

namespace belvedere {
namespace {

using testing::ElementsAre;

struct All : Progress {
  std::vector<std::string> heard;
  void begin(std::string_view stage, double total) override {
    heard.push_back(std::string(stage) + " " + std::to_string(total));
  }
  void advance(double amount) override { heard.push_back(std::to_string(amount)); }
  void note(std::string_view text) override { heard.emplace_back(text); }
};

// A stage as in the library.
void work(Progress& progress) {
  progress.begin("tracing", 2.0);
  progress.advance(1.0);
  progress.note("a void is filled");
  progress.advance(1.0);
}

TEST(Progress, WhoListensHearsEverythingInItsOrder) {
  All all;
  work(all);
  EXPECT_THAT(all.heard,
              ElementsAre("tracing 2.000000", "1.000000", "a void is filled", "1.000000"));
}

TEST(Progress, WhoListensToNotesNeedNotListenToMore) {
  test::Notes notes;
  work(notes);
  EXPECT_THAT(notes.all, ElementsAre("a void is filled"));
}

// It is shared by all callers without a report, so it must have no state.
TEST(Progress, TheSilentOneIsOneForAll) {
  EXPECT_EQ(&silent_progress(), &silent_progress());
  EXPECT_NO_THROW(work(silent_progress()));
}

TEST(RepeatedStages, OfManyPiecesAreOneStageThatTheCallerBeganAndRemarkOnce) {
  All all;
  RepeatedStages pieces(all, false);
  work(pieces);
  work(pieces);
  EXPECT_THAT(all.heard,
              ElementsAre("0.000000", "a void is filled", "0.000000", "0.000000", "0.000000"));
}

TEST(RepeatedStages, OfFewPiecesAreToldOfOneByOneAndRemarkOnce) {
  All all;
  RepeatedStages pieces(all, true);
  work(pieces);
  work(pieces);
  EXPECT_THAT(all.heard,
              ElementsAre("tracing 2.000000", "1.000000", "a void is filled", "1.000000",  //
                          "tracing 2.000000", "1.000000", "1.000000"));
}

// A progress callback stops a job by throwing; that must also work with silent_progress().
TEST(RepeatedStages, LetAWishToStopThrough) {
  struct Stops : Progress {
    void advance(double) override { throw std::runtime_error("stopped"); }
  } stops;
  RepeatedStages pieces(stops, false);
  EXPECT_THROW(work(pieces), std::runtime_error);
}

}  // namespace
}  // namespace belvedere
