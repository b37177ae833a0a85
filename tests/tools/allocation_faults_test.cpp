// Memory that is not there: the n-th allocation of a run fails, for n in all stages of a picture.
// The run ends with status 5, older results stay, nothing half-written is left.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

// Numbers from 1 to total: half of them evenly, half by a constant factor.
std::vector<std::size_t> spread(std::size_t total, int count) {
  std::set<std::size_t> out;
  for (int k = 0; k < count; ++k) {
    const double t = (k / 2 + 0.5) / ((count + 1) / 2);
    const double n =
        k % 2 == 0 ? t * static_cast<double>(total) : std::pow(static_cast<double>(total), t);
    out.insert(std::clamp(static_cast<std::size_t>(n), std::size_t{1}, total));
  }
  return {out.begin(), out.end()};
}

class AllocationFaults : public Program {
 protected:
  void SetUp() override {
    fs::create_directory(path("out"));
    for (const std::string& name : older_) write("out/" + name, "an older " + name);
  }
  // In a fork of this process, also under sanitizers, with a scene of 64 × 32 pixels.
  Outcome render(std::size_t failing, const std::string& more) const {
    const std::string scene =
        write("scene.toml",
              "version = 1\n[terrain.synthetic]\nwidth = 40\nheight = 40\ncell_m = 400\n"
              "[camera]\nposition = [8000, -8000]\nheight_m = 9000\npitch_deg = -25\n[sampling]\n"
              "pixel_samples = 1\nshadow_rays = 1\nsky_directions = 1\n[output]\nwidth = 64\n"
              "height = 32\nsheet_width_mm = 64\n" +
                  more);
    const pid_t child = test::start_in_server(
        {"render", scene, "--out", path("out"), "--threads", "1", "--no-cache", "-q", "--force"},
        {fmt::format("{}={}", test::failing_allocation, failing),
         fmt::format("{}={}", test::allocations_file, path("allocations"))},
        path("stdout"), path("stderr"));
    return finish(child);
  }
  // A failure after the files are renamed leaves the new ones.
  // Fails `count` allocations of a run, one at a time.
  void fail_each(int count, const std::string& more) {
    const Outcome whole = render(0, more);
    ASSERT_EQ(whole.status, 0) << whole.err;
    const std::size_t total = std::stoul(read_bytes(path("allocations")));
    for (const std::string& name : older_) whole_[name] = read_bytes(path("out/" + name));
    ASSERT_GT(total, 10000U);
    int foreign = 0;
    for (const std::size_t n : spread(total, count)) {
      SetUp();
      const Outcome outcome = render(n, more);
      if (outcome.status == 0) continue;  // a library did without that memory
      expect_older_files(n, outcome.status > 1000);
      if (outcome.status == 5) {
        EXPECT_THAT(outcome.err, HasSubstr("memory")) << n << " of " << total;
        continue;
      }
      // Of libraries: OpenColorIO ends the program while it fills its table of transforms, and
      // streams take what they had no memory for as the end of a text.
      ++foreign;
      EXPECT_THAT(outcome.err, Not(HasSubstr("internal error"))) << n << " of " << total;
    }
    EXPECT_LE(foreign, count / 100) << "neither status 5 nor a whole result";
  }
  void expect_older_files(std::size_t n, bool killed) {
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(path("out")))
      files.insert(entry.path().filename().string());
    files.erase(".belvedere");          // whole pieces, for --resume
    files.erase(".belvedere_results");  // what the run began to write here
    // A library that ends the program leaves what a killed run leaves; the next run removes it.
    if (killed) std::erase_if(files, [](const auto& name) { return name.starts_with(".belv"); });
    EXPECT_EQ(files, older_) << "after failure " << n;
    for (const std::string& name : older_) {
      const std::string bytes = read_bytes(path("out/" + name));
      EXPECT_TRUE(bytes == "an older " + name || bytes == whole_[name])
          << name << " after failure " << n;
    }
  }
  std::map<std::string, std::string> whole_;  // bytes of the results
  const std::set<std::string> older_ = {"panorama.tif", "panorama.png", "panorama.exr",
                                        "guidance.exr"};
};

constexpr const char* without_synthesis = "[synthesis]\nenabled = false\n";

TEST_F(AllocationFaults, EndARunWithStatusFive) { fail_each(4, without_synthesis); }

using AllocationFaultsLong = AllocationFaults;
TEST_F(AllocationFaultsLong, EndARunInAnyStage) { fail_each(600, without_synthesis); }
TEST_F(AllocationFaultsLong, EndARunWithCopiedTexture) { fail_each(60, ""); }

}  // namespace
}  // namespace belvedere
