#include "devices/cameras/libcamera/libcamera_device.h"

#include <libcamera/control_ids.h>
#include <libcamera/framebuffer_allocator.h>
#include <libcamera/property_ids.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <map>
#include <string>
#include <utility>

#include "devices/cameras/format_choice.h"
#include "devices/cameras/libcamera/completed_requests.h"
#include "devices/cameras/libcamera/libcamera_controls.h"
#include "devices/cameras/libcamera/libcamera_manager.h"
#include "devices/cameras/libcamera/mapped_planes.h"
#include "devices/cameras/v4l2/v4l2_controls.h"

namespace pleinair::devices {
namespace {

using std::chrono::milliseconds;

constexpr unsigned kBuffers = 6;

Error NotThere(const std::string& where) {
  return {ErrorKind::kInput, where, "there is no such camera (any more)",
          "plug it in; 'pleinair devices' lists what is there"};
}

Error LibcameraError(const std::string& where, const std::string& doing, int error_number) {
  if (error_number == ENODEV || error_number == ENOENT) return NotThere(where);
  if (error_number == EBUSY) {
    return {ErrorKind::kInput, where, doing + ": another program uses the camera",
            "close that program"};
  }
  if (error_number == EACCES || error_number == EPERM) {
    return {ErrorKind::kInput, where, doing + ": you have no permission for it",
            "join the group 'video' and log in again"};
  }
  return {ErrorKind::kSystem, where, doing + ": " + std::strerror(error_number),
          "unplug it and plug it in again"};
}

/// Converts a time stamp to the steady clock. libcamera documents CLOCK_BOOTTIME but passes on the
/// driver's stamp, mostly CLOCK_MONOTONIC; they differ by the time that the machine was suspended.
std::int64_t ToSteady_ns(std::int64_t stamp_ns, std::int64_t steady_now_ns) {
  timespec boot{};
  clock_gettime(CLOCK_BOOTTIME, &boot);
  const std::int64_t slept_ns = boot.tv_sec * 1'000'000'000LL + boot.tv_nsec - steady_now_ns;
  return stamp_ns > steady_now_ns ? stamp_ns - slept_ns : stamp_ns;
}

/// Detects whether a camera is plugged in, by its entry in the kernel's list of devices.
class Presence {
 public:
  /// Without an entry it is assumed present; only a stall shows its absence.
  explicit Presence(std::string entry = "") : entry_(std::move(entry)) {}

  bool IsThere() const { return entry_.empty() || access(entry_.c_str(), F_OK) == 0; }

  /// True if the camera was gone at the last call too: by then all requests that completed on
  /// libcamera's thread have been handled.
  bool IsGoneForATick() { return std::exchange(was_gone_, !IsThere()) && was_gone_; }

 private:
  std::string entry_;
  bool was_gone_ = false;
};

/// The negotiated format, in libcamera's form and for our callers.
struct Format {
  std::unique_ptr<libcamera::CameraConfiguration> configuration;
  NegotiatedFormat negotiated;
  RawImage layout;
};

/// The image memory, and the requests that carry it.
struct Buffers {
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator;
  std::vector<std::unique_ptr<libcamera::Request>> requests;
  std::map<const libcamera::FrameBuffer*, MappedPlanes> planes;

  /// Frees in the order of dependencies.
  void Free() {
    requests.clear();
    planes.clear();
    allocator.reset();
  }
};

class LibcameraDevice final : public CameraDevice {
 public:
  LibcameraDevice(std::shared_ptr<libcamera::CameraManager> manager,
                  std::shared_ptr<libcamera::Camera> camera)
      : manager_(std::move(manager)),
        camera_(std::move(camera)),
        identity_{CameraUri::Backend::kLibcamera, CameraUri::Key::kId, camera_->id()} {}

  ~LibcameraDevice() override {
    if (started_) {
      // No request completes after this, so the slot can be disconnected. The streams of a removed
      // camera cannot be stopped: libcamera aborts when it tries.
      if (presence_.IsThere()) camera_->stop();
      camera_->requestCompleted.disconnect(this);
    }
    buffers_.Free();
    if (acquired_) camera_->release();
  }

