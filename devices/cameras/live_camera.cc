#include "devices/cameras/live_camera.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "devices/cameras/camera_backends.h"
#include "devices/cameras/camera_device.h"
#include "devices/cameras/loss_counter.h"

namespace pleinair::devices {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kTick{100};           // Longest single wait for the device.
constexpr milliseconds kTryAgainEvery{300};  // Interval of attempts to open a missing camera.

/// Opens the requested camera; after the first time the same physical one, on whichever port.
class CameraFinder {
 public:
  CameraFinder(LiveCamera::Opener opener, const LiveCameraOptions& options)
      : opener_(std::move(opener)), uri_(options.uri), pictures_(options.pictures) {}

  Result<std::unique_ptr<CameraDevice>> Open() const { return opener_(uri_, pictures_); }
  /// Records the stable name of the camera that was found.
  void Found(CameraUri identity) {
    uri_ = std::move(identity);
    reported_.clear();
  }
  /// True if this reason for its absence differs from the last.
  bool IsNews(const std::string& reason) {
    if (reason == reported_) return false;
    reported_ = reason;
    return true;
  }

 private:
  LiveCamera::Opener opener_;
  CameraUri uri_;
  FormatRequest pictures_;
  std::string reported_;
};

/// The stream of the open device.
struct Stream {
  CapturedImage captured;
  LossCounter loss_counter{0};
  Clock::time_point last_picture;
  bool reported_stall = false;

  /// Resets for a newly opened device.
  void Restart(milliseconds stall_limit, Clock::time_point picture) {
    loss_counter =
        LossCounter(std::chrono::duration_cast<std::chrono::nanoseconds>(stall_limit).count());
    last_picture = picture;
  }
};

/// The newest image that has not been read, and the counts of all images.
struct NewestImage {
  bool there = false;
  CapturedImage image;
  std::int64_t index = 0;
  FrameLoss loss_before;
  std::int64_t last_index = -1;  ///< Including damaged ones.
};

/// The controls to lock each time the camera is opened.
struct HeldControls {
  std::vector<ControlRequest> requests;
  bool lock_again = false;
  std::vector<ControlResult> results;
};

/// State that callers can query.
struct CameraStatus {
  std::vector<CameraEvent> events;
  CameraCounts counts;
  std::optional<TransportCounts> transport;
  std::optional<NegotiatedFormat> negotiated;
};

}  // namespace

/// The capture thread and the state that it shares with callers.
class LiveCamera::Worker {
 public:
  Worker(LiveCameraOptions options, Opener opener)
      : finder_(std::move(opener), options),
        wait_for_camera_(options.wait_for_camera),
        stall_limit_(options.stall_limit) {
    controls_.requests = std::move(options.controls);
  }

  ~Worker() {
    Stop();
    if (thread_.joinable()) thread_.join();
  }

  Result<void> Start() {
    if (!wait_for_camera_) {
      PLEINAIR_ASSIGN_OR_RETURN(auto device, finder_.Open());
      Connect(std::move(device));
    }
    thread_ = std::thread([this] { Run(); });
    return {};
  }

  void Stop() {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    if (device_) device_->Wake();
    changed_.notify_all();
  }

  bool stopped() const {
    const std::lock_guard lock(mutex_);
    return stop_;
  }

  /// Returns the newest image as soon as there is an unread one.
  bool Take(std::optional<milliseconds> limit, CapturedImage* image, FrameLoss* loss,
            std::int64_t* index) {
    std::unique_lock lock(mutex_);
    const auto ready = [this] { return newest_.there || stop_; };
    if (limit) {
      changed_.wait_for(lock, *limit, ready);
    } else {
      changed_.wait(lock, ready);
    }
    if (!newest_.there || stop_) return false;
    std::swap(*image, newest_.image);
    *loss = newest_.loss_before;
    *index = newest_.index;
    newest_.there = false;
    newest_.loss_before = {};
    return true;
  }

  void CountDelivered() {
    const std::lock_guard lock(mutex_);
    ++status_.counts.delivered;
  }

  /// Counts an image that turned out to be damaged after it was taken.
  void CountDamaged() {
    const std::lock_guard lock(mutex_);
    ++status_.counts.loss.damaged;
  }

