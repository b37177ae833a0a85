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
#include "base/math_exact.h"

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

// One grid of posts that is traced: the surface's own or that of a window.
struct Part {
  const Grid<glm::vec3>* posts = nullptr;
  PixelRect traced;  // posts whose cells are traced, but for those of the hole
  PixelRect hole;    // posts around cells that a window replaces; may be empty
  bool is_window = false;
  double side = 0.0;            // of a cell, about
  std::vector<GridTile> tiles;  // a window's all in one geometry; the surface's last one is a geometry of its own
  std::vector<RTCGrid> grids;

  // The post that stands for (x, y): along a window's edge those that the coarser side lacks are not met.
  glm::ivec2 met(int x, int y) const {
    if (is_window) {
      if (y == traced.y0 || y == traced.y1 - 1) x -= (x - traced.x0) & 1;
      if (x == traced.x0 || x == traced.x1 - 1) y -= (y - traced.y0) & 1;
    }
    return {x, y};
  }
  glm::dvec3 post(int x, int y) const { return glm::dvec3((*posts)(x, y)); }
  bool has_cell(int x, int y) const {
    const bool inside = x >= traced.x0 && y >= traced.y0 && x + 1 < traced.x1 && y + 1 < traced.y1;
    return inside && !in_hole(x, y);
  }
  bool in_hole(int x, int y) const { return x >= hole.x0 && y >= hole.y0 && x + 1 < hole.x1 && y + 1 < hole.y1; }
  // Whether a cell touches another part.
  bool at_joint(int x, int y) const {
    if (is_window && (x <= traced.x0 || y <= traced.y0 || x + 2 >= traced.x1 || y + 2 >= traced.y1)) return true;
    return !hole.empty() && x >= hole.x0 - 1 && y >= hole.y0 - 1 && x < hole.x1 && y < hole.y1;
  }
};

}  // namespace

struct Tracer::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  glm::dvec3 origin{0.0};
  std::vector<Part> parts;        // the surface's own: geometry 0, its last tile geometry 1; then a geometry for each window
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
  const Part& part_of(unsigned geometry) const;
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

// The cells between posts that are no hole, as up to four rectangles, the last of which holds the last post.
std::vector<PixelRect> without_hole(const PixelRect& posts, const PixelRect& hole) {
  if (hole.empty()) return {posts};
  return {{posts.x0, posts.y0, posts.x1, hole.y0 + 1},
          {posts.x0, hole.y0, hole.x0 + 1, hole.y1},
          {hole.x1 - 1, hole.y0, posts.x1, hole.y1},
          {posts.x0, hole.y1 - 1, posts.x1, posts.y1}};
}

RTCGrid grid_of(unsigned start, unsigned stride, const GridTile& tile) {
  return {start, stride, static_cast<std::uint16_t>(tile.cells_x + 1), static_cast<std::uint16_t>(tile.cells_y + 1)};
}

void make_tiles(Part& part, int tile_cells) {
  for (const PixelRect& posts : without_hole(part.traced, part.hole)) {
    for (int y = posts.y0; y + 1 < posts.y1; y += tile_cells)
      for (int x = posts.x0; x + 1 < posts.x1; x += tile_cells)
        part.tiles.push_back({x, y, std::min(tile_cells, posts.x1 - 1 - x), std::min(tile_cells, posts.y1 - 1 - y)});
  }
  for (const GridTile& tile : part.tiles)
    part.grids.push_back(
        grid_of(static_cast<unsigned>(part.posts->index(tile.x0, tile.y0)), static_cast<unsigned>(part.posts->width()), tile));
}

// The surface's own grid and its windows, and what of each is traced.
std::vector<Part> make_parts(const DeformedSurface& surface) {
  const auto side_of = [](const Grid<glm::vec3>& posts) {
    const glm::dvec3 across = glm::dvec3(posts(posts.width() - 1, posts.height() - 1)) - glm::dvec3(posts(0, 0));
    return glm::length(across) / exact::hypot(posts.width() - 1.0, posts.height() - 1.0);
  };
  const Grid<glm::vec3>& own = surface.vertices_m;
  std::vector<Part> parts;
  parts.push_back({&own, {0, 0, own.width(), own.height()}, {}, false, side_of(own), {}, {}});
  for (const SurfaceWindow& window : surface.windows) {
    const Grid<glm::vec3>& posts = window.surface.vertices_m;
    const PixelRect& part = window.part;
    const bool fits = part.width() == 2 * window.replaces.width() - 1 && part.height() == 2 * window.replaces.height() - 1 &&
                      std::min(part.width(), part.height()) >= 5 && part.x1 < posts.width() && part.y1 < posts.height() &&
                      intersection(grown(window.replaces, 1), parts.back().traced) == grown(window.replaces, 1);
    if (!fits) throw Error(ErrorKind::bug, "ray tracing", "a window that does not lie in the surface before it");
    parts.back().hole = window.replaces;
    parts.push_back({&posts, part, {}, true, side_of(posts), {}, {}});
  }
  return parts;
}

