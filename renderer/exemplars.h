#pragma once

#include <vector>

#include "renderer/base/guidance_buffers.h"
#include "renderer/base/progress.h"
#include "renderer/lit_picture.h"
#include "renderer/paint.h"
#include "renderer/scene_file.h"

namespace belvedere {

// What synthesis shall compare: the part of a painting that the residual carries over, picture - residual · base, because a seam shows
// where that part jumps and not where light does. Each label is stretched to the same contrast about mid grey: strokes that differ
// little would else be torn apart for the sake of guides.
Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels, double residual);

// A painting from files: picture with a guidance file, or with a class mask and perhaps altitudes. Such a painting has no base picture
// of its own; target_base lends it the mean of each class, so that the target's light is laid over it and not its colours.
PaintedExemplar read_painting(const SceneExemplar& wish, const LoadedScene& scene, const LitPicture& target);

// Error(input) naming the file where a painting cannot be read whole or its guides have another size, Error(limit) where it takes too
// much memory: to be called before the work begins.
void check_paintings(const LoadedScene& scene);

// All exemplars of a scene; one painted sheet where it names none. An optional one whose file is missing is noted and left out.
std::vector<PaintedExemplar> make_exemplars(const LoadedScene& scene, const Stage& stage, const LitPicture& target, Progress& progress);

}  // namespace belvedere
