#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "base/vector.h"

namespace pleinair::accuracy {

/// Where a painted hand is. Its own coordinates: the unit is the palm's width, the origin the
/// middle of the palm, y along the fingers.
struct HandPlace {
  Vec2 palm_px;  ///< Middle of the palm.
  double palm_width_px = 0;
  double turn = 0;    ///< Of the fingers from the picture's upward direction, clockwise, rad.
  double spread = 0;  ///< Of the fingers: 0 closed … 1 wide apart.
};

/// Paints a right hand with its forearm, and the soft shadow beside it, over an sRGB picture (BGR):
/// a union of round cones, shaded as skin by the sun from the upper left. Nothing is random.
/// Returns how much of each pixel the hand covers, 0…1 (CV_32F); the shadow does not count.
cv::Mat PaintHand(const HandPlace& place, cv::Mat* bgr);

/// A hand that comes in from the lower right, passes over a marker and goes out again, at a share
/// 0…1 of its way. `middle_px`: where the marker is; `side_px`: how large it looks.
HandPlace PassingHand(double share, Vec2 middle_px, double side_px);

}  // namespace pleinair::accuracy
