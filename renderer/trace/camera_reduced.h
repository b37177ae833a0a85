#pragma once

#include <memory>

#include "renderer/trace/camera.h"

namespace belvedere {

// Another camera's view in a picture whose pixels are `factor` times as wide and high: the same
// rays, fewer of them. Its size is rounded up, so its last column and row may extend beyond the
// edge of the whole picture. `whole` must outlive it.
std::unique_ptr<const Camera> make_reduced_camera(const Camera& whole, int factor);

}  // namespace belvedere
