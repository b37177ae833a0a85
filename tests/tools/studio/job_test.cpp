#include "tools/studio/job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "base/error.h"

namespace belvedere::tools {
namespace {

Job::Report ended(const Job& job) {
  while (job.report().state == Job::State::running) std::this_thread::yield();
  return job.report();
}

TEST(Job, AFailureIsReportedWithItsMessage) {
  Job job("rendering");
  EXPECT_EQ(job.report().state, Job::State::idle);
  job.start("out", {}, [](const auto&) -> std::string {
    throw Error(ErrorKind::input, "/nowhere/terrain.tif", "file not found");
  });
  const Job::Report report = ended(job);
  EXPECT_EQ(report.state, Job::State::failed);
  EXPECT_NE(report.error.find("/nowhere/terrain.tif"), std::string::npos) << report.error;
}

TEST(Job, AResultIsKept) {
  Job job("rendering");
  job.start("out", {}, [](const auto&) -> std::string { return "page"; });
  EXPECT_EQ(ended(job).state, Job::State::done);
  EXPECT_EQ(job.report().result, "page");
  EXPECT_EQ(job.report().folder, "out");
}

// Requests of several connections: each is begun or refused, and a job that ends while the next
// one begins is no harm.
TEST(Job, StartsAtTheSameTimeAreOneAfterTheOther) {
  Job job("rendering");
  std::atomic<int> begun = 0;
  std::atomic<int> refused = 0;
  std::vector<std::thread> pages;
  for (int page = 0; page < 4; ++page)
    pages.emplace_back([&] {
      for (int i = 0; i < 20; ++i) try {
          job.start("out", {}, [](const auto&) -> std::string { return ""; });
          ++begun;
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::usage);
          ++refused;
        }
    });
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(ended(job).state, Job::State::done);
  EXPECT_GE(begun, 1);
  EXPECT_EQ(begun + refused, 80);
}

}  // namespace
}  // namespace belvedere::tools
