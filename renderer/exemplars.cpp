#include "renderer/exemplars.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/filter.h"
#include "renderer/composite.h"
#include "renderer/guidance_io.h"
#include "renderer/image_io.h"
#include "renderer/sheet.h"

namespace belvedere {
namespace {

constexpr std::uint8_t excluded_label = 255;

Rgb8 to_rgb8(glm::vec3 encoded) {
  Rgb8 rgb{};
  for (int c = 0; c < 3; ++c)
    rgb[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(std::clamp(encoded[c], 0.F, 1.F) * 255.F));
  return rgb;
}

// Deviation of a texel's brightness from that around it that the prices of synthesis are tuned for, encoded sRGB: strong, even strokes.
constexpr double tuned_contrast = 14.0 / 255.0;
constexpr double around_texels = 2.0;

void check_same_size(const std::string& file, int width, int height, const Grid<glm::vec3>& picture) {
  if (width != picture.width() || height != picture.height())
    throw Error(ErrorKind::input, file,
                fmt::format("{}×{} pixels beside a picture of {}×{}", width, height, picture.width(), picture.height()),
                "the picture's size");
}

// Where the classes of a file-based painting come from.
GuidanceBuffers read_painting_guides(const SceneExemplar& wish, const LoadedScene& scene, const Grid<glm::vec3>& picture) {
  if (!wish.guidance.empty()) {
    const std::string path = find_scene_file(scene, wish.guidance);
    GuidanceBuffers guidance = read_guidance(path);
    check_same_size(path, guidance.width(), guidance.height(), picture);
    return guidance;
  }
  GuidanceBuffers guidance;
  const std::string path = find_scene_file(scene, wish.classes);
  const Grid<std::uint16_t> ids = read_grey(path);
  check_same_size(path, ids.width(), ids.height(), picture);
  guidance.depth_m = Grid<float>(ids.width(), ids.height(), 1.F);
  guidance.land_cover = Grid<LandCoverClass>(ids.width(), ids.height());
  for (std::size_t i = 0; i < ids.size(); ++i)
    guidance.land_cover[i] = static_cast<LandCoverClass>(std::min<std::uint16_t>(ids[i], excluded_label));
  if (!wish.altitude.empty()) {
    const std::string altitude_path = find_scene_file(scene, wish.altitude);
    const Grid<std::uint16_t> grey = read_grey(altitude_path);
    check_same_size(altitude_path, grey.width(), grey.height(), picture);
    std::uint16_t highest = 255;
    for (const std::uint16_t value : grey)
      if (value > 255) highest = 65535;
    guidance.altitude_m = Grid<float>(grey.width(), grey.height());
    for (std::size_t i = 0; i < grey.size(); ++i)
      guidance.altitude_m[i] =
          static_cast<float>(wish.altitude_range_m[0] + (wish.altitude_range_m[1] - wish.altitude_range_m[0]) * grey[i] / highest);
  }
  return guidance;
}

// The target's mean base colour of each class.
std::array<glm::vec3, land_cover_class_count> class_means(const LitPicture& target) {
  std::array<glm::dvec3, land_cover_class_count> sum{};
  std::array<double, land_cover_class_count> count{};
  for (std::size_t i = 0; i < target.ground.colour.size(); ++i) {
    const auto id = static_cast<std::size_t>(target.guidance.land_cover[i]);
    sum[id] += glm::dvec3(target.ground.colour[i]);
    count[id] += 1.0;
  }
  std::array<glm::vec3, land_cover_class_count> mean{};
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = glm::vec3(sum[k] / std::max(1.0, count[k]));
  return mean;
}

}  // namespace

Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels, double residual) {
  const Grid<glm::vec3>& picture = painted.picture;
  Grid<glm::vec3> carried = picture;
  if (!painted.base.empty())
    for (std::size_t i = 0; i < carried.size(); ++i) carried[i] -= static_cast<float>(residual) * painted.base[i];
  Grid<float> brightness(carried.width(), carried.height());
  for (std::size_t i = 0; i < carried.size(); ++i) brightness[i] = (carried[i].x + carried[i].y + carried[i].z) / 3.F;
  const Grid<float> around = gaussian_blur(brightness, around_texels);

  struct Sums {
    glm::dvec3 colour{0.0};
    double squares = 0.0;
    double count = 0.0;
  };
  std::array<Sums, 256> sums{};
  for (std::size_t i = 0; i < carried.size(); ++i) {
    Sums& s = sums[labels[i]];
    const double detail = brightness[i] - around[i];
    s.colour += glm::dvec3(carried[i]);
    s.squares += detail * detail;
    s.count += 1.0;
  }
  std::array<glm::vec3, 256> middle{};
  std::array<float, 256> gain{};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double count = std::max(1.0, sums[k].count);
    middle[k] = glm::vec3(sums[k].colour / count);
    gain[k] = static_cast<float>(std::clamp(tuned_contrast / std::sqrt(sums[k].squares / count + 1e-12), 1.0, 8.0));
  }
  Grid<Rgb8> seams(picture.width(), picture.height());
  for (std::size_t i = 0; i < seams.size(); ++i) {
    const std::uint8_t k = labels[i];
    seams[i] = to_rgb8(glm::vec3(0.5F) + gain[k] * (carried[i] - middle[k]));
  }
  return seams;
}

