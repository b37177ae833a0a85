#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.h"
#include "renderer/image/image_file.h"
#include "renderer/image/rows/picture_rows.h"

namespace belvedere {

// A format of picture files: how it is identified, read and written. A new one is a file with these
// functions and a row.
struct PictureFormat {
  std::string_view extension = {};  // of its files, without the dot: "tif"
  std::string_view name = {};       // ImageInfo::format: "tiff"
  std::string_view title = {};      // display name: "TIFF"
  std::string_view meaning = {};    // use of a picture in it; empty: it is only read
  int bits = 0;                     // of a written channel
  bool linear = false;              // holds scene-linear half floats, else encoded whole numbers
  bool device = false;              // is converted to the printer's profile if there is one
  bool profile = false;             // carries an ICC profile
  bool resolution = false;          // carries dots per inch
  bool notes = false;               // carries FileNotes
  bool (*is)(std::string_view first_bytes) = nullptr;
  ImageInfo (*read_info)(const std::string& path) = nullptr;
  Grid<glm::vec3> (*read_picture)(const std::string& path, Grid<float>* alpha) = nullptr;
  // The same row by row, where the format can; null: it is unpacked whole.
  void (*read_rows)(const std::string& path, const UsePictureRows& use) = nullptr;
  Grid<std::uint16_t> (*read_grey)(const std::string& path) =
      nullptr;  // null: contains no exact grey numbers
  // Opens a file that is written row by row; null: it is only read.
  std::unique_ptr<PictureRows> (*open)(const std::string& path, int width, int height,
                                       const PictureFileOptions& options) = nullptr;
  // Maximum memory of its writer, bytes. Does not grow with the height except where the library
  // packs pictures whole: that one refuses, with Error(limit), what is over memory_budget_bytes().
  double (*writer_bytes)(int width, int height) = nullptr;
  int longest_px =
      0;  // larger pictures are written reduced by a whole factor; 0: always of full size
};
const std::vector<PictureFormat>& picture_formats();

// Extensions of the written formats, in the order of the table.
std::vector<std::string> picture_extensions();
// The format of a file, identified by its first bytes whatever its name; Error(input) where there
// is none.
const PictureFormat& format_of_file(const std::string& path);
// The format of an extension that can be written; Error(usage) for another.
const PictureFormat& written_format(const std::string& extension);
// Content of a format, for documents: "16 bit; colour profile, resolution, notes".
std::string describe_format(const PictureFormat& format);

// The whole factor by which a picture of that size is reduced: 1 but above `longest_px`.
int reduction_factor(const PictureFormat& format, int width, int height);

}  // namespace belvedere
