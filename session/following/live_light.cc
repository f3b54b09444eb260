#include "session/following/live_light.h"

#include <cstddef>
#include <iterator>
#include <utility>

#include "session/following/low_priority.h"

namespace pleinair::session {

namespace {

// Frames whose light is kept: three seconds of them.
constexpr std::size_t kKept = 100;

}  // namespace

LiveLight::LiveLight(const CameraModel& camera, const CameraResponse& response)
    : follower_(camera, response) {
  threads_.emplace_back([this] { Follow(); });
  threads_.emplace_back([this] { TraceLights(); });
}

LiveLight::~LiveLight() { Stop(); }

void LiveLight::Stop() {
  {
    const std::lock_guard lock(mutex_);
    shared_.stop = true;
    changed_.notify_all();
  }
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void LiveLight::Use(const LightReference& reference) {
  const std::lock_guard lock(mutex_);
  shared_.references.push_back(reference);
}

void LiveLight::Show(std::shared_ptr<const devices::Frame> frame,
                     const Transform<Camera, Marker>& camera_from_marker,
                     const scene::MarkerReflectance& marker) {
  const std::lock_guard lock(mutex_);
  shared_.shown = ShownFrame{std::move(frame), camera_from_marker, marker};
  changed_.notify_all();
}

FollowedLight LiveLight::Of(std::int64_t frame_index) const {
  const std::lock_guard lock(mutex_);
  const auto after = shared_.lights.upper_bound(frame_index);
  return after == shared_.lights.begin() ? FollowedLight{} : std::prev(after)->second;
}

LiveLight::Newest LiveLight::newest() const {
  const std::lock_guard lock(mutex_);
  return shared_.newest;
}

void LiveLight::Follow() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return shared_.stop || shared_.shown; });
    if (shared_.stop) return;
    const ShownFrame shown = *std::exchange(shared_.shown, std::nullopt);
    const auto references = std::exchange(shared_.references, {});
    const auto lit = std::exchange(shared_.lit, std::nullopt);
    if (lit) shared_.lighting = false;
    lock.unlock();
    if (lit) follower_.AddLights(lit->reference, lit->lights);
    for (const LightReference& reference : references) follower_.Use(reference);
    follower_.Add(devices::ImageOf(*shown.frame), shown.camera_from_marker, shown.marker,
                  shown.frame->index, shown.frame->timestamp_ns);
    auto to_light = follower_.ProbesWithoutLight();
    const FollowedLight light = follower_.Newest();
    const bool in_full_sun = follower_.IsInFullSun();
    lock.lock();
    shared_.lights[shown.frame->index] = light;
    if (shared_.lights.size() > kKept) shared_.lights.erase(shared_.lights.begin());
    shared_.newest = {in_full_sun, shared_.newest.frames + 1};
    if (!to_light || shared_.lighting) continue;
    shared_.to_light = std::move(to_light);
    shared_.lighting = true;
    changed_.notify_all();
  }
}

void LiveLight::TraceLights() {
  LowerPriority();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return shared_.stop || shared_.to_light; });
    if (shared_.stop) return;
    const ProbesToLight work = *std::exchange(shared_.to_light, std::nullopt);
    lock.unlock();
    Lights lights{work.reference,
                  compositor::LightOn(work.probes, *work.light.phantoms, *work.light.day,
                                      work.light.marker_from_world)};
    lock.lock();
    shared_.lit = std::move(lights);
  }
}

}  // namespace pleinair::session
