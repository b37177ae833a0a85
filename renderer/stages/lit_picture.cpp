#include "renderer/stages/lit_picture.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "renderer/image/srgb.h"
#include "renderer/stages/stages.h"
#include "renderer/trace/camera_reduced.h"

namespace belvedere {
namespace {

constexpr int measured_width_px = 480;
constexpr double no_air_m = 1e9;  // air that begins beyond everything

// Of encoded sRGB, linear: the Y of IEC 61966-2-1.
double luminance_of(const glm::vec3& encoded) {
  const auto linear = [](float value) { return srgb_decoded(static_cast<double>(value)); };
  return 0.2126 * linear(encoded.x) + 0.7152 * linear(encoded.y) + 0.0722 * linear(encoded.z);
}

// Panels of example sheets are small at any print size, so they read only their own pixels.
LitPicture make_at_once(GroundInputs inputs, PixelRect region) {
  inputs.wide_views = false;
  TileStore::Place memory{.folder = {}, .memory_bytes = std::numeric_limits<std::uint64_t>::max()};
  Progress& progress = inputs.run.progress;
  StageGraph graph(memory, progress);
  const GroundStages ground =
      add_ground_stages(graph, std::move(inputs), std::max({64, region.x1, region.y1}));
  const StageGraph::Request all[] = {{ground.guidance, region}};
  graph.keep_only(all);
  LitPicture picture;
  picture.guidance = ground.guidance->read(region);
  picture.base = ground.base->read(region);
  return picture;
}

}  // namespace

GroundInputs make_ground_inputs(const World& world, const SheetView& view, const Palette& palette,
                                const Run& run) {
  GroundInputs inputs = make_unlit_inputs(world, view, palette, run);
  if (world.scene.light.model == "product") inputs.base.mean_light = mean_light_of(world, palette);
  return inputs;
}

LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region,
                            const Run& run) {
  return make_lit_picture(world, view_of(world), palette, region, run);
}

LitPicture make_lit_picture(const World& world, const SheetView& view, const Palette& palette,
                            PixelRect region, const Run& run) {
  return make_at_once(make_ground_inputs(world, view, palette, run), region);
}

double mean_light_of(const World& world, const Palette& palette) {
  const int factor = std::max(1, world.camera->size().x / measured_width_px);
  const std::unique_ptr<const Camera> camera = make_reduced_camera(*world.camera, factor);
  GroundInputs inputs = make_unlit_inputs(world, reduced_view(world, *camera, factor), palette, {});
  inputs.base.mean_light = 1.0;
  inputs.base.air.from_m = no_air_m;
  inputs.base.air.rim_fade_m = 0.0;
  const glm::ivec2 size = camera->size();
  const LitPicture picture = make_at_once(std::move(inputs), {0, 0, size.x, size.y});
  const GuidanceBuffers& g = picture.guidance;
  double lit = 0.0;
  double own = 0.0;
  for (std::size_t i = 0; i < g.depth_m.size(); ++i) {
    if (g.is_sky(i) || g.land_cover[i] == LandCoverClass::water || g.shadow[i] <= 0.5F) continue;
    const double luminance = luminance_of(picture.base.colour[i]);
    lit += luminance;
    own += luminance / static_cast<double>(light_of_tone(g.tone[i]));
  }
  return own > 0.0 ? lit / own : static_cast<double>(light_of_tone(middle_tone));
}

}  // namespace belvedere
