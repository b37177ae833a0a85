#include "renderer/features/paint_features.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

constexpr int tile_px = 128;
constexpr float same_ground = 0.04F;  // of its distance: how far a pixel's ground may be in front
                                      // of or behind a line that runs over it
constexpr float in_front = 0.006F;    // of its distance: ground nearer by this hides a rope
constexpr double hand_mm = 1.1;       // wavelength of the unevenness of brushwork on the sheet

constexpr float load_share = 0.045F;  // variation of the load of paint
constexpr double load_mm = 0.45;      // and its wavelength on the sheet

enum class Coat : std::uint8_t { bed, band, casing, fill, cable };

// One coat of paint over the lines of one kind.
struct Layer {
  Coat coat;
  int kind;
  double rank;
};

std::vector<Layer> layers_of(const FeatureStyle& style) {
  std::vector<Layer> layers;
  for (std::size_t k = 0; k < style.kinds.size(); ++k) {
    const FeatureKind& kind = style.kinds[k];
    const auto add = [&](Coat coat) { layers.push_back({coat, static_cast<int>(k), kind.rank}); };
    if (kind.draw == FeatureDraw::cable) add(Coat::cable);
    if (kind.draw != FeatureDraw::line && kind.draw != FeatureDraw::band) continue;
    if (kind.bed_mm > 0.0) add(Coat::bed);
    if (kind.casing_mm > 0.0) add(Coat::casing);
    add(kind.draw == FeatureDraw::band ? Coat::band : Coat::fill);
  }
  std::stable_sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) {
    return a.coat != b.coat ? a.coat < b.coat : a.rank < b.rank;
  });
  return layers;
}

// The nearest point of a segment to a pixel.
struct Near {
  float t;
  float distance;
  glm::vec2 off;  // from that point to the pixel
};
Near nearest(const DrawnPoint& a, const DrawnPoint& b, glm::vec2 pixel) {
  const glm::vec2 way = b.position - a.position;
  const glm::vec2 from = pixel - a.position;
  const float t = std::clamp(glm::dot(from, way) / (glm::dot(way, way) + 1e-9F), 0.F, 1.F);
  const glm::vec2 off = from - t * way;
  return {t, glm::length(off), off};
}

// Pixels of the rectangle within `reach` of a segment.
PixelRect around(const DrawnPoint& a, const DrawnPoint& b, float reach, PixelRect rect) {
  const glm::vec2 low =
      glm::clamp(glm::min(a.position, b.position) - reach, glm::vec2(-1e6F), glm::vec2(1e6F));
  const glm::vec2 high =
      glm::clamp(glm::max(a.position, b.position) + reach, glm::vec2(-1e6F), glm::vec2(1e6F));
  return intersection(
      {static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y)),
       static_cast<int>(std::ceil(high.x)) + 1, static_cast<int>(std::ceil(high.y)) + 1},
      rect);
}

// The rows of the traced ground that a tile of the sheet shows, where crests of rock are drawn
// higher or lower than traced.
class ShownRows {
 public:
  ShownRows(const Grid<std::int16_t>* rows, PixelRect held, PixelRect tile)
      : rows_(rows), held_(held) {
    if (rows_ == nullptr) return;
    for (int y = tile.y0; y < tile.y1; ++y) {
      const auto [min, max] = std::minmax_element(rows_->row(y - held.y0) + (tile.x0 - held.x0),
                                                  rows_->row(y - held.y0) + (tile.x1 - held.x0));
      min_ = std::min<int>(min_, *min);
      max_ = std::max<int>(max_, *max);
    }
    if (min_ == 0 && max_ == 0) rows_ = nullptr;
  }
  // Where the ground in pixel x, y of the sheet was traced.
  glm::vec2 traced(int x, int y) const {
    const int below = rows_ == nullptr ? 0 : (*rows_)(x - held_.x0, y - held_.y0);
    return {static_cast<float>(x) + 0.5F, static_cast<float>(y + below) + 0.5F};
  }
  // All traced positions that the tile shows.
  PixelRect traced(PixelRect tile) const {
    return {tile.x0, tile.y0 + min_, tile.x1, tile.y1 + max_};
  }
  // All pixels of the tile that may show traced positions.
  PixelRect shown(PixelRect traced, PixelRect tile) const {
    return intersection({traced.x0, traced.y0 - max_, traced.x1, traced.y1 - min_}, tile);
  }

