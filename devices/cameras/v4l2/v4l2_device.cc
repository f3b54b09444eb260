#include "devices/cameras/v4l2/v4l2_device.h"

#include <linux/videodev2.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "devices/cameras/v4l2/v4l2_controls.h"
#include "devices/cameras/v4l2/v4l2_negotiation.h"
#include "devices/cameras/v4l2/v4l2_node.h"
#include "devices/cameras/v4l2/v4l2_status.h"

namespace pleinair::devices {
namespace {

// Enough for a thread that is delayed by a hundred milliseconds at 30 Hz; drivers may allocate
// more.
constexpr __u32 kBuffers = 4;

class V4l2Device : public CameraDevice {
 public:
  V4l2Device(V4l2Node node, V4l2NegotiatedFormat negotiated, CameraUri identity)
      : node_(std::move(node)),
        negotiated_(std::move(negotiated)),
        identity_(std::move(identity)),
        wake_fd_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

  ~V4l2Device() override {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (streaming_) node_.Control(VIDIOC_STREAMOFF, &type);
    for (const Buffer& buffer : buffers_) node_.io().Unmap(buffer.address, buffer.length);
    if (wake_fd_ >= 0) close(wake_fd_);
  }

  Result<void> Start() {
    const auto fail = [&](const char* doing, int result) {
      return tl::make_unexpected(V4l2Error(node_.path(), doing, -result));
    };
    v4l2_requestbuffers request{};
    request.count = kBuffers;
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    int result = node_.Control(VIDIOC_REQBUFS, &request);
    if (result < 0) return fail("cannot get buffers", result);
    for (__u32 i = 0; i < request.count; ++i) {
      v4l2_buffer buffer = BufferNumber(i);
      result = node_.Control(VIDIOC_QUERYBUF, &buffer);
      if (result < 0) return fail("cannot query a buffer", result);
      void* address = node_.io().Map(node_.fd(), buffer.length, buffer.m.offset);
      if (address == nullptr) return fail("cannot map a buffer", -ENOMEM);
      buffers_.push_back({static_cast<std::uint8_t*>(address), buffer.length});
      result = node_.Control(VIDIOC_QBUF, &buffer);
      if (result < 0) return fail("cannot queue a buffer", result);
    }
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    result = node_.Control(VIDIOC_STREAMON, &type);
    if (result < 0) return fail("cannot start the stream", result);
    streaming_ = true;
    RememberLockedControls();
    return {};
  }

  WaitOutcome Wait(std::chrono::milliseconds limit, CapturedImage* image) override {
    const int events = node_.io().Poll(node_.fd(), wake_fd_, static_cast<int>(limit.count()));
    if (events == 0) return WaitOutcome::kNothing;
    if (events < 0) return Gone(-events);
    v4l2_buffer buffer = BufferNumber(0);
    const int result = node_.Control(VIDIOC_DQBUF, &buffer);
    // POLLERR alone may be spurious; POLLHUP is final, whatever the call returns.
    if (result == -EAGAIN && (events & (POLLHUP | POLLNVAL | POLLERR)) == 0) {
      return WaitOutcome::kNothing;
    }
    if (result < 0) return Gone(result == -EAGAIN ? ENODEV : -result);
    if (buffer.index >= buffers_.size()) return Gone(EIO);
    Take(buffer, image);
    const int queued = node_.Control(VIDIOC_QBUF, &buffer);
    if (queued < 0) return Gone(-queued);
    return WaitOutcome::kImage;
  }

  void Wake() override {
    const std::uint64_t one = 1;
    // A full counter also wakes.
    if (write(wake_fd_, &one, sizeof one) < 0) return;
  }

  std::string StatusMessage() const override { return status_message_; }
  const NegotiatedFormat& negotiated() const override { return negotiated_.reported; }
  CameraUri identity() const override { return identity_; }
  std::vector<ControlRange> Controls() override { return V4l2Controls(node_); }

