#include "renderer/stages/copied_ground.h"

#include <utility>

namespace belvedere {

Grid<glm::vec3> copy_ground(const CopyPlan& plan, const GroundPaint& paint, const PaintDraft& draft,
                            const BasePicture& base, const Grid<LandCoverClass>& land_cover,
                            PixelRect window) {
  Grid<glm::vec3> copied = transfer_residual(paint.matches, plan.exemplars, draft.base, base.haze,
                                             plan.residual, draft.land_cover);
  if (plan.models.any())
    lay_model_paint(copied, paint.modelled, draft.base, base.haze, plan.residual, draft.land_cover);
  if (plan.seams)
    lay_even_paint(copied, paint.with_seam, draft.base, base.haze, plan.residual, draft.land_cover);
  return mix_borders(copied, to_painting(draft, window), draft.land_cover, land_cover, base.colour);
}

PaintBeforeSeams make_paint_before_seams(const CopyPlan& plan, const MatchField& matches,
                                         const ModelPaint& modelled,
                                         const Grid<LandCoverClass>& shown, Grid<float> depth_m) {
  const Grid<glm::vec3> grey(shown.width(), shown.height(), glm::vec3(even_grey));
  PaintBeforeSeams paint;
  paint.even = transfer_residual(matches, plan.exemplars, grey, {}, plan.residual, shown);
  paint.depth_m = std::move(depth_m);
  paint.source = Grid<std::uint16_t>(shown.width(), shown.height(), no_source);
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (matches[i].exemplar != Match::none)
      paint.source[i] = source_of(matches[i].exemplar, shown[i]);
  if (!plan.models.any()) return paint;
  lay_model_paint(paint.even, modelled, grey, {}, plan.residual, shown);
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (modelled.made[i] != 0)
      paint.source[i] = source_of(plan.exemplars.size() + modelled.made[i] - 1, shown[i]);
  return paint;
}

}  // namespace belvedere