 private:
  const Grid<std::int16_t>* rows_;
  PixelRect held_;
  int min_ = 0;
  int max_ = 0;
};

bool lies_on(float depth_m, float distance_m) {
  return std::abs(depth_m - distance_m) <= same_ground * distance_m;
}

// Coverage of a dash at a position along the line, antialiased over a pixel.
float dash_at(glm::dvec2 dash_mm, float along_mm, float px_of_mm) {
  const auto on = static_cast<float>(dash_mm.x);
  const auto period = static_cast<float>(dash_mm.x + dash_mm.y);
  if (!(dash_mm.y > 0.0) || period * px_of_mm < 2.F) return dash_mm.y > 0.0 ? on / period : 1.F;
  const float at = along_mm - period * std::floor(along_mm / period);
  // Distance into the dash, px: negative in the gap.
  const float inside = std::min(at, on - at);
  const float wrapped = std::max(inside, at - period);
  return std::clamp(0.5F + wrapped * px_of_mm, 0.F, 1.F);
}

// The coverage of one coat on a tile: the maximum over the lines of the kind, so that they join.
class Coverage {
 public:
  Coverage(const DrawnFeatures& features, const Grid<float>& depth_m, const ShownRows& rows,
           PixelRect held, PixelRect tile)
      : features_(features),
        depth_m_(depth_m),
        rows_(rows),
        held_(held),
        tile_(tile),
        values_(tile.width(), tile.height()) {}

  // False where none of the lines touches the tile.
  bool lay(const Layer& layer, const std::vector<std::uint32_t>& numbers) {
    std::fill(values_.begin(), values_.end(), 0.F);
    bool any = false;
    for (const std::uint32_t number : numbers) {
      const DrawnLine& line = features_.lines[number];
      if (line.kind != layer.kind || line.part == LinePart::lane) continue;
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
        any = lay_segment(layer, line, i) || any;
    }
    return any;
  }
  float at(int x, int y) const { return values_(x - tile_.x0, y - tile_.y0); }

