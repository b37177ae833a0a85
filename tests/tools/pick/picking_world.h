#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/register/pair_proposals.h"
#include "terrain/io/crs.h"
#include "terrain/io/dem.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

// A region of cones, and a painting of it by a known view, in which their summits are picked.
namespace belvedere::test {

constexpr glm::ivec2 picked_px(1200, 550);

// 36 km square, 200 m to a cell; cones 300 to 1000 m high on ground that rises to the north, two to
// four km apart, so that the summit of each is one of the DEM.
inline Dem cones() {
  return make_dem({grid_of(180, 180,
                           [](int x, int y) {
                             double height = 0.0;
                             for (int k = 0; k < 64; ++k) {
                               const int column = 20 + 20 * (k % 8), row = 20 + 20 * (k / 8);
                               const double off = std::hypot(x - column - k % 5, y - row - k % 3);
                               height = std::max(height, 300.0 + 100.0 * (k % 8) - 120.0 * off);
                             }
                             return 1000.0 - 2.0 * y + height;
                           }),
                   {666000.0, 5274000.0, 200.0, 200.0},
                   normalize_crs("EPSG:32632")});
}

struct PaintedCones {
  Dem dem = cones();
  std::vector<ControlPair> pairs;  // all that lie in the painting, with lonlat and name
};
inline const PaintedCones& painted_cones() {
  static const PaintedCones world = [] {
    PaintedCones out;
    std::vector<ControlPair> all;
    for (const KnownPlace& place : known_places(out.dem, {})) {
      const ControlPair pair{.position = place.position,
                             .lonlat = transform_point(out.dem.crs, "EPSG:4326", place.position),
                             .altitude_m = place.altitude_m};
      all.push_back(pair);
    }
    const SyntheticView truth = synthetic_view(ViewKind::cylinder, all);
    paint(truth, all);
    for (ControlPair& pair : all) {
      if (!(pair.pixel.x > 0.0 && pair.pixel.y > 0.0 && pair.pixel.x < picked_px.x &&
            pair.pixel.y < picked_px.y))
        continue;
      pair.name = "cone " + std::to_string(out.pairs.size());
      out.pairs.push_back(pair);
    }
    return out;
  }();
  return world;
}

}  // namespace belvedere::test
