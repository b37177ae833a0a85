#include "renderer/pipeline/picture_legend.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <locale>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/statistics.h"
#include "base/text/hex_colour.h"
#include "renderer/labels/sheet_painter.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

constexpr int looked_px = 700;            // width of the overview
constexpr double min_share = 0.001;       // of its ground
constexpr double swatch_tone = 0.72;      // lit, but not glaring
constexpr double open_ground_m = 1200.0;  // altitude of the ground under swatches of features
// A smaller piece must have a share of the class larger by this.
constexpr double worth_half = 0.15;
constexpr double min_piece_share = 0.4;  // else a colour tells more
// Penalty of a piece per unit of luminance that it differs from the class, and bonus at the lower
// edge of the picture, where strokes are largest.
constexpr double unlike = 2.0;
constexpr double nearness = 0.15;

// Sums of values over all rectangles from the corner.
Grid<double> summed(const Grid<float>& values) {
  Grid<double> sums(values.width() + 1, values.height() + 1, 0.0);
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x)
      sums(x + 1, y + 1) =
          static_cast<double>(values(x, y)) + sums(x, y + 1) + sums(x + 1, y) - sums(x, y);
  return sums;
}

double sum_in(const Grid<double>& sums, glm::ivec2 low, glm::ivec2 size) {
  const glm::ivec2 high = low + size;
  return sums(high.x, high.y) - sums(low.x, high.y) - sums(high.x, low.y) + sums(low.x, low.y);
}

struct FoundPiece {
  PixelRect rect;      // of the sheet
  double share = 0.0;  // of the class in it
};

// The piece of that size that shows a class best; the first of equals.
FoundPiece best_piece(const PictureOverview& overview, const Grid<float>& light, LandCoverClass id,
                      float usual, glm::dvec2 size_px) {
  const glm::ivec2 of(light.width(), light.height());
  const glm::ivec2 size = glm::clamp(
      glm::ivec2(glm::ceil(size_px / static_cast<double>(overview.factor))), glm::ivec2(1), of);
  Grid<float> is_class(of.x, of.y);
  for (std::size_t i = 0; i < is_class.size(); ++i)
    is_class[i] = overview.classes[i] == id ? 1.0F : 0.0F;
  const Grid<double> classes = summed(is_class);
  const Grid<double> lights = summed(light);
  const double area = static_cast<double>(size.x) * size.y;
  FoundPiece best;
  double best_score = -1e9;
  for (int y = 0; y + size.y <= of.y; ++y)
    for (int x = 0; x + size.x <= of.x; ++x) {
      const double share = sum_in(classes, {x, y}, size) / area;
      if (share <= 0.0) continue;
      const double mean = sum_in(lights, {x, y}, size) / area;
      const double score =
          share - unlike * std::abs(mean - static_cast<double>(usual)) + nearness * y / of.y;
      if (score <= best_score) continue;
      best_score = score;
      // About the same centre, in pixels of the sheet.
      const glm::ivec2 wanted = glm::min(glm::ivec2(glm::round(size_px)), overview.sheet_px);
      const glm::ivec2 centre = glm::ivec2(static_cast<double>(overview.factor) *
                                           (glm::dvec2(x, y) + .5 * glm::dvec2(size)));
      const glm::ivec2 low =
          glm::clamp(centre - wanted / 2, glm::ivec2(0), overview.sheet_px - wanted);
      best = {{low.x, low.y, low.x + wanted.x, low.y + wanted.y}, share};
    }
  return best;
}

std::string words_of(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

SwatchForm form_of(FeatureDraw draw) {
  return draw == FeatureDraw::cable      ? SwatchForm::cable
         : draw == FeatureDraw::building ? SwatchForm::house
                                         : SwatchForm::line;
}

}  // namespace

PictureOverview make_overview(const World& world, const Palette& palette, const Run& run) {
  const int factor = std::max(1, world.scene.output.width / looked_px);
  const std::unique_ptr<const Camera> camera = make_reduced_camera(*world.camera, factor);
  const glm::ivec2 size = camera->size();
  LitPicture picture = make_lit_picture(world, reduced_view(world, *camera, factor), palette,
                                        {0, 0, size.x, size.y}, run);
  return {.sheet_px = world.camera->size(),
          .factor = factor,
          .classes = std::move(picture.guidance.land_cover),
          .colours = std::move(picture.base.colour)};
}

// A byte of the square root: dark values are finer, as the eye wants them.
std::string luminance_to_bytes(const PictureOverview& overview) {
  std::string bytes = fmt::format("{} {}\n", overview.colours.width(), overview.colours.height());
  for (std::size_t i = 0; i < overview.colours.size(); ++i)
    bytes += static_cast<char>(static_cast<unsigned char>(
        std::lround(255.0 * std::sqrt(std::clamp(luminance(overview.colours[i]), 0.0, 1.0)))));
  return bytes;
}

Grid<float> luminance_from_bytes(const std::string& bytes) {
  std::istringstream text(bytes);
  text.imbue(std::locale::classic());
  int width = 0, height = 0;
  text >> width >> height;
  const std::size_t begin = bytes.find('\n') + 1;
  Grid<float> values(width, height);
  if (begin + values.size() != bytes.size())
    throw Error(ErrorKind::input, "luminance in the work folder", "is truncated",
                "a run without --resume");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float root = static_cast<float>(static_cast<unsigned char>(bytes[begin + i])) / 255.0F;
    values[i] = root * root;
  }
  return values;
}

