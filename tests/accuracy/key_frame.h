#pragma once

#include <opencv2/core.hpp>

namespace pleinair::accuracy {

/// A frame of the bundled recording for which it has a true picture.
struct KeyFrame {
  cv::Mat background, truth;    ///< sRGB, BGR: without and with the object.
  cv::Mat object_mask, shadow;  ///< How much of a pixel the object covers; where it takes light.
};

KeyFrame ReadKeyFrame(int frame);

/// Mean CIEDE2000 against the truth.
struct Score {
  double object = 0.0;  ///< Where the object covers more than half of a pixel.
  double shadow = 0.0;  ///< Where it takes more than 4 % of the light, itself excluded.
  double around = 0.0;  ///< Both with 25 pixels around them.
};

/// `leave_out`: where it is not zero nothing is compared; may be empty.
Score Compare(const cv::Mat& picture, const KeyFrame& key, const cv::Mat& leave_out = {});

}  // namespace pleinair::accuracy
