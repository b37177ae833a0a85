#include "renderer/stages/picture_layers.h"

#include <algorithm>
#include <cmath>

#include "base/land_cover_class.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double highest = 65535.0;
constexpr std::size_t mist_at = 1;
constexpr std::size_t strokes_at = 2;
constexpr std::size_t ground_strokes_at = strokes_at + 1;
constexpr std::size_t edges_at = strokes_at + paint_part_count;
constexpr std::array<PaintPart, paint_part_count> strokes_upwards = {
    PaintPart::sky,   PaintPart::ground, PaintPart::ice,    PaintPart::features,
    PaintPart::trees, PaintPart::houses, PaintPart::accents};

std::uint16_t whole(double value) {
  return static_cast<std::uint16_t>(std::clamp(value, 0.0, 1.0) * highest + 0.5);
}
LayerPixel pixel_of(glm::dvec3 colour, double opacity) {
  return {whole(colour.x), whole(colour.y), whole(colour.z), whole(opacity)};
}

// Strokes of one pixel, from the top down: a layer's opacity is its share of what the layers above
// it leave, so that each shows by its weight.
void cut_strokes(const PaintParts& parts, std::size_t at, std::size_t i, PictureLayers& out) {
  double left = 1.0;
  for (std::size_t k = paint_part_count; k-- > 0;) {
    const glm::vec4 sum = parts.sum(strokes_upwards[k])[at];
    const double weight = std::min(static_cast<double>(sum.w), left);
    if (weight <= 0.5 / highest) continue;
    out.planes[strokes_at + k][i] =
        pixel_of(glm::dvec3(sum.x, sum.y, sum.z) / static_cast<double>(sum.w), weight / left);
    left = std::max(1e-12, left - weight);
  }
}

bool holds(const std::vector<LandCoverClass>& classes, std::uint16_t id) {
  return std::any_of(classes.begin(), classes.end(),
                     [&](LandCoverClass one) { return static_cast<std::uint16_t>(one) == id; });
}

}  // namespace

const std::array<std::string_view, layer_plane_count>& layer_plane_names() {
  static const std::array<std::string_view, layer_plane_count> names = {
      "layer_ground",  "layer_mist",     "layer_sky",   "layer_strokes",
      "layer_ice",     "layer_features", "layer_trees", "layer_houses",
      "layer_accents", "layer_edges",    "layer_about"};
  return names;
}

const std::vector<PictureLayer>& picture_layers() {
  using C = LandCoverClass;
  static const std::vector<PictureLayer> all = [] {
    std::vector<PictureLayer> layers = {
        {.name = "ground", .title = "Ground", .plane = 0},
        {.name = "water", .title = "Water", .plane = 0, .where = {C::water}},
        {.name = "snow_and_ice",
         .title = "Snow and ice",
         .plane = 0,
         .where = {C::snow, C::glacier}},
        {.name = "sky", .title = "Sky", .plane = 0, .where = {C::sky}},
        {.name = "mist", .title = "Mist", .plane = mist_at, .of = LayerOf::mist},
        {.name = "strokes_sky", .title = "Strokes: sky", .plane = strokes_at},
        {.name = "strokes_rock",
         .title = "Strokes: rock, scree and sand",
         .plane = ground_strokes_at,
         .where = {C::rock, C::scree, C::sand}},
        {.name = "strokes_meadows",
         .title = "Strokes: meadows and shrubs",
         .plane = ground_strokes_at,
         .where = {C::pasture, C::alpine_grass, C::valley_floor, C::shrub}},
        {.name = "strokes_forest",
         .title = "Strokes: ground of forests",
         .plane = ground_strokes_at,
         .where = {C::forest}},
        {.name = "strokes_water",
         .title = "Strokes: water",
         .plane = ground_strokes_at,
         .where = {C::water}},
        {.name = "strokes_ground", .title = "Strokes: other ground", .plane = ground_strokes_at},
        {.name = "strokes_ice", .title = "Strokes: snow and ice", .plane = strokes_at + 2},
        {.name = "features",
         .title = "Roads, lifts and runs",
         .plane = strokes_at + 3,
         .of = LayerOf::features},
        {.name = "strokes_trees",
         .title = "Strokes: trees and what stands",
         .plane = strokes_at + 4},
        {.name = "strokes_houses", .title = "Strokes: houses", .plane = strokes_at + 5},
        {.name = "strokes_accents", .title = "Strokes: accents", .plane = strokes_at + 6},
        {.name = "edges", .title = "Softened edges", .plane = edges_at}};
    // Classes without a layer of their own count as other ground.
    const auto rest = std::find_if(layers.begin(), layers.end(), [](const PictureLayer& one) {
      return one.name == "strokes_ground";
    });
    for (const LandCoverClassInfo& info : land_cover_classes()) {
      const bool told = std::any_of(layers.begin(), layers.end(), [&](const PictureLayer& one) {
        return one.plane == ground_strokes_at &&
               holds(one.where, static_cast<std::uint16_t>(info.id));
      });
      if (!told) rest->where.push_back(info.id);
    }
    const auto mask = [&](const char* name, const char* title, int share, std::uint32_t rgb) {
      layers.push_back({.name = name,
                        .title = title,
                        .mask = true,
                        .plane = about_plane,
                        .share = share,
                        .rgb = rgb});
    };
    mask("mask_shadow", "Mask: cast shadow", 0, 0x202040);
    mask("mask_light", "Mask: light", 1, 0xffe0a0);
    mask("mask_air", "Mask: air", 2, 0xa0c0e0);
    for (const LandCoverClassInfo& info : land_cover_classes()) {
      if (info.id == C::sky) continue;
      const std::string name(info.name);
      layers.push_back({.name = "class_" + name,
                        .title = "Mask: " + name,
                        .mask = true,
                        .plane = about_plane,
                        .where = {info.id},
                        .rgb = info.rgb});
    }
    return layers;
  }();
  return all;
}

