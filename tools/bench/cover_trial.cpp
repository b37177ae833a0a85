#include "tools/bench/cover_trial.h"

#include <array>

#include "base/land_cover_class.h"
#include "renderer/exemplar/classes_by_paint.h"
#include "renderer/image/guidance_io.h"
#include "renderer/register/registered_ground.h"
#include "renderer/register/registered_guidance.h"

namespace belvedere::bench {
namespace {

ClassAgreement agreement(const Grid<std::uint8_t>& classes, const GuidanceBuffers& truth) {
  constexpr double min_share = 0.005;
  std::array<double, 256> both{}, drawn{}, found{};
  double ground = 0.0, right = 0.0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (truth.is_sky(i)) continue;
    const auto id = static_cast<std::uint8_t>(truth.land_cover[i]);
    ++ground;
    ++drawn[id];
    ++found[classes[i]];
    if (classes[i] != id) continue;
    ++both[id];
    ++right;
  }
  ClassAgreement out{0.0, right / ground};
  double counted = 0.0;
  for (std::size_t id = 0; id < drawn.size(); ++id) {
    if (drawn[id] < min_share * ground) continue;
    out.iou += both[id] / (drawn[id] + found[id] - both[id]);
    ++counted;
  }
  out.iou /= counted;
  return out;
}

}  // namespace

CoverTrial try_cover(const Registration& registration, const Grid<glm::vec3>& painting,
                     const std::shared_ptr<const Dem>& dem, const std::string& truth_file) {
  const GuidanceBuffers truth = read_guidance(truth_file);
  const glm::ivec2 size(painting.width(), painting.height());
  LoadedScene loaded;
  loaded.scene = registered_scene(registration, size);
  loaded.scene.deform.allow_folds = true;
  const RegisteredView view(registration, loaded.scene, *dem, size, silent_progress());
  const Grid<float> sigma_px = trace_registered(view).sigma_px;
  GuidanceBuffers guidance = trace_registered_guidance(loaded, dem, size, {});
  CoverTrial out;
  out.rules = agreement(places_of(guidance).labels, truth);
  out.painted = agreement(classes_by_paint(painting, places_of(guidance)), truth);
  const RegisteredCover cover =
      find_registered_cover(painting, sigma_px, guidance, loaded, *dem, silent_progress());
  out.lines = cover.lines;
  cover_scene(cover, loaded.scene);
  renew_land_cover(loaded, *dem, guidance, silent_progress());
  out.own_rules = agreement(places_of(guidance).labels, truth);
  out.own = agreement(classes_by_paint(painting, places_of(guidance)), truth);
  return out;
}

}  // namespace belvedere::bench
