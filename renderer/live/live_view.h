#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/run.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/resolve_view.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_values.h"
#include "renderer/world/view.h"

namespace belvedere {

struct NamedSheet;

// A live picture is made several times, each better and slower than the one before: a ladder, from
// what follows the hand to exactly what `render` makes at that size.
struct Rung {
  std::string name;
  std::vector<std::string> without;  // what the finished picture has and this one lacks, in words
  int max_width_px = 1000;           // of the picture, 64…4096
  bool strokes = true;  // rock relief, brushwork, mist, features and style; else light and colour
  bool names = true;    // LivePicture::sheet
  std::optional<PixelRect> part = {};  // of the picture, px; absent: all of it
  // Draws the scene as it is; all others are on a level of the ground of about a million cells
  // (LivePicture::shortest_m says what that lacks), with one ray a pixel and few for the light of
  // the sky, and copy nothing from paintings.
  bool is_last() const { return without.empty(); }
};
const std::vector<Rung>& rungs();
// What a rung's picture of this scene lacks: `without`, and those of mist and features that the
// scene has and the rung does not draw.
std::vector<std::string> lacks_of(const LoadedScene& loaded, const Rung& rung);

// The scene as a rung draws it.
LoadedScene scene_of_rung(const LoadedScene& loaded, const Rung& rung);

struct LivePicture {
  Grid<glm::vec3> colour;  // encoded sRGB
  // The ground seen in each pixel: depth_m, position_m, altitude_m, land_cover.
  GuidanceBuffers seen;
  View view;
  std::string crs;  // of the ground, WKT2
  // Where the ground is a level of the data's: how often these were halved, and the landforms that
  // it cannot show, m; else 0.
  int halved = 0;
  double shortest_m = 0.0;
  // Names, tracks and margin at the print's size, on the ground of this picture; none in the first
  // rung, and where the scene has none.
  std::shared_ptr<const NamedSheet> sheet;
};

// Makes pictures of a scene that changes, one after the other. Values of the world stay in memory,
// and only what a change touches is made again; pictures are the same as without.
// Not thread-safe.
class LiveView {
 public:
  // A finished rectangle of the picture.
  using UseTile = std::function<void(PixelRect rect, const Grid<glm::vec3>& colour)>;

  // `run.progress` is asked between tiles whether to go on. With `use_tile` the picture is made in
  // tiles, from its middle outwards, and each is passed on at once.
  LivePicture paint(const LoadedScene& loaded, const Rung& rung, const Run& run,
                    const UseTile& use_tile = {});
  // The ground of the quickest rung, for maps; made if it is missing.
  struct Ground {
    std::shared_ptr<const Dem> dem;
    std::shared_ptr<const LandCover> land_cover;
    std::shared_ptr<const Grid<float>> generalized_m;
    View view;
  };
  Ground ground(const LoadedScene& loaded, const Run& run);

 private:
  GroundSize size_of(const LoadedScene& loaded);
  ValueStore* kept_for(const Rung& rung, const GroundSize& ground);

  ValueStore coarse_;
  ValueStore fine_;   // of the last rung, if its ground is small
  ValueStore paint_;  // of all rungs, with the size of the ground
};

}  // namespace belvedere
