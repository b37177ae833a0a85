#include "renderer/style/fit/style_painting.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "renderer/image/oklab.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

constexpr double soft_px = 0.8;
constexpr std::size_t max_texels = 200'000;  // of a list
constexpr int frame_px = 8;                  // ignored: edges of scans often show something else

void check_labels(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask) {
  if (!painting.same_size(mask))
    throw Error(
        ErrorKind::usage, "mask", fmt::format("{} × {} pixels", mask.width(), mask.height()),
        fmt::format("the size of the painting: {} × {}", painting.width(), painting.height()));
  for (const std::uint8_t label : mask)
    if (label >= land_cover_class_count && label != far_air_label && label != unused_label)
      throw Error(ErrorKind::input, "mask", fmt::format("the number {}", label),
                  fmt::format("classes 0 … {}, {} (distant haze) or {} (unused)",
                              land_cover_class_count - 1, far_air_label, unused_label));
}

// Every n-th texel with `wanted(x, y)`; n is the smallest that leaves at most `most`.
template <class F>
std::vector<glm::vec3> some_texels(const Grid<glm::vec3>& colours, std::size_t most, F wanted) {
  std::vector<glm::vec3> all;
  for (int y = 0; y < colours.height(); ++y)
    for (int x = 0; x < colours.width(); ++x)
      if (wanted(x, y)) all.push_back(colours(x, y));
  const std::size_t step = std::max<std::size_t>(1, (all.size() + most - 1) / most);
  std::vector<glm::vec3> some;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

double lightness_at(const std::vector<glm::vec3>& texels, double share) {
  std::vector<float> lightness;
  lightness.reserve(texels.size());
  for (const glm::vec3& texel : texels) lightness.push_back(texel.x);
  return static_cast<double>(value_at_share(std::move(lightness), share));
}

}  // namespace

std::vector<glm::vec3> class_texels(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    LandCoverClass id, std::size_t most) {
  const auto label = static_cast<std::uint8_t>(id);
  return some_texels(colours, most, [&](int x, int y) { return mask(x, y) == label; });
}

bool has_class(const StylePainting& painting, LandCoverClass id) {
  return std::find(painting.classes.begin(), painting.classes.end(), id) != painting.classes.end();
}

StylePainting prepare_painting(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                               const CleanMaskParameters& parameters) {
  check_labels(painting, mask);
  StylePainting out;
  out.drawn = mask;
  out.colours = Grid<glm::vec3>(painting.width(), painting.height());
  parallel_rows(painting.height(), [&](int y) {
    for (int x = 0; x < painting.width(); ++x)
      out.colours(x, y) = glm::vec3(to_oklab(painting(x, y)));
  });
  out.clean = clean_mask(out.colours, mask, parameters);
  out.soft = blur_within_classes(out.colours, mask, soft_px);
  std::array<std::size_t, 256> count{};
  for (const std::uint8_t label : out.clean) ++count[label];
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.id != LandCoverClass::sky && count[static_cast<std::size_t>(info.id)] > 0)
      out.classes.push_back(info.id);
  if (out.classes.empty())
    throw Error(
        ErrorKind::input, "mask",
        fmt::format("no class of the ground with more than {} pixels", parameters.min_texels),
        "a landscape painting and a mask of its classes");
  const int frame = std::min({frame_px, painting.width() / 4, painting.height() / 4});
  out.every = some_texels(out.colours, max_texels, [&](int x, int y) {
    return x >= frame && y >= frame && x < painting.width() - frame &&
           y < painting.height() - frame;
  });
  out.ground = some_texels(out.soft, max_texels, [&](int x, int y) {
    return mask(x, y) != unused_label &&
           mask(x, y) != static_cast<std::uint8_t>(LandCoverClass::sky);
  });
  // A4: the painting's range of lightness, slightly extended for classes that it shows in a small
  // range of light and shade.
  out.min_lightness = std::max(lightness_at(out.ground, 0.004) - 0.03, 0.12);
  out.max_lightness = std::min(std::max(lightness_at(out.every, 0.995), 0.90) + 0.01, 0.985);
  return out;
}

}  // namespace belvedere
