#include "compositor/light/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pleinair::compositor {
namespace {

/// An Embree object with its reference, released on destruction.
template <typename Handle, void (*Release)(Handle)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Handle handle) : handle_(handle) {}
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owned() {
    if (handle_ != nullptr) Release(handle_);
  }
  Handle get() const { return handle_; }

 private:
  Handle handle_ = nullptr;
};

using Device = Owned<RTCDevice, rtcReleaseDevice>;
using Scene = Owned<RTCScene, rtcReleaseScene>;
using Geometry = Owned<RTCGeometry, rtcReleaseGeometry>;

RTCRay MakeRay(Vec3 origin, Vec3 direction) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0U;
  return ray;
}

// As Embree takes them: -1 follows a ray.
struct alignas(32) Followed {
  explicit Followed(unsigned bits) {
    for (unsigned i = 0; i < RayPacket::kSize; ++i) lanes[i] = (bits >> i & 1U) != 0 ? -1 : 0;
  }
  std::array<int, RayPacket::kSize> lanes;
};

void SetRays(const RayPacket& rays, RTCRay8* packet) {
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    packet->org_x[i] = static_cast<float>(rays.origins[i].x);
    packet->org_y[i] = static_cast<float>(rays.origins[i].y);
    packet->org_z[i] = static_cast<float>(rays.origins[i].z);
    packet->dir_x[i] = static_cast<float>(rays.directions[i].x);
    packet->dir_y[i] = static_cast<float>(rays.directions[i].y);
    packet->dir_z[i] = static_cast<float>(rays.directions[i].z);
    packet->tnear[i] = 0.0F;
    packet->tfar[i] = std::numeric_limits<float>::infinity();
    packet->time[i] = 0.0F;
    packet->mask[i] = ~0U;
    packet->id[i] = 0;
    packet->flags[i] = 0;
  }
}

class EmbreeScene : public RayScene {
 public:
  EmbreeScene(Device device, Scene everything, Scene phantoms)
      : device_(std::move(device)),
        everything_(std::move(everything)),
        phantoms_(std::move(phantoms)) {}

  void SetPositions(std::span<const std::vector<std::array<float, 3>>> positions) override {
    for (unsigned id = 0; id < positions.size(); ++id) {
      const RTCGeometry geometry = rtcGetGeometry(everything_.get(), id);
      if (geometry == nullptr) continue;  // A mesh without triangles.
      void* buffer = rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
      std::memcpy(buffer, positions[id].data(), positions[id].size() * 3 * sizeof(float));
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
      rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
      rtcCommitGeometry(geometry);
    }
    rtcSetSceneFlags(everything_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
    rtcCommitScene(everything_.get());
  }

  bool Intersect(RayTargets targets, Vec3 origin, Vec3 direction, RayHit* hit) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = MakeRay(origin, direction);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(SceneOf(targets), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit->mesh = query.hit.geomID;
    hit->triangle = query.hit.primID;
    hit->u = query.hit.u;
    hit->v = query.hit.v;
    hit->distance_m = query.ray.tfar;
    // Embree's Ng is (v1−v0)×(v2−v0): right-handed, so counter-clockwise towards the viewer.
    hit->back = query.hit.Ng_x * query.ray.dir_x + query.hit.Ng_y * query.ray.dir_y +
                    query.hit.Ng_z * query.ray.dir_z >
                0.0F;
    return true;
  }

  unsigned Intersect(RayTargets targets, const RayPacket& rays, unsigned followed,
                     std::array<RayHit, RayPacket::kSize>* hits) const override {
    if (followed == 0) return 0;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit8 query;
    SetRays(rays, &query.ray);
    for (unsigned& id : query.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
    for (unsigned& id : query.hit.instID[0]) id = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect8(Followed(followed).lanes.data(), SceneOf(targets), &context, &query);
    unsigned found = 0;
    for (unsigned i = 0; i < RayPacket::kSize; ++i) {
      if ((followed >> i & 1U) == 0 || query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      found |= 1U << i;
      RayHit& hit = (*hits)[i];
      hit.mesh = query.hit.geomID[i];
      hit.triangle = query.hit.primID[i];
      hit.u = query.hit.u[i];
      hit.v = query.hit.v[i];
      hit.distance_m = query.ray.tfar[i];
      hit.back = query.hit.Ng_x[i] * query.ray.dir_x[i] + query.hit.Ng_y[i] * query.ray.dir_y[i] +
                     query.hit.Ng_z[i] * query.ray.dir_z[i] >
                 0.0F;
    }
    return found;
  }

  unsigned Occluded(RayTargets targets, const RayPacket& rays, unsigned followed) const override {
    if (followed == 0) return 0;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay8 query;
    SetRays(rays, &query);
    rtcOccluded8(Followed(followed).lanes.data(), SceneOf(targets), &context, &query);
    unsigned hidden = 0;
    for (unsigned i = 0; i < RayPacket::kSize; ++i) {
      if ((followed >> i & 1U) != 0 && query.tfar[i] < 0.0F) hidden |= 1U << i;
    }
    return hidden;
  }

  bool Occluded(RayTargets targets, Vec3 origin, Vec3 direction) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = MakeRay(origin, direction);
    rtcOccluded1(SceneOf(targets), &context, &ray);
    return ray.tfar < 0.0F;
  }

 private:
  RTCScene SceneOf(RayTargets targets) const {
    return targets == RayTargets::kEverything ? everything_.get() : phantoms_.get();
  }

  Device device_;
  Scene everything_;
  Scene phantoms_;
};

// Copies of one triangle in the hierarchy. A ray that meets them intersects each: 10,000 copies
// took minutes. Both sides of leaves and doubled exports are a few.
constexpr int kMaxCopies = 16;

/// Leaves out the copies of triangles beyond kMaxCopies, counted over several meshes.
class CopyFilter {
 public:
  explicit CopyFilter(std::size_t triangles)
      : counts_(std::bit_ceil(std::max<std::size_t>(64, 4 * triangles))) {}

  /// Sets the corners of copies beyond the limit to no vertex; Embree ignores such triangles.
  void Apply(const RayMesh& mesh, std::uint32_t* indices) {
    constexpr std::uint32_t kNoVertex = ~0U;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      std::uint64_t sum = 0;  // The same for every order of the corners.
      Corners corners;
      for (std::size_t c = 0; c < 3; ++c) {
        std::memcpy(corners[c].data(), mesh.positions[mesh.indices[i + c]].data(),
                    sizeof(Corners::value_type));
        sum += HashOf(corners[c]);
      }
      std::uint8_t& count = counts_[sum & (counts_.size() - 1)];
      if (count < kMaxCopies) {
        ++count;
        continue;
      }
      // Exact only here: different triangles may share a count.
      std::sort(corners.begin(), corners.end());
      if (++copies_[corners] > kMaxCopies) std::fill_n(indices + i, 3, kNoVertex);
    }
  }

 private:
  using Corners = std::array<std::array<std::uint32_t, 3>, 3>;

  static std::uint64_t HashOf(const std::array<std::uint32_t, 3>& corner) {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (const std::uint32_t part : corner) {
      hash = (hash ^ part) * 0xBF58476D1CE4E5B9U;
      hash ^= hash >> 31;
    }
    return hash;
  }

  std::vector<std::uint8_t> counts_;
  std::map<Corners, int> copies_;
};

}  // namespace

