#include "renderer/world/ground_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "base/parallel.h"
#include "renderer/trace/camera.h"
#include "renderer/world/generalize_view.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem_levels.h"

#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr int stride = 2;               // cells of the whole between sampled positions
constexpr double unseen_share = 0.125;  // of the distance: cell size of ground that is not shown
constexpr double finest_px = 0.25;      // finer cells show nothing more
constexpr double coarser_step = 1.1;    // from one try to the next
constexpr int window_margin =
    16;  // cells from a window's edge to that of the previous one, of its own
constexpr int smallest_window = 64;  // cells on a side

// The camera's requirement on the ground at a position.
struct RequestedDetail {
  double m_per_pixel = std::numeric_limits<double>::infinity();  // infinite where it is not shown
  double distance_m = 0.0;                                       // the nearest of its block

  double cell_m(double cells_per_pixel) const {
    return std::min(cells_per_pixel * m_per_pixel, unseen_share * distance_m);
  }
};

bool is_shown(const Camera& camera, glm::dvec3 point) {
  const auto at = camera.project(point);
  const glm::dvec2 size(camera.size());
  return at && at->x > -0.1 * size.x && at->x < 1.1 * size.x && at->y > -0.25 * size.y &&
         at->y < 1.25 * size.y;
}

Grid<RequestedDetail> ask(const Dem& whole, const View& view) {
  const std::unique_ptr<Camera> camera = make_camera(view.camera);
  const Deformation deformation(view.deform, view.viewer_xy);
  const double reach_m =
      0.71 * stride * whole.cell_m();  // from the centre of a block to its corner
  Grid<RequestedDetail> requests((whole.width() - 1) / stride + 1,
                                 (whole.height() - 1) / stride + 1);
  parallel_rows(requests.height(), [&](int y) {
    for (int x = 0; x < requests.width(); ++x) {
      const glm::dvec2 position = whole.transform.to_crs(stride * x, stride * y);
      const double altitude = whole.altitude_m(stride * x, stride * y);
      const glm::dvec3 point = deformation.point({position, altitude});
      const glm::dvec3 line = point - view.camera.eye;
      const double distance = std::max(1.0, glm::length(line));
      const double across = std::max(0.0, exact::hypot(line.x, line.y) - reach_m);
      RequestedDetail& request = requests(x, y);
      request.distance_m = std::max(1.0, exact::hypot(across, line.z));
      if (distance > 4.0 * reach_m && !is_shown(*camera, point)) continue;
      const double step_m = std::clamp(0.01 * distance, 1.0, whole.cell_m());
      const double pixels = pixels_per_m(*camera, deformation, position, altitude, step_m);
      // Behind the viewer or at the picture's vanishing line there is no value; distance alone is
      // used there.
      if (pixels > 0.0) request.m_per_pixel = request.distance_m / distance / pixels;
    }
  });
  return requests;
}

// The windows for a given ratio of cell width to pixels.
GroundPlan plan_for(const Grid<RequestedDetail>& requests, const RasterFrame& frame, int coarsest,
                    double cells_per_pixel) {
  GroundPlan plan{coarsest, {}, cells_per_pixel};
  const GeoTransform& t = frame.transform;
  const double cell_m = 0.5 * (t.cell_x + t.cell_y);
  PixelRect before = {0, 0, level_cells(frame.width, coarsest),
                      level_cells(frame.height, coarsest)};
  for (int level = coarsest - 1; level >= 0; --level) {
    const double too_coarse_m = std::ldexp(cell_m, level + 1);
    constexpr int far = std::numeric_limits<int>::max();
    PixelRect box{far, far, -1, -1};
    double to_m = 0.0;
    for (int y = 0; y < requests.height(); ++y)
      for (int x = 0; x < requests.width(); ++x) {
        if (!(requests(x, y).cell_m(cells_per_pixel) < too_coarse_m)) continue;
        box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
               std::max(box.y1, y + 1)};
        to_m = std::max(to_m, requests(x, y).distance_m);
      }
    if (box.empty()) break;
    // Blocks to cells of this level, and on to the next even ones; inside the previous window.
    const int factor = stride << (coarsest - level);
    const PixelRect wanted = {box.x0 * factor - factor, box.y0 * factor - factor,
                              box.x1 * factor + 1, box.y1 * factor + 1};
    const PixelRect room =
        grown({2 * before.x0, 2 * before.y0, 2 * before.x1 - 1, 2 * before.y1 - 1}, -window_margin);
    PixelRect part = intersection(wanted, room);
    part = {part.x0 + (part.x0 & 1), part.y0 + (part.y0 & 1), part.x1 - (~part.x1 & 1),
            part.y1 - (~part.y1 & 1)};
    if (std::min(part.width(), part.height()) < smallest_window) break;
    plan.windows.push_back({level, part, to_m});
    before = part;
  }
  return plan;
}

double cells_of(const GroundPlan& plan, const RasterFrame& frame) {
  double cells = static_cast<double>(level_cells(frame.width, plan.coarsest)) *
                 level_cells(frame.height, plan.coarsest);
  for (const GroundWindow& window : plan.windows) {
    const PixelRect all = {0, 0, level_cells(frame.width, window.level),
                           level_cells(frame.height, window.level)};
    const PixelRect made = intersection(grown(window.part, ground_halo_cells), all);
    cells += static_cast<double>(made.width()) * made.height();
  }
  return cells;
}

}  // namespace

GroundPlan plan_ground(const RasterFrame& frame, const Dem& whole, const View& view,
                       double max_cells) {
  const Grid<RequestedDetail> requests = ask(whole, view);
  GroundPlan plan;
  for (double cells_per_pixel = finest_px;; cells_per_pixel *= coarser_step) {
    plan = plan_for(requests, frame, whole.halved, cells_per_pixel);
    constexpr double coarsest_px = 1e6;  // then even the ground in front of the viewer is too much
    if (plan.windows.empty() || cells_of(plan, frame) <= max_cells) return plan;
    if (cells_per_pixel > coarsest_px) return {whole.halved, {}, cells_per_pixel};
  }
}

std::string describe(const GroundPlan& plan, const RasterFrame& frame) {
  const double cell_m = 0.5 * (frame.transform.cell_x + frame.transform.cell_y);
  std::string text = fmt::format("elevation of {} × {} cells is more than memory holds: read at",
                                 frame.width, frame.height);
  for (auto window = plan.windows.rbegin(); window != plan.windows.rend(); ++window)
    text += fmt::format(" {:g} m to {:.0f} km,", std::ldexp(cell_m, window->level),
                        window->to_m / 1000.0);
  text += fmt::format(" {:g} m beyond", std::ldexp(cell_m, plan.coarsest));
  if (!plan.windows.empty())
    text += fmt::format(" (cells up to {:.2g} pixels wide)", plan.cells_per_pixel);
  return text;
}

}  // namespace belvedere
