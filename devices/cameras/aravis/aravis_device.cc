#include "devices/cameras/aravis/aravis_device.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "devices/cameras/aravis/aravis_camera.h"
#include "devices/cameras/aravis/aravis_handles.h"
#include "devices/cameras/aravis/gige_probe.h"
#include "devices/cameras/format_choice.h"

namespace pleinair::devices {
namespace {

constexpr int kBuffers = 8;

Error NotThere(const std::string& where) {
  return {ErrorKind::kInput, where, "there is no such camera (any more)",
          "plug it in; 'pleinair devices --network' lists what answers"};
}

Error Taken(const std::string& where, const std::string& doing) {
  return {ErrorKind::kInput, where, doing + ": another program controls the camera",
          "close that program"};
}

Error AravisError(const std::string& where, const std::string& doing, const GErrorSlot& error) {
  if (error.Is(ARV_DEVICE_ERROR_NOT_FOUND)) return NotThere(where);
  if (error.Is(ARV_DEVICE_ERROR_NOT_CONTROLLER)) return Taken(where, doing);
  return {ErrorKind::kSystem, where, doing + ": " + error.details(),
          "check that the camera and this machine are in one network"};
}

class AravisDevice : public CameraDevice {
 public:
  AravisDevice(GObjectPtr<ArvCamera> camera, CameraUri identity)
      : camera_(std::move(camera)), identity_(std::move(identity)) {}

  // If the camera is gone, stopping waits for answers that never arrive: 2.5 to 3 s.
  ~AravisDevice() override {
    g_signal_handlers_disconnect_by_data(arv_camera_get_device(camera_.get()), this);
    GErrorSlot error;
    if (started_) arv_camera_stop_acquisition(camera_.get(), error.Fresh());
  }

  Result<void> Agree(const FormatRequest& requested) {
    const std::string where = identity_.ToString();
    PLEINAIR_ASSIGN_OR_RETURN(const FormatChoice choice,
                              ChooseFormat(AravisFormats(camera_.get()), requested, where));
    GErrorSlot error;
    arv_camera_set_pixel_format(camera_.get(), AravisFormatOf(choice.format)->theirs,
                                error.Fresh());
    if (error.failed()) {
      return tl::make_unexpected(AravisError(where, "cannot set the pixel format", error));
    }
    if (requested.size) {
      arv_camera_set_region(camera_.get(), 0, 0, requested.size->width, requested.size->height,
                            error.Fresh());
    }
    if (requested.rate_hz)
      arv_camera_set_frame_rate(camera_.get(), *requested.rate_hz, error.Fresh());
    gint x = 0, y = 0;
    arv_camera_get_region(camera_.get(), &x, &y, &negotiated_.size.width, &negotiated_.size.height,
                          error.Fresh());
    const double rate_hz = arv_camera_get_frame_rate(camera_.get(), error.Fresh());
    if (!error.failed() && rate_hz > 0.0) negotiated_.rate_hz = rate_hz;
    negotiated_.format = choice.format;
    negotiated_.details = Differences(requested, negotiated_);
    return {};
  }

  Result<void> Start() {
    const std::string where = identity_.ToString();
    GErrorSlot error;
    if (arv_camera_is_gv_device(camera_.get()) != FALSE) {
      // The network silently drops packets that are too large.
      arv_camera_gv_auto_packet_size(camera_.get(), error.Fresh());
      transport_.packet_size =
          static_cast<int>(arv_camera_gv_get_packet_size(camera_.get(), error.Fresh()));
    }
    stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, error.Fresh()));
    if (!stream_) return tl::make_unexpected(AravisError(where, "cannot open a stream", error));
    const guint payload = arv_camera_get_payload(camera_.get(), error.Fresh());
    if (error.failed()) {
      return tl::make_unexpected(AravisError(where, "cannot query the image size", error));
    }
    for (int i = 0; i < kBuffers; ++i) {
      arv_stream_push_buffer(stream_.get(), arv_buffer_new_allocate(payload));
    }
    g_signal_connect(arv_camera_get_device(camera_.get()), "control-lost",
                     G_CALLBACK(&AravisDevice::OnControlLost), this);
    OpenProbe();
    RememberControls();
    arv_camera_start_acquisition(camera_.get(), error.Fresh());
    if (error.failed()) return tl::make_unexpected(AravisError(where, "cannot start", error));
    started_ = true;
    return {};
  }