Result<std::unique_ptr<RayScene>> RayScene::Create(const std::vector<RayMesh>& meshes,
                                                   const std::string& where) {
  // One build thread: the hierarchy must not depend on the machine, because it decides among
  // surfaces at equal distance. 200,000 triangles take a quarter of a second.
  Device device(rtcNewDevice("threads=1,set_affinity=0"));
  if (device.get() == nullptr) {
    return SystemError("Embree", "cannot start on this processor",
                       "Embree 3 needs SSE2 or NEON instructions");
  }
  Scene everything(rtcNewScene(device.get()));
  Scene phantoms(rtcNewScene(device.get()));
  for (const RTCScene scene : {everything.get(), phantoms.get()}) {
    // Robust: no ray slips through the edge between two triangles.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }
  std::size_t triangles = 0;
  for (const RayMesh& mesh : meshes) triangles += mesh.indices.size() / 3;
  // Apart: a copy among the objects does not stand for one among the phantoms.
  CopyFilter object_copies(triangles), phantom_copies(triangles);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const RayMesh& mesh = meshes[i];
    if (mesh.indices.empty()) continue;
    const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    void* positions =
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.positions.size());
    void* indices =
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
    if (positions == nullptr || indices == nullptr) {
      return SystemError(where, "not enough memory for the models' ray queries",
                         "use models with fewer triangles");
    }
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * 3 * sizeof(float));
    std::memcpy(indices, mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
    (mesh.is_phantom ? phantom_copies : object_copies)
        .Apply(mesh, static_cast<std::uint32_t*>(indices));
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(everything.get(), geometry.get(), static_cast<unsigned>(i));
    if (mesh.is_phantom) {
      rtcAttachGeometryByID(phantoms.get(), geometry.get(), static_cast<unsigned>(i));
    }
  }
  rtcCommitScene(everything.get());
  rtcCommitScene(phantoms.get());
  if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) {
    return SystemError(where, "Embree could not build the models' ray queries",
                       "use models with fewer triangles");
  }
  return std::make_unique<EmbreeScene>(std::move(device), std::move(everything),
                                       std::move(phantoms));
}

}  // namespace pleinair::compositor
