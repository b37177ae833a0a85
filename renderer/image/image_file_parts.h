#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "renderer/image/image_file.h"

// Shared by the files of the formats.
namespace belvedere::image_io {

// In ImageInfo::notes: Exif orientation 2…8 of a picture that readers turn upright.
inline constexpr const char* orientation_note = "Orientation";
// The same for a TIFF of CIE L*a*b*, which is read in sRGB.
inline constexpr const char* lab_note = "CIE Lab";
// The page of a TIFF that is read, where it is not the only one or not the first.
inline constexpr const char* page_note = "Page";

// The first bytes of a file, at most 16, which identify its format. Error(input) where it cannot be
// opened.
std::string first_bytes(const std::string& path);
// For a file that read_grey refuses.
Error no_grey_picture(const std::string& path);
[[noreturn]] void throw_damaged(const std::string& path, const std::string& reason);
// Error(limit) where `bytes`, needed to read this width × height picture, are over
// memory_budget_bytes().
void check_memory(const std::string& path, std::int64_t width, std::int64_t height, double bytes);

// Colours under full transparency are not seen, and differ by the program that wrote them.
void blacken_transparent(Grid<glm::vec3>& picture, const Grid<float>& alpha);

// Notes as one text for formats that have a single description: a first line that marks it, then
// `key: value` lines with \n and \\ for line feed and backslash. Text without that first line gives
// one note, "ImageDescription".
std::string join_notes(const FileNotes& notes);
FileNotes split_notes(const std::string& text);

// Rows [first, first + rows) of a picture as whole numbers 0…`highest`, rounded; a row of `out` has
// room for row_pixels ≥ width pixels, of which those beyond the picture are not changed.
template <class Number>
void quantize_rows(const Grid<glm::vec3>& encoded, int first, int rows, int row_pixels,
                   Number* out);

}  // namespace belvedere::image_io
