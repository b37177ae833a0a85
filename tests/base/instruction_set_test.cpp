#include "base/instruction_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "tests/files.h"

namespace belvedere {
namespace {

using test::message_of;
using test::usage_error;
using ::testing::AllOf;
using ::testing::HasSubstr;

class InstructionSet : public testing::Test {
 protected:
  void SetUp() override { unsetenv("BELVEDERE_INSTRUCTION_SET"); }
  void TearDown() override { unsetenv("BELVEDERE_INSTRUCTION_SET"); }
};

// The kernel's own list of what the processor can do.
TEST_F(InstructionSet, WidestIsWhatTheKernelSays) {
  std::istringstream file(test::read_bytes("/proc/cpuinfo"));
  std::string flags;
  for (std::string line; flags.empty() && std::getline(file, line);)
    if (line.starts_with("flags")) flags = line + ' ';
  if (flags.empty()) GTEST_SKIP() << "/proc/cpuinfo names no flags";
  const auto has = [&](const char* flag) {
    return flags.find(' ' + std::string(flag) + ' ') != std::string::npos;
  };
  std::string widest = "sse2";
  if (has("sse4_2")) widest = "sse4.2";
  if (has("avx")) widest = "avx";
  if (has("avx2") && has("fma")) widest = "avx2";
  if (has("avx512f") && has("avx512bw") && has("avx512vl")) widest = "avx512";
  EXPECT_EQ(machine_instruction_set(), widest);
}

TEST_F(InstructionSet, NarrowerOnesAreThereAndWiderOnesAreMissed) {
  const std::vector<std::string> names = instruction_sets();
  const std::string machine = machine_instruction_set();
  for (std::size_t widest = 0; names[widest] != machine; ++widest) {
    setenv("BELVEDERE_INSTRUCTION_SET", names[widest].c_str(), 1);
    EXPECT_EQ(machine_instruction_set(), names[widest]);
    EXPECT_EQ(choose_instruction_set("any"), names[widest]);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (i <= widest) {
        EXPECT_EQ(choose_instruction_set(names[i]), names[i]);
      } else {
        EXPECT_THAT(message_of(ErrorKind::limit, [&] { choose_instruction_set(names[i]); }),
                    AllOf(HasSubstr(instruction_set_title(names[i])),
                          HasSubstr('"' + names[widest] + '"')));
      }
  }
  // The environment variable cannot enable what the machine lacks.
  setenv("BELVEDERE_INSTRUCTION_SET", "avx512", 1);
  EXPECT_EQ(machine_instruction_set(), machine);
}

TEST_F(InstructionSet, UnknownNamesAreUsageErrors) {
  EXPECT_THAT(usage_error([] { choose_instruction_set("mmx"); }),
              AllOf(HasSubstr("\"mmx\""), HasSubstr("avx2")));
  setenv("BELVEDERE_INSTRUCTION_SET", "neon", 1);
  EXPECT_THAT(usage_error([] { machine_instruction_set(); }),
              AllOf(HasSubstr("BELVEDERE_INSTRUCTION_SET"), HasSubstr("neon")));
}

}  // namespace
}  // namespace belvedere
