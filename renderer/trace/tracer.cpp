#include "renderer/trace/tracer.h"

#include <fmt/core.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/instruction_set.h"
#include "base/parallel.h"
#include "renderer/trace/embree.h"
#include "renderer/trace/traced_part.h"

namespace belvedere {
namespace {

constexpr int bundle = 16;  // rays passed to Embree at once
constexpr float infinity = std::numeric_limits<float>::infinity();

// Embree requires denormal floats to be flushed (FTZ, bit 15) and read as zero (DAZ, bit 6) in
// every thread that traces.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040U); }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
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

// Embree's device, and with it a task arena of TBB, of an instruction set. Made once and never
// released: TBB 2021.8 rarely loses a wake-up where arenas are made and destroyed one after the
// other (oneTBB issue 1281), and then the program waits for ever.
struct Device {
  RTCDevice device = nullptr;
  std::mutex building;  // one structure at a time, by all threads
  std::atomic<std::ptrdiff_t> bytes{0};
};

Device& device_for(const std::string& instructions) {
  static std::mutex making;
  static std::map<std::pair<std::string, int>, std::unique_ptr<Device>>& all =
      *new std::map<std::pair<std::string, int>, std::unique_ptr<Device>>;
  const std::lock_guard lock(making);
  std::unique_ptr<Device>& kept = all[{instructions, max_threads()}];
  if (kept != nullptr) return *kept;
  auto made = std::make_unique<Device>();
  made->device = rtcNewDevice(("isa=" + instructions).c_str());
  check(made->device, "starting Embree");
  rtcSetDeviceMemoryMonitorFunction(
      made->device,
      [](void* user, ssize_t bytes, bool) {
        *static_cast<std::atomic<std::ptrdiff_t>*>(user) += bytes;
        return true;
      },
      &made->bytes);
  kept = std::move(made);
  return *kept;
}

RTCGrid grid_of(unsigned start, unsigned stride, const GridTile& tile) {
  return {start, stride, static_cast<std::uint16_t>(tile.cells_x + 1),
          static_cast<std::uint16_t>(tile.cells_y + 1)};
}

std::vector<RTCGrid> grids_of(const TracedPart& part) {
  std::vector<RTCGrid> grids;
  grids.reserve(part.tiles.size());
  for (const GridTile& tile : part.tiles)
    grids.push_back(grid_of(static_cast<unsigned>(part.posts->index(tile.x0, tile.y0)),
                            static_cast<unsigned>(part.posts->width()), tile));
  return grids;
}

}  // namespace

struct Tracer::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  glm::dvec3 origin{0.0};
  std::vector<TracedPart> parts;  // the surface's own: geometry 0, its last tile geometry 1; then a
                                  // geometry for each window
  std::vector<std::vector<RTCGrid>> grids;  // of each part, but for that last tile
  std::vector<float> last_posts;            // of geometry 1, with 4 readable bytes after the end
  RTCGrid last_grid{};
  std::ptrdiff_t bytes = 0;
  std::string description;

  ~State() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }

  void attach(const float* vertices, std::size_t count, const RTCGrid* first,
              std::size_t grid_count);
  void build();
  std::size_t part_of(unsigned geometry) const;
  // The exact hit from the facet that Embree named; see resolve_facet.
  bool resolve(const Ray& ray, unsigned geometry, unsigned primitive, glm::vec2 in_tile,
               Hit& hit) const;
  void trace_on(const Ray& ray, float from, Hit& hit) const;
};

void Tracer::State::attach(const float* vertices, std::size_t count, const RTCGrid* first,
                           std::size_t grid_count) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_GRID);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0,
                             3 * sizeof(float), count);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, first, 0,
                             sizeof(RTCGrid), grid_count);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

