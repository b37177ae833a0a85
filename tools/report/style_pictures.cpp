#include "tools/report/style_pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "base/math_exact.h"
#include "base/noise.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "renderer/image/oklab.h"
#include "renderer/style/fit/clean_mask.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr double covering = 3.0;  // mean number of strokes over a point
constexpr std::size_t min_crop_texels = 600;

glm::vec3 unpacked_rgb(std::uint32_t rgb) {
  return glm::vec3(rgb >> 16U, rgb >> 8U & 255U, rgb & 255U) / 255.0F;
}

glm::vec3 sky_gradient(const Palette& palette, double at) {
  if (palette.sky.empty()) return glm::vec3(0.5F);
  std::size_t i = 0;
  while (i + 1 < palette.sky.size() && palette.sky[i + 1].first <= at) ++i;
  if (i + 1 == palette.sky.size() || at <= palette.sky[i].first) return palette.sky[i].second;
  const auto& [a, from] = palette.sky[i];
  const auto& [b, to] = palette.sky[i + 1];
  return glm::mix(from, to, static_cast<float>((at - a) / (b - a)));
}

// The r for which directions uniform within ± r have the mean `level` of cos 2θ, which is
// sin(2r) / 2r; by bisection.
double direction_reach(double level) {
  double low = 1e-3;
  double high = 0.5 * std::numbers::pi;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (exact::sin(2.0 * middle) / (2.0 * middle) > level ? low : high) = middle;
  }
  return low;
}

// A stroke as a capsule with soft edges.
void lay_stroke(Grid<glm::dvec3>& lab, glm::dvec2 at, glm::dvec2 way, double length, double width,
                const glm::dvec3& colour) {
  const double half = 0.5 * std::max(0.0, length - width);
  const double radius = 0.5 * width;
  const int reach = static_cast<int>(std::ceil(half + radius + 1.0));
  for (int y = static_cast<int>(at.y) - reach; y <= static_cast<int>(at.y) + reach; ++y)
    for (int x = static_cast<int>(at.x) - reach; x <= static_cast<int>(at.x) + reach; ++x) {
      if (!lab.contains(x, y)) continue;
      const glm::dvec2 d(x + 0.5 - at.x, y + 0.5 - at.y);
      const double along = std::clamp(d.x * way.x + d.y * way.y, -half, half);
      const glm::dvec2 off = d - along * way;
      const double share =
          std::clamp(radius - std::sqrt(off.x * off.x + off.y * off.y) + 0.5, 0.0, 1.0);
      lab(x, y) += 0.9 * share * (colour - lab(x, y));
    }
}

Grid<glm::vec3> encoded_picture(const Grid<glm::dvec3>& lab) {
  Grid<glm::vec3> out(lab.width(), lab.height());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::clamp(from_oklab(lab[i]), 0.0F, 1.0F);
  return out;
}

}  // namespace

Grid<glm::vec3> stroke_swatch(const Style& style, LandCoverClass id, int width_px, int height_px,
                              int zoom) {
  const StyleBrushwork& hand = style.brushwork[static_cast<std::size_t>(id)];
  const auto ground = [&](glm::dvec2 at) {
    if (id == LandCoverClass::sky)
      return to_oklab(sky_gradient(style.palette, at.y / (height_px * zoom)));
    return to_oklab(palette_colour(style.palette, id, 0.0, at.x / (width_px * zoom)));
  };
  Grid<glm::dvec3> lab(width_px * zoom, height_px * zoom);
  for (int y = 0; y < lab.height(); ++y)
    for (int x = 0; x < lab.width(); ++x) lab(x, y) = ground({x + 0.5, y + 0.5});
  if (hand.length_px <= 0.0) return encoded_picture(lab);
  const std::uint64_t seed = stream_seed(static_cast<std::uint64_t>(id), Stream::style_fit, 3);
  const int count = static_cast<int>(covering * width_px * height_px /
                                     std::max(1.0, hand.length_px * hand.width_px));
  const double reach = direction_reach(std::abs(hand.level));
  for (int i = 0; i < count; ++i) {
    const auto draw = [&](std::uint64_t k) { return random_uniform(seed, i, 0, k); };
    const glm::dvec2 at(draw(0) * lab.width(), draw(1) * lab.height());
    const double off = (2.0 * draw(2) - 1.0) * reach;
    const exact::Turn turn = exact::turn((hand.level < 0.0 ? 0.5 * std::numbers::pi : 0.0) + off);
    glm::dvec3 colour = ground(at);
    const double tone = id == LandCoverClass::sky ? draw(4) : at.x / lab.width();
    const std::vector<glm::vec3>& residuals = hand.residuals[tone < 0.43 ? 0 : tone < 0.75 ? 1 : 2];
    if (!residuals.empty())
      colour += glm::dvec3(
          residuals[random_index(static_cast<std::uint32_t>(residuals.size()), seed, i, 1)]);
    lay_stroke(lab, at, {turn.cosine, turn.sine}, zoom * hand.length_px * (0.6 + 0.8 * draw(5)),
               zoom * hand.width_px * (0.65 + 0.7 * draw(6)), colour);
  }
  return encoded_picture(lab);
}

