#pragma once

// Internal: between the .cc files of this module; not installed.

#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// The marker bit patterns that a reader compares with an image. Keeps the last one of a number:
/// consecutive fits are mostly of the same marker.
class SgPatterns {
 public:
  SgPatterns();

  /// The border, with cells that are not known.
  const MarkerPattern& blank() const { return blank_; }
  /// Valid until the pattern of another number is asked for.
  const MarkerPattern& OfNumber(int number);

 private:
  MarkerPattern blank_;
  MarkerPattern last_;
  int last_number_ = -1;
};

}  // namespace pleinair::tracker
