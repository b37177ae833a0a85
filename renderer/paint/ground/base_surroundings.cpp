#include "renderer/paint/ground/base_surroundings.h"

#include <algorithm>
#include <cmath>

#include "base/grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

constexpr double range_sigma_units = 14.0;      // width of mist behind an edge
constexpr double krummholz_sigma_units = 12.0;  // width of the belt of dwarf pine at the treeline
constexpr double tongue_sigma_units =
    20.0;  // distance to ice-free ground at which ice is fully blue and bare
constexpr double brook_sigma_units = 1.8;  // water that this blur leaves pale is a brook

using Class = LandCoverClass;

// 1 where the class is `id`, else 0.
Grid<float> class_mask(const GuidanceBuffers& g, Class id) {
  Grid<float> mask(g.width(), g.height(), 0.0F);
  parallel_ranges(mask.size(), std::size_t{65536}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) mask[i] = g.land_cover[i] == id ? 1.0F : 0.0F;
  });
  return mask;
}

// Whether any pixel is water: most windows have none and skip what water needs.
bool has_water(const GuidanceBuffers& g) {
  return std::find(g.land_cover.begin(), g.land_cover.end(), Class::water) != g.land_cover.end();
}

bool has_ice(const GuidanceBuffers& g) {
  return std::find(g.land_cover.begin(), g.land_cover.end(), Class::glacier) != g.land_cover.end();
}

Grid<float> bare_around(const WideView& wide, double wide_ppu, PixelRect window) {
  Grid<float> bare(wide.seen.width(), wide.seen.height(), 0.0F);
  for (std::size_t i = 0; i < bare.size(); ++i) {
    const Class id = wide.seen.land_cover[i];
    bare[i] = id == Class::sky || has_trait(id, ClassTrait::icy) ? 0.0F : 1.0F;
  }
  const PixelRect asked =
      moved(wide_rect(window, wide.factor), -wide.origin_px.x, -wide.origin_px.y);
  return blur_on_surface(bare, wide.seen.depth_m, tongue_sigma_units * wide_ppu,
                         intersection({0, 0, bare.width(), bare.height()}, surface_look(asked)));
}

}  // namespace

BaseSurroundings look_around(const GuidanceBuffers& g, const WideView& wide, const Palette& palette,
                             const BaseParameters& p, const SkyParameters& sky,
                             glm::ivec2 origin_px, PixelRect wanted) {
  const double ppu = p.pixels_per_unit;
  const double wide_ppu = ppu / wide.factor;
  const double range_sigma_px = range_sigma_units * wide_ppu;
  const PixelRect window{origin_px.x, origin_px.y, origin_px.x + g.width(),
                         origin_px.y + g.height()};
  const Grid<float> wide_logs = log_depths(wide.seen, blur_reach_px(range_sigma_px));
  BaseSurroundings around;
  around.log_depth = log_depths(g, 0);  // sky values are not read here
  around.mean_log_depth =
      enlarge(wide, blur_in_picture(wide_logs, range_sigma_px, wide.origin_px), window);
  around.wood = enlarge(wide,
                        blur_in_picture(class_mask(wide.seen, Class::forest),
                                        krummholz_sigma_units * wide_ppu, wide.origin_px),
                        window);
  if (has_ice(g)) around.bare = bare_around(wide, wide_ppu, window);
  around.cover = make_forest_cover(g, wide, {ppu, p.seed}, origin_px, wanted);
  around.fans = make_scree_fans(g, wide, {ppu, p.seed}, origin_px, wanted);
  if (has_water(g)) {
    around.water =
        blur_on_surface(class_mask(g, Class::water), g.depth_m, brook_sigma_units * ppu, wanted);
    around.mirrored = find_reflections(g, ppu, wanted);
    around.streaks = make_image_noise(stream_seed(p.seed, Stream::water_streaks), origin_px,
                                      g.width(), g.height(), ppu, 26.0, 1.6);
  } else {
    around.water = Grid<float>(g.width(), g.height(), 0.0F);
  }
  around.mist = hollow_mist_places(p.seed, origin_px, g.width(), g.height(), p.pixels_per_unit);
  around.sky = make_sky(part_of(g.depth_m, wanted), palette, sky,
                        origin_px + glm::ivec2(wanted.x0, wanted.y0));
  return around;
}

int base_margin_px(const BaseParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  const int factor = wide_factor(ppu);
  // Reach of the blur, of the sky's lookup down to the terrain, and of interpolation between the
  // centres of wide pixels.
  const int ranges = factor * (2 * blur_reach_px(range_sigma_units * ppu / factor) + 2);
  const int woods = factor * (blur_reach_px(krummholz_sigma_units * ppu / factor) + 2);
  const int ice =
      factor * (surface_reach_px(tongue_sigma_units * ppu / factor) + surface_look_rows + 3);
  const int waters = std::max(reflection_margin_px(ppu), surface_reach_px(brook_sigma_units * ppu));
  return std::max({ranges, woods, ice, waters, forest_cover_margin_px(ppu) + factor,
                   scree_fans_margin_px(ppu) + factor}) +
         3 * static_cast<int>(std::ceil(ppu)) + 2;
}

PixelRect base_window(PixelRect wanted, bool has_water, const BaseParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  PixelRect window = grown(
      wanted, surface_reach_px(brook_sigma_units * ppu) + 3 * static_cast<int>(std::ceil(ppu)) + 2);
  if (!has_water) return window;
  window.y0 = std::min(window.y0, wanted.y0 - reflection_margin_px(ppu));
  window.y1 = std::max(window.y1, wanted.y1 + reflection_margin_px(ppu));
  return window;
}

}  // namespace belvedere
