#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/frames.h"

namespace pleinair::devices {

/// The frame that EuRoC's ground truth follows, "S" in its papers: the inertial sensor's.
struct EurocBody;

/// A line of a EuRoC data.csv: "timestamp [ns],filename".
struct EurocFrame {
  std::int64_t timestamp_ns = 0;
  std::string file;  ///< A bare name, in the folder data/ beside the table.
};

/// The frames of a data.csv; comment lines begin with '#'.
/// Errors: a line that is not a time stamp and a bare file name, stamps that do not ascend, no
/// frames at all.
Result<std::vector<EurocFrame>> ParseEurocTable(std::string_view bytes, const std::string& name);

/// `rate_hz` of a sensor.yaml, where it is there and positive.
Result<std::optional<double>> ParseEurocRate(std::string_view bytes, const std::string& name);

/// `T_BS` of a camera's sensor.yaml. Errors: it is not there, not 4×4, or no rigid motion.
Result<Transform<EurocBody, Camera>> ParseEurocExtrinsics(std::string_view bytes,
                                                          const std::string& name);

}  // namespace pleinair::devices
