#include "renderer/image/picture_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"
#include "base/text/missing_file.h"
#include "renderer/image/exr/exr_reader.h"
#include "renderer/image/exr/exr_writer.h"
#include "renderer/image/jxl_file.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/tiff_file.h"

namespace belvedere {
namespace {

using std::string_view_literals::operator""sv;
using Path = const std::string&;

// A preview that opens at once, in browsers too.
constexpr int preview_max_px = 8000;

}  // namespace

const std::vector<PictureFormat>& picture_formats() {
  static const std::vector<PictureFormat> all = {
      {.extension = "tif",
       .name = "tiff",
       .title = "TIFF",
       .meaning = "printing",
       .bits = 16,
       .device = true,
       .profile = true,
       .resolution = true,
       .notes = true,
       .is =
           [](std::string_view b) {
             return b.starts_with("II*\0"sv) || b.starts_with("MM\0*"sv) ||
                    b.starts_with("II+\0"sv) || b.starts_with("MM\0+"sv);
           },
       .read_info = [](Path path) { return read_oiio_info(path, "tiff"); },
       .read_picture = [](Path path,
                          Grid<float>* alpha) { return read_oiio_picture(path, "tiff", alpha); },
       .read_rows = [](Path path, const UsePictureRows& use) { read_oiio_rows(path, "tiff", use); },
       .read_grey = [](Path path) { return read_oiio_grey(path, "tiff"); },
       .open = &open_tiff16,
       .writer_bytes = &tiff16_writer_bytes},
      {.extension = "png",
       .name = "png",
       .title = "PNG",
       .meaning = "viewing",
       .bits = 8,
       .profile = true,
       .resolution = true,
       .notes = true,
       .is = [](std::string_view b) { return b.starts_with("\x89PNG\r\n\x1a\n"); },
       .read_info = [](Path path) { return read_oiio_info(path, "png"); },
       .read_picture = [](Path path,
                          Grid<float>* alpha) { return read_oiio_picture(path, "png", alpha); },
       .read_rows = [](Path path, const UsePictureRows& use) { read_oiio_rows(path, "png", use); },
       .read_grey = [](Path path) { return read_oiio_grey(path, "png"); },
       .open = &open_png8,
       .writer_bytes = &png8_writer_bytes,
       .longest_px = preview_max_px},
      {.extension = "exr",
       .name = "openexr",
       .title = "OpenEXR",
       .meaning = "further work",
       .bits = 16,
       .linear = true,
       .notes = true,
       .is = [](std::string_view b) { return b.starts_with("\x76\x2f\x31\x01"); },
       .read_info = &read_exr_info,
       .read_picture = &read_exr_picture,
       .open =
           [](Path path, int width, int height, const PictureFileOptions& options) {
             return open_exr(path, width, height, options.notes);
           },
       .writer_bytes = &exr_writer_bytes},
      {.extension = "jxl",
       .name = "jpegxl",
       .title = "JPEG XL",
       .meaning = "archiving and sending: every value of 16 bits in less space",
       .bits = 16,
       .profile = true,
       .resolution = true,
       .notes = true,
       .is =
           [](std::string_view b) {
             return b.starts_with("\xff\x0a") || b.starts_with("\0\0\0\x0cJXL \r\n\x87\n"sv);
           },
       .read_info = &read_jxl_info,
       .read_picture = &read_jxl_picture,
       .open = &open_jxl16,
       .writer_bytes = &jxl16_writer_bytes},
      {.extension = "jpg",
       .name = "jpeg",
       .title = "JPEG",
       .is = [](std::string_view b) { return b.starts_with("\xff\xd8\xff"); },
       .read_info = [](Path path) { return read_oiio_info(path, "jpeg"); },
       .read_picture = [](Path path,
                          Grid<float>* alpha) { return read_oiio_picture(path, "jpeg", alpha); },
       .read_rows = [](Path path,
                       const UsePictureRows& use) { read_oiio_rows(path, "jpeg", use); }},
  };
  return all;
}

std::vector<std::string> picture_extensions() {
  std::vector<std::string> extensions;
  for (const PictureFormat& format : picture_formats())
    if (format.open != nullptr) extensions.emplace_back(format.extension);
  return extensions;
}

const PictureFormat& format_of_file(const std::string& path) {
  const std::string bytes = image_io::first_bytes(path);
  if (const std::string archive = archive_kind(path); !archive.empty())
    throw Error(ErrorKind::input, path, "is " + archive, unpack_advice);
  std::vector<std::string_view> titles;
  for (const PictureFormat& format : picture_formats()) {
    if (format.is(bytes)) return format;
    titles.push_back(format.title);
  }
  throw Error(ErrorKind::input, path, "is not a picture in a known format",
              fmt::format("{}", fmt::join(titles, ", ")));
}

std::string describe_format(const PictureFormat& format) {
  std::vector<std::string_view> carried;
  if (format.profile)
    carried.emplace_back(format.device ? "colour profile (the printer's, if one is given)"
                                       : "colour profile");
  if (format.resolution) carried.emplace_back("resolution");
  if (format.notes) carried.emplace_back("notes");
  std::string values =
      format.linear ? "scene-linear, half float" : fmt::format("{} bit", format.bits);
  if (format.longest_px > 0)
    values +=
        fmt::format(", at most {} pixels per side: larger pictures are reduced", format.longest_px);
  return carried.empty() ? values : fmt::format("{}; {}", values, fmt::join(carried, ", "));
}

const PictureFormat& written_format(const std::string& extension) {
  for (const PictureFormat& format : picture_formats())
    if (format.open != nullptr && format.extension == extension) return format;
  throw Error(ErrorKind::usage, "picture format", fmt::format("\"{}\"", extension),
              fmt::format("{}", fmt::join(picture_extensions(), ", ")));
}

int reduction_factor(const PictureFormat& format, int width, int height) {
  return format.longest_px == 0
             ? 1
             : std::max(1, (std::max(width, height) + format.longest_px - 1) / format.longest_px);
}

}  // namespace belvedere
