#include "renderer/rock/rock_view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/random.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

constexpr float band_cell_units = 90.0F;    // of the invisible partition by which sizes change
constexpr float band_depth_ratio = 1.105F;  // max depth ratio within a cell
constexpr float warp_units = 0.56F;
constexpr float warp_cell_units = 6.4F;
constexpr float small_warp = 0.45F;

BandPartition part_bands(const SpurGround& ground, PixelRect rect) {
  const auto ppu = static_cast<float>(ground.pixels_per_unit);
  const auto cell_at = [&](int px) {
    return static_cast<int>(std::floor(static_cast<float>(px) / ppu / band_cell_units));
  };
  BandPartition bands;
  bands.first = {cell_at(rect.x0) - 1, cell_at(rect.y0) - 1};
  bands.count = glm::ivec2(cell_at(rect.x1) + 2, cell_at(rect.y1) + 2) - bands.first;
  const std::uint64_t key = stream_seed(ground.seed, Stream::rock_bands);
  for (int y = bands.first.y; y < bands.first.y + bands.count.y; ++y)
    for (int x = bands.first.x; x < bands.first.x + bands.count.x; ++x) {
      BandCell cell;
      cell.position.x = (static_cast<float>(x) + static_cast<float>(random_uniform(key, x, y, 0))) *
                        band_cell_units;
      cell.position.y = (static_cast<float>(y) + static_cast<float>(random_uniform(key, x, y, 1))) *
                        band_cell_units;
      const int px = static_cast<int>(std::floor(cell.position.x * ppu));
      const int py = static_cast<int>(std::floor(cell.position.y * ppu));
      if (ground.wide.holds(px, py)) {
        const std::size_t i = ground.wide.index(px, py);
        if (!ground.wide.seen.is_sky(i)) {
          cell.depth_m = ground.wide.seen.depth_m[i];
          cell.band = spur_band(ground.wide.seen.footprint_m[i] /
                                static_cast<float>(ground.wide.factor) * ppu * units_per_mm);
        }
      }
      bands.cells.push_back(cell);
    }
  return bands;
}

// Null where the pixels are not thinned.
std::shared_ptr<const GuidanceBuffers> thinned(const WideView& wide, int times) {
  return times == 1 ? nullptr : std::make_shared<const GuidanceBuffers>(thin_out(wide, times));
}

}  // namespace

FarView::FarView(const WideView& wide, double pixels_per_unit, PixelRect read)
    : FarView(thinned(wide, thinned_times(pixels_per_unit, wide.factor)), wide, pixels_per_unit,
              read) {}

FarView::FarView(std::shared_ptr<const GuidanceBuffers> thin, const WideView& wide,
                 double pixels_per_unit, PixelRect read)
    : thin_(std::move(thin)), wide_([&]() -> WideView {
        if (!thin_) return wide;
        const int times = thinned_times(pixels_per_unit, wide.factor);
        return {*thin_, wide.factor * times, thinned_origin(wide, times)};
      }()) {
  if (wide_.smooth_fall != nullptr) return;
  const PixelRect asked = intersection(
      whole(), moved(wide_rect(read, wide_.factor), -wide_.origin_px.x, -wide_.origin_px.y));
  smoothed_ =
      std::make_shared<const Grid<glm::vec2>>(smooth_fall_lines(wide_, pixels_per_unit, asked));
  wide_.smooth_fall = smoothed_.get();
}

int rock_factor(double pixels_per_unit) {
  return std::max(1, static_cast<int>(std::floor(pixels_per_unit)));
}

int thinned_times(double pixels_per_unit, int factor) {
  return std::max(1, static_cast<int>(std::floor(pixels_per_unit / factor)));
}

