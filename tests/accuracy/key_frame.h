#pragma once

#include <opencv2/core.hpp>

namespace pleinair::accuracy {

/// A frame of the bundled recording with a ground-truth image.
struct KeyFrame {
  cv::Mat background, truth;    ///< sRGB, BGR: without and with the object.
  cv::Mat object_mask, shadow;  ///< Coverage by the object; region that it darkens.
};

KeyFrame ReadKeyFrame(int frame);

/// Mean CIEDE2000 difference from the ground truth.
struct Score {
  double object = 0.0;  ///< Pixels that the object covers by more than half.
  double shadow = 0.0;  ///< Pixels where the object removes more than 4 % of the light, without the
                        ///< object itself.
  double around = 0.0;  ///< Both regions with 25 pixels around them.
};

/// `leave_out`: pixels that are not zero are ignored; may be empty.
Score Compare(const cv::Mat& picture, const KeyFrame& key, const cv::Mat& leave_out = {});

}  // namespace pleinair::accuracy
