#include "texture/strokes/stroke_parts.h"

#include <algorithm>

#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr int lowest_octave = 64;  // patches of 2^-64 m are the smallest

glm::dvec2 ground_place(const StrokeScene& scene, std::size_t i) {
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  return {p.x, p.y};
}

}  // namespace

void take_brush(Stroke& stroke, const StrokeScene& scene, float width_units, const Brush& brush) {
  stroke.start_width = width_units * scene.scale();
  stroke.end_width = stroke.start_width * brush.taper;
  stroke.alpha = brush.alpha;
  stroke.bristle = brush.bristle;
  stroke.wetness = brush.wetness;
  stroke.tip = StrokeTip::hairs;
  stroke.load = brush.load;
  stroke.edge = (stroke.seed & 0x200U) != 0U ? brush.edge : -brush.edge;
}

Stroke ground_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  Stroke stroke;
  stroke.depth_m = scene.guidance.depth_m[i];
  stroke.order = stroke.depth_m;
  stroke.seed = seed.bits();
  stroke.source = static_cast<std::uint32_t>(i);
  return stroke;
}

Stroke standing_stroke(const StrokeScene& scene, std::size_t i) {
  Stroke stroke;
  stroke.depth_m = scene.guidance.depth_m[i];
  stroke.order = stroke.depth_m;
  stroke.seed = static_cast<std::uint32_t>(mix_bits(scene.sheet_index(i) + 1U));
  stroke.source = static_cast<std::uint32_t>(i);
  return stroke;
}

void set_line(Stroke& stroke, glm::vec2 from, glm::vec2 to, float start_width, float end_width) {
  stroke.points[0] = from;
  stroke.points[1] = to;
  stroke.point_count = 2;
  stroke.start_width = start_width;
  stroke.end_width = end_width;
  if (stroke.tip == StrokeTip::round) stroke.tip = StrokeTip::hairs;  // square tips stay square
  stroke.edge = 0.5F;
  stroke.load = 0.5F;
}

glm::vec3 through_air(const StrokeScene& scene, std::size_t i, glm::vec3 paint) {
  return paint + (scene.base.colour[i] - paint) * std::clamp(scene.base.haze[i], 0.F, 1.F);
}

glm::vec3 through_air_factor(const StrokeScene& scene, std::size_t i, glm::vec3 factor) {
  return factor + (1.F - factor) * std::clamp(scene.base.haze[i], 0.F, 1.F);
}

glm::vec3 fresh_snow(float tone) {
  const float light = std::clamp(tone, 0.F, 1.F);
  const float sunny = light * (0.55F + 0.4F * light);
  return {0.55F + 0.42F * sunny, 0.62F + 0.34F * sunny, 0.78F + 0.17F * light};
}

void lay_on_top(Stroke& stroke) { stroke.order -= tight_depth * stroke.depth_m; }

float ground_noise(const StrokeScene& scene, std::size_t i, Stream stream, double sigma_m) {
  const glm::dvec2 p = ground_place(scene, i);
  return static_cast<float>(
      gaussian_noise(stream_seed(scene.parameters.seed, stream), p.x, p.y, sigma_m));
}

float patch_noise(const StrokeScene& scene, std::size_t i, Stream stream, double sigma_units) {
  const double octave = exact::log2(sigma_units * static_cast<double>(scene.metres_per_unit(i)));
  const double below = std::floor(octave);
  const auto share = static_cast<float>(octave - below);
  const glm::dvec2 p = ground_place(scene, i);
  // A mixture of two octaves with deviation 1.
  const auto of = [&](int power) {
    const std::uint64_t seed = stream_seed(scene.parameters.seed, stream,
                                           static_cast<std::uint64_t>(power + lowest_octave));
    return static_cast<float>(gaussian_noise(seed, p.x, p.y, std::ldexp(1.0, power)));
  };
  const int power = static_cast<int>(below);
  return std::sqrt(1.F - share) * of(power) + std::sqrt(share) * of(power + 1);
}

float hand_busy_at(const StrokeScene& scene, glm::vec2 position) {
  const float broad = sheet_noise(scene, position, Stream::meadow_patches, 46.0);
  const float narrow = sheet_noise(scene, position, Stream::fleck_patches, 15.0);
  return std::clamp(0.5F + 0.42F * broad + 0.16F * narrow, 0.F, 1.F);
}

bool is_grassy(const StrokeScene& scene, std::size_t i) {
  const LandCoverClass id = scene.class_at(i);
  return is_grass(id) ||
         (id == LandCoverClass::forest && scene.base.tree_density[i] < glade_density);
}

float sheet_noise(const StrokeScene& scene, glm::vec2 position, Stream stream, double sigma_units) {
  return static_cast<float>(gaussian_noise(
      stream_seed(scene.parameters.seed, stream),
      static_cast<double>(position.x) / scene.parameters.pixels_per_unit,
      static_cast<double>(position.y) / scene.parameters.pixels_per_unit, sigma_units));
}

}  // namespace belvedere
