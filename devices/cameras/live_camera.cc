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

constexpr milliseconds kTick{100};           // How long the device is waited for at a time.
constexpr milliseconds kTryAgainEvery{300};  // A camera that is not there.

}  // namespace

/// The capturing thread and what it shares with others.
class LiveCamera::Worker {
 public:
  Worker(LiveCameraOptions options, Opener opener)
      : options_(std::move(options)), opener_(std::move(opener)), uri_(options_.uri) {}

  ~Worker() {
    Stop();
    if (thread_.joinable()) thread_.join();
  }

  Result<void> Start() {
    if (!options_.wait_for_camera) {
      PLEINAIR_ASSIGN_OR_RETURN(auto device, opener_(uri_, options_.pictures));
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

  /// The newest image, once there is one that nobody took.
  bool Take(std::optional<milliseconds> limit, CapturedImage* image, FrameLoss* loss,
            std::int64_t* index) {
    std::unique_lock lock(mutex_);
    const auto ready = [this] { return has_image_ || stop_; };
    if (limit) {
      changed_.wait_for(lock, *limit, ready);
    } else {
      changed_.wait(lock, ready);
    }
    if (!has_image_ || stop_) return false;
    std::swap(*image, newest_);
    *loss = loss_before_newest_;
    *index = newest_index_;
    has_image_ = false;
    loss_before_newest_ = {};
    return true;
  }

  void CountDelivered() {
    const std::lock_guard lock(mutex_);
    ++counts_.delivered;
  }

  /// An image that was taken turned out to be damaged.
  void CountDamaged() {
    const std::lock_guard lock(mutex_);
    ++counts_.loss.damaged;
  }

  void LockControls(std::vector<ControlRequest> controls) {
    const std::lock_guard lock(mutex_);
    options_.controls = std::move(controls);
    lock_again_ = true;
    if (device_) device_->Wake();
  }

  std::vector<CameraEvent> TakeEvents() {
    const std::lock_guard lock(mutex_);
    return std::exchange(events_, {});
  }

  CameraCounts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }
  std::optional<TransportCounts> transport() const {
    const std::lock_guard lock(mutex_);
    return transport_;
  }
  std::optional<NegotiatedFormat> negotiated() const {
    const std::lock_guard lock(mutex_);
    return negotiated_;
  }
  std::vector<ControlResult> ControlResults() const {
    const std::lock_guard lock(mutex_);
    return control_results_;
  }

 private:
  void Run() {
    while (!stopped()) {
      if (!device_) {
        TryToOpen();
        continue;
      }
      LockIfRequested();
      const WaitOutcome outcome = device_->Wait(kTick, &captured_);
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
    auto device = opener_(uri_, options_.pictures);
    if (device) return Connect(*std::move(device));
    std::string details = device.error().Message();
    if (details != reported_waiting_) {
      Report(CameraEvent::Kind::kWaiting, details);
      reported_waiting_ = std::move(details);
    }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kTryAgainEvery, [this] { return stop_; });
  }

  void Connect(std::unique_ptr<CameraDevice> device) {
    // From now on it is this very camera that is sought, wherever it is plugged in again.
    uri_ = device->identity();
    loss_counter_ = LossCounter(
        std::chrono::duration_cast<std::chrono::nanoseconds>(options_.stall_limit).count());
    last_picture_ = Clock::now();
    reported_stall_ = false;
    reported_waiting_.clear();
    std::string details;
    for (const std::string& each : device->negotiated().details)
      details += (details.empty() ? "" : "; ") + each;
    {
      const std::lock_guard lock(mutex_);
      negotiated_ = device->negotiated();
      transport_ = device->Transport();
      device_ = std::move(device);
      lock_again_ = !options_.controls.empty();
      ++counts_.connections;
    }
    Report(CameraEvent::Kind::kConnected, details);
  }

  // Closing may take seconds with some backends: nobody waits for it with the mutex.
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
      if (!std::exchange(lock_again_, false)) return;
      control_requests = options_.controls;
    }
    std::vector<ControlResult> results = device_->LockControls(control_requests);
    const std::lock_guard lock(mutex_);
    control_results_ = std::move(results);
  }

  void TakeIn() {
    const FrameLoss missing = loss_counter_.Add(captured_.number, captured_.timestamp_ns);
    last_picture_ = Clock::now();
    if (std::exchange(reported_stall_, false)) Report(CameraEvent::Kind::kRecovered, "");
    const bool whole = !captured_.damaged;
    const std::lock_guard lock(mutex_);
    FrameLoss loss = missing;
    index_ += 1 + missing.Total();
    if (!whole) ++loss.damaged;
    // The one that nobody took makes room for a whole one only.
    if (whole && has_image_) ++loss.not_taken;
    loss_before_newest_ += loss;
    counts_.loss += loss;
    transport_ = device_->Transport();
    if (!whole) return;
    std::swap(newest_, captured_);
    newest_index_ = index_;
    has_image_ = true;
    changed_.notify_all();
  }

  void CheckForStall() {
    const auto silent = Clock::now() - last_picture_;
    if (silent < options_.stall_limit) return;
    if (!std::exchange(reported_stall_, true)) {
      Report(CameraEvent::Kind::kStalled, "the camera is there but sends no pictures");
      const std::lock_guard lock(mutex_);
      ++counts_.stalls;
    }
    if (silent < 2 * options_.stall_limit) return;
    // Starting afresh wakes most of them; a stream that goes on by itself is not touched before.
    Disconnect();
    auto device = opener_(uri_, options_.pictures);
    if (!device) return Report(CameraEvent::Kind::kGone, device.error().what);
    const std::lock_guard lock(mutex_);
    device_ = *std::move(device);
    lock_again_ = !options_.controls.empty();
    loss_counter_ = LossCounter(
        std::chrono::duration_cast<std::chrono::nanoseconds>(options_.stall_limit).count());
    last_picture_ = Clock::now() - options_.stall_limit;
  }

  void Report(CameraEvent::Kind kind, std::string details) {
    // A consumer that never asks must not fill the memory.
    constexpr std::size_t kMax = 1000;
    const std::lock_guard lock(mutex_);
    if (events_.size() >= kMax) events_.erase(events_.begin());
    events_.push_back({kind, SteadyNow_ns(), std::move(details)});
  }

  LiveCameraOptions options_;  // controls: under the mutex.
  Opener opener_;
  std::thread thread_;

  // The thread's own.
  CameraUri uri_;
  CapturedImage captured_;
  LossCounter loss_counter_{0};
  Clock::time_point last_picture_;
  bool reported_stall_ = false;
  std::string reported_waiting_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // Changed by the thread under the mutex, so the thread may read it without.
  std::unique_ptr<CameraDevice> device_;
  bool stop_ = false;
  bool has_image_ = false;
  CapturedImage newest_;
  std::int64_t newest_index_ = 0;
  std::int64_t index_ = -1;
  FrameLoss loss_before_newest_;
  bool lock_again_ = false;
  std::vector<CameraEvent> events_;
  CameraCounts counts_;
  std::optional<TransportCounts> transport_;
  std::optional<NegotiatedFormat> negotiated_;
  std::vector<ControlResult> control_results_;
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
    // The limit only bounds how long damaged pictures are passed over before the flag is seen.
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