  Result<void> Agree(const FormatRequest& requested) {
    const std::string where = identity_.ToString();
    if (const int failed = camera_->acquire(); failed != 0) {
      return tl::make_unexpected(LibcameraError(where, "cannot open", -failed));
    }
    acquired_ = true;
    format_.configuration = camera_->generateConfiguration({libcamera::StreamRole::Viewfinder});
    if (!format_.configuration || format_.configuration->empty()) {
      return InputError(where, "has no viewfinder stream", "choose another camera");
    }
    libcamera::StreamConfiguration& stream = format_.configuration->at(0);
    PLEINAIR_ASSIGN_OR_RETURN(const FormatChoice choice,
                              ChooseFormat(LibcameraFormats(stream.formats()), requested, where));
    stream.pixelFormat = *LibcameraFormatOf(choice.format);
    if (choice.size) {
      stream.size = {static_cast<unsigned>(choice.size->width),
                     static_cast<unsigned>(choice.size->height)};
    }
    stream.bufferCount = std::max(stream.bufferCount, kBuffers);
    if (format_.configuration->validate() == libcamera::CameraConfiguration::Invalid) {
      return InputError(where, "refuses the requested image format",
                        "request another size or format");
    }
    const auto format = PixelFormatOf(stream.pixelFormat);
    if (!format) {
      return InputError(where,
                        "sends " + stream.pixelFormat.toString() + ", which is not supported",
                        "request another format");
    }
    if (const int failed = camera_->configure(format_.configuration.get()); failed != 0) {
      return tl::make_unexpected(LibcameraError(where, "cannot set size and format", -failed));
    }
    format_.negotiated.format = *format;
    format_.negotiated.size = {static_cast<int>(stream.size.width),
                               static_cast<int>(stream.size.height)};
    Describe(stream);
    presence_ = Presence(KernelEntryOf(*manager_, camera_).value_or(""));
    node_ = NodeBehind(*manager_, camera_);
    return {};
  }

  Result<void> Start(const FormatRequest& requested) {
    const std::string where = identity_.ToString();
    libcamera::Stream* stream = format_.configuration->at(0).stream();
    buffers_.allocator = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
    if (const int count = buffers_.allocator->allocate(stream); count <= 0) {
      return tl::make_unexpected(LibcameraError(where, "cannot make buffers", -count));
    }
    for (const auto& buffer : buffers_.allocator->buffers(stream)) {
      auto request = camera_->createRequest();
      MappedPlanes planes;
      for (const auto& plane : buffer->planes()) {
        if (planes.Add(plane)) continue;
        return tl::make_unexpected(LibcameraError(where, "cannot map a buffer", errno));
      }
      if (!request || request->addBuffer(stream, buffer.get()) != 0) {
        return tl::make_unexpected(LibcameraError(where, "cannot make a request", ENOMEM));
      }
      buffers_.planes.emplace(buffer.get(), std::move(planes));
      buffers_.requests.push_back(std::move(request));
    }
    libcamera::ControlList controls(camera_->controls());
    const auto durations = camera_->controls().find(&libcamera::controls::FrameDurationLimits);
    if (requested.rate_hz && durations != camera_->controls().end()) {
      const auto duration_us = static_cast<std::int64_t>(1e6 / *requested.rate_hz);
      const std::int64_t limits[2] = {duration_us, duration_us};
      controls.set(libcamera::controls::FrameDurationLimits,
                   libcamera::Span<const std::int64_t, 2>(limits));
      format_.negotiated.rate_hz = requested.rate_hz;
    }
    format_.negotiated.details = Differences(requested, format_.negotiated);
    RememberControls();
    camera_->requestCompleted.connect(this, &LibcameraDevice::OnCompleted);
    if (const int failed = camera_->start(&controls); failed != 0) {
      camera_->requestCompleted.disconnect(this);
      return tl::make_unexpected(LibcameraError(where, "cannot start", -failed));
    }
    started_ = true;
    for (const auto& request : buffers_.requests) camera_->queueRequest(request.get());
    return {};
  }

  WaitOutcome Wait(milliseconds limit, CapturedImage* image) override {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (true) {
      const std::optional<libcamera::Request*> completed = completed_.TakeUntil(end);
      if (!completed) return WaitOutcome::kNothing;
      libcamera::Request* request = *completed;
      // The requests of a removed camera never complete; only the kernel's list of devices shows
      // it.
      if (request == nullptr)
        return presence_.IsGoneForATick() ? WaitOutcome::kGone : WaitOutcome::kNothing;
      const bool taken = Take(*request, image);
      request->reuse(libcamera::Request::ReuseBuffers);
      ApplyControlRequests(request);
      camera_->queueRequest(request);  // Fails only if the camera was removed: see above.
      if (taken) return WaitOutcome::kImage;
    }
  }

