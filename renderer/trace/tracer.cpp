#include "renderer/trace/tracer.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/instruction_set.h"

namespace belvedere {
namespace {

constexpr int bundle = 16;  // rays handed to Embree at once
constexpr float infinity = std::numeric_limits<float>::infinity();

// Embree needs denormal floats flushed (FTZ, bit 15) and read as zero (DAZ, bit 6) in every thread that traces.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040U); }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

// What one RTCGrid covers: its first post and how many cells it has.
struct GridTile {
  int x0, y0, cells_x, cells_y;
};

void check(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  const bool memory = error == RTC_ERROR_OUT_OF_MEMORY;
  const bool cpu = error == RTC_ERROR_UNSUPPORTED_CPU;
  throw Error(memory || cpu ? ErrorKind::limit : ErrorKind::bug, "ray tracing",
              fmt::format("{} failed (Embree error {}{})", what, static_cast<int>(error),
                          memory ? ", out of memory"
                          : cpu  ? ", this processor is not supported"
                                 : ""));
}

// The nearest hit so far among some cells.
struct CellHit {
  double distance = std::numeric_limits<double>::infinity();
  double u = 0.0;  // in the cell, 0…1
  double v = 0.0;
  int x = 0;  // the cell
  int y = 0;
  bool lower = false;   // its south-eastern triangle
  double volume = 1.0;  // the facet's normal, twice its area long, along the ray
};

}  // namespace

struct Tracer::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  const Grid<glm::vec3>* posts = nullptr;
  double side = 0.0;  // of a cell, about
  glm::dvec3 origin{0.0};
  std::vector<GridTile> tiles;    // those of geometry 0, then the last one, which is geometry 1
  std::vector<RTCGrid> grids;     // of geometry 0
  std::vector<float> last_posts;  // of geometry 1, with 4 readable bytes after the end
  RTCGrid last_grid{};
  std::atomic<std::ptrdiff_t> bytes{0};
  std::string description;

  ~State() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void attach(const float* vertices, std::size_t count, const RTCGrid* first, std::size_t grid_count);
  void build(int tile_cells);
  glm::dvec3 post(int x, int y) const { return glm::dvec3((*posts)(x, y)); }
  void intersect_facet(int x, int y, bool lower, const glm::dvec3& o, const glm::dvec3& d, CellHit& best) const;
  glm::dvec3 facet_area(const CellHit& hit) const;
  bool resolve(const Ray& ray, unsigned geometry, unsigned primitive, float u, float v, Hit& hit) const;
  void trace_on(const Ray& ray, float from, Hit& hit) const;
};

void Tracer::State::attach(const float* vertices, std::size_t count, const RTCGrid* first, std::size_t grid_count) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_GRID);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0, 3 * sizeof(float), count);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, first, 0, sizeof(RTCGrid), grid_count);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

void Tracer::State::build(int tile_cells) {
  const int width = posts->width();
  const int height = posts->height();
  for (int y = 0; y + 1 < height; y += tile_cells) {
    for (int x = 0; x + 1 < width; x += tile_cells) {
      tiles.push_back({x, y, std::min(tile_cells, width - 1 - x), std::min(tile_cells, height - 1 - y)});
    }
  }
  const auto grid = [](unsigned start, unsigned stride, const GridTile& tile) {
    return RTCGrid{start, stride, static_cast<std::uint16_t>(tile.cells_x + 1), static_cast<std::uint16_t>(tile.cells_y + 1)};
  };
  for (const GridTile& tile : tiles) {
    grids.push_back(grid(static_cast<unsigned>(posts->index(tile.x0, tile.y0)), static_cast<unsigned>(width), tile));
  }
  grids.pop_back();
  // Embree reads each post with 16 bytes, so the very last one needs 4 more than the surface owns. Only the last tile
  // reads it: that tile alone is copied, all others are traced where they lie.
  const GridTile& last = tiles.back();
  for (int y = last.y0; y <= last.y0 + last.cells_y; ++y) {
    for (int x = last.x0; x <= last.x0 + last.cells_x; ++x) {
      const glm::vec3& p = (*posts)(x, y);
      last_posts.insert(last_posts.end(), {p.x, p.y, p.z});
    }
  }
  const std::size_t last_count = last_posts.size() / 3;
  last_posts.push_back(0.F);
  last_grid = grid(0, static_cast<unsigned>(last.cells_x + 1), last);

  if (!grids.empty()) attach(&posts->data()->x, posts->size() - 1, grids.data(), grids.size());
  attach(last_posts.data(), last_count, &last_grid, 1);
  check(device, "taking over the terrain");
  rtcCommitScene(scene);
  check(device, "building the terrain's structure");
}

