#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>

#include "base/error.h"

// Files and errors, as tests of all layers meet them.
namespace belvedere::test {

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

inline void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// A folder of one test's own, so that tests may run side by side; gone with the object. `name`
// tells several of one test apart.
class Folder {
 public:
  explicit Folder(const std::string& name = "files") {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    const std::string whose = test == nullptr
                                  ? std::string("all")
                                  : std::string(test->test_suite_name()) + "." + test->name();
    std::string single = whose + "-" + name;
    for (char& c : single)
      if (c == '/') c = '_';  // of tests with parameters
    path_ = std::filesystem::path(::testing::TempDir()) /
            ("belvedere-" + std::to_string(getpid()) + "-" + single);
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path() const { return path_.string(); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // Writes a file, in folders that are made where they are missing, and gives its path.
  std::string write(const std::string& name, std::string_view bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    write_bytes(path_ / name, bytes);
    return *this / name;
  }
  // Files and folders right in it.
  std::size_t count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_),
                                                  std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

// What f throws; fails where it throws nothing or something else.
inline Error error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return Error(ErrorKind::bug, "", "");
}

// The kind of what f throws, which says where.
inline ErrorKind kind_of(const std::function<void()>& f) {
  const Error error = error_of(f);
  EXPECT_FALSE(error.where().empty()) << error.what();
  return error.kind();
}

// The message of the Error(kind) that f throws.
inline std::string message_of(ErrorKind kind, const std::function<void()>& f) {
  const Error error = error_of(f);
  EXPECT_EQ(error.kind(), kind) << error.what();
  return error.what();
}
inline std::string usage_error(const std::function<void()>& f) {
  return message_of(ErrorKind::usage, f);
}
inline std::string input_error(const std::function<void()>& f) {
  return message_of(ErrorKind::input, f);
}

}  // namespace belvedere::test
