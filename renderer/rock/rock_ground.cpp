#include "renderer/rock/rock_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Widths of the blurs, units.
constexpr double rock_sigma_units = 5.1;
constexpr double turf_sigma_units = 13.6;
constexpr double snow_sigma_units = 12.0;

constexpr float tongue = 0.75F;      // how far spurs and gullies shift the border
constexpr float bed_ledge = 0.50F;   // how far beds do
constexpr float keeps_rock = 0.42F;  // share of rock around below which rock is replaced …
constexpr float inside = 0.93F;      // … but not in the centre of a wall
constexpr float becomes_rock = 0.62F;
constexpr float bare_snow_deg = 50.0F;  // slope at which most crests are bare of snow
constexpr float bare_share = 0.56F;
constexpr float cone_share = 0.20F;  // share by which debris reaches up beneath a funnel

bool is_vegetation(Class id) { return is_turf(id) || id == Class::forest; }
bool is_snow(Class id) { return id == Class::snow || id == Class::glacier; }
bool gives_way(Class id) { return id == Class::scree || is_turf(id) || id == Class::snow; }

template <class Test>
Grid<float> share_around_of(const WideView& wide, double sigma_px, PixelRect wanted, Test&& test) {
  Grid<float> mask(wide.seen.width(), wide.seen.height(), 0.0F);
  std::vector<std::uint8_t> any(static_cast<std::size_t>(mask.height()), std::uint8_t{0});
  parallel_ranges(mask.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      for (int x = 0; x < mask.width(); ++x)
        if (test(wide.seen.land_cover(x, y))) {
          mask(x, y) = 1.0F;
          any[static_cast<std::size_t>(y)] = 1;
        }
  });
  return std::find(any.begin(), any.end(), std::uint8_t{1}) != any.end()
             ? blur_on_surface(mask, wide.seen.depth_m, sigma_px, wanted)
             : mask;
}

}  // namespace

RockAround look_around_rock(const WideView& wide, double pixels_per_unit, PixelRect wanted) {
  const double scale = pixels_per_unit / wide.factor;
  return {.rock = share_around_of(wide, rock_sigma_units * scale, wanted,
                                  [](Class id) { return id == Class::rock; }),
          .turf = share_around_of(wide, turf_sigma_units * scale, wanted, is_vegetation),
          .snow = share_around_of(wide, snow_sigma_units * scale, wanted, is_snow)};
}

int rock_around_reach(double pixels_per_unit, int factor) {
  return surface_reach_px(turf_sigma_units * pixels_per_unit / factor);
}

float standing_bed(double altitude_m, double east_m, double north_m, float metres_per_unit,
                   float noise) {
  constexpr float bed_units = 7.0F;
  const double wanted_m = std::max(0.5, static_cast<double>(bed_units * metres_per_unit));
  double thick_m = 1.0;
  while (thick_m * 1.4142 < wanted_m) thick_m *= 2.0;
  const auto phase =
      static_cast<float>((altitude_m + 0.26 * east_m - 0.11 * north_m) / thick_m) + 0.22F * noise;
  const float number = std::floor(phase);
  const float at = phase - number;
  const auto height = [](float bed) {
    const auto id = static_cast<std::uint64_t>(static_cast<std::int64_t>(bed));
    return 2.0F * static_cast<float>(mix_bits(id + 77U) >> 40U) / static_cast<float>(1U << 24U) -
           1.0F;
  };
  // A bed ends sharply at its top; below it weathers back.
  constexpr float back = 0.3F;
  const float own = height(number);
  return at < back ? own + (height(number - 1.0F) - own) * (1.0F - at / back) : own;
}

bool is_turf(Class id) {
  return id == Class::alpine_grass || id == Class::pasture || id == Class::shrub;
}

std::optional<float> clings_deg(LandCoverClass id, float close) {
  if (id == Class::snow) return 0.0F;
  if (close <= 0.0F) return std::nullopt;
  if (id == Class::glacier) return 2.0F;
  if (id == Class::scree) return 1.0F;
  if (is_turf(id)) return 3.0F;
  return std::nullopt;
}