 private:
  bool lay_segment(const Layer& layer, const DrawnLine& line, std::size_t i) {
    const FeatureKind& kind = features_.style.kinds[static_cast<std::size_t>(layer.kind)];
    const DrawnPoint& a = line.points[i];
    const DrawnPoint& b = line.points[i + 1];
    const auto scale = static_cast<float>(features_.px_per_mm);
    const float beyond_mm = static_cast<float>(layer.coat == Coat::casing ? kind.casing_mm
                                               : layer.coat == Coat::bed  ? kind.bed_mm
                                                                          : 0.0);
    const bool soft_coat = layer.coat == Coat::bed || layer.coat == Coat::band;
    const float soft_mm = soft_coat ? static_cast<float>(kind.soft_mm) : 0.F;
    const auto hand = static_cast<float>(line.part == LinePart::way ? kind.hand : 0.0);
    const float share = std::max(a.share, b.share);
    const float reach =
        std::max(a.half_px, b.half_px) * (1.F + hand) + (beyond_mm + soft_mm) * scale * share + 1.F;
    const bool in_air = layer.coat == Coat::cable;
    const PixelRect where = in_air ? around(a, b, reach, tile_)
                                   : rows_.shown(around(a, b, reach, rows_.traced(tile_)), tile_);
    if (where.empty()) return false;
    bool any = false;
    for (int y = where.y0; y < where.y1; ++y)
      for (int x = where.x0; x < where.x1; ++x) {
        const glm::vec2 pixel =
            in_air ? glm::vec2(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F)
                   : rows_.traced(x, y);
        const Near near = nearest(a, b, pixel);
        if (near.distance > reach) continue;
        const float distance_m = glm::mix(a.distance_m, b.distance_m, near.t);
        const float depth = depth_m_(x - held_.x0, y - held_.y0);
        if (in_air ? depth < distance_m * (1.F - in_front) : !lies_on(depth, distance_m)) continue;
        const float share_here = glm::mix(a.share, b.share, near.t) * scale;
        float half = glm::mix(a.half_px, b.half_px, near.t);
        // Brushwork: slightly wider or narrower, by position on the sheet.
        if (hand > 0.F && near.distance > 0.5F * half - 1.F)
          half *= 1.F + hand * std::clamp(hand_noise(pixel), -1.F, 1.F);
        const float own = half;
        half += beyond_mm * share_here;
        const float soft = std::max(1.F, soft_mm * share_here);
        // Antialiased by distance; a line thinner than a pixel keeps its area instead of its width.
        float value =
            soft > 1.F
                ? smoothstep(std::clamp((half + 0.5F * soft - near.distance) / soft, 0.F, 1.F))
                : std::clamp(0.5F + half - near.distance, 0.F, std::min(1.F, 2.F * half));
        if (line.part == LinePart::station)
          value = std::clamp(0.5F + own - std::max(std::abs(near.off.x), std::abs(near.off.y)), 0.F,
                             1.F);
        if (layer.coat == Coat::fill && kind.dash_mm.y > 0.0)
          value *= dash_at(kind.dash_mm, glm::mix(a.along_mm, b.along_mm, near.t), share_here);
        float& to = values_(x - tile_.x0, y - tile_.y0);
        to = std::max(to, value);
        any = any || value > 0.F;
      }
    return any;
  }

  float hand_noise(glm::vec2 pixel) const {
    const std::uint64_t seed = stream_seed(features_.seed, Stream::feature_edges);
    const double scale = 1.0 / features_.px_per_mm;
    return static_cast<float>(gaussian_noise(seed, static_cast<double>(pixel.x) * scale,
                                             static_cast<double>(pixel.y) * scale, hand_mm));
  }

  const DrawnFeatures& features_;
  const Grid<float>& depth_m_;
  const ShownRows& rows_;
  PixelRect held_;
  PixelRect tile_;
  Grid<float> values_;
};

// Paint in the local light: warm and light in the sun, cool and darker in the shade.
glm::vec3 in_light(glm::vec3 paint, float tone) {
  const float light = std::clamp(tone, 0.F, 1.F);
  const glm::vec3 cool{0.90F, 0.96F, 1.08F};
  return glm::min(paint * (0.66F + 0.40F * light) * (cool + (1.F - cool) * smoothstep(light)),
                  glm::vec3(1.F));
}

// Relative excess of paint at a pixel, deviation 1, by position on the sheet.
float load_noise(const DrawnFeatures& features, int x, int y) {
  const std::uint64_t seed = stream_seed(features.seed, Stream::feature_edges, 1);
  const double scale = 1.0 / features.px_per_mm;
  return static_cast<float>(gaussian_noise(seed, (x + 0.5) * scale, (y + 0.5) * scale, load_mm));
}

bool is_ice_or_snow(LandCoverClass id) {
  return id == LandCoverClass::snow || id == LandCoverClass::glacier;
}

struct Canvas {
  Grid<glm::vec3>& picture;
  const FeatureGround& ground;
  PixelRect rect;
  PaintParts* parts;