Grid<glm::vec3> ramp_swatch(const Palette& palette, const Palette& reference, LandCoverClass id,
                            int width_px, int height_px) {
  Grid<glm::vec3> out(width_px, height_px);
  const std::vector<ClassPalette::Stop>& stops =
      reference.classes[static_cast<std::size_t>(id)].stops;
  const double middle_m = stops[stops.size() / 2].altitude_m;  // as in the fit
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const double tone = (x + 0.5) / width_px;
      out(x, y) = 2 * y < height_px ? palette_colour(palette, id, 0.0, tone)
                                    : palette_colour(reference, id, middle_m, tone);
    }
  return out;
}

Grid<glm::vec3> sky_swatch(const StyleSky& sky, int width_px, int height_px) {
  constexpr double lattice = 3.2;  // lengths of half correlation to a cell of noise
  constexpr std::array<double, 7> places = {-2.05, -1.28, -0.67, 0.0, 0.67, 1.28, 2.05};
  Grid<glm::dvec3> lab(width_px, height_px);
  const auto mixed = [&](double u, double v) {
    const double x = std::clamp(u * sky.medians.width() - 0.5, 0.0, sky.medians.width() - 1.0);
    const double y = std::clamp(v * sky.medians.height() - 0.5, 0.0, sky.medians.height() - 1.0);
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    const auto at = [&](int a, int b) { return glm::dvec3(sky.medians.clamped(a, b)); };
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), x - i),
                    glm::mix(at(i, j + 1), at(i + 1, j + 1), x - i), y - j);
  };
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      lab(x, y) = mixed((x + 0.5) / width_px, (y + 0.5) / height_px);
      for (std::size_t k = 0; k < sky.changes.size(); ++k) {
        const StyleSkyChange& change = sky.changes[k];
        double amount = 0.0;
        double squares = 0.0;
        double weight = 1.0;
        for (std::uint64_t octave = 0; octave < 4; ++octave) {
          const double shrink = lattice / 4.0 / static_cast<double>(1U << octave);
          amount += weight * gaussian_noise(stream_seed(k, Stream::style_fit, 10 + octave), x, y,
                                            std::max(1.0, shrink * change.length_x * width_px),
                                            std::max(1.0, shrink * change.length_y * height_px));
          squares += weight * weight;
          weight *= 0.55;
        }
        amount = std::clamp(amount / std::sqrt(squares), places.front(), places.back());
        std::size_t i = 0;
        while (i + 2 < places.size() && amount > places[i + 1]) ++i;
        const double share = (amount - places[i]) / (places[i + 1] - places[i]);
        lab(x, y) +=
            glm::mix(change.quantiles[i], change.quantiles[i + 1], share) * glm::dvec3(change.axis);
      }
    }
  return encoded_picture(lab);
}

Grid<glm::vec3> class_picture(const Grid<std::uint8_t>& mask) {
  Grid<glm::vec3> out(mask.width(), mask.height(), glm::vec3(0.08F));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (mask[i] == far_air_label) out[i] = glm::vec3(0.75F, 0.78F, 0.86F);
    if (mask[i] < land_cover_class_count) out[i] = unpacked_rgb(land_cover_table[mask[i]].rgb);
  }
  return out;
}

std::optional<Grid<glm::vec3>> class_crop(const Grid<glm::vec3>& painting,
                                          const Grid<std::uint8_t>& mask, LandCoverClass id,
                                          int width_px, int height_px, int zoom) {
  std::size_t count = 0;
  const int width = std::min(width_px, mask.width());
  const int height = std::min(height_px, mask.height());
  // Sums over rectangles: the number of the class's pixels above and left of each corner.
  Grid<std::uint32_t> sums(mask.width() + 1, mask.height() + 1, 0U);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      const bool own = mask(x, y) == static_cast<std::uint8_t>(id);
      count += own ? 1 : 0;
      sums(x + 1, y + 1) = sums(x, y + 1) + sums(x + 1, y) - sums(x, y) + (own ? 1U : 0U);
    }
  if (count < min_crop_texels) return std::nullopt;
  PixelRect best{0, 0, width, height};
  std::uint32_t most = 0;
  for (int y = 0; y + height <= mask.height(); ++y)
    for (int x = 0; x + width <= mask.width(); ++x) {
      const std::uint32_t own =
          sums(x + width, y + height) - sums(x, y + height) - sums(x + width, y) + sums(x, y);
      if (own > most) {
        most = own;
        best = {x, y, x + width, y + height};
      }
    }
  return enlarged(cut(painting, best), zoom);
}

}  // namespace belvedere::tools
