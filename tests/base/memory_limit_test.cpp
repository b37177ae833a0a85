#include "base/memory_limit.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

class MemoryBudget : public testing::Test {
 protected:
  void TearDown() override { unsetenv("BELVEDERE_MEMORY_MIB"); }
};

TEST_F(MemoryBudget, IsPartOfTheMachine) {
  EXPECT_GT(memory_budget_bytes(), std::uint64_t{64} << 20);
  EXPECT_NO_THROW(check_memory("small.tif", 1e6));
  EXPECT_THROW(check_memory("huge.tif", 1e30), Error);
}

TEST_F(MemoryBudget, IsSetByTheEnvironment) {
  setenv("BELVEDERE_MEMORY_MIB", "16", 1);
  EXPECT_EQ(memory_budget_bytes(), std::uint64_t{16} << 20);
  EXPECT_NO_THROW(check_memory("a.tif", 16.0 * 1048576.0));
  const Error error = test::error_of([&] { check_memory("a.tif", 16.0 * 1048576.0 + 1.0); });
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_EQ(error.where(), "a.tif");
}

TEST_F(MemoryBudget, IsLimitedWhileALimitLives) {
  const std::uint64_t before = memory_budget_bytes();
  {
    const MemoryLimit wide(std::uint64_t{64} << 20);
    EXPECT_EQ(memory_budget_bytes(), std::uint64_t{64} << 20);
    const MemoryLimit narrow(std::uint64_t{16} << 20);
    const MemoryLimit none(0);
    const MemoryLimit again(std::uint64_t{32} << 20);  // the strictest one holds
    EXPECT_EQ(memory_budget_bytes(), std::uint64_t{16} << 20);
    EXPECT_THROW(check_memory("a.tif", 17.0 * 1048576.0), Error);
  }
  EXPECT_EQ(memory_budget_bytes(), before);
}

TEST_F(MemoryBudget, RefusesWhatIsNoNumber) {
  for (const char* text : {"0", "-1", "many", "12x", "1e3", "99999999999999999999"}) {
    setenv("BELVEDERE_MEMORY_MIB", text, 1);
    EXPECT_THROW(memory_budget_bytes(), Error) << text;
  }
}

}  // namespace
}  // namespace belvedere