  // Pixel x, y of the sheet becomes `after`, which contains 1 - alpha of its old value: as a layer,
  // paint of opacity alpha.
  void change(int x, int y, glm::vec3 after, float alpha) const {
    const glm::ivec2 position{x - rect.x0, y - rect.y0};
    glm::vec3& pixel = picture(position.x, position.y);
    if (parts != nullptr && alpha > 0.F)
      parts->cover(position.x, position.y, PaintPart::features, alpha,
                   (after - (1.F - alpha) * pixel) / alpha);
    pixel = after;
  }
};

// The tints of all bands over a tile: where two overlap the later one shows, as if one brush took
// up the other's paint. Applied as a factor, so that light and relief show through.
void lay_tint(const DrawnFeatures& features, const Layer& layer, const Coverage& coverage,
              PixelRect tile, Grid<glm::vec3>& tints) {
  const FeatureKind& kind = features.style.kinds[static_cast<std::size_t>(layer.kind)];
  const glm::vec3 fill = (features.winter ? kind.winter : kind.summer).fill;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const float alpha = coverage.at(x, y);
      glm::vec3& tint = tints(x - tile.x0, y - tile.y0);
      if (alpha > 0.F)
        tint += alpha * (1.F + static_cast<float>(kind.opacity) * (fill - 1.F) - tint);
    }
}

void paint_tints(const Canvas& canvas, const Grid<glm::vec3>& tints, PixelRect tile) {
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const glm::vec3 tint = tints(x - tile.x0, y - tile.y0);
      if (tint == glm::vec3(1.F)) continue;
      const std::size_t i = canvas.picture.index(x - canvas.rect.x0, y - canvas.rect.y0);
      const float seen = canvas.ground.seen_ground[i];
      const glm::vec3 below =
          canvas.ground.base[i] + (canvas.picture[i] - canvas.ground.base[i]) * seen;
      const float strength = seen * (1.F - std::clamp(canvas.ground.haze[i], 0.F, 1.F));
      // A layer keeps the share of the background that the tint keeps in its strongest channel: its
      // colour depends on the background.
      const float max = 1.F - std::min({1.F, tint.x, tint.y, tint.z});
      canvas.change(x, y, canvas.picture[i] + strength * below * (tint - 1.F),
                    strength * seen * max);
    }
}

void paint_layer(const Canvas& canvas, const DrawnFeatures& features, const Layer& layer,
                 const Coverage& coverage, PixelRect tile) {
  const FeatureKind& kind = features.style.kinds[static_cast<std::size_t>(layer.kind)];
  const FeatureColours& colours = features.winter ? kind.winter : kind.summer;
  const auto opacity = static_cast<float>(kind.opacity);
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const float share = coverage.at(x, y);
      if (share <= 0.F) continue;
      const std::size_t i = canvas.picture.index(x - canvas.rect.x0, y - canvas.rect.y0);
      const FeatureGround& ground = canvas.ground;
      const float haze = std::clamp(ground.haze[i], 0.F, 1.F);
      const float tone = ground.guidance.tone[i];
      // In front of sky there is no ground whose light could be used.
      const float light = ground.guidance.is_sky(i) ? 0.6F : tone;
      const bool hangs = layer.coat == Coat::cable;
      const float under = hangs ? 1.F : ground.seen_ground[i];
      const float nearer = hangs && !ground.seen_overhead.empty() ? ground.seen_overhead[i] : 1.F;
      const glm::vec3 pixel = canvas.picture[i];
      // The background where standing objects cover the ground; the picture itself elsewhere.
      const glm::vec3 below = ground.base[i] + (pixel - ground.base[i]) * under;
      const float alpha =
          share * under * nearer * (layer.coat == Coat::bed || hangs ? 1.F : opacity);
      const glm::vec3 paint = layer.coat == Coat::bed      ? colours.bed
                              : layer.coat == Coat::casing ? colours.casing
                                                           : colours.fill;
      // The load of paint varies.
      const glm::vec3 loaded = paint * (1.F + load_share * load_noise(features, x, y));
      if (layer.coat == Coat::bed && is_ice_or_snow(ground.guidance.land_cover[i]))
        continue;  // it is one already
      const glm::vec3 lit = layer.coat == Coat::bed
                                ? glm::min(loaded * fresh_snow(light), glm::vec3(1.F))
                                : in_light(loaded, light);
      canvas.change(x, y, pixel + alpha * (lit + (ground.base[i] - lit) * haze - below),
                    alpha * under);
    }
}