PaintedExemplar read_painting(const SceneExemplar& wish, const LoadedScene& scene, const LitPicture& target) {
  PaintedExemplar painting;
  painting.picture = read_picture(find_scene_file(scene, wish.picture));
  const GuidanceBuffers guidance = read_painting_guides(wish, scene, painting.picture);
  painting.exemplar.name = wish.picture;
  painting.exemplar.guides = make_guide_stack(guidance, guidance.land_cover);
  if (!guidance.base.empty()) {
    painting.base = encode_srgb(guidance.base);
  } else {
    const auto means = class_means(target);
    painting.base = Grid<glm::vec3>(painting.picture.width(), painting.picture.height());
    for (std::size_t i = 0; i < painting.base.size(); ++i) {
      const auto id = static_cast<std::size_t>(guidance.land_cover[i]);
      if (id < means.size()) painting.base[i] = means[id];
    }
  }
  painting.exemplar.picture = seam_picture(painting, painting.exemplar.guides.label, scene.scene.synthesis.residual);
  return painting;
}

void check_paintings(const LoadedScene& scene) {
  for (const SceneExemplar& wish : scene.scene.exemplars) {
    const std::string path = wish.picture.empty() ? std::string() : find_scene_file(scene, wish.picture);
    if (path.empty()) continue;
    const Grid<glm::vec3> picture = read_picture(path);
    for (const std::string* file : {&wish.guidance, &wish.classes, &wish.altitude}) {
      if (file->empty()) continue;
      const std::string guide = find_scene_file(scene, *file);
      const ImageInfo info = read_image_info(guide);
      check_same_size(guide, info.width, info.height, picture);
      if (file != &wish.guidance) read_grey(guide);
    }
  }
}

std::vector<PaintedExemplar> make_exemplars(const LoadedScene& scene, const Stage& stage, const LitPicture& target, Progress& progress) {
  std::vector<PaintedExemplar> exemplars;
  for (const SceneExemplar& wish : scene.scene.exemplars) {
    if (wish.picture.empty()) {
      exemplars.push_back(paint_sheet(wish, stage, progress));
    } else if (find_scene_file(scene, wish.picture).empty()) {
      // Missing files that are not optional were refused before the work began.
      progress.note(fmt::format("exemplar {} is not there and is left out; get it from {}", wish.picture, wish.get_from));
    } else {
      exemplars.push_back(read_painting(wish, scene, target));
    }
  }
  if (exemplars.empty()) exemplars.push_back(paint_sheet({}, stage, progress));
  return exemplars;
}

}  // namespace belvedere
