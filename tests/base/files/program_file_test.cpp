#include "base/files/program_file.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace belvedere {
namespace {

TEST(ProgramFile, IsTheRunningProgramUntilAModuleNamesItself) {
  const std::string before = program_file();
  EXPECT_EQ(std::filesystem::read_symlink(before).filename(), "base_tests");
  program_file() = "/usr/lib/module.so";
  EXPECT_EQ(program_file(), "/usr/lib/module.so");
  program_file() = before;
}

}  // namespace
}  // namespace belvedere