bool is_in_air(LinePart part) { return part == LinePart::rope || part == LinePart::pylon; }

}  // namespace

void paint_features(Grid<glm::vec3>& picture, const DrawnFeatures& features,
                    const FeatureGround& ground, PixelRect rect, PixelRect asked,
                    PaintParts* parts) {
  const bool same = picture.width() == rect.width() && picture.height() == rect.height() &&
                    picture.same_size(ground.guidance.depth_m) &&
                    picture.same_size(ground.guidance.tone) && picture.same_size(ground.base) &&
                    picture.same_size(ground.haze) && picture.same_size(ground.seen_ground) &&
                    (ground.seen_overhead.empty() || picture.same_size(ground.seen_overhead)) &&
                    (ground.crest_rows == nullptr || picture.same_size(*ground.crest_rows));
  if (!same) throw Error(ErrorKind::bug, "paint_features", "the grids have different sizes");
  const std::vector<Layer> layers = layers_of(features.style);
  const Canvas canvas{picture, ground, rect, parts};
  parallel_tiles(asked.width(), asked.height(), tile_px, [&](PixelRect part) {
    const PixelRect tile = moved(part, asked.x0, asked.y0);
    const ShownRows rows(ground.crest_rows, rect, tile);
    const std::vector<std::uint32_t> numbers = features.lines_at(rows.traced(tile));
    if (numbers.empty()) return;
    Coverage coverage(features, ground.guidance.depth_m, rows, rect, tile);
    Grid<glm::vec3> tints;
    for (const Layer& layer : layers) {
      // Bands lie over their beds and under all lines.
      if (layer.coat > Coat::band && !tints.empty()) {
        paint_tints(canvas, tints, tile);
        tints = {};
      }
      if (!coverage.lay(layer, numbers)) continue;
      if (layer.coat == Coat::band) {
        if (tints.empty()) tints = Grid<glm::vec3>(tile.width(), tile.height(), glm::vec3(1.F));
        lay_tint(features, layer, coverage, tile, tints);
      } else {
        paint_layer(canvas, features, layer, coverage, tile);
      }
    }
    if (!tints.empty()) paint_tints(canvas, tints, tile);
  });
}

void visit_coats(const DrawnFeatures& features, const Grid<float>& depth_m, PixelRect rect,
                 const Grid<std::int16_t>* crest_rows, const UseCoat& use) {
  const std::vector<Layer> layers = layers_of(features.style);
  parallel_tiles(rect.width(), rect.height(), tile_px, [&](PixelRect part) {
    const PixelRect tile = moved(part, rect.x0, rect.y0);
    const ShownRows rows(crest_rows, rect, tile);
    const std::vector<std::uint32_t> numbers = features.lines_at(rows.traced(tile));
    Coverage coverage(features, depth_m, rows, rect, tile);
    for (const Layer& layer : layers) {
      if (!coverage.lay(layer, numbers)) continue;
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
          if (const float share = coverage.at(x, y); share > 0.F) use(layer.kind, x, y, share);
    }
  });
}

