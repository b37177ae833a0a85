#include "renderer/press/press_picture.h"

#include <filesystem>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/text/missing_file.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/image/image_io.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr const char* allowed =
    "an RGB picture (TIFF, PNG, JPEG XL, JPEG), or the folder of a rendered scene";

bool is_inks(const ImageInfo& info) {
  return !info.parts.empty() && !info.parts.front().channels.empty() &&
         info.parts.front().channels.front().name == "C";
}

PressPicture picture_of(const std::string& file, const ImageInfo& info) {
  if (is_inks(info) || is_cmyk_profile(info.icc_profile))
    throw Error(ErrorKind::input, file, "is a CMYK picture", allowed);
  if (info.format == "openexr")
    throw Error(ErrorKind::input, file, "contains linear light instead of device colours", allowed);
  PressPicture out{file, info.width, info.height, info.dots_per_inch, info.icc_profile};
  if (!out.profile.empty() && !is_rgb_profile(out.profile))
    out.profile.clear();  // a grey profile: its numbers are used unchanged
  return out;
}

}  // namespace

PressPicture find_press_picture(const std::string& path) {
  if (!fs::exists(path)) throw missing_file(path, allowed);
  if (!fs::is_directory(path)) return picture_of(path, read_image_info(path));
  for (const std::string& name :
       newest_results(path, {"panorama.tif", "panorama.jxl", "panorama.png"})) {
    const std::string file = (fs::path(path) / name).string();
    const ImageInfo info = read_image_info(file);
    if (!is_inks(info)) return picture_of(file, info);
  }
  throw Error(ErrorKind::input, path, "has no panorama.tif, .jxl or .png in RGB", allowed);
}

}  // namespace belvedere