// A ray (origin o relative to the surface's, direction d) against one triangle of a cell, in double. Sides are signs of the volumes
// that the ray's line spans with each edge; an edge shared by two triangles gives both the same volume with opposite sign, so no
// ray slips between them.
inline void Tracer::State::intersect_facet(int x, int y, bool lower, const glm::dvec3& o, const glm::dvec3& d, CellHit& best) const {
  const int near = lower ? 1 : 0;  // the triangle's right angle is at post (x + near, y + near)
  const int far = 1 - near;
  const glm::dvec3 a = post(x + near, y + near) - o;
  const glm::dvec3 b = post(x + far, y + near) - o;
  const glm::dvec3 c = post(x + near, y + far) - o;
  const double ab = glm::dot(glm::cross(a, b), d);  // weighs c, and so on
  const double bc = glm::dot(glm::cross(b, c), d);
  const double ca = glm::dot(glm::cross(c, a), d);
  const double sum = ab + bc + ca;
  const bool beside = std::min(ab, std::min(bc, ca)) < 0.0 && std::max(ab, std::max(bc, ca)) > 0.0;
  if (beside || sum == 0.0) return;  // 0: seen edge on
  const double share = 1.0 / sum;
  const double wb = ca * share;
  const double wc = ab * share;
  const double distance = glm::dot(a + (b - a) * wb + (c - a) * wc, d);
  if (!(distance >= 0.0) || !(distance < best.distance)) return;
  best = {distance, lower ? 1.0 - wb : wb, lower ? 1.0 - wc : wc, x, y, lower, sum};
}

glm::dvec3 Tracer::State::facet_area(const CellHit& hit) const {
  const glm::dvec3 east = hit.lower ? post(hit.x + 1, hit.y + 1) - post(hit.x, hit.y + 1) : post(hit.x + 1, hit.y) - post(hit.x, hit.y);
  const glm::dvec3 south = hit.lower ? post(hit.x + 1, hit.y + 1) - post(hit.x + 1, hit.y) : post(hit.x, hit.y + 1) - post(hit.x, hit.y);
  return glm::cross(south, east);
}

// The exact hit from the facet that Embree named. False where in double the ray passes it by (it grazed an edge).
bool Tracer::State::resolve(const Ray& ray, unsigned geometry, unsigned primitive, float u, float v, Hit& hit) const {
  const bool in_last = grids.empty() || geometry == 1;
  const GridTile& tile = in_last ? tiles.back() : tiles[primitive];
  const float fx = u * static_cast<float>(tile.cells_x);
  const float fy = v * static_cast<float>(tile.cells_y);
  const int x = tile.x0 + std::clamp(static_cast<int>(fx), 0, tile.cells_x - 1);
  const int y = tile.y0 + std::clamp(static_cast<int>(fy), 0, tile.cells_y - 1);
  const glm::dvec3 o = ray.origin - origin;
  CellHit best;
  const float in_x = fx - static_cast<float>(x - tile.x0);
  const float in_y = fy - static_cast<float>(y - tile.y0);
  intersect_facet(x, y, in_x + in_y > 1.F, o, ray.direction, best);
  // Embree's float places err by the rounding of volumes of about distance × side of a cell, against the facet's own. So near an
  // edge, and where the facet is missed, its neighbours are asked too, and the nearest hit is the answer, from whichever side
  // Embree came. 16 roundings are more than its sums have.
  constexpr double rounding = 16.0 * 0x1.0p-24;
  const double volume = std::abs(best.volume);
  const double rim = std::min(0.5 * volume, rounding * best.distance * side);  // times the volume, which spares a division a ray
  const auto within_rim = [&](double share) { return share * volume < rim; };
  const bool missed = !(best.distance < std::numeric_limits<double>::infinity());
  const double to_edge = std::min(std::min(best.u, best.v), 1.0 - std::max(best.u, best.v));
  if (missed || within_rim(std::min(to_edge, std::abs(best.u + best.v - 1.0)))) {
    const int x0 = std::max(missed || within_rim(best.u) ? x - 1 : x, 0);
    const int x1 = std::min(missed || within_rim(1.0 - best.u) ? x + 1 : x, posts->width() - 2);
    const int y0 = std::max(missed || within_rim(best.v) ? y - 1 : y, 0);
    const int y1 = std::min(missed || within_rim(1.0 - best.v) ? y + 1 : y, posts->height() - 2);
    for (int cy = y0; cy <= y1; ++cy) {
      for (int cx = x0; cx <= x1; ++cx) {
        intersect_facet(cx, cy, false, o, ray.direction, best);
        intersect_facet(cx, cy, true, o, ray.direction, best);
      }
    }
    if (!(best.distance < std::numeric_limits<double>::infinity())) return false;
  }
  hit.found = true;
  hit.distance_m = best.distance;
  hit.column = best.x + best.u;
  hit.row = best.y + best.v;
  hit.facet_area = facet_area(best);
  return true;
}

