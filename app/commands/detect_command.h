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
  std::vector<std::string> families{"sg", "tag36h11"};  ///< Which markers to look for.
  bool track = false;                                   ///< The pictures are consecutive frames.
  std::string strategy = "hybrid";   ///< For S-G markers: hybrid, fast or surf-golay.
  std::vector<std::string> numbers;  ///< S-G numbers in use ("17", "0-49"); none: all.
  std::vector<std::string> targets;  ///< Target files ('pleinair target').
};

/// Looks for markers in each picture and writes one JSON line a picture to `out`. Every picture is
/// inspected before the first line is written, so that a wrong name costs no results.
/// Errors: a picture or the calibration that cannot be read, a picture of another size than the
/// calibration's, a size that is not positive, an unknown family, a target file that is none.
Result<void> RunDetect(const DetectArguments& arguments, std::ostream& out);

}  // namespace pleinair::app
