#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "devices/cameras/camera_device.h"

namespace pleinair::devices {

/// Controls a simulated camera: plug, unplug, send. Callable from any thread.
class FakeCamera {
 public:
  static constexpr int kWidth = 4, kHeight = 2;
  explicit FakeCamera(int width = kWidth, int height = kHeight) : size_{width, height} {}
  static constexpr std::int64_t kPeriod_ns = 33'333'333;

  void Plug() {
    Change([this] { plugged_ = true; });
  }
  /// An open stream stays disconnected, like a device node, even if the camera is plugged in again
  /// at once.
  void Unplug() {
    Change([this] {
      plugged_ = false;
      ++unplugged_;
      pictures_.clear();
    });
  }
  /// A grey image with all pixels `level`, and this number and time stamp.
  void Send(std::int64_t number, std::uint8_t level, bool damaged = false) {
    SendAt(number, number * kPeriod_ns, level, damaged);
  }
  void SendAt(std::int64_t number, std::int64_t stamp_ns, std::uint8_t level, bool damaged) {
    CapturedImage image;
    image.raw.format = PixelFormat::kGrey8;
    image.raw.width = size_.width;
    image.raw.height = size_.height;
    image.raw.stride = size_.width;
    image.raw.full_range = true;
    image.raw.bytes.assign(static_cast<std::size_t>(size_.width) * size_.height, level);
    image.number = number;
    image.timestamp_ns = stamp_ns;
    image.stamp_meaning = StampMeaning::kExposureStart;
    image.damaged = damaged;
    Change([&] { pictures_.push_back(std::move(image)); });
  }
  /// Waits until every sent image has been taken from the simulated driver.
  void WaitUntilEmpty() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return pictures_.empty() && waiting_; });
  }
  int opened() const { return opened_; }
  std::vector<ControlRequest> locked() {
    const std::lock_guard lock(mutex_);
    return locked_;
  }

  Result<std::unique_ptr<CameraDevice>> Open(const CameraUri& uri, const FormatRequest&) {
    const std::lock_guard lock(mutex_);
    if (!plugged_) return InputError(uri.ToString(), "there is no such camera", "plug it in");
    ++opened_;
    requested_uri_ = uri.ToString();
    return std::unique_ptr<CameraDevice>(new Device(this));
  }
  std::string requested_uri() {
    const std::lock_guard lock(mutex_);
    return requested_uri_;
  }

 private:
  class Device : public CameraDevice {
   public:
    explicit Device(FakeCamera* camera) : camera_(camera), unplugged_(camera->unplugged_) {
      negotiated_.format = PixelFormat::kGrey8;
      negotiated_.size = camera->size_;
    }
    WaitOutcome Wait(std::chrono::milliseconds limit, CapturedImage* image) override {
      std::unique_lock lock(camera_->mutex_);
      camera_->waiting_ = true;
      camera_->changed_.notify_all();
      camera_->changed_.wait_for(
          lock, limit, [this] { return !camera_->pictures_.empty() || IsGone() || woken_; });
      camera_->waiting_ = false;
      woken_ = false;
      if (IsGone()) return WaitOutcome::kGone;
      if (camera_->pictures_.empty()) return WaitOutcome::kNothing;
      *image = std::move(camera_->pictures_.front());
      camera_->pictures_.pop_front();
      return WaitOutcome::kImage;
    }
    void Wake() override {
      camera_->Change([this] { woken_ = true; });
    }
    std::string StatusMessage() const override { return "the stream ended"; }
    const NegotiatedFormat& negotiated() const override { return negotiated_; }
    CameraUri identity() const override {
      return {CameraUri::Backend::kV4l2, CameraUri::Key::kSerial, "0001"};
    }
    std::vector<ControlRange> Controls() override { return {}; }
    std::vector<ControlResult> LockControls(
        const std::vector<ControlRequest>& control_requests) override {
      const std::lock_guard lock(camera_->mutex_);
      camera_->locked_ = control_requests;
      std::vector<ControlResult> results;
      results.reserve(control_requests.size());
      for (const ControlRequest& requested : control_requests)
        results.push_back({requested.control, requested.value, true, ""});
      return results;
    }

   private:
    bool IsGone() const { return camera_->unplugged_ != unplugged_; }

    FakeCamera* camera_;
    const int unplugged_;
    NegotiatedFormat negotiated_;
    bool woken_ = false;
  };

  template <typename Action>
  void Change(Action action) {
    const std::lock_guard lock(mutex_);
    action();
    changed_.notify_all();
  }

  const ImageSize size_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool plugged_ = true;
  int unplugged_ = 0;  // Number of times.
  bool waiting_ = false;
  std::deque<CapturedImage> pictures_;
  std::atomic<int> opened_{0};
  std::vector<ControlRequest> locked_;
  std::string requested_uri_;
};

}  // namespace pleinair::devices
