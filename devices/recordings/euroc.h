#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/frames.h"

namespace pleinair::devices {

/// The frame of EuRoC's ground truth, "S" in its papers: that of the inertial sensor.
struct EurocBody;

/// A line of a EuRoC data.csv: "timestamp [ns],filename".
struct EurocFrame {
  std::int64_t timestamp_ns = 0;
  std::string file;  ///< File name only, in the folder data/ next to the table.
};

/// Parses the frames of a data.csv; comment lines begin with '#'. Errors: a line that is not a time
/// stamp and a bare file name; stamps that do not ascend; no frames.
Result<std::vector<EurocFrame>> ParseEurocTable(std::string_view bytes, const std::string& name);

/// `rate_hz` of a sensor.yaml; nullopt unless present and positive.
Result<std::optional<double>> ParseEurocRate(std::string_view bytes, const std::string& name);

/// `T_BS` of a camera's sensor.yaml. Errors: missing, not 4×4, or not a rigid transform.
Result<Transform<EurocBody, Camera>> ParseEurocExtrinsics(std::string_view bytes,
                                                          const std::string& name);

}  // namespace pleinair::devices
