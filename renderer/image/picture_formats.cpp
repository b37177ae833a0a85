#include "renderer/image/picture_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "renderer/image/exr/exr_reader.h"
#include "renderer/image/exr/exr_writer.h"
#include "renderer/image/image_file_parts.h"
#include "renderer/image/jxl_file.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/tiff_file.h"

namespace belvedere {
namespace {

using std::string_view_literals::operator""sv;
using Bytes = std::string_view;
using Path = const std::string&;

const PictureFormat& written_format(const std::string& ending) {
  for (const PictureFormat& format : picture_formats())
    if (format.write != nullptr && format.ending == ending) return format;
  throw Error(ErrorKind::usage, "picture format", fmt::format("\"{}\"", ending), fmt::format("{}", fmt::join(picture_endings(), ", ")));
}

}  // namespace

const std::vector<PictureFormat>& picture_formats() {
  static const std::vector<PictureFormat> all = {
      {.ending = "tif",
       .name = "tiff",
       .title = "TIFF",
       .meaning = "printing",
       .bits = 16,
       .device = true,
       .profile = true,
       .resolution = true,
       .notes = true,
       .is =
           [](Bytes b) {
             return b.starts_with("II*\0"sv) || b.starts_with("MM\0*"sv) || b.starts_with("II+\0"sv) || b.starts_with("MM\0+"sv);
           },
       .read_info = [](Path path) { return read_oiio_info(path, "tiff"); },
       .read_picture = [](Path path, Grid<float>* alpha) { return read_oiio_picture(path, "tiff", alpha); },
       .read_grey = [](Path path) { return read_oiio_grey(path, "tiff"); },
       .write = &write_tiff16},
      {.ending = "png",
       .name = "png",
       .title = "PNG",
       .meaning = "looking at",
       .bits = 8,
       .profile = true,
       .resolution = true,
       .notes = true,
       .is = [](Bytes b) { return b.starts_with("\x89PNG\r\n\x1a\n"); },
       .read_info = [](Path path) { return read_oiio_info(path, "png"); },
       .read_picture = [](Path path, Grid<float>* alpha) { return read_oiio_picture(path, "png", alpha); },
       .read_grey = [](Path path) { return read_oiio_grey(path, "png"); },
       .write = &write_png8},
      {.ending = "exr",
       .name = "openexr",
       .title = "OpenEXR",
       .meaning = "further work",
       .bits = 16,
       .linear = true,
       .notes = true,
       .is = [](Bytes b) { return b.starts_with("\x76\x2f\x31\x01"); },
       .read_info = &read_exr_info,
       .read_picture = &read_exr_picture,
       .write = [](Path path, const Grid<glm::vec3>& linear,
                   const PictureFileOptions& options) { write_exr(path, linear, options.notes); }},
      {.ending = "jxl",
       .name = "jpegxl",
       .title = "JPEG XL",
       .meaning = "keeping and sending: every value of 16 bits in less space",
       .bits = 16,
       .profile = true,
       .resolution = true,
       .notes = true,
       .is = [](Bytes b) { return b.starts_with("\xff\x0a") || b.starts_with("\0\0\0\x0cJXL \r\n\x87\n"sv); },
       .read_info = &read_jxl_info,
       .read_picture = &read_jxl_picture,
       .write = &write_jxl16},
      {.ending = "jpg",
       .name = "jpeg",
       .title = "JPEG",
       .is = [](Bytes b) { return b.starts_with("\xff\xd8\xff"); },
       .read_info = [](Path path) { return read_oiio_info(path, "jpeg"); },
       .read_picture = [](Path path, Grid<float>* alpha) { return read_oiio_picture(path, "jpeg", alpha); }},
  };
  return all;
}

std::vector<std::string> picture_endings() {
  std::vector<std::string> endings;
  for (const PictureFormat& format : picture_formats())
    if (format.write != nullptr) endings.emplace_back(format.ending);
  return endings;
}

const PictureFormat& format_of_file(const std::string& path) {
  const std::string bytes = image_io::first_bytes(path);
  std::vector<std::string_view> titles;
  for (const PictureFormat& format : picture_formats()) {
    if (format.is(bytes)) return format;
    titles.push_back(format.title);
  }
  throw Error(ErrorKind::input, path, "is no picture in a known format", fmt::format("{}", fmt::join(titles, ", ")));
}

std::string describe_format(const PictureFormat& format) {
  std::vector<std::string_view> carried;
  if (format.profile) carried.emplace_back(format.device ? "colour profile (the printer's, where one is given)" : "colour profile");
  if (format.resolution) carried.emplace_back("resolution");
  if (format.notes) carried.emplace_back("notes");
  const std::string values = format.linear ? "scene-linear, half float" : fmt::format("{} bit", format.bits);
  return carried.empty() ? values : fmt::format("{}; {}", values, fmt::join(carried, ", "));
}

void write_pictures(const std::string& stem, const std::vector<std::string>& endings, const Image& linear, const PictureColors& colors,
                    double dots_per_inch, const FileNotes& notes) {
  std::vector<const PictureFormat*> formats;
  for (const std::string& ending : endings) formats.push_back(&written_format(ending));
  PictureFileOptions options;
  options.dots_per_inch = dots_per_inch;
  options.notes = notes;
  Grid<glm::vec3> display;
  if (std::any_of(formats.begin(), formats.end(), [](const PictureFormat* f) { return !f->linear; }))
    display = to_display(linear, colors.display);
  for (const PictureFormat* format : formats) {
    const std::string path = fmt::format("{}.{}", stem, format->ending);
    const bool converted = format->device && !colors.device_profile.empty();
    options.icc_profile = !format->profile ? std::vector<std::uint8_t>{} : converted ? colors.device_profile : srgb_profile();
    if (format->linear)
      format->write(path, linear, options);
    else
      format->write(path, converted ? to_profile(display, colors.device_profile) : display, options);
  }
}

}  // namespace belvedere