void Tracer::State::build(int tile_cells) {
  for (Part& part : parts) make_tiles(part, tile_cells);
  Part& own = parts.front();
  own.grids.pop_back();
  // Embree reads each post with 16 bytes, so the very last one needs 4 more than the surface owns. Only the last tile
  // reads it: that tile alone is copied, all others are traced where they lie.
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

  if (!own.grids.empty()) attach(&own.posts->data()->x, own.posts->size() - 1, own.grids.data(), own.grids.size());
  attach(last_posts.data(), last_count, &last_grid, 1);
  // A window's last post is not traced and may be read beyond others.
  for (std::size_t i = 1; i < parts.size(); ++i)
    attach(&parts[i].posts->data()->x, parts[i].posts->size() - 1, parts[i].grids.data(), parts[i].grids.size());
  check(device, "taking over the terrain");
  rtcCommitScene(scene);
  check(device, "building the terrain's structure");
}

const Part& Tracer::State::part_of(unsigned geometry) const {
  const unsigned own = parts.front().grids.empty() ? 1U : 2U;  // geometries
  return parts[geometry < own ? 0 : geometry - own + 1];
}

namespace {

// The corners of a facet as weights know them: a, b for u, c for v.
struct Facet {
  std::array<glm::ivec2, 3> posts;
};
Facet facet_of(const Part& part, int x, int y, bool lower) {
  const int near = lower ? 1 : 0;  // the triangle's right angle is at post (x + near, y + near)
  const int far = 1 - near;
  return {{part.met(x + near, y + near), part.met(x + far, y + near), part.met(x + near, y + far)}};
}

// A ray (origin o relative to the surface's, direction d) against one triangle of a cell, in double. Sides are signs of the volumes
// that the ray's line spans with each edge; an edge shared by two triangles gives both the same volume with opposite sign, so no
// ray slips between them. `clamped`: a ray beside it meets it at the nearest of its points instead.
inline void intersect_facet(const Part& part, int x, int y, bool lower, const glm::dvec3& o, const glm::dvec3& d, CellHit& best,
                            bool clamped = false) {
  const Facet facet = facet_of(part, x, y, lower);
  const glm::dvec3 a = part.post(facet.posts[0].x, facet.posts[0].y) - o;
  const glm::dvec3 b = part.post(facet.posts[1].x, facet.posts[1].y) - o;
  const glm::dvec3 c = part.post(facet.posts[2].x, facet.posts[2].y) - o;
  const double ab = glm::dot(glm::cross(a, b), d);  // weighs c, and so on
  const double bc = glm::dot(glm::cross(b, c), d);
  const double ca = glm::dot(glm::cross(c, a), d);
  const double sum = ab + bc + ca;
  const bool beside = std::min(ab, std::min(bc, ca)) < 0.0 && std::max(ab, std::max(bc, ca)) > 0.0;
  if ((beside && !clamped) || sum == 0.0) return;  // 0: seen edge on
  const double share = 1.0 / sum;
  double wb = ca * share;
  double wc = ab * share;
  if (clamped) {
    wb = std::clamp(wb, 0.0, 1.0);
    wc = std::clamp(wc, 0.0, 1.0 - wb);
  }
  const double distance = glm::dot(a + (b - a) * wb + (c - a) * wc, d);
  if (!(distance >= 0.0) || !(distance < best.distance)) return;
  best = {distance, lower ? 1.0 - wb : wb, lower ? 1.0 - wc : wc, x, y, lower, sum};
}

glm::dvec3 facet_area(const Part& part, const CellHit& hit) {
  const Facet facet = facet_of(part, hit.x, hit.y, hit.lower);
  const auto edge = [&](std::size_t to) {
    return part.post(facet.posts[to].x, facet.posts[to].y) - part.post(facet.posts[0].x, facet.posts[0].y);
  };
  const glm::dvec3 east = hit.lower ? -edge(1) : edge(1);
  const glm::dvec3 south = hit.lower ? -edge(2) : edge(2);
  return glm::cross(south, east);
}

// Column and row of a hit: where a post of the cell is not met, places between those that are.
glm::dvec2 place_of(const Part& part, const CellHit& hit) {
  const Facet facet = facet_of(part, hit.x, hit.y, hit.lower);
  const int near = hit.lower ? 1 : 0;
  if (!part.is_window ||
      (facet.posts[0] == glm::ivec2(hit.x + near, hit.y + near) && facet.posts[1] == glm::ivec2(hit.x + 1 - near, hit.y + near) &&
       facet.posts[2] == glm::ivec2(hit.x + near, hit.y + 1 - near)))
    return {hit.x + hit.u, hit.y + hit.v};
  const double wb = hit.lower ? 1.0 - hit.u : hit.u;
  const double wc = hit.lower ? 1.0 - hit.v : hit.v;
  return (1.0 - wb - wc) * glm::dvec2(facet.posts[0]) + wb * glm::dvec2(facet.posts[1]) + wc * glm::dvec2(facet.posts[2]);
}

}  // namespace

