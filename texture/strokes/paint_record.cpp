#include "texture/strokes/paint_record.h"

#include <cmath>
#include <utility>

namespace belvedere {

PaintRecord::PaintRecord(const Painting& painting, const GuidanceBuffers& guidance, PixelRect tile, bool keep_shores)
    : guidance_(guidance), tile_(tile), keep_shores_(keep_shores), layers_(tile.x1 - tile.x0, tile.y1 - tile.y0) {
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const float under = static_cast<float>(painting.under_share(x, y)) / 255.F;
      layers_(x - tile.x0, y - tile.y0) = {painting.sources(x, y), 1.F - under, painting.under(x, y), under, painting.strokes(x, y), 1.F};
    }
}

void PaintRecord::cover(int x, int y, const Stroke& stroke, std::uint32_t number, float alpha) {
  Layers& here = layers_(x - tile_.x0, y - tile_.y0);
  here.stroke_share *= 1.F - alpha;
  if (alpha > here.stroke_share) {
    here.stroke = number;
    here.stroke_share = alpha;
  }
  if (keep_shores_ && guidance_.land_cover(x, y) == LandCoverClass::water) return;
  const LandCoverClass paint = guidance_.land_cover[stroke.source];
  here.share *= 1.F - alpha;
  here.under_share *= 1.F - alpha;
  if (guidance_.land_cover[here.source] == paint) {
    here.share += alpha;
    here.source = stroke.source;
    return;
  }
  if (here.under_share > 0.F && guidance_.land_cover[here.under_source] == paint) {
    here.under_share += alpha;
    here.under_source = stroke.source;
  } else if (alpha > here.under_share) {
    here.under_share = alpha;
    here.under_source = stroke.source;
  }
  if (here.under_share > here.share) {
    std::swap(here.share, here.under_share);
    std::swap(here.source, here.under_source);
  }
}

void PaintRecord::hand_back(Painting& painting) const {
  for (int y = tile_.y0; y < tile_.y1; ++y)
    for (int x = tile_.x0; x < tile_.x1; ++x) {
      const Layers& here = layers_(x - tile_.x0, y - tile_.y0);
      const auto own = static_cast<std::uint32_t>(painting.sources.index(x, y));
      const bool own_class = guidance_.land_cover[own] == guidance_.land_cover[here.source];
      painting.sources[own] = own_class ? own : here.source;
      const float known = here.share + here.under_share;  // > 0: the layers of the two thickest classes
      const auto share = static_cast<std::uint8_t>(std::lround(255.F * here.under_share / known));
      painting.under[own] = share > 0 ? here.under_source : own;
      painting.under_share[own] = share;
      painting.strokes[own] = here.stroke;
    }
}

}  // namespace belvedere
