#include "tools/report/style_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "base/land_cover_class.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/style/fit/style_painting.h"
#include "tools/report/report.h"
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

namespace {

constexpr int style_painting_px = 720;  // longest side of a painting on the page
// Size of pieces of the painting, in its pixels, and their enlargement.
constexpr int piece_width_px = 110;
constexpr int piece_height_px = 60;
constexpr int piece_zoom = 3;
constexpr int sky_width_px = 600;

std::string words_of(LandCoverClass id) {
  std::string words(class_name(id));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

using ClassCounts = std::array<std::size_t, land_cover_class_count>;

void add_ramps(Report& page, const Style& style, const Palette& reference,
               const ClassCounts& counts) {
  page.section("ramps", "Colours by class and light",
               "The colours of each class from shadow to full light, above those of the palette "
               "summer. Hues come from the painting, the order of lightness among classes from the "
               "palette.");
  ReportTable table({{"class", "class"},
                     {"from", "from"},
                     {"dark", "shadow"},
                     {"low", "tone .34"},
                     {"high", "tone .66"},
                     {"light", "full light"}});
  int shown = 0;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    if (info.id == LandCoverClass::sky) continue;
    const auto c = static_cast<std::size_t>(info.id);
    const ToneRamp& ramp = style.palette.classes[c].stops.front().ramp;
    const bool seen = counts[c] > CleanMaskParameters{}.min_texels;
    table.row(words_of(info.id), seen ? "the painting" : "derived", swatch(ramp[0]),
              swatch(ramp[1]), swatch(ramp[2]), swatch(ramp[3]));
    if (shown++ % 4 == 0) page.next_row();
    page.picture("ramp_" + std::string(info.name),
                 ramp_swatch(style.palette, reference, info.id, 240, 56),
                 words_of(info.id) + (seen ? "" : " (derived)"));
  }
  page.table(table);
}

void add_strokes(Report& page, const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                 const Style& style) {
  page.section("strokes", "Strokes to scale",
               fmt::format("For each class a piece of the painting, enlarged {} times, and strokes "
                           "with the style's measurements at random positions over its colours.",
                           piece_zoom));
  ReportTable table(
      {{"class", "class"},
       {"length", "length, px", ".1f"},
       {"width", "width, px", ".1f"},
       {"level", "level", "+.2f", "1: all strokes are level, -1: upright"},
       {"form", "form", "+.2f", "1: along larger forms, -1: across"},
       {"coherence", "coherence", ".2f", "agreement in direction of neighbouring strokes"},
       {"deviation", "lightness", ".3f", "standard deviation of the residuals, OKLab"}});
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const StyleBrushwork& b = style.brushwork[static_cast<std::size_t>(info.id)];
    if (b.length_px <= 0.0) continue;
    table.row(words_of(info.id), b.length_px, b.width_px, b.level, b.form, b.coherence,
              b.lightness_deviation);
    const std::optional<Grid<glm::vec3>> crop =
        class_crop(painting, mask, info.id, piece_width_px, piece_height_px, piece_zoom);
    page.next_row();
    if (crop)
      page.picture("crop_" + std::string(info.name), *crop, words_of(info.id) + ", painted");
    page.picture("strokes_" + std::string(info.name),
                 stroke_swatch(style, info.id, piece_width_px, piece_height_px, piece_zoom),
                 words_of(info.id) + ", in the style");
  }
  page.table(table);
}

// Ratio of the sky's height to its width in the painting.
double sky_shape(const Grid<std::uint8_t>& mask) {
  int x0 = mask.width(), x1 = 0, y0 = mask.height(), y1 = 0;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) == static_cast<std::uint8_t>(LandCoverClass::sky)) {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x + 1);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y + 1);
      }
  return static_cast<double>(y1 - y0) / std::max(1, x1 - x0);
}

void add_air(Report& page, const Grid<std::uint8_t>& mask, const Style& style) {
  page.section("air", "Sky and air");
  if (!style.sky.medians.empty())
    page.picture("sky",
                 sky_swatch(style.sky, sky_width_px,
                            std::clamp(static_cast<int>(sky_width_px * sky_shape(mask)), 40, 600)),
                 "a sky in the style: medians and the two principal components of colour");
  ReportTable table({{"what", ""}, {"colour", "colour"}});
  const Palette& p = style.palette;
  table.row("haze, near", swatch(p.haze_near))
      .row("haze, far", swatch(p.haze_far))
      .row("between ranges", swatch(p.range_mist))
      .row("light of clouds", swatch(p.cloud_light))
      .row("shade of clouds", swatch(p.cloud_shade))
      .row("larches", swatch(p.growth.larch));
  for (const glm::vec3& leaf : p.growth.leaves) table.row("leaves", swatch(leaf));
  page.table(table);
  ReportTable figures({{"what", ""}, {"value", "value", ".3f"}});
  figures.row("broken paint", style.broken)
      .row("vapour", style.vapour)
      .row("share of hue variance by lightness", style.hue_by_light)
      .row("trend of lightness, bottom to top", style.trend.x)
      .row("trend of a (green to red)", style.trend.y)
      .row("trend of b (blue to yellow)", style.trend.z)
      .row("contrast of medium-scale forms", style.form_deviation)
      .row("unevenness of contrast", style.unevenness)
      .row("dark lines on borders", style.contour_lines)
      .row("share of haze", p.haze_share)
      .row("units per pixel of the painting", style.units_per_px);
  page.table(figures);
}

}  // namespace

void write_style_page(const std::string& folder, const std::string& painting_name,
                      const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                      const Style& style, const Palette& reference, const std::string& command) {
  Report page(folder);
  page.section("painting", painting_name,
               "The painting and its classes in the colours of class maps; unused pixels are near "
               "black.");
  page.picture("painting", reduced_picture(painting, style_painting_px), "painting");
  page.picture("classes", reduced_picture(class_picture(mask), style_painting_px), "classes");
  page.section("notes", "What was derived, and from what");
  page.list(style.notes);
  ClassCounts counts{};
  for (const std::uint8_t label : mask)
    if (label < land_cover_class_count) ++counts[label];
  add_ramps(page, style, reference, counts);
  add_strokes(page, painting, mask, style);
  add_air(page, mask, style);
  page.write({.title = "Style " + style.name,
              .lead = style.origin.empty() ? "The look of a painting." : style.origin + ".",
              .command = command});
}

}  // namespace belvedere::tools
