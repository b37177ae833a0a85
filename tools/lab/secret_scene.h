#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "renderer/trace/camera.h"
#include "renderer/trace/geo_map.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/register/control_pairs.h"

namespace belvedere::bench {

// Draws from one stream, in their order.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high);
  double normal(double deviation);
  double sign() { return between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0; }
  std::size_t below(std::size_t count);

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

// A part of the world that secret scenes are made in.
struct SecretRegion {
  std::string name;
  std::string file;  // in the data folder
  double cell_m = 0.0;
  double side_m = 0.0;  // of the part about the middle that a view shows
};
const std::vector<SecretRegion>& secret_regions();
Dem read_secret_region(const SecretRegion& region, const std::string& data_folder);

// A view of a region as a painter might have made it, which a registration must find: a plane, a
// cylinder or a panini; a bend, exaggeration that changes with distance, mountains that are moved,
// turned and raised, summits that are raised more, and in half of the scenes wider valleys.
struct SecretScene {
  const Dem* dem = nullptr;
  CameraParameters camera;
  DeformParameters deform;
  double widened_m = 0.0;
  Grid<float> drawn_m;      // the ground that is drawn: with wide valleys
  Grid<glm::vec2> goes_to;  // where the map's content moves with them
  std::unique_ptr<Deformation> deformation;
  std::unique_ptr<DeformedSurface> surface;
  std::unique_ptr<Camera> made_camera;
  std::unique_ptr<Tracer> tracer;
  std::unique_ptr<GeoMap> map;
  double moved_share = 0.0;  // of the seen ground: within 0.8 radius of a handle

  bool on_moved_ground(glm::dvec2 position) const;
};
SecretScene make_secret_scene(const Dem& dem, const SecretRegion& region, std::uint64_t seed);

// The same as a scene file, whose data are in the region's folder. Its wider valleys differ a
// little, as a scene's keep lakes.
std::string secret_scene_text(const SecretScene& scene, const SecretRegion& region);

// Pixels on the ground and the place that each shows.
struct SeenPixel {
  glm::dvec2 pixel{0.0};
  glm::dvec2 position{0.0};
  double altitude_m = 0.0;
};
std::vector<SeenPixel> seen_pixels(const SecretScene& scene, std::size_t count, std::uint64_t seed);

struct SecretPairsParameters {
  std::size_t count = 40;
  double sigma_px = 3.0;
  double wrong_share = 0.1;  // 30 to 220 px off across, half of that in height
};
struct SecretPairs {
  std::vector<ControlPair> pairs;
  std::vector<bool> wrong;
};
// As read_control_pairs takes them; the names of wrong ones say so.
std::string secret_pairs_text(const SecretScene& scene, const SecretPairs& pairs);
// Seen summits, passes and hollows, spread over the picture.
SecretPairs make_secret_pairs(const SecretScene& scene, const SecretPairsParameters& parameters,
                              std::uint64_t seed);

}  // namespace belvedere::bench
