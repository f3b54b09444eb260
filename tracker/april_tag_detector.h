#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "tracker/marker_detector.h"

namespace pleinair::tracker {

/// Names of the AprilTag families that can be looked for.
std::vector<std::string> AprilTagFamilyNames();

/// The marker of one number of a family; null where there is no such family or number.
std::shared_ptr<const MarkerPattern> AprilTagPattern(std::string_view family, int id);

/// The fast path: AprilTag 3 (Krogius, Haggenmiller, Olson 2019) on the full image. `families`
/// are names out of AprilTagFamilyNames(); others are an error.
Result<std::unique_ptr<MarkerDetector>> CreateAprilTagDetector(
    const std::vector<std::string>& families);

}  // namespace pleinair::tracker