LandCoverClass rock_border(const RockPosition& position) {
  const float r = position.rock;
  const float edge = 1.0F - 0.6F * std::abs(2.0F * r - 1.0F);
  const float under = smoothstep(0.05F, 0.4F, position.above);  // the foot of a wall
  const float cone = cone_share * position.cones * under * smoothstep(0.2F, 1.2F, -position.funnel);
  const float by_spurs =
      tongue * (1.0F - 0.65F * position.bedded) * std::clamp(1.4F * position.stands, -0.6F, 0.6F);
  const float m = r + (by_spurs + bed_ledge * position.bedded * position.bed) * edge - cone;
  if (position.mapped == Class::rock) {
    if (m > keeps_rock || (r > inside && cone <= 0.0F)) return Class::rock;
    if (position.snow > 0.30F && position.snow > position.turf) return Class::snow;
    return under < 0.35F ? Class::rock : Class::scree;
  }
  if (const std::optional<float> clings = clings_deg(position.mapped, position.close)) {
    // Near snow, stones and turf stay in the hollows of a wall and leave its ribs.
    const float slope_deg = position.slope_deg - *clings +
                            position.close * (3.0F * std::clamp(position.funnel, -1.5F, 1.5F) +
                                              4.5F * std::clamp(position.wall, -1.5F, 1.2F));
    const float from_deg = steep_snow_deg(position.close);
    float bare = smoothstep(from_deg, bare_snow_deg - 9.0F * position.close, slope_deg);
    // In turf no lone splinters.
    if (is_turf(position.mapped)) bare *= smoothstep(0.45F, 0.80F, bare);
    const float far_out = m + bare_share * bare;
    // The barer a wall, the broader its ribs.
    const float near_out = r + bare * (0.42F + 0.75F * position.rib) + 0.50F * position.stands +
                           0.15F * position.bedded * position.bed;
    if (far_out + position.close * (near_out - far_out) > becomes_rock) return Class::rock;
  }
  return gives_way(position.mapped) && m > becomes_rock ? Class::rock : position.mapped;
}