  WaitOutcome Wait(std::chrono::milliseconds limit, CapturedImage* image) override {
    if (control_lost_) return WaitOutcome::kGone;
    ArvBuffer* buffer = arv_stream_timeout_pop_buffer(
        stream_.get(), static_cast<guint64>(std::chrono::microseconds(limit).count()));
    if (buffer == nullptr) {
      const bool gone = control_lost_ || (probe_ && probe_->IsRefused());
      return gone ? WaitOutcome::kGone : WaitOutcome::kNothing;
    }
    Take(buffer, image);
    arv_stream_push_buffer(stream_.get(), buffer);
    return WaitOutcome::kImage;
  }

  // Waits are short, and Aravis cannot interrupt one.
  void Wake() override {}

  std::string StatusMessage() const override { return "the camera no longer responds"; }
  const NegotiatedFormat& negotiated() const override { return negotiated_; }
  CameraUri identity() const override { return identity_; }

  std::optional<TransportCounts> Transport() override {
    guint64 completed = 0, failures = 0, underruns = 0, resent = 0, missing = 0;
    arv_stream_get_statistics(stream_.get(), &completed, &failures, &underruns);
    if (ARV_IS_GV_STREAM(stream_.get())) {
      arv_gv_stream_get_statistics(ARV_GV_STREAM(stream_.get()), &resent, &missing);
    }
    transport_.completed = static_cast<std::int64_t>(completed);
    transport_.damaged = static_cast<std::int64_t>(failures);
    transport_.underruns = static_cast<std::int64_t>(underruns);
    transport_.resent_packets = static_cast<std::int64_t>(resent);
    transport_.missing_packets = static_cast<std::int64_t>(missing);
    return transport_;
  }

  std::vector<ControlRange> Controls() override { return AravisControls(camera_.get()); }
  std::vector<ControlResult> LockControls(
      const std::vector<ControlRequest>& control_requests) override {
    auto results = LockAravisControls(camera_.get(), control_requests);
    RememberControls();
    return results;
  }

 private:
  static void OnControlLost(ArvDevice*, AravisDevice* self) { self->control_lost_ = true; }

  void OpenProbe() {
    ArvDevice* device = arv_camera_get_device(camera_.get());
    if (!ARV_IS_GV_DEVICE(device)) return;
    GSocketAddress* address = arv_gv_device_get_device_address(ARV_GV_DEVICE(device));
    sockaddr_in native{};
    GErrorSlot error;
    if (g_socket_address_get_native_size(address) == sizeof native &&
        g_socket_address_to_native(address, &native, sizeof native, error.Fresh()) != FALSE) {
      probe_ = std::make_unique<GigeProbe>(native);
    }
  }

  void RememberControls() {
    settings_ = {};
    for (const ControlRange& range : Controls()) {
      if (range.is_auto) continue;
      (range.control == CameraControl::kExposure ? settings_.exposure_s : settings_.gain) =
          range.value;
    }
  }

