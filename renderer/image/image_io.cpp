#include "renderer/image/image_io.h"

#include "renderer/image/picture_formats.h"

namespace belvedere {

ImageInfo read_image_info(const std::string& path) { return format_of_file(path).read_info(path); }

Grid<glm::vec3> read_picture(const std::string& path, Grid<float>* alpha) {
  return format_of_file(path).read_picture(path, alpha);
}

void read_picture_rows(const std::string& path, const UsePictureRows& use) {
  const PictureFormat& format = format_of_file(path);
  if (format.read_rows != nullptr)
    format.read_rows(path, use);
  else
    use(0, format.read_picture(path, nullptr));
}

Grid<std::uint16_t> read_grey(const std::string& path) {
  const PictureFormat& format = format_of_file(path);
  if (format.read_grey == nullptr) throw image_io::no_grey_picture(path);
  return format.read_grey(path);
}

}  // namespace belvedere