namespace {

// Lengths in units.
constexpr double max_up = 4.4;
constexpr double max_down = 3.0;
// A raised crest finds its own surface in a wide view, which has less than four pixels per unit.
static_assert(max_up * 4.0 <= surface_look_rows);
constexpr double stretched = 14.0;  // height of rock beneath an edge that is stretched to meet it …
constexpr double min_beneath = 10.0;  // … and where there is less than this the edge stays
constexpr float edge_ratio = 1.02F;   // of depths; from this on there is an edge
constexpr float same_ratio = 0.05F;
// Shares of the heights of the three sizes of spurs that shift an edge.
constexpr std::array<float, spur_sizes> share = {0.07F, 0.30F, 0.30F};
constexpr float smoothed_units = 0.6F;  // along the edge, so that it does not look like a comb
constexpr float around_units =
    3.2F;  // between the seven positions along it that it is compared with

int to_px(double units, double ppu) { return static_cast<int>(std::ceil(units * ppu)); }

bool is_edge(const GuidanceBuffers& g, int x, int y) {
  if (g.land_cover(x, y) != Class::rock || y == 0) return false;
  return g.depth_m(x, y - 1) > edge_ratio * g.depth_m(x, y);
}

// Rows beneath an edge that lie on its own surface, up to `max`.
int rows_beneath(const GuidanceBuffers& g, int x, int y, int max) {
  int run = 0;
  while (run < max && y + run < g.height() &&
         std::abs(g.depth_m(x, y + run) / g.depth_m(x, y) - 1.0F) < same_ratio)
    ++run;
  return run;
}

// Height of the spurs at a position of an edge, as far as they shape it, units.
float height_at(const RockView& view, const RockKind& kind, glm::vec2 position, int band,
                float depth_m) {
  const SpurHits hits = view.at(position, band, depth_m);
  float sum = 0.0F;
  for (int size = 0; size < spur_sizes; ++size) {
    const SpurHit& hit = hits[static_cast<std::size_t>(size)];
    if (hit.spur == nullptr) break;
    sum += share[static_cast<std::size_t>(size)] * spur_spacing(kind, size, band) *
           std::clamp(hit.height, -1.0F, 1.2F);
  }
  return sum;
}

// How far an edge rises (> 0) or sinks, units: the height of its spurs relative to those along it,
// so that the range keeps its height.
float rise_of(const RockView& view, const GuidanceBuffers& g, const RockKind& kind,
              glm::ivec2 origin_px, int x, int y) {
  const float depth_m = g.depth_m(x, y);
  const float ppu = view.pixels_per_unit;
  const glm::vec2 position((static_cast<float>(origin_px.x + x) + 0.5F) / ppu,
                           (static_cast<float>(origin_px.y + y) + 0.5F) / ppu);
  const int band = view.bands.at(position, depth_m, g.footprint_m(x, y) * ppu * units_per_mm);
  const auto mean = [&](float step_units, int steps) {
    float sum = 0.0F;
    for (int k = -steps; k <= steps; ++k)
      sum += height_at(view, kind, position + glm::vec2(step_units * static_cast<float>(k), 0.0F),
                       band, depth_m);
    return sum / static_cast<float>(2 * steps + 1);
  };
  const float rise = mean(smoothed_units, 1) - mean(around_units, 3);
  return std::clamp(rise, -static_cast<float>(max_down), static_cast<float>(max_up));
}

// One column of the window: the row that each row shows, and its `front`.
struct Column {
  std::vector<int> from;
  std::vector<float> front;
};

// Rows are counted from the edge, so that rounding does not depend on the window.
void shift_edge(Column& column, int edge, int beneath, float rise_px) {
  const int rows = static_cast<int>(column.from.size());
  const auto run = static_cast<float>(beneath);
  const auto take = [&](int below, int source, float front) {
    const int row = edge + below;
    if (row < 0 || row >= rows) return;
    column.from[static_cast<std::size_t>(row)] = std::clamp(edge + source, 0, rows - 1);
    column.front[static_cast<std::size_t>(row)] = front;
  };
  for (int below = std::min(static_cast<int>(std::floor(-rise_px)), 0); below < beneath; ++below) {
    const float under_top = static_cast<float>(below) + 0.5F + rise_px;
    const int source =
        static_cast<int>(std::floor(std::max(under_top, 0.0F) * run / (run + rise_px)));
    const float covered = unit(under_top + 0.5F);
    if (below >= 0 && under_top < 0.0F)
      take(below, -1 - below / 2, 1.0F);  // a notch: the farther surface shows
    else if (below >= 0 || covered >= 0.5F)
      take(below, source, covered);
  }
}

}  // namespace

