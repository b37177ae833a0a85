#include "texture/strokes/paint_record.h"

#include <cmath>
#include <utility>

namespace belvedere {

PaintRecord::PaintRecord(const Painting& painting, const GuidanceBuffers& guidance, PixelRect tile,
                         bool to_copy_from)
    : guidance_(guidance),
      tile_(tile),
      to_copy_from_(to_copy_from),
      layers_(tile.x1 - tile.x0, tile.y1 - tile.y0) {
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const float under = static_cast<float>(painting.under_share(x, y)) / 255.F;
      layers_(x - tile.x0, y - tile.y0) = {
          .top = {painting.sources(x, y), 1.F - under, 1.F - under},
          .under = {painting.under(x, y), under, under},
          .stroke = painting.strokes(x, y),
          .stroke_share = 1.F};
    }
}

void PaintRecord::Paint::thin(float by) {
  share *= by;
  source_share *= by;
}

void PaintRecord::Paint::add(std::uint32_t from, float alpha) {
  share += alpha;
  if (alpha < source_share) return;
  source = from;
  source_share = alpha;
}

void PaintRecord::cover(int x, int y, const Stroke& stroke, std::uint32_t number, float alpha) {
  Layers& here = layers_(x - tile_.x0, y - tile_.y0);
  here.stroke_share *= 1.F - alpha;
  if (alpha > here.stroke_share) {
    here.stroke = number;
    here.stroke_share = alpha;
  }
  if (!to_copy_from_ && guidance_.land_cover(x, y) == LandCoverClass::water) return;
  const LandCoverClass paint = guidance_.land_cover[stroke.source];
  here.top.thin(1.F - alpha);
  here.under.thin(1.F - alpha);
  if (guidance_.land_cover[here.top.source] == paint) {
    here.top.add(stroke.source, alpha);
    return;
  }
  if (here.under.share > 0.F && guidance_.land_cover[here.under.source] == paint)
    here.under.add(stroke.source, alpha);
  else if (alpha > here.under.share)
    here.under = {stroke.source, alpha, alpha};
  if (here.under.share > here.top.share) std::swap(here.top, here.under);
}

void PaintRecord::hand_back(Painting& painting) const {
  for (int y = tile_.y0; y < tile_.y1; ++y)
    for (int x = tile_.x0; x < tile_.x1; ++x) {
      const Layers& here = layers_(x - tile_.x0, y - tile_.y0);
      const auto own = static_cast<std::uint32_t>(painting.sources.index(x, y));
      const bool is_own =
          !to_copy_from_ && guidance_.land_cover[own] == guidance_.land_cover[here.top.source];
      painting.sources[own] = is_own ? own : here.top.source;
      const float known =
          here.top.share + here.under.share;  // > 0: the layers of the two thickest classes
      const auto share = static_cast<std::uint8_t>(std::lround(255.F * here.under.share / known));
      painting.under[own] = share > 0 ? here.under.source : own;
      painting.under_share[own] = share;
      painting.strokes[own] = here.stroke;
    }
}

}  // namespace belvedere
