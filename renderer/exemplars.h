#pragma once

#include <vector>

#include "renderer/base/guidance_buffers.h"
#include "renderer/base/progress.h"
#include "renderer/lit_picture.h"
#include "renderer/paint.h"
#include "renderer/scan.h"
#include "renderer/scene_file.h"

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
