#pragma once

#include <cmath>
#include <vector>

#include "base/random.h"
#include "terrain/register/view_model.h"

// A painting of synthetic places by a known view.
namespace belvedere::test {

constexpr glm::dvec2 synthetic_size(1200.0, 550.0);

// Places 30 km square, spread evenly, 600 to 2600 m high.
inline std::vector<ControlPair> synthetic_places(std::size_t count, std::uint64_t seed = 1) {
  std::vector<ControlPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<std::int64_t>(i);
    const ControlPair pair{.position = {670000.0 + 30000.0 * random_uniform(seed, n, 0),
                                        5240000.0 + 30000.0 * random_uniform(seed, n, 1)},
                           .altitude_m = 600.0 + 2000.0 * random_uniform(seed, n, 2)};
    pairs.push_back(pair);
  }
  return pairs;
}

// An eye 24 km in the south of the places' middle looks north; all priors hold exactly.
struct SyntheticView {
  ViewFrame frame;
  ViewUnknowns view = {};
};
inline SyntheticView synthetic_view(ViewKind kind, const std::vector<ControlPair>& places) {
  SyntheticView out{view_frame(kind, synthetic_size, false, places), {}};
  out.view[view_unknown::north] = -0.8;
  out.view[view_unknown::azimuth] = 0.05;
  out.view[view_unknown::log_focal] = std::log(kind == ViewKind::plane ? 950.0 : 850.0);
  out.view[view_unknown::exaggeration] = 1.5;
  out.view[view_unknown::drop] = 0.42;
  if (kind != ViewKind::cylinder)
    out.view[view_unknown::pitch] = -0.25;
  else
    out.view[view_unknown::drop + 1] = -0.1;
  return out;
}

inline glm::dvec2 pixel_of(const SyntheticView& synthetic, const ControlPair& place,
                           const Displacement& displaced = {}) {
  const ViewPixel at =
      project_in_view(synthetic.frame, synthetic.view, place.position, place.altitude_m, displaced);
  return {at.u.value, at.v.value};
}

inline void paint(const SyntheticView& synthetic, std::vector<ControlPair>& places) {
  for (ControlPair& place : places) place.pixel = pixel_of(synthetic, place);
}

}  // namespace belvedere::test