// The exact hit from the facet that Embree named. False where in double the ray passes it by (it grazed an edge).
bool Tracer::State::resolve(const Ray& ray, unsigned geometry, unsigned primitive, float u, float v, Hit& hit) const {
  const Part& part = part_of(geometry);
  const bool in_last = !part.is_window && (part.grids.empty() || geometry == 1);
  const GridTile& tile = in_last ? part.tiles.back() : part.tiles[primitive];
  const float fx = u * static_cast<float>(tile.cells_x);
  const float fy = v * static_cast<float>(tile.cells_y);
  const int x = tile.x0 + std::clamp(static_cast<int>(fx), 0, tile.cells_x - 1);
  const int y = tile.y0 + std::clamp(static_cast<int>(fy), 0, tile.cells_y - 1);
  const glm::dvec3 o = ray.origin - origin;
  CellHit best;
  const float in_x = fx - static_cast<float>(x - tile.x0);
  const float in_y = fy - static_cast<float>(y - tile.y0);
  const bool lower = in_x + in_y > 1.F;
  intersect_facet(part, x, y, lower, o, ray.direction, best);
  // Embree's float places err by the rounding of volumes of about distance × side of a cell, against the facet's own. So near an
  // edge, and where the facet is missed, its neighbours are asked too, and the nearest hit is the answer, from whichever side
  // Embree came. 16 roundings are more than its sums have.
  constexpr double rounding = 16.0 * 0x1.0p-24;
  const double volume = std::abs(best.volume);
  const double rim = std::min(0.5 * volume, rounding * best.distance * part.side);  // times the volume, which spares a division a ray
  const auto within_rim = [&](double share) { return share * volume < rim; };
  const bool missed = !(best.distance < std::numeric_limits<double>::infinity());
  const double to_edge = std::min(std::min(best.u, best.v), 1.0 - std::max(best.u, best.v));
  if (missed || within_rim(std::min(to_edge, std::abs(best.u + best.v - 1.0)))) {
    const int x0 = missed || within_rim(best.u) ? x - 1 : x;
    const int x1 = missed || within_rim(1.0 - best.u) ? x + 1 : x;
    const int y0 = missed || within_rim(best.v) ? y - 1 : y;
    const int y1 = missed || within_rim(1.0 - best.v) ? y + 1 : y;
    for (int cy = y0; cy <= y1; ++cy) {
      for (int cx = x0; cx <= x1; ++cx) {
        if (!part.has_cell(cx, cy)) continue;
        intersect_facet(part, cx, cy, false, o, ray.direction, best);
        intersect_facet(part, cx, cy, true, o, ray.direction, best);
      }
    }
    if (!(best.distance < std::numeric_limits<double>::infinity())) {
      // Beyond the edge lies another part. Going on along the ray could lose both, as their distances differ by rounding alone.
      if (!part.at_joint(x, y)) return false;
      intersect_facet(part, x, y, lower, o, ray.direction, best, true);
      if (!(best.distance < std::numeric_limits<double>::infinity())) return false;
    }
  }
  const glm::dvec2 place = place_of(part, best);
  hit.found = true;
  hit.distance_m = best.distance;
  hit.column = place.x;
  hit.row = place.y;
  hit.window = static_cast<int>(&part - parts.data());
  hit.facet_area = facet_area(part, best);
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
  state.origin = surface.origin;
  const Grid<glm::vec3>& posts = surface.vertices_m;
  if (posts.width() < 2 || posts.height() < 2) {
    throw Error(ErrorKind::bug, "ray tracing", fmt::format("a terrain of {} × {} posts", posts.width(), posts.height()), "2 × 2 or more");
  }
  if (parameters.tile_cells < 1 || parameters.tile_cells > 1024) {
    throw Error(ErrorKind::bug, "ray tracing", fmt::format("tiles of {} cells", parameters.tile_cells), "1 to 1024");
  }
  state.parts = make_parts(surface);
  // About 40 bytes a cell while building (23 are kept); Embree's ids of posts have 32 bits.
  double all_posts = 0.0;
  for (const Part& part : state.parts) all_posts += static_cast<double>(part.posts->size());
  const double needed = 40.0 * all_posts;
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