  std::vector<ControlResult> LockControls(
      const std::vector<ControlRequest>& control_requests) override {
    auto results = LockV4l2Controls(node_, control_requests);
    RememberLockedControls();
    return results;
  }

 private:
  struct Buffer {
    std::uint8_t* address;
    std::size_t length;
  };

  static v4l2_buffer BufferNumber(__u32 index) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    return buffer;
  }

  WaitOutcome Gone(int error_number) {
    status_message_ = V4l2Error(node_.path(), "the stream ended", error_number).what;
    return WaitOutcome::kGone;
  }

  // Only locked values are known for every frame; reading values under automatic control costs a
  // USB transfer each time.
  void RememberLockedControls() {
    locked_ = {};
    bool exposure_is_auto = false;
    for (const ControlRange& range : Controls()) {
      if (range.control == CameraControl::kExposure) exposure_is_auto = range.is_auto;
      if (range.is_auto) continue;
      if (range.control == CameraControl::kExposure) locked_.exposure_s = range.value;
      // USB cameras have no separate automatic gain: it may follow the exposure.
      if (range.control == CameraControl::kGain && !exposure_is_auto) locked_.gain = range.value;
      if (range.control == CameraControl::kWhiteBalance) locked_.white_balance_k = range.value;
    }
  }

  void Take(const v4l2_buffer& buffer, CapturedImage* image) {
    image->arrival_ns = SteadyNow_ns();
    // The driver's number has 32 bits.
    if (last_number_ >= 0) {
      last_number_ += static_cast<std::int32_t>(buffer.sequence -
                                                static_cast<__u32>(last_number_ & 0xFFFFFFFF));
    } else {
      last_number_ = buffer.sequence;
    }
    image->number = last_number_;
    const std::int64_t stamp_ns =
        buffer.timestamp.tv_sec * std::int64_t{1'000'000'000} + buffer.timestamp.tv_usec * 1000L;
    // On Linux std::chrono::steady_clock is CLOCK_MONOTONIC and no other clock.
    const bool steady =
        (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    const bool start =
        (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
    image->timestamp_ns = steady ? stamp_ns : image->arrival_ns;
    image->stamp_meaning = !steady ? StampMeaning::kArrival
                           : start ? StampMeaning::kExposureStart
                                   : StampMeaning::kExposureEnd;
    image->device_timestamp_ns = stamp_ns;
    image->settings = locked_;
    image->damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
    const Buffer& from = buffers_[buffer.index];
    const std::size_t used = std::min<std::size_t>(buffer.bytesused, from.length);
    std::vector<std::uint8_t> bytes = std::move(image->raw.bytes);
    bytes.assign(from.address, from.address + used);
    image->raw = negotiated_.layout;
    image->raw.bytes = std::move(bytes);
  }

  V4l2Node node_;
  V4l2NegotiatedFormat negotiated_;
  CameraUri identity_;
  int wake_fd_;
  std::vector<Buffer> buffers_;
  bool streaming_ = false;
  std::int64_t last_number_ = -1;
  CameraSettings locked_;
  std::string status_message_;
};

}  // namespace

Result<std::unique_ptr<CameraDevice>> OpenV4l2Device(const std::shared_ptr<V4l2Io>& io,
                                                     const CameraUri& uri,
                                                     const FormatRequest& requested) {
  PLEINAIR_ASSIGN_OR_RETURN(const V4l2Io::Node found, FindV4l2Node(io, uri));
  PLEINAIR_ASSIGN_OR_RETURN(V4l2Node node, V4l2Node::Open(io, found.path));
  PLEINAIR_ASSIGN_OR_RETURN(V4l2NegotiatedFormat negotiated, AgreeOnPictures(node, requested));
  CameraUri identity = V4l2Identity(io, node);
  auto device = std::make_unique<V4l2Device>(std::move(node), std::move(negotiated), identity);
  PLEINAIR_RETURN_IF_ERROR(device->Start());
  return std::unique_ptr<CameraDevice>(std::move(device));
}

}  // namespace pleinair::devices
