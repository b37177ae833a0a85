#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "renderer/image/color.h"
#include "renderer/image/image_file.h"

namespace belvedere {

// A format of picture files: how it is known and read, and what is written as it. A new one is a file with these functions and a row.
struct PictureFormat {
  std::string_view ending = {};   // of its files, without the point: "tif"
  std::string_view name = {};     // ImageInfo::format: "tiff"
  std::string_view title = {};    // for people: "TIFF"
  std::string_view meaning = {};  // what a picture of it is for; empty: it is only read
  int bits = 0;                   // of a written channel
  bool linear = false;            // holds scene-linear half floats, else encoded whole numbers
  bool device = false;            // is converted to the printer's profile where there is one
  bool profile = false;           // carries an ICC profile
  bool resolution = false;        // carries dots per inch
  bool notes = false;             // carries FileNotes
  bool (*is)(std::string_view first_bytes) = nullptr;
  ImageInfo (*read_info)(const std::string& path) = nullptr;
  Grid<glm::vec3> (*read_picture)(const std::string& path, Grid<float>* alpha) = nullptr;
  Grid<std::uint16_t> (*read_grey)(const std::string& path) = nullptr;  // null: holds no exact grey numbers
  void (*write)(const std::string& path, const Grid<glm::vec3>& picture, const PictureFileOptions& options) = nullptr;
};
const std::vector<PictureFormat>& picture_formats();

// Endings of the formats that are written, in the order of the table.
std::vector<std::string> picture_endings();
// The format that a file has, known by its first bytes whatever its name; Error(input) where it is none.
const PictureFormat& format_of_file(const std::string& path);
// What a format holds and carries, for documents: "16 bit; colour profile, resolution, notes".
std::string describe_format(const PictureFormat& format);

// How a finished picture is written.
struct PictureColors {
  ColorParameters display;                   // scene-linear to encoded
  std::vector<std::uint8_t> device_profile;  // ICC, of the printer; empty: none
};
// A scene-linear picture as STEM.ENDING for each of the endings. Encoded ones are sRGB and carry its profile, `device` formats the
// printer's where there is one. Error(usage) for an unknown ending, before anything is written; Error(output).
void write_pictures(const std::string& stem, const std::vector<std::string>& endings, const Image& linear, const PictureColors& colors,
                    double dots_per_inch, const FileNotes& notes);

}  // namespace belvedere