std::vector<LegendEntry> find_legend(const PictureOverview& overview, glm::dvec2 swatch_px) {
  std::array<std::vector<float>, land_cover_class_count> seen;
  std::array<glm::dvec3, land_cover_class_count> sums{};
  std::size_t ground = 0;
  Grid<float> light(overview.colours.width(), overview.colours.height());
  for (std::size_t i = 0; i < overview.classes.size(); ++i) {
    light[i] = static_cast<float>(luminance(overview.colours[i]));
    const LandCoverClass id = overview.classes[i];
    if (id == LandCoverClass::sky) continue;
    seen[static_cast<std::size_t>(id)].push_back(light[i]);
    sums[static_cast<std::size_t>(id)] += glm::dvec3(overview.colours[i]);
    ++ground;
  }
  std::vector<LegendEntry> legend;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    std::vector<float>& values = seen[static_cast<std::size_t>(info.id)];
    const double count = static_cast<double>(values.size());
    if (values.empty() || count < min_share * static_cast<double>(ground)) continue;
    const float middle = value_at_rank(values, values.size() / 2);
    const glm::dvec3 mean = sums[static_cast<std::size_t>(info.id)] / count;
    const FoundPiece whole = best_piece(overview, light, info.id, middle, swatch_px);
    const FoundPiece half = best_piece(overview, light, info.id, middle, .5 * swatch_px);
    const FoundPiece& best = half.share > whole.share + worth_half ? half : whole;
    legend.push_back({words_of(info.name), hex_colour(glm::vec3(mean)),
                      best.share >= min_piece_share ? best.rect : PixelRect()});
  }
  return legend;
}

std::vector<FeatureSwatch> find_feature_legend(const DrawnFeatures& drawn, const Palette& palette) {
  const std::string ground = hex_colour(
      palette_colour(palette, drawn.winter ? LandCoverClass::snow : LandCoverClass::pasture,
                     open_ground_m, swatch_tone));
  std::vector<FeatureSwatch> swatches;
  for (std::size_t k = 0; k < drawn.style.kinds.size(); ++k) {
    const FeatureKind& kind = drawn.style.kinds[k];
    const bool shown = std::any_of(drawn.counts.begin(), drawn.counts.end(),
                                   [&](const std::vector<DrawnCount>& source) {
                                     return k < source.size() && source[k].drawn > 0;
                                   });
    if (!shown || becomes_ground(kind)) continue;
    const FeatureColours& colours = drawn.winter ? kind.winter : kind.summer;
    swatches.push_back({.name = words_of(kind.name),
                        .form = form_of(kind.draw),
                        .ground = ground,
                        .fill = hex_colour(colours.fill),
                        .casing = hex_colour(colours.casing),
                        .bed = hex_colour(colours.bed),
                        .width_mm = kind.width_mm,
                        .min_px = kind.min_px,
                        .casing_mm = kind.casing_mm,
                        .bed_mm = kind.bed_mm,
                        .opacity = kind.opacity,
                        .dash_mm = kind.dash_mm,
                        .has_pylons = kind.pylon_mm > 0.0});
  }
  return swatches;
}

std::string legend_to_text(const std::vector<LegendEntry>& legend) {
  std::string text;
  for (const auto& [name, colour, at] : legend)
    text += fmt::format("{} {} {} {} {} {}\n", colour, at.x0, at.y0, at.x1, at.y1, name);
  return text;
}

std::vector<LegendEntry> legend_from_text(const std::string& text) {
  std::vector<LegendEntry> legend;
  std::istringstream lines(text);
  lines.imbue(std::locale::classic());
  LegendEntry entry;
  PixelRect& at = entry.at;
  while (lines >> entry.colour >> at.x0 >> at.y0 >> at.x1 >> at.y1 &&
         std::getline(lines >> std::ws, entry.name))
    legend.push_back(entry);
  return legend;
}

std::string swatches_to_text(const std::vector<FeatureSwatch>& swatches) {
  std::string text;
  for (const FeatureSwatch& s : swatches)
    text +=
        fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", static_cast<int>(s.form),
                    s.ground, s.fill, s.casing, s.bed, s.width_mm, s.min_px, s.casing_mm, s.bed_mm,
                    s.opacity, s.dash_mm.x, s.dash_mm.y, s.has_pylons ? 1 : 0, s.name);
  return text;
}

std::vector<FeatureSwatch> swatches_from_text(const std::string& text) {
  std::vector<FeatureSwatch> swatches;
  std::istringstream lines(text);
  lines.imbue(std::locale::classic());
  FeatureSwatch s;
  int form = 0;
  while (lines >> form >> s.ground >> s.fill >> s.casing >> s.bed >> s.width_mm >> s.min_px >>
             s.casing_mm >> s.bed_mm >> s.opacity >> s.dash_mm.x >> s.dash_mm.y >> s.has_pylons &&
         std::getline(lines >> std::ws, s.name)) {
    s.form = static_cast<SwatchForm>(form);
    swatches.push_back(s);
  }
  return swatches;
}

}  // namespace belvedere
