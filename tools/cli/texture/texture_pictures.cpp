#include "tools/cli/texture/texture_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/error.h"
#include "base/text/letters.h"
#include "renderer/image/image_io.h"
#include "texture/statistical/band_pyramid.h"
#include "tools/cli/file_names.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {

Grid<std::uint8_t> read_mask_of(const std::string& path, const std::string& picture_path,
                                const Grid<Rgb8>& picture) {
  const Grid<std::uint16_t> grey = read_grey(path);
  if (!grey.same_size(picture))
    throw Error(
        ErrorKind::input, path, fmt::format("{} × {} pixels", grey.width(), grey.height()),
        fmt::format("the size of {}: {} × {}", picture_path, picture.width(), picture.height()));
  Grid<std::uint8_t> mask(grey.width(), grey.height());
  std::transform(grey.begin(), grey.end(), mask.begin(),
                 [](std::uint16_t v) { return static_cast<std::uint8_t>(v != 0 ? 1 : 0); });
  return mask;
}

TextureCrop read_crop(const std::string& path, const std::string& mask, Grid<glm::vec3>* stored) {
  Grid<float> alpha;
  Grid<glm::vec3> picture = read_picture(path, &alpha);
  TextureCrop crop{Grid<Rgb8>(picture.width(), picture.height()), {}};
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      crop.picture[i][c] = static_cast<std::uint8_t>(
          std::clamp(255.F * picture[i][static_cast<int>(c)] + .5F, 0.F, 255.F));
  const auto leave_out = [&](std::size_t i) {
    if (crop.states.empty())
      crop.states = Grid<std::uint8_t>(picture.width(), picture.height(), pixel_free);
    crop.states[i] = 0;
  };
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    if (alpha[i] >= 1.F) continue;
    leave_out(i);
    ++crop.transparent;
  }
  if (stored != nullptr) *stored = std::move(picture);
  if (mask.empty()) return crop;
  const Grid<std::uint8_t> kept = read_mask_of(mask, path, crop.picture);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] == 0) leave_out(i);
  return crop;
}

Grid<glm::vec3> with_changes(Grid<glm::vec3> stored, const Grid<Rgb8>& before,
                             const Grid<Rgb8>& after) {
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (after[i] != before[i]) stored[i] = glm::vec3(after[i][0], after[i][1], after[i][2]) / 255.F;
  return stored;
}

void note_rounding(const std::string& read, const std::string& out, Progress& progress) {
  const ImageInfo info = read_image_info(read);
  const bool fine = !info.parts.empty() && !info.parts.front().channels.empty() &&
                    info.parts.front().channels.front().type != ChannelType::uint8;
  if (fine && lower_extension(out) == ".png")
    progress.note(
        fmt::format("{} has more than 8 bits, of which a .png keeps 8; use a .tif to keep 16",
                    file_name(read)));
}

void check_texture_name(const std::string& path) {
  if (const std::string extension = lower_extension(path);
      extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw Error(ErrorKind::usage, "--out", path, "a .png or a .tif");
}

void write_texture(const std::string& path, const Grid<Rgb8>& picture, const std::string& note) {
  write_encoded_texture(path, to_picture(picture), note);
}

void write_encoded_texture(const std::string& path, const Grid<glm::vec3>& picture,
                           const std::string& note) {
  PictureFileOptions options;
  options.notes["belvedere:texture"] = note;
  if (lower_extension(path) == ".png")
    write_png8(path, picture, options);
  else
    write_tiff16(path, picture, options);
}

Json with_figures(Json object, const TextureFigures& figures) {
  object.add("selected", Json::number(figures.selected))
      .add("held_out", Json::number(figures.held_out))
      .add("worst", Json::number(figures.worst))
      .add("beyond", Json::number(figures.beyond))
      .add("drawn", Json::number(figures.drawn))
      .add("turned", Json::number(figures.turned));
  return object;
}

}  // namespace belvedere::tools
