#include "session/following/live_lens.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "compositor/picture/marker_in_image.h"
#include "session/following/low_priority.h"

namespace pleinair::session {
namespace {

constexpr double kReadEvery_s = 0.2, kFitEvery_s = 2.0, kWindow_s = 20.0;
constexpr double kLongestMotion_s = 0.25;

double SecondsOf(std::int64_t timestamp_ns) { return static_cast<double>(timestamp_ns) * 1e-9; }

}  // namespace

LiveLens::LiveLens(const CameraModel& camera, const CameraResponse& response,
                   const compositor::KnownLens& known)
    : camera_(camera), response_(response), known_(known), thread_([this] { Run(); }) {}

LiveLens::~LiveLens() { Stop(); }

void LiveLens::Stop() {
  {
    const std::lock_guard lock(mutex_);
    shared_.stop = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void LiveLens::Show(std::shared_ptr<const devices::Frame> frame,
                    const Transform<Camera, Marker>& camera_from_marker,
                    const scene::MarkerReflectance& marker) {
  const std::lock_guard lock(mutex_);
  std::deque<ShownFrame>& shown = shared_.shown;
  if (!shown.empty()) {
    const double step_s = SecondsOf(frame->timestamp_ns - shown.back().frame->timestamp_ns);
    if (step_s > 0.0 && (shared_.interval_s == 0.0 || step_s < shared_.interval_s)) {
      shared_.interval_s = step_s;
    }
  }
  shown.push_back({std::move(frame), camera_from_marker, marker});
  if (shown.size() > 3) shown.pop_front();
  if (shown.size() < 3 || shared_.job) return;
  const double seconds = SecondsOf(shown[2].frame->timestamp_ns - shown[0].frame->timestamp_ns);
  Job job{shown[1], std::nullopt};
  if (seconds > 0.0 && seconds <= kLongestMotion_s) {
    job.motion = {shown[0].camera_from_marker, shown[2].camera_from_marker, seconds};
  }
  shared_.job = std::move(job);
  changed_.notify_all();
}

std::optional<MeasuredLens> LiveLens::TakeNews() {
  const std::lock_guard lock(mutex_);
  return std::exchange(shared_.news, std::nullopt);
}

void LiveLens::Run() {
  LowerPriority();
  std::optional<double> read_s, fitted_s;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return shared_.stop || shared_.job; });
    if (shared_.stop) return;
    const Job job = *std::exchange(shared_.job, std::nullopt);
    const double now_s = SecondsOf(job.shown.frame->timestamp_ns);
    if (read_s && now_s - *read_s < kReadEvery_s) continue;
    const double interval_s = shared_.interval_s;
    lock.unlock();
    read_s = now_s;
    if (!fitted_s) fitted_s = now_s;
    Read(job);
    std::optional<MeasuredLens> measured;
    if (now_s - *fitted_s >= kFitEvery_s) {
      fitted_s = now_s;
      measured = Fit(interval_s);
    }
    lock.lock();
    if (measured) shared_.news = std::move(measured);
  }
}

void LiveLens::Read(const Job& job) {
  const devices::Frame& frame = *job.shown.frame;
  const compositor::MarkerInImage in_image(frame.rgb.view(), camera_, job.shown.camera_from_marker,
                                           job.shown.marker, response_);
  const double now_s = SecondsOf(frame.timestamp_ns);
  for (compositor::SideProfile& side : compositor::ReadSideProfiles(in_image, job.motion)) {
    side.place.frame_index = frame.index;
    side.place.timestamp_s = now_s;
    profiles_.push_back(std::move(side));
  }
  std::erase_if(profiles_, [&](const compositor::SideProfile& side) {
    return side.place.timestamp_s < now_s - kWindow_s;
  });
}

MeasuredLens LiveLens::Fit(double interval_s) const {
  MeasuredLens measured;
  measured.fx = camera_.fx;
  measured.fit = compositor::MeasureFocus(profiles_, camera_.fx, known_, &measured.readings);
  measured.exposure = compositor::MeasureExposure(
      profiles_, measured.fit.is_measured() ? measured.fit.in_focus_blur_px : 0.0, interval_s);
  return measured;
}

}  // namespace pleinair::session