Grid<LayerPixel> make_layer(const PictureLayer& layer, const Grid<LayerPixel>& plane,
                            const Grid<LayerPixel>& about) {
  if (!layer.mask && layer.where.empty()) return plane;
  const LayerPixel mask = pixel_of(
      glm::dvec3((layer.rgb >> 16U) & 255U, (layer.rgb >> 8U) & 255U, layer.rgb & 255U) / 255.0,
      1.0);
  Grid<LayerPixel> out(about.width(), about.height(), LayerPixel{});
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!layer.where.empty() && !holds(layer.where, about[i][3])) continue;
    if (!layer.mask) {
      out[i] = plane[i];
      continue;
    }
    const std::uint16_t opacity =
        layer.share < 0 ? mask[3] : about[i][static_cast<std::size_t>(layer.share)];
    if (opacity != 0) out[i] = {mask[0], mask[1], mask[2], opacity};
  }
  return out;
}

Grid<LayerPixel> opaque_pixels(const Grid<glm::vec3>& finished) {
  Grid<LayerPixel> out(finished.width(), finished.height());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = pixel_of(finished[i], 1.0);
  return out;
}

void lay_over(glm::dvec3& below, const LayerPixel& above) {
  const double opacity = above[3] / highest;
  for (int c = 0; c < 3; ++c)
    below[c] += opacity * (above[static_cast<std::size_t>(c)] / highest - below[c]);
}

PictureLayers cut_layers(const Grid<glm::vec3>& bare, const MistPaint& mist,
                         const PaintParts& parts, PixelRect rect, const GuidanceBuffers& guidance,
                         const Grid<float>& haze, const Grid<glm::vec3>& finished) {
  PictureLayers out;
  for (Grid<LayerPixel>& plane : out.planes)
    plane = Grid<LayerPixel>(bare.width(), bare.height(), LayerPixel{});
  parallel_rows(bare.height(), [&](int y) {
    for (int x = 0; x < bare.width(); ++x) {
      const std::size_t i = bare.index(x, y);
      out.planes[0][i] = pixel_of(bare[i], 1.0);
      if (!mist.share.empty() && mist.share[i] > 0.0F)
        out.planes[mist_at][i] = pixel_of(mist.colour[i], mist.share[i]);
      cut_strokes(parts, parts.sum(PaintPart::sky).index(rect.x0 + x, rect.y0 + y), i, out);

      glm::dvec3 flat(0.0);
      for (std::size_t k = 0; k < edges_at; ++k) lay_over(flat, out.planes[k][i]);
      const LayerPixel wanted = pixel_of(finished[i], 1.0);
      double off = 0.0;
      for (int c = 0; c < 3; ++c)
        off = std::max(off, std::abs(flat[c] * highest - wanted[static_cast<std::size_t>(c)]));
      if (off > flatten_steps) out.planes[edges_at][i] = wanted;

      const bool sky = guidance.is_sky(i);
      const auto id =
          static_cast<std::uint16_t>(sky ? LandCoverClass::sky : guidance.land_cover[i]);
      out.planes[about_plane][i] = {
          sky ? std::uint16_t{0} : whole(1.0 - static_cast<double>(guidance.shadow[i])),
          sky ? std::uint16_t{0} : whole(guidance.tone[i]), sky ? std::uint16_t{0} : whole(haze[i]),
          id};
    }
  });
  return out;
}

}  // namespace belvedere
