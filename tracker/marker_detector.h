#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.h"
#include "tracker/print_pattern.h"
#include "tracker/sighting.h"

namespace pleinair::tracker {

/// A marker whose number has been read and whose corners are known to about half a pixel.
struct Candidate {
  MarkerDetection detection;
  std::shared_ptr<const PrintPattern> pattern;  ///< The print that carries this number.
};

/// One way to find markers. One thread at a time.
class MarkerDetector {
 public:
  virtual ~MarkerDetector() = default;

  /// Markers in one sRGB-encoded grey picture of any size, in no particular order; the same
  /// picture gives the same list.
  virtual std::vector<Candidate> Detect(ImageView<const std::uint8_t> grey) = 0;
};

}  // namespace pleinair::tracker
