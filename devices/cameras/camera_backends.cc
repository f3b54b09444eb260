#include "devices/cameras/camera_backends.h"

#include <string>
#include <utility>

#include "devices/cameras/camera_list.h"
#include "devices/cameras/v4l2/v4l2_device.h"
#include "devices/cameras/v4l2/v4l2_node.h"
#ifdef PLEINAIR_HAS_ARAVIS
#include "devices/cameras/aravis/aravis_device.h"
#endif
#ifdef PLEINAIR_HAS_LIBCAMERA
#include "devices/cameras/libcamera/libcamera_device.h"
#endif

namespace pleinair::devices {
namespace {

#ifdef PLEINAIR_HAS_ARAVIS
constexpr bool kHasAravis = true;
#else
constexpr bool kHasAravis = false;
#endif
#ifdef PLEINAIR_HAS_LIBCAMERA
constexpr bool kHasLibcamera = true;
#else
constexpr bool kHasLibcamera = false;
#endif

Error NotBuilt(const CameraUri& uri, const char* package) {
  return {ErrorKind::kInput, uri.ToString(), "this build has no support for such cameras",
          std::string("install ") + package + " and build again"};
}

}  // namespace

Result<void> CheckBackend(const CameraUri& uri) {
  switch (uri.backend) {
    case CameraUri::Backend::kFile:
      return InputError(uri.ToString(), "is a recording, no camera");
    case CameraUri::Backend::kAravis:
      if (!kHasAravis) return tl::make_unexpected(NotBuilt(uri, "libaravis-dev"));
      return {};
    case CameraUri::Backend::kLibcamera:
      if (!kHasLibcamera) return tl::make_unexpected(NotBuilt(uri, "libcamera-dev"));
      return {};
    case CameraUri::Backend::kV4l2:
      return {};
  }
  return {};
}

Result<std::unique_ptr<CameraDevice>> OpenCameraDevice(const CameraUri& uri,
                                                       const FormatRequest& requested) {
  PLEINAIR_RETURN_IF_ERROR(CheckBackend(uri));
#ifdef PLEINAIR_HAS_ARAVIS
  if (uri.backend == CameraUri::Backend::kAravis) return OpenAravisDevice(uri, requested);
#endif
#ifdef PLEINAIR_HAS_LIBCAMERA
  if (uri.backend == CameraUri::Backend::kLibcamera) return OpenLibcameraDevice(uri, requested);
#endif
  return OpenV4l2Device(SystemV4l2Io(), uri, requested);
}

CameraList ListCameras([[maybe_unused]] bool search_network) {
  CameraList list;
  list.cameras = ListV4l2Cameras(SystemV4l2Io());
  list.backends = {
      {"v4l2", true, ""}, {"libcamera", kHasLibcamera, ""}, {"aravis", kHasAravis, ""}};
  [[maybe_unused]] const auto append = [&](Result<std::vector<CameraDescription>> found,
                                           CameraBackendState* backend) {
    if (!found) {
      backend->trouble = found.error().what;
      return;
    }
    for (CameraDescription& camera : *found) list.cameras.push_back(std::move(camera));
  };
#ifdef PLEINAIR_HAS_LIBCAMERA
  append(ListLibcameraCameras(), &list.backends[1]);
#endif
#ifdef PLEINAIR_HAS_ARAVIS
  if (search_network) append(ListAravisCameras(), &list.backends[2]);
#endif
  return list;
}

}  // namespace pleinair::devices