void Tracer::State::build() {
  for (const TracedPart& part : parts) grids.push_back(grids_of(part));
  const TracedPart& own = parts.front();
  grids.front().pop_back();
  // Embree reads each post with 16 bytes, so the very last one needs 4 more than the surface owns.
  // Only the last tile reads it: that tile alone is copied, all others are traced in place.
  const GridTile& last = own.tiles.back();
  for (int y = last.y0; y <= last.y0 + last.cells_y; ++y) {
    for (int x = last.x0; x <= last.x0 + last.cells_x; ++x) {
      const glm::vec3& p = (*own.posts)(x, y);
      last_posts.insert(last_posts.end(), {p.x, p.y, p.z});
    }
  }
  const std::size_t last_count = last_posts.size() / 3;
  last_posts.push_back(0.F);
  last_grid = grid_of(0, static_cast<unsigned>(last.cells_x + 1), last);

  if (!grids.front().empty())
    attach(&own.posts->data()->x, own.posts->size() - 1, grids.front().data(),
           grids.front().size());
  attach(last_posts.data(), last_count, &last_grid, 1);
  // A window's last post is not traced, so reading 4 bytes past any other post stays in the buffer.
  for (std::size_t i = 1; i < parts.size(); ++i)
    attach(&parts[i].posts->data()->x, parts[i].posts->size() - 1, grids[i].data(),
           grids[i].size());
  check(device, "loading the terrain");
  rtcCommitScene(scene);
  check(device, "building the acceleration structure");
}

std::size_t Tracer::State::part_of(unsigned geometry) const {
  const unsigned own = grids.front().empty() ? 1U : 2U;  // geometries
  return geometry < own ? 0 : geometry - own + 1;
}

bool Tracer::State::resolve(const Ray& ray, unsigned geometry, unsigned primitive,
                            glm::vec2 in_tile, Hit& hit) const {
  const std::size_t number = part_of(geometry);
  const TracedPart& part = parts[number];
  const bool in_last = number == 0 && (grids.front().empty() || geometry == 1);
  const GridTile& tile = in_last ? part.tiles.back() : part.tiles[primitive];
  hit.window = static_cast<int>(number);
  return resolve_facet(part, tile, in_tile, {ray.origin - origin, ray.direction}, hit);
}

// Follows a ray beyond a facet that it only grazed, one hit at a time.
void Tracer::State::trace_on(const Ray& ray, float from, Hit& hit) const {
  const glm::vec3 o(ray.origin - origin);
  const glm::vec3 d(ray.direction);
  EmbreeQuery query(scene, false);
  for (int tries = 0; tries < 16; ++tries) {
    // Two float steps beyond the last facet.
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
    query.intersect(r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID ||
        resolve(ray, r.hit.geomID, r.hit.primID, {r.hit.u, r.hit.v}, hit))
      return;
    from = r.ray.tfar;
  }
}

