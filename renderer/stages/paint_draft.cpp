#include "renderer/stages/paint_draft.h"

#include "base/grid_part.h"
#include "renderer/paint/guides.h"

namespace belvedere {
namespace {

// Column and row of a sheet position as one number; sheets are at most 65535 px wide and high.
std::uint32_t sheet_place(int x, int y) {
  return static_cast<std::uint32_t>(y) << 16U | static_cast<std::uint32_t>(x);
}

}  // namespace

PaintDraft make_paint_draft(const GuidanceBuffers& guidance, const BasePicture& base,
                            const StrokeParameters& strokes, const SheetWindow& position,
                            Progress& progress) {
  const Painting painting =
      paint_strokes(base.colour, guidance, base, draft_layers, strokes, progress, position);
  const PaintedClasses classes = find_painted_classes(painting.sources, guidance, base.colour);
  PaintDraft draft{part_of(classes.land_cover, position.asked),
                   part_of(classes.base, position.asked), part_of(painting.under, position.asked),
                   part_of(painting.under_share, position.asked)};
  const auto width = static_cast<std::uint32_t>(guidance.width());
  for (std::uint32_t& from : draft.under)
    from = sheet_place(position.origin_px.x + static_cast<int>(from % width),
                       position.origin_px.y + static_cast<int>(from / width));
  return draft;
}

Painting to_painting(const PaintDraft& draft, PixelRect window) {
  Painting painting;
  painting.under = Grid<std::uint32_t>(window.width(), window.height());
  painting.under_share = draft.under_share;
  for (std::size_t i = 0; i < painting.under.size(); ++i) {
    const int x = static_cast<int>(draft.under[i] & 0xffffU) - window.x0;
    const int y = static_cast<int>(draft.under[i] >> 16U) - window.y0;
    const bool inside = painting.under.contains(x, y);
    painting.under[i] = static_cast<std::uint32_t>(inside ? painting.under.index(x, y) : i);
    if (!inside) painting.under_share[i] = 0;
  }
  return painting;
}

}  // namespace belvedere
