#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "base/vector.h"

namespace pleinair::accuracy {

/// Pose of a painted hand. Hand coordinates: unit is the palm's width, origin its centre, y along
/// the fingers.
struct HandPlace {
  Vec2 palm_px;  ///< Centre of the palm.
  double palm_width_px = 0;
  double turn = 0;  ///< Direction of the fingers, clockwise from the image's upward direction, rad.
  double spread = 0;  ///< Spread of the fingers: 0 closed … 1 wide apart.
};

/// Paints a right hand with its forearm and soft shadow over an sRGB image (BGR). The hand is a
/// union of round cones, shaded as skin by the sun from the upper left. It is deterministic.
/// Returns the coverage of each pixel by the hand without its shadow, 0…1 (CV_32F).
cv::Mat PaintHand(const HandPlace& place, cv::Mat* bgr);

/// A hand that enters from the lower right, crosses a marker and leaves, at fraction 0…1 of its
/// trajectory. `middle_px`: the marker's centre; `side_px`: its apparent size.
HandPlace PassingHand(double share, Vec2 middle_px, double side_px);

}  // namespace pleinair::accuracy
