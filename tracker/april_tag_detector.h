#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "tracker/marker_detector.h"

namespace pleinair::tracker {

/// Names of the supported AprilTag families.
std::vector<std::string> AprilTagFamilyNames();

/// Bit pattern of one marker of a family; null if there is no such family or id.
std::shared_ptr<const MarkerPattern> AprilTagPattern(std::string_view family, int id);

/// Detector of AprilTag 3 (Krogius, Haggenmiller, Olson 2019) on the full image. `families`: names
/// from AprilTagFamilyNames(); others are an error.
Result<std::unique_ptr<MarkerDetector>> CreateAprilTagDetector(
    const std::vector<std::string>& families);

}  // namespace pleinair::tracker
