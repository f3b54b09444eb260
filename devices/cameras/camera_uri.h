#pragma once

#include <string>
#include <string_view>

#include "base/error.h"

namespace pleinair::devices {

/// Identifies a camera: "v4l2:/dev/video0", "v4l2:serial=…", "v4l2:bus=…", "libcamera:ID",
/// "aravis:ID", "file:PATH".
struct CameraUri {
  enum class Backend { kV4l2, kLibcamera, kAravis, kFile };
  enum class Key { kNode, kSerial, kBus, kId, kPath };

  Backend backend = Backend::kV4l2;
  Key key = Key::kNode;
  std::string value;

  std::string ToString() const;
  bool operator==(const CameraUri&) const = default;
};

/// Errors: an unknown backend (the message lists the known ones); nothing after the colon; a V4L2
/// name that is none of a node below /dev, serial= and bus=.
Result<CameraUri> ParseCameraUri(std::string_view text);

}  // namespace pleinair::devices
