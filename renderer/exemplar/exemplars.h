#pragma once

#include <vector>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "renderer/exemplar/scan.h"
#include "renderer/paint/paint.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/lit_picture.h"

namespace belvedere {

// What synthesis shall compare: the part of a painting that the residual carries over, picture - residual · base, because a seam shows
// where that part jumps and not where light does. Each label is stretched to the same contrast about mid grey: strokes that differ
// little would else be torn apart for the sake of guides.
Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels, double residual);

// All exemplars of a scene: its paintings (read_scans), and sheets for the blocks that name none; one painted sheet where there is nothing
// else.
std::vector<PaintedExemplar> make_exemplars(const LoadedScene& scene, const Stage& stage, std::vector<ScannedPainting> scans,
                                            Progress& progress);

}  // namespace belvedere