namespace {

// The part of a bundle that is the same for all rays and that Embree does not change.
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

// Fills a lane's ray part; false where there is no ray (null), or one with a NaN or without
// direction, which Embree does not handle. Such a lane gets a ray that ends before it begins:
// without 16-wide instructions Embree splits bundles by that and not by the mask.
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

std::string describe(RTCDevice device, const std::string& instructions, bool pinned) {
  const auto version = [device](RTCDeviceProperty property) {
    return static_cast<int>(rtcGetDeviceProperty(device, property));
  };
  return fmt::format("Embree {}.{}.{}, {}{}", version(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     version(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     version(RTC_DEVICE_PROPERTY_VERSION_PATCH),
                     instruction_set_title(instructions), pinned ? " pinned" : "");
}

}  // namespace

Tracer::Tracer(const DeformedSurface& surface, const TracerParameters& parameters)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.origin = surface.origin;
  const Grid<glm::vec3>& posts = surface.vertices_m;
  if (posts.width() < 2 || posts.height() < 2) {
    throw Error(ErrorKind::bug, "ray tracing",
                fmt::format("a terrain of {} × {} posts", posts.width(), posts.height()),
                "2 × 2 or more");
  }
  if (parameters.tile_cells < 1 || parameters.tile_cells > 1024) {
    throw Error(ErrorKind::bug, "ray tracing",
                fmt::format("tiles of {} cells", parameters.tile_cells), "1 to 1024");
  }
  state.parts = make_traced_parts(surface, parameters.tile_cells);
  // About 40 bytes per cell while building (23 are kept); Embree's ids of posts have 32 bits.
  double all_posts = 0.0;
  for (const TracedPart& part : state.parts) all_posts += static_cast<double>(part.posts->size());
  const double needed = 40.0 * all_posts;
  const double present =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (needed > present || posts.size() > std::numeric_limits<std::uint32_t>::max() / 12) {
    throw Error(ErrorKind::limit, "ray tracing",
                fmt::format("a terrain of {} × {} posts needs about {:.1f} GB", posts.width(),
                            posts.height(), needed * 1e-9),
                fmt::format("{:.1f} GB of memory, {} posts", present * 1e-9,
                            std::numeric_limits<std::uint32_t>::max() / 12));
  }
  // Embree falls back silently where the processor lacks the requested instructions; this does not.
  const std::string instructions = choose_instruction_set(parameters.instruction_set);
  Device& shared = device_for(instructions);
  state.device = shared.device;
  const std::lock_guard lock(shared.building);
  const std::ptrdiff_t before = shared.bytes;
  state.scene = rtcNewScene(state.device);
  // Compact: 23 bytes per cell instead of 60. Robust: without it rays pass through the edges of
  // cells.
  rtcSetSceneFlags(state.scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_ROBUST));
  state.description = describe(state.device, instructions, parameters.instruction_set != "any");
  const FlushDenormals flush;
  state.build();
  state.bytes = shared.bytes - before;
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

std::string Tracer::description() const { return state_->description; }
std::size_t Tracer::memory_bytes() const {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, state_->bytes));
}

void Tracer::intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
  const FlushDenormals flush;
  EmbreeQuery query(state_->scene, true);
  RTCRayHit16 packet;
  begin_packet(packet.ray);
  for (std::size_t first = 0; first < rays.size(); first += bundle) {
    const int count = static_cast<int>(std::min<std::size_t>(bundle, rays.size() - first));
    alignas(64) std::array<int, bundle> valid{};
    for (int k = 0; k < bundle; ++k) {
      valid[k] =
          set_lane(packet.ray, k, k < count ? &rays[first + k] : nullptr, state_->origin, infinity)
              ? -1
              : 0;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    query.intersect(valid.data(), packet);
    for (int k = 0; k < count; ++k) {
      Hit& hit = hits[first + k];
      hit = Hit{};
      if (valid[k] == 0 || packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
      const Ray& ray = rays[first + k];
      if (state_->resolve(ray, packet.hit.geomID[k], packet.hit.primID[k],
                          {packet.hit.u[k], packet.hit.v[k]}, hit))
        continue;
      state_->trace_on(ray, packet.ray.tfar[k], hit);
    }
  }
}

void Tracer::occluded(std::span<const Ray> rays, double reach_m,
                      std::span<std::uint8_t> blocked) const {
  const FlushDenormals flush;
  EmbreeQuery query(state_->scene, true);
  RTCRay16 packet;
  begin_packet(packet);
  for (std::size_t first = 0; first < rays.size(); first += bundle) {
    const int count = static_cast<int>(std::min<std::size_t>(bundle, rays.size() - first));
    alignas(64) std::array<int, bundle> valid{};
    for (int k = 0; k < bundle; ++k) {
      valid[k] = set_lane(packet, k, k < count ? &rays[first + k] : nullptr, state_->origin,
                          static_cast<float>(reach_m))
                     ? -1
                     : 0;
    }
    query.occluded(valid.data(), packet);
    // Embree marks blocked rays with tfar = -infinity.
    for (int k = 0; k < count; ++k)
      blocked[first + k] = valid[k] != 0 && packet.tfar[k] < 0.F ? 1 : 0;
  }
}

}  // namespace belvedere
