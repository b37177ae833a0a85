#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "renderer/base/error.h"
#include "terrain/raster.h"

namespace belvedere {

// A folder of its own for each test, gone afterwards.
class RasterFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("belvedere_" + std::string(info->test_suite_name()) + "_" + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    unsetenv("BELVEDERE_MEMORY_MIB");
    std::filesystem::remove_all(folder_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  std::string read_text(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }
  // An ESRI ASCII grid of 1-unit… cells, its lower left corner at (x, y); a .prj beside it where a CRS is wanted is not needed:
  // sources can say theirs.
  std::string write_ascii(const std::string& name, int width, int height, double x, double y, double cell,
                          const std::function<std::string(int, int)>& value, const std::string& nodata = "") const {
    std::ostringstream text;
    text.precision(17);
    text << "ncols " << width << "\nnrows " << height << "\nxllcorner " << x << "\nyllcorner " << y << "\ncellsize " << cell << '\n';
    if (!nodata.empty()) text << "NODATA_value " << nodata << '\n';
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) text << (column == 0 ? "" : " ") << value(column, row);
      text << '\n';
    }
    return write_text(name, text.str());
  }

  std::filesystem::path folder_;
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

}  // namespace belvedere