// Follows a ray beyond a facet that it only grazed, one hit at a time.
void Tracer::State::trace_on(const Ray& ray, float from, Hit& hit) const {
  const glm::vec3 o(ray.origin - origin);
  const glm::vec3 d(ray.direction);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (int tries = 0; tries < 16; ++tries) {
    // Two steps of float farther than the facet left behind.
    from = std::nextafter(std::nextafter(from, infinity), infinity);
    RTCRayHit r{};
    r.ray.org_x = o.x;
    r.ray.org_y = o.y;
    r.ray.org_z = o.z;
    r.ray.tnear = from;
    r.ray.dir_x = d.x;
    r.ray.dir_y = d.y;
    r.ray.dir_z = d.z;
    r.ray.tfar = infinity;
    r.ray.mask = ~0U;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID || resolve(ray, r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v, hit)) return;
    from = r.ray.tfar;
  }
}

namespace {

// What no ray of a bundle changes, and Embree neither.
template <class Packet>
void begin_packet(Packet& packet) {
  for (int lane = 0; lane < bundle; ++lane) {
    packet.tnear[lane] = 0.F;
    packet.time[lane] = 0.F;
    packet.mask[lane] = ~0U;
    packet.id[lane] = static_cast<unsigned>(lane);
    packet.flags[lane] = 0;
  }
}

// Fills a lane's ray part; false where there is no ray (null), or one with a NaN or without direction, which Embree would not survive well.
// Such a lane gets a ray that ends before it begins: without 16-wide instructions Embree takes bundles apart by that and not by the mask.
template <class Packet>
bool set_lane(Packet& packet, int lane, const Ray* ray, const glm::dvec3& origin, float reach) {
  const glm::vec3 o = ray == nullptr ? glm::vec3(0.F) : glm::vec3(ray->origin - origin);
  const glm::vec3 d = ray == nullptr ? glm::vec3(0.F) : glm::vec3(ray->direction);
  const bool usable = std::isfinite(o.x + o.y + o.z + d.x + d.y + d.z) && glm::dot(d, d) > 0.F;
  packet.org_x[lane] = usable ? o.x : 0.F;
  packet.org_y[lane] = usable ? o.y : 0.F;
  packet.org_z[lane] = usable ? o.z : 0.F;
  packet.dir_x[lane] = usable ? d.x : 0.F;
  packet.dir_y[lane] = usable ? d.y : 0.F;
  packet.dir_z[lane] = usable ? d.z : 1.F;
  packet.tfar[lane] = usable ? reach : -1.F;
  return usable;
}

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

std::string describe(RTCDevice device, const std::string& instructions, bool pinned) {
  const auto version = [device](RTCDeviceProperty property) { return static_cast<int>(rtcGetDeviceProperty(device, property)); };
  return fmt::format("Embree {}.{}.{}, {}{}", version(RTC_DEVICE_PROPERTY_VERSION_MAJOR), version(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     version(RTC_DEVICE_PROPERTY_VERSION_PATCH), instruction_set_title(instructions), pinned ? " pinned" : "");
}

}  // namespace

Tracer::Tracer(const DeformedSurface& surface, const TracerParameters& parameters) : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.posts = &surface.vertices_m;
  state.origin = surface.origin;
  const Grid<glm::vec3>& posts = surface.vertices_m;
  if (posts.width() < 2 || posts.height() < 2) {
    throw Error(ErrorKind::bug, "ray tracing", fmt::format("a terrain of {} × {} posts", posts.width(), posts.height()), "2 × 2 or more");
  }
  if (parameters.tile_cells < 1 || parameters.tile_cells > 1024) {
    throw Error(ErrorKind::bug, "ray tracing", fmt::format("tiles of {} cells", parameters.tile_cells), "1 to 1024");
  }
  const glm::dvec3 across = state.post(posts.width() - 1, posts.height() - 1) - state.post(0, 0);
  state.side = glm::length(across) / std::hypot(posts.width() - 1.0, posts.height() - 1.0);
  // About 40 bytes a cell while building (23 are kept); Embree's ids of posts have 32 bits.
  const double needed = 40.0 * static_cast<double>(posts.size());
  const double present = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (needed > present || posts.size() > std::numeric_limits<std::uint32_t>::max() / 12) {
    throw Error(ErrorKind::limit, "ray tracing",
                fmt::format("a terrain of {} × {} posts needs about {:.1f} GB", posts.width(), posts.height(), needed * 1e-9),
                fmt::format("{:.1f} GB of memory, {} posts", present * 1e-9, std::numeric_limits<std::uint32_t>::max() / 12));
  }
  // Embree falls back silently where the processor lacks what is asked for; this does not.
  const std::string instructions = choose_instruction_set(parameters.instruction_set);
  state.device = rtcNewDevice(("isa=" + instructions).c_str());
  check(state.device, "starting Embree");
  rtcSetDeviceMemoryMonitorFunction(
      state.device,
      [](void* user, ssize_t bytes, bool) {
        *static_cast<std::atomic<std::ptrdiff_t>*>(user) += bytes;
        return true;
      },
      &state.bytes);
  state.scene = rtcNewScene(state.device);
  // Compact: 23 bytes a cell instead of 60. Robust: without it rays fall through the edges of cells.
  rtcSetSceneFlags(state.scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_ROBUST));
  state.description = describe(state.device, instructions, parameters.instruction_set != "any");
  const FlushDenormals flush;
  state.build(parameters.tile_cells);
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

