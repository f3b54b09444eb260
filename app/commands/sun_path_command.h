#pragma once

#include <optional>
#include <string>

#include "app/options/local_time.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

constexpr int kMinSunPath_px = 200;
constexpr int kMaxSunPath_px = 8'000;

/// The diagram of `pleinair sun --path`.
struct SunPathOptions {
  std::string file;  ///< Its extension selects the format: .svg or .png.
  int year = 0;
  UtcOffset offset;
  sky::SunModel model = sky::SunModel::kPrecise;
  std::optional<UtcTime> moment;
  int size_px = 1200;
  bool json = false;  ///< Report the drawing on standard output.
};

/// Writes the diagram of app/sun/sun_path_diagram.h under a temporary name and renames it. Errors
/// (input): another extension; as WriteError.
Result<void> WriteSunPath(const sky::Observer& observer, const SunPathOptions& options);

}  // namespace pleinair::app
