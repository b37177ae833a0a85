#include "tools/bench/bare_embree.h"

#include <xmmintrin.h>

#include <algorithm>
#include <limits>

#include "renderer/trace/embree.h"

namespace belvedere::bench {

constexpr std::size_t packet_size = 16;
constexpr int tile_cells = 64;

// Not in the anonymous namespace: a class in a header has members of these types.
struct alignas(64) PacketRays {
  float org_x[packet_size], org_y[packet_size], org_z[packet_size], dir_x[packet_size],
      dir_y[packet_size], dir_z[packet_size];
};
struct PacketHits {
  float distance[packet_size], u[packet_size], v[packet_size];
  unsigned primitive[packet_size];
};

namespace {

void fill(RTCRay16& out, const PacketRays& in, float reach) {
  std::copy_n(in.org_x, packet_size, out.org_x);
  std::copy_n(in.org_y, packet_size, out.org_y);
  std::copy_n(in.org_z, packet_size, out.org_z);
  std::copy_n(in.dir_x, packet_size, out.dir_x);
  std::copy_n(in.dir_y, packet_size, out.dir_y);
  std::copy_n(in.dir_z, packet_size, out.dir_z);
  std::fill_n(out.tnear, packet_size, 0.F);
  std::fill_n(out.tfar, packet_size, reach);
  std::fill_n(out.time, packet_size, 0.F);
  std::fill_n(out.mask, packet_size, ~0U);
  std::fill_n(out.flags, packet_size, 0U);
}

}  // namespace

struct BareEmbree::State {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  std::vector<float> posts;
  std::vector<RTCGrid> grids;
  glm::dvec3 origin{0.0};
  std::vector<PacketRays> rays;
  std::vector<PacketHits> hits;
  float reach = std::numeric_limits<float>::infinity();
};

BareEmbree::BareEmbree(const DeformedSurface& surface) : state_(std::make_unique<State>()) {
  State& s = *state_;
  const Grid<glm::vec3>& posts = surface.vertices_m;
  s.origin = surface.origin;
  s.posts.resize(posts.size() * 3 + 1);  // Embree reads 4 bytes beyond the last vertex
  std::copy_n(&posts.data()->x, posts.size() * 3, s.posts.data());
  for (int y = 0; y + 1 < posts.height(); y += tile_cells) {
    for (int x = 0; x + 1 < posts.width(); x += tile_cells) {
      s.grids.push_back(
          {static_cast<unsigned>(posts.index(x, y)), static_cast<unsigned>(posts.width()),
           static_cast<std::uint16_t>(std::min(tile_cells, posts.width() - 1 - x) + 1),
           static_cast<std::uint16_t>(std::min(tile_cells, posts.height() - 1 - y) + 1)});
    }
  }
  RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_GRID);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, s.posts.data(),
                             0, 3 * sizeof(float), posts.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, s.grids.data(), 0,
                             sizeof(RTCGrid), s.grids.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(s.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(s.scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_ROBUST));
  rtcCommitScene(s.scene);
}

BareEmbree::~BareEmbree() {
  rtcReleaseScene(state_->scene);
  rtcReleaseDevice(state_->device);
}

void BareEmbree::prepare(std::span<const Ray> rays, double reach_m) {
  State& s = *state_;
  s.rays.assign(rays.size() / packet_size, {});
  s.hits.assign(s.rays.size(), {});
  s.reach = static_cast<float>(reach_m);
  for (std::size_t i = 0; i < s.rays.size() * packet_size; ++i) {
    PacketRays& packet = s.rays[i / packet_size];
    const std::size_t k = i % packet_size;
    const glm::vec3 o(rays[i].origin - s.origin);
    const glm::vec3 d(rays[i].direction);
    packet.org_x[k] = o.x;
    packet.org_y[k] = o.y;
    packet.org_z[k] = o.z;
    packet.dir_x[k] = d.x;
    packet.dir_y[k] = d.y;
    packet.dir_z[k] = d.z;
  }
}

std::size_t BareEmbree::packets() const { return state_->rays.size(); }

void BareEmbree::intersect(std::size_t first, std::size_t last) {
  _mm_setcsr(_mm_getcsr() | 0x8040U);  // FTZ and DAZ
  EmbreeQuery query(state_->scene, true);
  alignas(64) int valid[packet_size];
  std::fill_n(valid, packet_size, -1);
  for (std::size_t i = first; i < last; ++i) {
    RTCRayHit16 packet;
    fill(packet.ray, state_->rays[i], state_->reach);
    std::fill_n(packet.hit.geomID, packet_size, RTC_INVALID_GEOMETRY_ID);
    query.intersect(valid, packet);
    PacketHits& out = state_->hits[i];
    for (std::size_t k = 0; k < packet_size; ++k) {
      out.distance[k] = packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID ? -1.F : packet.ray.tfar[k];
    }
    std::copy_n(packet.hit.u, packet_size, out.u);
    std::copy_n(packet.hit.v, packet_size, out.v);
    std::copy_n(packet.hit.primID, packet_size, out.primitive);
  }
}

void BareEmbree::occluded(std::size_t first, std::size_t last) {
  _mm_setcsr(_mm_getcsr() | 0x8040U);
  EmbreeQuery query(state_->scene, true);
  alignas(64) int valid[packet_size];
  std::fill_n(valid, packet_size, -1);
  for (std::size_t i = first; i < last; ++i) {
    RTCRay16 packet;
    fill(packet, state_->rays[i], state_->reach);
    query.occluded(valid, packet);
    for (std::size_t k = 0; k < packet_size; ++k)
      state_->hits[i].distance[k] = packet.tfar[k] < 0.F ? 1.F : -1.F;
  }
}

std::size_t BareEmbree::count_hits() const {
  std::size_t count = 0;
  for (const PacketHits& packet : state_->hits) {
    count += static_cast<std::size_t>(std::count_if(packet.distance, packet.distance + packet_size,
                                                    [](float d) { return d >= 0.F; }));
  }
  return count;
}

}  // namespace belvedere::bench
