#include "renderer/world/ground_windows.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/filter.h"
#include "base/grid.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/trace/camera.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"

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

namespace {

constexpr int collar_cells = 32;  // from a window's edge to where its own values apply
constexpr int apron_cells = 4;  // vertices kept around the part, which derivatives at its edge need

// Position of the grids of a ground on the cells of their level.
struct Lattice {
  int level = 0;
  PixelRect kept;
};

// Rivers of the whole that enter a window of a finer level: where the largest neighbour downstream
// of a cell outside lies inside.
std::vector<RiverEntry> find_entries(const TerrainModel& whole, const Dem& window,
                                     const PixelRect& cells, int halvings) {
  const Grid<float>& flow = whole.flow;  // logarithm of m²
  const int factor = 1 << halvings;
  const PixelRect inside = {(cells.x0 + factor - 1) / factor, (cells.y0 + factor - 1) / factor,
                            (cells.x1 - 1) / factor + 1, (cells.y1 - 1) / factor + 1};
  const double own_m2 = whole.dem->transform.cell_x * whole.dem->transform.cell_y;
  std::vector<RiverEntry> entries;
  const auto is_inside = [&](int x, int y) {
    return x >= inside.x0 && y >= inside.y0 && x < inside.x1 && y < inside.y1;
  };
  const auto look = [&](int x, int y) {  // at a cell outside, beside the window
    if (!flow.contains(x, y) || flow(x, y) < exact::log10(4.0 * own_m2)) return;
    glm::ivec2 next(x, y);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (flow.contains(x + i, y + j) && flow(x + i, y + j) > flow(next.x, next.y))
          next = {x + i, y + j};
    if (!is_inside(next.x, next.y)) return;
    // It runs where the ground around is lowest.
    const glm::ivec2 at = glm::ivec2(next * factor) - glm::ivec2(cells.x0, cells.y0);
    RiverEntry entry{std::clamp(at.x, 0, window.width() - 1),
                     std::clamp(at.y, 0, window.height() - 1), 1e-6 * exact::pow(10.0, flow(x, y))};
    const glm::ivec2 centre(entry.x, entry.y);
    for (int v = -factor / 2; v <= factor / 2; ++v)
      for (int u = -factor / 2; u <= factor / 2; ++u) {
        const glm::ivec2 other = centre + glm::ivec2(u, v);
        if (!window.altitude_m.contains(other.x, other.y)) continue;
        if (window.altitude_m(other.x, other.y) < window.altitude_m(entry.x, entry.y))
          entry.x = other.x, entry.y = other.y;
      }
    entries.push_back(entry);
  };
  for (int x = inside.x0 - 1; x <= inside.x1; ++x) look(x, inside.y0 - 1), look(x, inside.y1);
  for (int y = inside.y0; y < inside.y1; ++y) look(inside.x0 - 1, y), look(inside.x1, y);
  return entries;
}

// Position of a finer lattice in a grid of twice its cells: even positions coincide with its
// vertices, odd ones lie between them.
template <class T>
T between(const Grid<T>& coarse, int x, int y) {
  // Catmull and Rom's cubic half way: interpolates the vertices, with slopes by central
  // differences.
  constexpr std::array<float, 4> half = {-0.0625F, 0.5625F, 0.5625F, -0.0625F};
  const auto across = [&](int row) {
    if ((x & 1) == 0) return coarse.clamped(x / 2, row);
    T sum{};
    for (int k = 0; k < 4; ++k)
      sum += half[static_cast<std::size_t>(k)] * coarse.clamped(x / 2 - 1 + k, row);
    return sum;
  };
  if ((y & 1) == 0) return across(y / 2);
  T sum{};
  for (int k = 0; k < 4; ++k) sum += half[static_cast<std::size_t>(k)] * across(y / 2 - 1 + k);
  return sum;
}

// Blends the grids of a window into those of the coarser ground.
class Joint {
 public:
  Joint(const Lattice& fine, const PixelRect& part, const Lattice& coarse)
      : shift_{fine.kept.x0 - 2 * coarse.kept.x0, fine.kept.y0 - 2 * coarse.kept.y0},
        share_(fine.kept.width(), fine.kept.height()) {
    for (int y = 0; y < share_.height(); ++y)
      for (int x = 0; x < share_.width(); ++x) {
        const int from_edge =
            std::min(std::min(fine.kept.x0 + x - part.x0, part.x1 - 1 - fine.kept.x0 - x),
                     std::min(fine.kept.y0 + y - part.y0, part.y1 - 1 - fine.kept.y0 - y));
        share_(x, y) =
            static_cast<float>(smoothstep(static_cast<double>(from_edge) / collar_cells));
      }
  }
  // `scale`: units of the coarse grid in those of the fine.
  template <class T>
  void operator()(Grid<T>& fine, const Grid<T>& coarse, float scale = 1.F) const {
    if (coarse.empty() && fine.empty()) return;
    if (fine.empty()) fine = Grid<T>(share_.width(), share_.height(), T{});
    parallel_rows(fine.height(), [&](int y) {
      for (int x = 0; x < fine.width(); ++x) {
        const float share = share_(x, y);
        if (share >= 1.F) continue;
        const T there = coarse.empty() ? T{} : scale * between(coarse, shift_.x + x, shift_.y + y);
        fine(x, y) = share <= 0.F ? there : there + share * (fine(x, y) - there);
      }
    });
  }

