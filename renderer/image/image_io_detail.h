#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/image_io.h"

// What the image_io_*.cpp files say to each other; no other file includes this. Standard types only: each library stays in its own .cpp.
namespace belvedere::image_io {

// Known by its first bytes: "openexr", "tiff", "png", "jpeg", or empty.
std::string find_format(const std::string& path);
[[noreturn]] void throw_damaged(const std::string& path, const std::string& reason);
// Error(limit) where `bytes`, needed to read this width × height picture, are over memory_budget_bytes().
void check_memory(const std::string& path, std::int64_t width, std::int64_t height, double bytes);

// Notes as one text for formats that have a single description: a first line that says so, then `key: value` lines with \n and \\ for
// line feed and backslash. Text without that first line gives one note, "ImageDescription".
std::string join_notes(const FileNotes& notes);
FileNotes split_notes(const std::string& text);

// Rows [y0, y1) of a picture as whole numbers 0…`highest`, rounded; `row_pixels` ≥ width pixels to a row, the rest 0.
template <class Number>
void quantize_rows(const Grid<glm::vec3>& encoded, int y0, int y1, int row_pixels, std::vector<Number>& out);

// image_io_exr_read.cpp
ImageInfo read_exr_info(const std::string& path);
Grid<glm::vec3> read_exr_picture(const std::string& path, Grid<float>* alpha);
// image_io_png_check.cpp: whether a PNG reaches its end, all checksums right.
bool is_png_complete(const std::string& path);
struct PngKind {
  int bits = 8;  // a channel, 1…16
  bool palette = false;
};
PngKind read_png_kind(const std::string& path);
// image_io_palette.cpp: the indices of a PNG with a palette.
Grid<std::uint16_t> read_palette_png(const std::string& path);

}  // namespace belvedere::image_io
