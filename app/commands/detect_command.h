#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

struct DetectArguments {
  std::vector<std::string> pictures;
  std::string calibration;
  double size_mm = 0.0;  ///< Edge of the outer black square; 0 with targets: no markers.
  std::vector<std::string> families{"sg", "tag36h11"};  ///< Markers to detect.
  bool track = false;                                   ///< The images are consecutive frames.
  std::string strategy = "hybrid";   ///< For S-G markers: hybrid, fast or surf-golay.
  std::vector<std::string> numbers;  ///< S-G numbers in use ("17", "0-49"); none: all.
  std::vector<std::string> targets;  ///< Target files ('pleinair target').
};

/// Detects markers in each image and writes one JSON line per image to `out`. Every image is
/// checked before the first line is written, so that a wrong name costs no results.
/// Errors: an image or calibration that cannot be read, an image of another size than the
/// calibration's. Also a marker size that is not positive, an unknown family, an invalid target
/// file.
Result<void> RunDetect(const DetectArguments& arguments, std::ostream& out);

}  // namespace pleinair::app