 private:
  glm::ivec2 shift_;
  Grid<float> share_;  // of the fine ground
};

template <class T>
void cut(Grid<T>& grid, const PixelRect& rect) {
  if (!grid.empty()) grid = part_of(grid, rect);
}

// Cells of a raster on the cells of a DEM; one on its own cells is unchanged.
template <class T>
void cut(Raster<T>& raster, const Dem& dem, const PixelRect& rect) {
  if (!raster.cells.same_size(dem.altitude_m)) return;
  const glm::dvec2 first = raster.transform.to_crs(rect.x0 - 0.5, rect.y0 - 0.5);
  raster.transform.origin_x = first.x;
  raster.transform.origin_y = first.y;
  cut(raster.cells, rect);
}

void cut(GroundRelief& relief, const Dem& dem, const PixelRect& rect) {
  const glm::dvec2 first = dem.transform.to_crs(rect.x0 - 0.5, rect.y0 - 0.5);
  relief.transform = {first.x, first.y, dem.transform.cell_x, dem.transform.cell_y};
  cut(relief.lake_depth_m, rect);
  for (GroundRelief::Bumps& bumps : relief.bumps) cut(bumps.share, rect);
}

// The cells of a window with its halo.
PixelRect made_cells(const GroundWindow& window, const RasterFrame& data) {
  const RasterFrame frame = level_frame(data, window.level);
  return intersection(grown(window.part, ground_halo_cells), {0, 0, frame.width, frame.height});
}

// The cells of the coarser ground (`made`: available) that a window needs all around its halo.
PixelRect kept_for(const GroundWindow& window, const RasterFrame& data, const PixelRect& made) {
  constexpr int beyond = 3;  // cells: glaciers beside the window, and their sources
  const PixelRect halo = made_cells(window, data);
  const PixelRect wanted =
      grown({halo.x0 / 2, halo.y0 / 2, (halo.x1 + 1) / 2, (halo.y1 + 1) / 2}, beyond);
  return moved(intersection(wanted, made), -made.x0, -made.y0);
}

// A window's position in the nest.
struct Nested {
  const GroundWindow& planned;
  const GroundWindow* next;  // null: the finest
  const TerrainModel& coarser;
  const Lattice& coarser_at;
};

TerrainModel make_window(const TerrainModel& whole, const Nested& nested, const WholeTerrain& known,
                         const WindowMaking& making, std::optional<SeenGround>& seen, Lattice& at) {
  const auto& [planned, next, coarser, coarser_at] = nested;
  const PixelRect made = made_cells(planned, making.levels.frame());
  Progress& quiet = silent_progress();
  Dem dem = making.levels.window(planned.level, made, *whole.dem);
  WindowGround window_ground;
  window_ground.sea = prepare_window_dem(dem, making.loaded, known.dem, known.sea, making.cache);
  dem.entries = find_entries(whole, dem, made, whole.dem->halved - planned.level);
  const auto halo = std::make_shared<const Dem>(std::move(dem));
  window_ground.dem = halo;
  window_ground.catchments = std::make_shared<Catchments>(*halo);
  window_ground.part = moved(planned.part, -made.x0, -made.y0);
  if (next != nullptr) window_ground.kept = kept_for(*next, making.levels.frame(), made);
  window_ground.around = std::move(seen);
  window_ground.seen = &making.seen;
  auto [cover, seen_here] =
      make_window_cover(making.loaded, window_ground, known, quiet, making.cache);
  seen = std::move(seen_here);
  GeneralizedTerrain ground = generalize_for_view(making.loaded, *halo, &cover, making.view, quiet,
                                                  making.cache, {.sea = &window_ground.sea});
  TerrainModel model = make_terrain_model(halo, std::move(ground.altitude_m),
                                          std::make_shared<const LandCover>(cover),
                                          whole.exaggeration, window_ground.catchments.get());
  model.came_from = std::move(ground.came_from);
  model.goes_to = std::move(ground.goes_to);
  model.local = making.deformation;

  // Moved ground is looked up at its origin, at most the width of a valley away.
  const double moved_cells = making.loaded.scene.generalize.valleys.width_m / halo->cell_m();
  const int apron =
      std::min(ground_halo_cells, apron_cells + static_cast<int>(std::ceil(moved_cells)));
  at = {planned.level, intersection(intersection(grown(planned.part, apron), made),
                                    {2 * coarser_at.kept.x0, 2 * coarser_at.kept.y0,
                                     2 * coarser_at.kept.x1 - 1, 2 * coarser_at.kept.y1 - 1})};
  const PixelRect kept = moved(at.kept, -made.x0, -made.y0);
  Dem window;
  window.altitude_m = part_of(halo->altitude_m, kept);
  window.filled = part_of(halo->filled, kept);
  const glm::dvec2 first = halo->transform.to_crs(kept.x0 - 0.5, kept.y0 - 0.5);
  window.transform = {first.x, first.y, halo->transform.cell_x, halo->transform.cell_y};
  window.crs = halo->crs;
  window.halved = halo->halved;
  if (cover.classes.cells.same_size(halo->altitude_m)) cut(cover.below, kept);
  cut(cover.classes, *halo, kept);
  cut(cover.colours, *halo, kept);
  cut(cover.relief, *halo, kept);
  for (Grid<float>* grid :
       {&model.generalized_m, &model.detail_smooth_m, &model.shape_smooth_m, &model.relief_s_m,
        &model.relief_m_m, &model.relief_l_m, &model.valley_height_m, &model.rim_m, &model.flow,
        &model.floor_plan.built})
    cut(*grid, kept);
  cut(model.came_from, kept);
  cut(model.goes_to, kept);
  cut(model.floor_plan.grain, kept);
  // Where the terrain ends only the whole has data.
  const double factor = std::ldexp(1.0, whole.dem->halved - planned.level);
  parallel_rows(model.rim_m.height(), [&](int y) {
    for (int x = 0; x < model.rim_m.width(); ++x)
      model.rim_m(x, y) =
          sample_bilinear(whole.rim_m, (at.kept.x0 + x) / factor, (at.kept.y0 + y) / factor);
  });

  const Joint join(at, planned.part, coarser_at);
  join(window.altitude_m, coarser.dem->altitude_m);
  join(model.generalized_m, coarser.generalized_m);
  join(model.came_from, coarser.came_from, 2.F);
  join(model.goes_to, coarser.goes_to, 2.F);
  join(model.detail_smooth_m, coarser.detail_smooth_m);
  join(model.shape_smooth_m, coarser.shape_smooth_m);
  join(model.relief_s_m, coarser.relief_s_m);
  join(model.relief_m_m, coarser.relief_m_m);
  join(model.relief_l_m, coarser.relief_l_m);
  join(model.valley_height_m, coarser.valley_height_m);
  join(model.flow, coarser.flow);
  join(model.floor_plan.built, coarser.floor_plan.built);
  join(model.floor_plan.grain, coarser.floor_plan.grain);
  GroundRelief& relief = cover.relief;
  const GroundRelief& relief_around = coarser.land_cover->relief;
  join(relief.lake_depth_m, relief_around.lake_depth_m);
  for (std::size_t k = 0; k < relief.bumps.size() && k < relief_around.bumps.size(); ++k)
    join(relief.bumps[k].share, relief_around.bumps[k].share);
  model.land_cover = std::make_shared<const LandCover>(std::move(cover));
  model.dem = std::make_shared<const Dem>(std::move(window));
  return model;
}

}  // namespace