  void LockControls(std::vector<ControlRequest> controls) {
    const std::lock_guard lock(mutex_);
    controls_.requests = std::move(controls);
    controls_.lock_again = true;
    if (device_) device_->Wake();
  }

  std::vector<CameraEvent> TakeEvents() {
    const std::lock_guard lock(mutex_);
    return std::exchange(status_.events, {});
  }

  CameraCounts counts() const {
    const std::lock_guard lock(mutex_);
    return status_.counts;
  }
  std::optional<TransportCounts> transport() const {
    const std::lock_guard lock(mutex_);
    return status_.transport;
  }
  std::optional<NegotiatedFormat> negotiated() const {
    const std::lock_guard lock(mutex_);
    return status_.negotiated;
  }
  std::vector<ControlResult> ControlResults() const {
    const std::lock_guard lock(mutex_);
    return controls_.results;
  }

 private:
  void Run() {
    while (!stopped()) {
      if (!device_) {
        TryToOpen();
        continue;
      }
      LockIfRequested();
      const WaitOutcome outcome = device_->Wait(kTick, &stream_.captured);
      if (outcome == WaitOutcome::kImage) {
        TakeIn();
      } else if (outcome == WaitOutcome::kGone) {
        Report(CameraEvent::Kind::kGone, device_->StatusMessage());
        Disconnect();
      } else {
        CheckForStall();
      }
    }
    Disconnect();
  }

  void TryToOpen() {
    auto device = finder_.Open();
    if (device) return Connect(*std::move(device));
    std::string details = device.error().Message();
    if (finder_.IsNews(details)) Report(CameraEvent::Kind::kWaiting, std::move(details));
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kTryAgainEvery, [this] { return stop_; });
  }

  void Connect(std::unique_ptr<CameraDevice> device) {
    finder_.Found(device->identity());
    stream_.Restart(stall_limit_, Clock::now());
    stream_.reported_stall = false;
    std::string details;
    for (const std::string& each : device->negotiated().details)
      details += (details.empty() ? "" : "; ") + each;
    {
      const std::lock_guard lock(mutex_);
      status_.negotiated = device->negotiated();
      status_.transport = device->Transport();
      device_ = std::move(device);
      controls_.lock_again = !controls_.requests.empty();
      ++status_.counts.connections;
    }
    Report(CameraEvent::Kind::kConnected, details);
  }

  // Closing may take seconds with some backends, so the mutex is not held.
  void Disconnect() {
    std::unique_ptr<CameraDevice> device;
    {
      const std::lock_guard lock(mutex_);
      device = std::move(device_);
    }
  }

  void LockIfRequested() {
    std::vector<ControlRequest> control_requests;
    {
      const std::lock_guard lock(mutex_);
      if (!std::exchange(controls_.lock_again, false)) return;
      control_requests = controls_.requests;
    }
    std::vector<ControlResult> results = device_->LockControls(control_requests);
    const std::lock_guard lock(mutex_);
    controls_.results = std::move(results);
  }

  void TakeIn() {
    const FrameLoss missing =
        stream_.loss_counter.Add(stream_.captured.number, stream_.captured.timestamp_ns);
    stream_.last_picture = Clock::now();
    if (std::exchange(stream_.reported_stall, false)) Report(CameraEvent::Kind::kRecovered, "");
    const bool whole = !stream_.captured.damaged;
    const std::lock_guard lock(mutex_);
    FrameLoss loss = missing;
    newest_.last_index += 1 + missing.Total();
    if (!whole) ++loss.damaged;
    // Only a complete image replaces an unread one.
    if (whole && newest_.there) ++loss.not_taken;
    newest_.loss_before += loss;
    status_.counts.loss += loss;
    status_.transport = device_->Transport();
    if (!whole) return;
    std::swap(newest_.image, stream_.captured);
    newest_.index = newest_.last_index;
    newest_.there = true;
    changed_.notify_all();
  }

  void CheckForStall() {
    const auto silent = Clock::now() - stream_.last_picture;
    if (silent < stall_limit_) return;
    if (!std::exchange(stream_.reported_stall, true)) {
      Report(CameraEvent::Kind::kStalled, "the camera is connected but sends no images");
      const std::lock_guard lock(mutex_);
      ++status_.counts.stalls;
    }
    if (silent < 2 * stall_limit_) return;
    // Restarting ends most stalls; a stream that resumes by itself is left alone until then.
    Disconnect();
    auto device = finder_.Open();
    if (!device) return Report(CameraEvent::Kind::kGone, device.error().what);
    const std::lock_guard lock(mutex_);
    device_ = *std::move(device);
    controls_.lock_again = !controls_.requests.empty();
    stream_.Restart(stall_limit_, Clock::now() - stall_limit_);
  }

  void Report(CameraEvent::Kind kind, std::string details) {
    // Bounds the memory if a caller never reads the events.
    constexpr std::size_t kMax = 1000;
    const std::lock_guard lock(mutex_);
    if (status_.events.size() >= kMax) status_.events.erase(status_.events.begin());
    status_.events.push_back({kind, SteadyNow_ns(), std::move(details)});
  }

  // Accessed only by the thread, once it runs.
  CameraFinder finder_;
  const bool wait_for_camera_;
  const milliseconds stall_limit_;
  Stream stream_;
  std::thread thread_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // Written by the thread under the mutex, so the thread may read it without.
  std::unique_ptr<CameraDevice> device_;
  bool stop_ = false;
  NewestImage newest_;
  HeldControls controls_;
  CameraStatus status_;
};

