#include "base/files/kept_files.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/files.h"

namespace belvedere {
namespace {

TEST(KeptFiles, AreReadOnceUntilOneChanges) {
  const test::Folder folder;
  folder.write("a.txt", "one");
  KeptFiles kept;
  int readings = 0;
  const auto get = [&](const std::string& key) {
    return *kept.get<int>(key, {folder / "a.txt"}, [&] { return ++readings; });
  };
  EXPECT_EQ(get("x"), 1);
  EXPECT_EQ(get("x"), 1);
  EXPECT_EQ(get("y"), 2) << "the same file, read in another way";
  folder.write("a.txt", "another");
  EXPECT_EQ(get("x"), 3);
  EXPECT_EQ(get("x"), 3);
}

TEST(KeptFiles, AFileThatCannotBeReadIsTriedAgain) {
  KeptFiles kept;
  const auto fails = [&] {
    kept.get<int>("x", {"none.txt"}, []() -> int { throw std::runtime_error("cannot be read"); });
  };
  EXPECT_THROW(fails(), std::runtime_error);
  EXPECT_THROW(fails(), std::runtime_error);
  EXPECT_EQ(*kept.get<int>("x", {"none.txt"}, [] { return 7; }), 7);
}

}  // namespace
}  // namespace belvedere