CrestShift shift_crests(const GuidanceBuffers& guidance, const WideView& wide,
                        const RockParameters& parameters, glm::ivec2 origin_px, PixelRect wanted) {
  using B = GuidanceBuffers;
  require_channels(guidance, {&B::depth_m, &B::front, &B::land_cover, &B::footprint_m},
                   "crests of rock");
  const double ppu = parameters.light.pixels_per_unit;
  CrestShift shift{Grid<std::int16_t>(wanted.width(), wanted.height(), std::int16_t{0}),
                   Grid<float>(wanted.width(), wanted.height())};
  parallel_ranges(wanted.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      std::copy_n(guidance.front.row(wanted.y0 + y) + wanted.x0, wanted.width(),
                  shift.front.row(y));
  });
  // Edges that can move a wanted pixel.
  const int first = std::max(wanted.y0 - to_px(stretched, ppu), 0);
  const int last = std::min(wanted.y1 + to_px(max_up, ppu) + 1, guidance.height());
  const PixelRect edges = extent_of({wanted.x0, first, wanted.x1, last},
                                    [&](int x, int y) { return is_edge(guidance, x, y); });
  if (edges.empty()) return shift;
  const RockView view =
      view_rock(guidance, wide, parameters, origin_px,
                grown(edges, to_px(3.0 * static_cast<double>(around_units), ppu)));
  parallel_ranges(edges.width(), 16, [&](int begin, int end) {
    Column column{std::vector<int>(static_cast<std::size_t>(guidance.height())),
                  std::vector<float>(static_cast<std::size_t>(guidance.height()))};
    for (int x = edges.x0 + begin; x < edges.x0 + end; ++x) {
      for (int y = 0; y < guidance.height(); ++y) {
        column.from[static_cast<std::size_t>(y)] = y;
        column.front[static_cast<std::size_t>(y)] = guidance.front(x, y);
      }
      for (int y = edges.y0; y < edges.y1; ++y) {  // far to near
        if (!is_edge(guidance, x, y)) continue;
        const int beneath = rows_beneath(guidance, x, y, to_px(stretched, ppu));
        const auto units = static_cast<float>(beneath / ppu);
        if (units < static_cast<float>(min_beneath)) continue;
        const float taper = smoothstep(static_cast<float>(min_beneath),
                                       static_cast<float>(stretched) - 0.5F, units);
        const float rise =
            std::clamp(rise_of(view, guidance, *parameters.kind, origin_px, x, y) * taper,
                       -0.3F * units, 0.4F * units);
        shift_edge(column, y, beneath, rise * static_cast<float>(ppu));
      }
      for (int y = 0; y < wanted.height(); ++y) {
        const auto row = static_cast<std::size_t>(wanted.y0 + y);
        shift.rows(x - wanted.x0, y) =
            static_cast<std::int16_t>(column.from[row] - static_cast<int>(row));
        shift.front(x - wanted.x0, y) = column.front[row];
      }
    }
  });
  return shift;
}

int crest_view_margin_px(const RockParameters& parameters) {
  const double ppu = parameters.light.pixels_per_unit;
  return rock_view_margin_px(parameters) + crest_margin_px(ppu) +
         to_px(3.0 * static_cast<double>(around_units), ppu);
}

int crest_reach_px(double pixels_per_unit) {
  return to_px(stretched + max_up, pixels_per_unit) + 2;
}

int crest_margin_px(double pixels_per_unit) {
  return to_px(2.0 * stretched + max_up, pixels_per_unit) + 3;
}

GuidanceBuffers gather_rows(const GuidanceBuffers& guidance, const CrestShift& shift,
                            PixelRect wanted) {
  if (shift.rows.width() != wanted.width() || shift.rows.height() != wanted.height())
    throw Error(ErrorKind::bug, "crests of rock",
                "the shift and the guidance have different sizes");
  GuidanceBuffers shifted;
  shifted.origin_m = guidance.origin_m;
  std::vector<std::uint8_t> moved_rows(static_cast<std::size_t>(wanted.height()));
  parallel_ranges(wanted.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      moved_rows[static_cast<std::size_t>(y)] =
          std::any_of(shift.rows.row(y), shift.rows.row(y) + wanted.width(),
                      [](std::int16_t rows) { return rows != 0; })
              ? 1
              : 0;
  });
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          const auto& from = guidance.*member;
          if (from.empty()) return;
          auto& to = shifted.*member;
          to = std::decay_t<decltype(to)>(wanted.width(), wanted.height());
          parallel_ranges(wanted.height(), 32, [&](int begin, int end) {
            for (int y = begin; y != end; ++y) {
              const int own = std::clamp(wanted.y0 + y, 0, from.height() - 1);
              std::copy_n(from.row(own) + wanted.x0, wanted.width(), to.row(y));
              if (moved_rows[static_cast<std::size_t>(y)] == 0) continue;
              const std::int16_t* rows = shift.rows.row(y);
              for (int x = 0; x < wanted.width(); ++x)
                if (rows[x] != 0)
                  to(x, y) = from(wanted.x0 + x,
                                  std::clamp(wanted.y0 + y + rows[x], 0, from.height() - 1));
            }
          });
        },
        channel.member);
  if (!shifted.front.empty()) shifted.front = shift.front;
  return shifted;
}

}  // namespace belvedere
