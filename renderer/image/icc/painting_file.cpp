#include "renderer/image/icc/painting_file.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/icc/device_colour.h"
#include "renderer/image/icc/lcms.h"
#include "renderer/image/image_file.h"
#include "renderer/image/image_io.h"

namespace belvedere {
namespace {

// Converts colours 0…1 of a profile embedded in a picture (RGB or grey; empty: sRGB) to sRGB:
// relative colorimetric with black point compensation, clamped. Returns the profile's name. If the
// profile equals sRGB within half an 8-bit step, returns an empty name and changes nothing.
std::string to_srgb(Grid<glm::vec3>& encoded, const std::vector<std::uint8_t>& profile) {
  if (profile.empty() || encoded.empty() || profile == srgb_profile()) return {};
  const icc::Context context;
  const icc::Profile from = icc::open_profile(context, profile);
  const icc::Profile to = icc::open_profile(context, srgb_profile());
  const bool grey = from != nullptr && icc::colours_of(from) == cmsSigGrayData;
  if (from == nullptr || (!grey && icc::colours_of(from) != cmsSigRgbData))
    throw Error(ErrorKind::input, "ICC profile", "is neither RGB nor grey");
  const DeviceParameters parameters{.intent = RenderingIntent::relative, .black_point = true};
  const icc::Transform transform = icc::make_transform(
      context, from, grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT, to, TYPE_RGB_FLT, parameters);
  const auto convert_row = [&](const glm::vec3* row, glm::vec3* out, int width) {
    std::vector<float> greys;
    if (grey)
      for (int x = 0; x < width; ++x) greys.push_back(row[x].x);
    cmsDoTransform(transform.get(), grey ? static_cast<const void*>(greys.data()) : row, out,
                   static_cast<cmsUInt32Number>(width));
    for (int x = 0; x < width; ++x) out[x] = glm::clamp(out[x], 0.F, 1.F);
  };
  // Many files embed another vendor's sRGB profile with rounded tables.
  constexpr int steps = 9;
  constexpr float half_step = 0.5F / 255.F;
  std::vector<glm::vec3> lattice;
  for (int r = 0; r < steps; ++r)
    for (int g = 0; g < steps; ++g)
      for (int b = 0; b < steps; ++b)
        if (!grey || (r == g && g == b)) lattice.push_back(glm::vec3(r, g, b) / (steps - 1.F));
  std::vector<glm::vec3> there(lattice.size());
  convert_row(lattice.data(), there.data(), static_cast<int>(lattice.size()));
  bool same = true;
  for (std::size_t i = 0; i < lattice.size(); ++i)
    for (int c = 0; c < 3; ++c) same = same && std::abs(there[i][c] - lattice[i][c]) < half_step;
  if (same) return {};
  parallel_rows(encoded.height(), [&](int y) {
    const std::vector<glm::vec3> row(encoded.row(y), encoded.row(y) + encoded.width());
    convert_row(row.data(), encoded.row(y), encoded.width());
  });
  return icc::name_of(from);
}

}  // namespace

Grid<glm::vec3> read_painting(const std::string& path, Progress& progress, Grid<float>* alpha) {
  const ImageInfo info = read_image_info(path);
  Grid<glm::vec3> picture = read_picture(path, alpha);
  if (info.format == "openexr") return picture;
  if (info.notes.contains(image_io::orientation_note))
    progress.note(
        fmt::format("{}: turned upright according to its Exif orientation; masks and guides "
                    "must match the upright picture of {} × {} pixels",
                    path, picture.width(), picture.height()));
  if (const auto page = info.notes.find(image_io::page_note); page != info.notes.end())
    progress.note(fmt::format("{}: is read from page {}", path, page->second));
  if (info.notes.contains(image_io::lab_note))
    progress.note(fmt::format("{}: converted to sRGB from CIE Lab", path));
  try {
    if (const std::string from = to_srgb(picture, info.icc_profile); !from.empty())
      progress.note(fmt::format("{}: converted to sRGB from its colour profile {}", path, from));
  } catch (const Error& error) {
    throw Error(error.kind(), path, "its embedded colour profile " + error.found(),
                "a picture in sRGB, or with a valid profile");
  }
  return picture;
}

}  // namespace belvedere
