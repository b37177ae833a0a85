#include "tools/report/text_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

TEST(TextFile, IsThereWholeOrNotAtAll) {
  const test::Folder folder;
  const std::string path = folder / "a.txt";
  const std::string text("two\r\nlines\n\0of bytes", 20);
  write_text_file(path, "older and longer than what comes after it");
  write_text_file(path, text);
  std::ostringstream read;
  read << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_EQ(read.str(), text);
  EXPECT_EQ(folder.count(), 1U);
  EXPECT_THROW(write_text_file(folder / "missing/a.txt", text), Error);
}

}  // namespace
}  // namespace belvedere::tools