std::string Tracer::description() const { return state_->description; }
std::size_t Tracer::memory_bytes() const { return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, state_->bytes.load())); }

void Tracer::intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
  const FlushDenormals flush;
  RTCIntersectContext context = coherent_context();
  RTCRayHit16 packet;
  begin_packet(packet.ray);
  for (std::size_t first = 0; first < rays.size(); first += bundle) {
    const int count = static_cast<int>(std::min<std::size_t>(bundle, rays.size() - first));
    alignas(64) std::array<int, bundle> valid{};
    for (int k = 0; k < bundle; ++k) {
      valid[k] = set_lane(packet.ray, k, k < count ? &rays[first + k] : nullptr, state_->origin, infinity) ? -1 : 0;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid.data(), state_->scene, &context, &packet);
    for (int k = 0; k < count; ++k) {
      Hit& hit = hits[first + k];
      hit = Hit{};
      if (valid[k] == 0 || packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
      const Ray& ray = rays[first + k];
      if (state_->resolve(ray, packet.hit.geomID[k], packet.hit.primID[k], packet.hit.u[k], packet.hit.v[k], hit)) continue;
      state_->trace_on(ray, packet.ray.tfar[k], hit);
    }
  }
}

void Tracer::occluded(std::span<const Ray> rays, double reach_m, std::span<std::uint8_t> blocked) const {
  const FlushDenormals flush;
  RTCIntersectContext context = coherent_context();
  RTCRay16 packet;
  begin_packet(packet);
  for (std::size_t first = 0; first < rays.size(); first += bundle) {
    const int count = static_cast<int>(std::min<std::size_t>(bundle, rays.size() - first));
    alignas(64) std::array<int, bundle> valid{};
    for (int k = 0; k < bundle; ++k) {
      valid[k] = set_lane(packet, k, k < count ? &rays[first + k] : nullptr, state_->origin, static_cast<float>(reach_m)) ? -1 : 0;
    }
    rtcOccluded16(valid.data(), state_->scene, &context, &packet);
    // Embree marks what is blocked with tfar = -infinity.
    for (int k = 0; k < count; ++k) blocked[first + k] = valid[k] != 0 && packet.tfar[k] < 0.F ? 1 : 0;
  }
}

}  // namespace belvedere