  void Take(ArvBuffer* buffer, CapturedImage* image) {
    image->arrival_ns = SteadyNow_ns();
    // GigE Vision numbers frames from 1 to 65535, without 0.
    const auto id = static_cast<std::int64_t>(arv_buffer_get_frame_id(buffer));
    constexpr std::int64_t kNumbers = 65535;
    const bool wrapped = id < last_id_ && last_id_ <= kNumbers && last_id_ - id > kNumbers / 2;
    number_ += last_id_ < 0 ? 0 : wrapped ? id - last_id_ + kNumbers : id - last_id_;
    last_id_ = id;
    image->number = number_;
    // Aravis' time stamp is on the wall clock: convert it by the present difference of the clocks.
    const std::int64_t wall_ns = g_get_real_time() * 1000;
    const auto stamp_ns = static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer));
    image->timestamp_ns = stamp_ns - wall_ns + image->arrival_ns;
    image->stamp_meaning = StampMeaning::kArrival;
    image->device_timestamp_ns = static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer));
    image->settings = settings_;
    image->damaged = arv_buffer_get_status(buffer) != ARV_BUFFER_STATUS_SUCCESS;
    image->raw.bytes.clear();
    if (image->damaged) return;
    const auto format = AravisFormatOf(arv_buffer_get_image_pixel_format(buffer));
    std::size_t size = 0;
    const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &size));
    gint x_padding = 0, y_padding = 0;
    arv_buffer_get_image_padding(buffer, &x_padding, &y_padding);
    image->raw.format = format ? format->ours : negotiated_.format;
    image->raw.width = arv_buffer_get_image_width(buffer);
    image->raw.height = arv_buffer_get_image_height(buffer);
    image->raw.stride = TightStride(image->raw.format, image->raw.width) +
                        static_cast<std::size_t>(std::max(x_padding, 0));
    image->raw.full_range = true;
    image->raw.bytes.assign(data, data + size);
    image->damaged = !format;
  }

  GObjectPtr<ArvCamera> camera_;
  GObjectPtr<ArvStream> stream_;
  CameraUri identity_;
  NegotiatedFormat negotiated_;
  TransportCounts transport_;
  bool started_ = false;
  std::unique_ptr<GigeProbe> probe_;  ///< Null for cameras on USB.
  std::atomic<bool> control_lost_ = false;
  std::int64_t last_id_ = -1;
  std::int64_t number_ = 0;
  CameraSettings settings_;
};

std::string Text(const char* text) { return text == nullptr ? "" : text; }

}  // namespace

Result<std::unique_ptr<CameraDevice>> OpenAravisDevice(const CameraUri& uri,
                                                       const FormatRequest& requested) {
  GErrorSlot error;
  // Try the last address first: discovery on all networks takes a second.
  GObjectPtr<ArvCamera> camera(arv_camera_new(uri.value.c_str(), error.Fresh()));
  if (!camera) {
    arv_update_device_list();
    camera.reset(arv_camera_new(uri.value.c_str(), error.Fresh()));
  }
  if (!camera) {
    return tl::make_unexpected(error.failed() ? AravisError(uri.ToString(), "cannot open", error)
                                              : NotThere(uri.ToString()));
  }
  ArvDevice* opened = arv_camera_get_device(camera.get());
  if (ARV_IS_GV_DEVICE(opened) && arv_gv_device_is_controller(ARV_GV_DEVICE(opened)) == FALSE) {
    return tl::make_unexpected(Taken(uri.ToString(), "cannot open"));
  }
  auto device = std::make_unique<AravisDevice>(std::move(camera), uri);
  PLEINAIR_RETURN_IF_ERROR(device->Agree(requested));
  PLEINAIR_RETURN_IF_ERROR(device->Start());
  return std::unique_ptr<CameraDevice>(std::move(device));
}

Result<std::vector<CameraDescription>> ListAravisCameras() {
  arv_update_device_list();
  std::vector<CameraDescription> cameras;
  for (guint i = 0; i < arv_get_n_devices(); ++i) {
    CameraDescription description;
    const std::string id = Text(arv_get_device_id(i));
    description.uri = description.node = "aravis:" + id;
    description.name = Text(arv_get_device_vendor(i)) + " " + Text(arv_get_device_model(i));
    description.driver = "aravis";
    description.bus = Text(arv_get_device_protocol(i)) + " " + Text(arv_get_device_address(i));
    description.serial = Text(arv_get_device_serial_nbr(i));
    GErrorSlot error;
    const GObjectPtr<ArvCamera> camera(arv_camera_new(id.c_str(), error.Fresh()));
    if (camera) {
      description.formats = AravisFormats(camera.get());
      description.controls = AravisControls(camera.get());
    } else {
      description.trouble = error.details();
    }
    cameras.push_back(std::move(description));
  }
  return cameras;
}

}  // namespace pleinair::devices