int BandPartition::at(glm::vec2 position, float depth_m, float metres_per_mm) const {
  const int cx = static_cast<int>(std::floor(position.x / band_cell_units)) - first.x;
  const int cy = static_cast<int>(std::floor(position.y / band_cell_units)) - first.y;
  float nearest = 1e18F;
  int band = -1;
  for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, count.y - 1); ++y)
    for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, count.x - 1); ++x) {
      const BandCell& cell = cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(count.x) +
                                   static_cast<std::size_t>(x)];
      if (cell.depth_m > depth_m * band_depth_ratio || cell.depth_m * band_depth_ratio < depth_m)
        continue;
      const glm::vec2 offset = position - cell.position;
      const float distance = glm::dot(offset, offset);
      if (distance >= nearest) continue;
      nearest = distance;
      band = cell.band;
    }
  return band < 0 ? spur_band(metres_per_mm) : band;
}

glm::vec2 Warp::operator()(glm::vec2 position, float scale) const {
  const glm::vec2 q = position / warp_cell_units;
  const glm::vec2 broad(broken_noise(seeds[0], q.x, q.y), broken_noise(seeds[1], q.x, q.y));
  if (scale < 0.7F) return position + warp_units * broad;
  const glm::vec2 fine(broken_noise(seeds[2], 2.9F * q.x, 2.3F * q.y),
                       broken_noise(seeds[3], 2.9F * q.x, 2.3F * q.y));
  return position + warp_units * (broad + small_warp * fine);
}

Warp::Warp(std::uint64_t seed) {
  for (std::uint64_t k = 0; k < 4; ++k) seeds[k] = stream_seed(seed, Stream::rock_warp, k);
}

RockView view_rock(const GuidanceBuffers& guidance, const WideView& wide,
                   const RockParameters& parameters, glm::ivec2 origin_px, PixelRect made) {
  const double ppu = parameters.light.pixels_per_unit;
  const PixelRect sheet_rect = moved(made, origin_px.x, origin_px.y);
  const int margin_px = static_cast<int>(std::ceil(spur_margin_units(*parameters.kind) * ppu));
  RockView view{FarView(wide, ppu, grown(sheet_rect, margin_px)),
                {},
                {},
                Warp(parameters.light.seed),
                static_cast<float>(ppu)};
  const SpurGround ground{view.far.wide(), view.far.fall(), ppu, parameters.light.seed};
  view.bands = part_bands(ground, sheet_rect);
  std::array<bool, spur_bands> bands{};
  for (const BandCell& cell : view.bands.cells) bands[static_cast<std::size_t>(cell.band)] = true;
  const PixelRect held = intersection(made, {0, 0, guidance.width(), guidance.height()});
  std::vector<std::array<bool, spur_bands>> row_bands(
      static_cast<std::size_t>(std::max(held.height(), 0)));
  parallel_ranges(std::max(held.height(), 0), 32, [&](int begin, int end) {
    for (int row = begin; row != end; ++row)
      for (int x = held.x0; x < held.x1; ++x) {
        const std::size_t i = guidance.depth_m.index(x, held.y0 + row);
        if (guidance.is_sky(i)) continue;
        const int band =
            spur_band(guidance.footprint_m[i] * static_cast<float>(ppu) * units_per_mm);
        row_bands[static_cast<std::size_t>(row)][static_cast<std::size_t>(band)] = true;
      }
  });
  for (const std::array<bool, spur_bands>& row : row_bands)
    for (std::size_t band = 0; band < bands.size(); ++band) bands[band] = bands[band] || row[band];
  view.field = grow_spurs(ground, *parameters.kind, sheet_rect, bands);
  return view;
}

int rock_view_margin_px(const RockParameters& parameters) {
  const double ppu = parameters.light.pixels_per_unit;
  const int factor = rock_factor(ppu);
  const int spurs = static_cast<int>(std::ceil(spur_margin_units(*parameters.kind) * ppu));
  const int bands =
      static_cast<int>(std::ceil(2.0 * static_cast<double>(band_cell_units) * ppu)) + factor;
  return std::max(spurs + factor * (smooth_fall_reach(ppu, factor) + 3), bands) + 2;
}

}  // namespace belvedere
