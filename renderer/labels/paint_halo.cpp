#include "renderer/labels/paint_halo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <vector>

#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

constexpr float levels = 65535.0F;  // of a blurred colour
constexpr double always = 0.10;     // share of the way to white, or of black, in any case
constexpr double max_gain = 1.7;    // factor up to which light is added before white
constexpr double blur = 1.2;        // radius, of a halo's width
constexpr double flare = 0.05;      // of WCAG's contrast

glm::dvec3 linear_of(glm::vec3 colour) {
  return {srgb_decoded(static_cast<double>(colour.r)), srgb_decoded(static_cast<double>(colour.g)),
          srgb_decoded(static_cast<double>(colour.b))};
}

double luminance_of_linear(glm::dvec3 c) { return .2126 * c.r + .7152 * c.g + .0722 * c.b; }

using Levels = std::array<std::uint32_t, 3>;

// A box filter along a line, whose first `2 radius` results are lost; sums are exact.
void filter_line(std::vector<Levels>& line, int radius) {
  const auto width = static_cast<std::size_t>(2 * radius + 1);
  std::vector<Levels> out(line.size() - (width - 1));
  Levels sum{};
  for (std::size_t i = 0; i < line.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += line[i][c];
      if (i + 1 < width) continue;
      out[i + 1 - width][c] =
          (sum[c] + static_cast<std::uint32_t>(radius)) / static_cast<std::uint32_t>(width);
      sum[c] -= line[i + 1 - width][c];
    }
  line = std::move(out);
}

}  // namespace

double luminance(glm::vec3 colour) { return luminance_of_linear(linear_of(colour)); }

double contrast(glm::vec3 a, glm::vec3 b) {
  const double light = std::max(luminance(a), luminance(b));
  const double dark = std::min(luminance(a), luminance(b));
  return (light + flare) / (dark + flare);
}

glm::vec3 halo_colour(glm::vec3 paint, const HaloAim& aim) {
  const double letters = luminance(aim.letters) + flare;
  glm::dvec3 c = linear_of(paint);
  const double now = luminance_of_linear(c);
  if (aim.lightens) {
    const double wanted =
        std::min(1.0, std::max(aim.contrast * letters - flare, now + always * (1.0 - now)));
    const double brightest = std::max({c.r, c.g, c.b, 1e-6});
    if (now > 0.0) c *= std::clamp(wanted / now, 1.0, std::min(max_gain, 1.0 / brightest));
    const double reached = luminance_of_linear(c);
    if (reached < wanted) c = glm::mix(c, glm::dvec3(1.0), (wanted - reached) / (1.0 - reached));
  } else if (now > 0.0) {
    c *= std::clamp((letters / aim.contrast - flare) / now, 0.0, 1.0 - always);
  }
  return {srgb_encoded(c.r), srgb_encoded(c.g), srgb_encoded(c.b)};
}

int halo_blur_px(double halo_px) {
  return std::max(1, static_cast<int>(std::lround(blur * halo_px)));
}

Grid<glm::vec3> blurred(const PictureWindow& picture, PixelRect rect, int radius_px) {
  const int reach = halo_reach_px(radius_px);
  const int columns = rect.width() + 2 * reach;
  const int rows = rect.height() + 2 * reach;
  const auto level = [](float value) {
    return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 1.0F) * levels + .5F);
  };
  // Rows first; all of them, as columns read them.
  std::vector<std::vector<Levels>> lines(static_cast<std::size_t>(rows));
  for (int y = 0; y < rows; ++y) {
    std::vector<Levels>& line = lines[static_cast<std::size_t>(y)];
    const int from_y =
        std::clamp(rect.y0 - reach + y - picture.at.y, 0, picture.pixels.height() - 1);
    for (int x = 0; x < columns; ++x) {
      const int from_x =
          std::clamp(rect.x0 - reach + x - picture.at.x, 0, picture.pixels.width() - 1);
      const glm::vec3 c = picture.pixels(from_x, from_y);
      line.push_back({level(c.r), level(c.g), level(c.b)});
    }
    for (int pass = 0; pass < 3; ++pass) filter_line(line, radius_px);
  }
  Grid<glm::vec3> out(rect.width(), rect.height());
  std::vector<Levels> column;
  for (int x = 0; x < rect.width(); ++x) {
    column.clear();
    for (const std::vector<Levels>& line : lines)
      column.push_back(line[static_cast<std::size_t>(x)]);
    for (int pass = 0; pass < 3; ++pass) filter_line(column, radius_px);
    for (int y = 0; y < rect.height(); ++y) {
      const Levels& c = column[static_cast<std::size_t>(y)];
      out(x, y) = glm::vec3(c[0], c[1], c[2]) / levels;
    }
  }
  return out;
}

}  // namespace belvedere