  void Wake() override { completed_.Wake(); }

  std::string StatusMessage() const override { return "the camera is gone"; }
  const NegotiatedFormat& negotiated() const override { return format_.negotiated; }
  CameraUri identity() const override { return identity_; }

  std::vector<ControlRange> Controls() override {
    std::vector<ControlRange> controls = LibcameraControls(camera_->controls());
    if (!node_) return controls;
    // The node's values are read back from the camera; libcamera has ranges only.
    std::vector<ControlRange> better = V4l2Controls(*node_);
    for (const ControlRange& range : controls) {
      const auto same = [&](const ControlRange& each) { return each.control == range.control; };
      if (std::none_of(better.begin(), better.end(), same)) better.push_back(range);
    }
    return better;
  }

  std::vector<ControlResult> LockControls(
      const std::vector<ControlRequest>& control_requests) override {
    std::vector<ControlResult> results;
    control_requests_ = std::make_unique<libcamera::ControlList>(camera_->controls());
    for (const ControlRequest& requested : control_requests) {
      // The node first: it supports reading back, white balance and focus.
      if (node_) {
        ControlResult result = LockV4l2Controls(*node_, {requested}).front();
        if (result.value) {
          results.push_back(std::move(result));
          continue;
        }
      }
      const auto& now =
          requested.control == CameraControl::kExposure ? settings_.exposure_s : settings_.gain;
      auto result =
          RequestLibcameraControl(camera_->controls(), requested, now, control_requests_.get());
      if (!result) {
        result = ControlResult{};
        result->control = requested.control;
        result->details =
            "the camera has no control of its " + std::string(NameOf(requested.control));
      }
      results.push_back(*std::move(result));
    }
    RememberControls();
    return results;
  }

 private:
  // Runs on libcamera's own thread.
  void OnCompleted(libcamera::Request* request) {
    if (request->status() != libcamera::Request::RequestCancelled) completed_.Add(request);
  }

  void Describe(const libcamera::StreamConfiguration& stream) {
    format_.layout.format = format_.negotiated.format;
    format_.layout.width = format_.negotiated.size.width;
    format_.layout.height = format_.negotiated.size.height;
    format_.layout.stride = stream.stride;
    format_.layout.full_range = format_.negotiated.format == PixelFormat::kGrey8;
    if (!stream.colorSpace) return;
    using Space = libcamera::ColorSpace;
    format_.layout.matrix = stream.colorSpace->ycbcrEncoding == Space::YcbcrEncoding::Rec709
                                ? YuvMatrix::kBt709
                                : YuvMatrix::kBt601;
    format_.layout.full_range =
        format_.layout.full_range || stream.colorSpace->range == Space::Range::Full;
  }

  /// Reads the camera's settings between images; unset under automatic control.
  void RememberControls() {
    settings_ = {};
    if (!node_) return;
    for (const ControlRange& range : V4l2Controls(*node_)) {
      if (range.is_auto) continue;
      if (range.control == CameraControl::kExposure) settings_.exposure_s = range.value;
      if (range.control == CameraControl::kGain) settings_.gain = range.value;
      if (range.control == CameraControl::kWhiteBalance) settings_.white_balance_k = range.value;
    }
  }

  void ApplyControlRequests(libcamera::Request* request) {
    if (!control_requests_ || control_requests_->empty()) return;
    request->controls().merge(*control_requests_);
    control_requests_.reset();
  }