Grid<std::uint8_t> find_cleared(const DrawnFeatures& features, const Grid<float>& depth_m,
                                PixelRect rect, const Grid<std::int16_t>* crest_rows) {
  Grid<std::uint8_t> cleared(rect.width(), rect.height());
  const auto scale = static_cast<float>(features.px_per_mm);
  parallel_tiles(rect.width(), rect.height(), tile_px, [&](PixelRect part) {
    const PixelRect tile = moved(part, rect.x0, rect.y0);
    const ShownRows rows(crest_rows, rect, tile);
    // Pixels below a line count up to clear_below times as far as those at its sides.
    const auto clear = [&](const DrawnPoint& a, const DrawnPoint& b, float clear_mm) {
      const float max = std::max(a.half_px, b.half_px) + static_cast<float>(clear_below) *
                                                             clear_mm * scale *
                                                             std::max(a.share, b.share);
      const PixelRect where = rows.shown(around(a, b, max, rows.traced(tile)), tile);
      for (int y = where.y0; y < where.y1; ++y)
        for (int x = where.x0; x < where.x1; ++x) {
          const Near near = nearest(a, b, rows.traced(x, y));
          const float down = near.distance > 0.F ? std::max(0.F, near.off.y / near.distance) : 0.F;
          const float room = clear_mm * scale * glm::mix(a.share, b.share, near.t) *
                             (1.F + (static_cast<float>(clear_below) - 1.F) * down);
          if (near.distance > glm::mix(a.half_px, b.half_px, near.t) + room) continue;
          if (!lies_on(depth_m(x - rect.x0, y - rect.y0),
                       glm::mix(a.distance_m, b.distance_m, near.t)))
            continue;
          cleared(x - rect.x0, y - rect.y0) = 1;
        }
    };
    for (const std::uint32_t number : features.lines_at(rows.traced(tile))) {
      const DrawnLine& line = features.lines[number];
      const FeatureKind& kind = features.style.kinds[static_cast<std::size_t>(line.kind)];
      if (kind.clear_mm <= 0.0 || is_in_air(line.part)) continue;
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
        clear(line.points[i], line.points[i + 1], static_cast<float>(kind.clear_mm));
    }
    for (const std::uint32_t number : features.houses_at(rows.traced(tile))) {
      const DrawnHouse& house = features.houses[number];
      const FeatureKind& kind = features.style.kinds[static_cast<std::size_t>(house.kind)];
      const DrawnPoint foot{.position = house.foot,
                            .distance_m = house.distance_m,
                            .half_px = 0.6F * house.reach_px,
                            .share = 1.F,
                            .along_mm = 0.F};
      clear(foot, foot, static_cast<float>(kind.clear_mm));
    }
  });
  return cleared;
}

Grid<float> find_overhead(const DrawnFeatures& features, PixelRect rect) {
  const std::vector<std::uint32_t> numbers = features.lines_at(rect);
  const auto hangs = [&](std::uint32_t number) {
    const LinePart part = features.lines[number].part;
    return is_in_air(part) || part == LinePart::station;
  };
  if (std::none_of(numbers.begin(), numbers.end(), hangs)) return {};
  Grid<float> overhead_m(rect.width(), rect.height(), std::numeric_limits<float>::infinity());
  parallel_tiles(rect.width(), rect.height(), tile_px, [&](PixelRect part) {
    const PixelRect tile = moved(part, rect.x0, rect.y0);
    for (const std::uint32_t number : features.lines_at(tile)) {
      const DrawnLine& line = features.lines[number];
      for (std::size_t i = 0; hangs(number) && i + 1 < line.points.size(); ++i) {
        const DrawnPoint& a = line.points[i];
        const DrawnPoint& b = line.points[i + 1];
        // A station is square.
        const float reach = 1.5F * std::max(a.half_px, b.half_px) + 1.F;
        const PixelRect where = around(a, b, reach, tile);
        for (int y = where.y0; y < where.y1; ++y)
          for (int x = where.x0; x < where.x1; ++x) {
            const Near near =
                nearest(a, b, {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F});
            if (near.distance > reach) continue;
            float& to = overhead_m(x - rect.x0, y - rect.y0);
            to = std::min(to, glm::mix(a.distance_m, b.distance_m, near.t));
          }
      }
    }
  });
  return overhead_m;
}

}  // namespace belvedere
