#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Bit patterns that a decoder compares with an image. Caches the last one, because consecutive
/// fits are mostly of the same marker.
class SgPatterns {
 public:
  SgPatterns();

  /// The border, with unknown cells.
  const MarkerPattern& blank() const { return blank_; }
  /// Valid until the next call with another number.
  const MarkerPattern& OfNumber(int number);

 private:
  MarkerPattern blank_;
  MarkerPattern last_;
  int last_number_ = -1;
};

}  // namespace pleinair::tracker