  bool Take(libcamera::Request& request, CapturedImage* image) {
    const libcamera::FrameBuffer* buffer = request.buffers().begin()->second;
    const libcamera::FrameMetadata& facts = buffer->metadata();
    if (facts.status == libcamera::FrameMetadata::FrameCancelled) return false;
    image->arrival_ns = SteadyNow_ns();
    image->number = facts.sequence;
    const auto sensor = request.metadata().get(libcamera::controls::SensorTimestamp);
    const std::int64_t stamp_ns = sensor.value_or(static_cast<std::int64_t>(facts.timestamp));
    image->timestamp_ns = ToSteady_ns(stamp_ns, image->arrival_ns);
    // "The time when the first row of the image sensor active array is exposed" (control_ids.yaml).
    image->stamp_meaning = StampMeaning::kExposureStart;
    image->device_timestamp_ns = stamp_ns;
    const auto exposure_us = request.metadata().get(libcamera::controls::ExposureTime);
    image->settings.exposure_s =
        exposure_us ? std::optional(*exposure_us * 1e-6) : settings_.exposure_s;
    const auto gain = request.metadata().get(libcamera::controls::AnalogueGain);
    image->settings.gain = gain ? std::optional<double>(*gain) : settings_.gain;
    const auto kelvins = request.metadata().get(libcamera::controls::ColourTemperature);
    image->settings.white_balance_k =
        kelvins ? std::optional<double>(*kelvins) : settings_.white_balance_k;
    image->damaged = facts.status != libcamera::FrameMetadata::FrameSuccess;
    std::vector<std::uint8_t> bytes = std::move(image->raw.bytes);
    image->raw = format_.layout;
    bytes.clear();
    const MappedPlanes& planes = buffers_.planes.at(buffer);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const auto plane = planes.Plane(i);
      const std::size_t used = std::min<std::size_t>(facts.planes()[i].bytesused, plane.size());
      bytes.insert(bytes.end(), plane.begin(), plane.begin() + static_cast<std::ptrdiff_t>(used));
    }
    image->raw.bytes = std::move(bytes);
    return true;
  }

  // Last member destroyed.
  std::shared_ptr<libcamera::CameraManager> manager_;
  std::shared_ptr<libcamera::Camera> camera_;
  CameraUri identity_;
  bool acquired_ = false, started_ = false;
  Presence presence_;
  Format format_;
  Buffers buffers_;
  std::optional<V4l2Node> node_;
  std::unique_ptr<libcamera::ControlList> control_requests_;  ///< For the next request.
  CameraSettings settings_;  ///< As read from the camera between images.
  CompletedRequests completed_;
};

std::shared_ptr<libcamera::Camera> Find(libcamera::CameraManager& manager,
                                        const std::string& name) {
  if (auto camera = manager.get(name)) return camera;
  const bool is_number = name.size() < 4 && std::all_of(name.begin(), name.end(), [](char c) {
                           return c >= '0' && c <= '9';
                         });
  const auto cameras = manager.cameras();
  const std::size_t place = is_number ? std::strtoul(name.c_str(), nullptr, 10) : cameras.size();
  return place < cameras.size() ? cameras[place] : nullptr;
}

}  // namespace

Result<std::unique_ptr<CameraDevice>> OpenLibcameraDevice(const CameraUri& uri,
                                                          const FormatRequest& requested) {
  PLEINAIR_ASSIGN_OR_RETURN(auto manager, LibcameraManager());
  auto camera = Find(*manager, uri.value);
  if (!camera) return tl::make_unexpected(NotThere(uri.ToString()));
  auto device = std::make_unique<LibcameraDevice>(std::move(manager), std::move(camera));
  PLEINAIR_RETURN_IF_ERROR(device->Agree(requested));
  PLEINAIR_RETURN_IF_ERROR(device->Start(requested));
  return std::unique_ptr<CameraDevice>(std::move(device));
}

Result<std::vector<CameraDescription>> ListLibcameraCameras() {
  PLEINAIR_ASSIGN_OR_RETURN(const auto manager, LibcameraManager());
  std::vector<CameraDescription> cameras;
  for (const auto& camera : manager->cameras()) {
    CameraDescription description;
    description.uri = description.node = "libcamera:" + camera->id();
    description.name = camera->properties().get(libcamera::properties::Model).value_or("");
    description.driver = "libcamera";
    description.bus = camera->id();
    if (const auto configuration =
            camera->generateConfiguration({libcamera::StreamRole::Viewfinder})) {
      description.formats = LibcameraFormats(configuration->at(0).formats());
    }
    const auto node = NodeBehind(*manager, camera);
    description.controls = node ? V4l2Controls(*node) : LibcameraControls(camera->controls());
    cameras.push_back(std::move(description));
  }
  return cameras;
}

}  // namespace pleinair::devices
