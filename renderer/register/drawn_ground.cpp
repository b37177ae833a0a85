#include "renderer/register/drawn_ground.h"

#include <utility>

#include "base/filter.h"
#include "terrain/generalize/moved_ground.h"
#include "terrain/generalize/widen_valleys.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

glm::dvec2 DrawnGround::drawn_position(glm::dvec2 position) const {
  if (goes_to.empty()) return position;
  const glm::dvec2 cell = drawn_cell(goes_to, dem.transform.to_cell(position.x, position.y));
  return dem.transform.to_crs(cell.x, cell.y);
}

glm::dvec2 DrawnGround::map_position(glm::dvec2 drawn) const {
  if (goes_to.empty()) return drawn;
  const glm::dvec2 cell = origin_cell(goes_to, dem.transform.to_cell(drawn.x, drawn.y));
  return dem.transform.to_crs(cell.x, cell.y);
}

ControlPair DrawnGround::drawn(ControlPair pair) const {
  if (goes_to.empty()) return pair;
  pair.position = drawn_position(pair.position);
  const glm::dvec2 cell = dem.transform.to_cell(pair.position.x, pair.position.y);
  pair.altitude_m = static_cast<double>(sample_bilinear(dem.altitude_m, cell.x, cell.y));
  return pair;
}

std::vector<ControlPair> DrawnGround::drawn(std::span<const ControlPair> pairs) const {
  std::vector<ControlPair> out;
  for (const ControlPair& pair : pairs) out.push_back(drawn(pair));
  return out;
}

DrawnGround draw_ground(const Dem& dem, double valleys_m, Progress& progress) {
  DrawnGround out{.valleys_m = valleys_m, .dem = dem};
  if (valleys_m <= 0.0) return out;
  WidenedValleys wide =
      widen_valleys(dem.altitude_m, find_lakes(dem.altitude_m, {}), {}, dem.cell_m(),
                    {.width_m = static_cast<float>(valleys_m)}, progress);
  out.dem.altitude_m = std::move(wide.altitude_m);
  out.goes_to = std::move(wide.goes_to);
  return out;
}

}  // namespace belvedere
