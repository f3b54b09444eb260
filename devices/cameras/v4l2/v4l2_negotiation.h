#pragma once

// Internal: between the .cc files of this module; not installed.

#include "devices/cameras/camera.h"
#include "devices/cameras/v4l2/v4l2_node.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

struct V4l2NegotiatedFormat {
  NegotiatedFormat reported;  ///< What was agreed, and each difference from the wish.
  RawImage layout;            ///< The same as an image without bytes.
};

/// Sets format, size and rate as near to the wish as the device goes and reads back what it took.
Result<V4l2NegotiatedFormat> AgreeOnPictures(const V4l2Node& node, const FormatRequest& requested);

}  // namespace pleinair::devices
