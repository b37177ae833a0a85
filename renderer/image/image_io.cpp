#include "renderer/image/image_io.h"

#include <string_view>

#include "base/error.h"
#include "renderer/image/image_file_parts.h"

namespace belvedere {
namespace {

using std::string_view_literals::operator""sv;

std::string find_format(const std::string& path) {
  const std::string bytes = image_io::first_bytes(path);
  if (bytes.starts_with("\x76\x2f\x31\x01")) return "openexr";
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "png";
  if (bytes.starts_with("\xff\xd8\xff")) return "jpeg";
  for (const std::string_view mark : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
    if (bytes.starts_with(mark)) return "tiff";
  throw Error(ErrorKind::input, path, "is no picture in a known format", "PNG, TIFF, JPEG or OpenEXR");
}

}  // namespace

ImageInfo read_image_info(const std::string& path) {
  const std::string format = find_format(path);
  return format == "openexr" ? read_exr_info(path) : read_oiio_info(path, format);
}

Grid<glm::vec3> read_picture(const std::string& path, Grid<float>* alpha) {
  const std::string format = find_format(path);
  return format == "openexr" ? read_exr_picture(path, alpha) : read_oiio_picture(path, format, alpha);
}

Grid<std::uint16_t> read_grey(const std::string& path) {
  const std::string format = find_format(path);
  if (format == "openexr" || format == "jpeg") throw image_io::no_grey_picture(path);  // JPEG changes numbers
  return read_oiio_grey(path, format);
}

}  // namespace belvedere
