#include "tools/report/style_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/land_cover_class.h"
#include "renderer/style/fit/clean_mask.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"
#include "tools/report/style_pictures.h"

namespace belvedere::tools {
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