void add_ground_windows(TerrainModel& terrain, const GroundPlan& plan, const WindowMaking& making) {
  if (plan.windows.empty()) return;
  making.progress.begin("finer ground", static_cast<double>(plan.windows.size()));
  WholeTerrain known = know_whole(making.loaded, *terrain.dem, making.sea);
  known.map = terrain.land_cover->map;
  std::vector<TerrainWindow> windows;
  windows.reserve(plan.windows.size());
  Lattice before{plan.coarsest, {0, 0, terrain.dem->width(), terrain.dem->height()}};
  std::optional<SeenGround> seen =
      see_whole(making.loaded, known,
                kept_for(plan.windows.front(), making.levels.frame(), before.kept), making.cache);
  for (std::size_t i = 0; i < plan.windows.size(); ++i) {
    const GroundWindow& planned = plan.windows[i];
    const GroundWindow* next = i + 1 < plan.windows.size() ? &plan.windows[i + 1] : nullptr;
    Lattice at;
    TerrainWindow window;
    window.ground = make_window(
        terrain, {planned, next, windows.empty() ? terrain : windows.back().ground, before}, known,
        making, seen, at);
    window.part = moved(planned.part, -at.kept.x0, -at.kept.y0);
    window.replaces = moved({planned.part.x0 / 2, planned.part.y0 / 2, planned.part.x1 / 2 + 1,
                             planned.part.y1 / 2 + 1},
                            -before.kept.x0, -before.kept.y0);
    windows.push_back(std::move(window));
    before = at;
    making.progress.advance(1.0);
  }
  terrain.windows = std::move(windows);
}

DeformedSurface deform_ground(const TerrainModel& terrain, glm::dvec3 origin,
                              const Deformation& deformation) {
  DeformedSurface surface =
      deform(terrain.generalized_m, terrain.dem->transform, origin, deformation);
  surface.windows.reserve(terrain.windows.size());
  for (const TerrainWindow& window : terrain.windows) {
    const TerrainModel& ground = window.ground;
    SurfaceWindow made{deform(ground.generalized_m, ground.dem->transform, origin, deformation),
                       window.part, window.replaces};
    join_window(made, surface.windows.empty() ? surface : surface.windows.back().surface);
    surface.windows.push_back(std::move(made));
  }
  return surface;
}

}  // namespace belvedere