LiveCamera::LiveCamera(std::unique_ptr<Worker> worker) : worker_(std::move(worker)) {}
LiveCamera::~LiveCamera() = default;

Result<std::unique_ptr<LiveCamera>> LiveCamera::Open(LiveCameraOptions options) {
  PLEINAIR_RETURN_IF_ERROR(CheckBackend(options.uri));
  return OpenWith(std::move(options), OpenCameraDevice);
}

Result<std::unique_ptr<LiveCamera>> LiveCamera::OpenWith(LiveCameraOptions options, Opener opener) {
  auto worker = std::make_unique<Worker>(std::move(options), std::move(opener));
  PLEINAIR_RETURN_IF_ERROR(worker->Start());
  return std::unique_ptr<LiveCamera>(new LiveCamera(std::move(worker)));
}

Result<std::optional<Frame>> LiveCamera::Next() {
  while (!worker_->stopped()) {
    // The limit bounds the time to notice the stop flag while damaged images are skipped.
    if (auto frame = NextWithin(milliseconds(1000))) return frame;
  }
  return std::nullopt;
}

std::optional<Frame> LiveCamera::NextWithin(milliseconds limit) {
  const Clock::time_point end = Clock::now() + limit;
  CapturedImage captured;
  FrameLoss loss, before;
  std::int64_t index = 0;
  while (true) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now());
    if (!worker_->Take(std::max(left, milliseconds(0)), &captured, &before, &index)) {
      return std::nullopt;
    }
    loss += before;
    DecodedImage image;
    if (ConvertRawImage(captured.raw, &image)) {
      Frame frame;
      frame.index = index;
      frame.timestamp_ns = captured.timestamp_ns;
      frame.stamp_meaning = captured.stamp_meaning;
      frame.arrival_ns = captured.arrival_ns;
      frame.device_timestamp_ns = captured.device_timestamp_ns;
      frame.settings = captured.settings;
      frame.loss = loss;
      frame.lost_before = loss.Total();
      frame.rgb = std::move(image.rgb);
      frame.grey = std::move(image.grey);
      frame.raw = std::make_shared<const RawImage>(std::move(captured.raw));
      worker_->CountDelivered();
      return frame;
    }
    ++loss.damaged;
    worker_->CountDamaged();
  }
}

void LiveCamera::Stop() { worker_->Stop(); }
bool LiveCamera::stopped() const { return worker_->stopped(); }
void LiveCamera::LockControls(std::vector<ControlRequest> controls) {
  worker_->LockControls(std::move(controls));
}
std::vector<CameraEvent> LiveCamera::TakeEvents() { return worker_->TakeEvents(); }
CameraCounts LiveCamera::counts() const { return worker_->counts(); }
std::optional<TransportCounts> LiveCamera::transport() const { return worker_->transport(); }
std::optional<NegotiatedFormat> LiveCamera::negotiated() const { return worker_->negotiated(); }
std::vector<ControlResult> LiveCamera::ControlResults() const { return worker_->ControlResults(); }

}  // namespace pleinair::devices
