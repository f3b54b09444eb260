#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include "devices/cameras/camera.h"
#include "devices/cameras/v4l2/v4l2_node.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

struct V4l2NegotiatedFormat {
  NegotiatedFormat reported;  ///< The negotiated format, and each difference from the request.
  RawImage layout;            ///< The same as an image without bytes.
};

/// Sets format, size and rate as close to the request as the device allows, and reads back the
/// result.
Result<V4l2NegotiatedFormat> AgreeOnPictures(const V4l2Node& node, const FormatRequest& requested);

}  // namespace pleinair::devices
