#include "tracker/surf_golay/sg_patterns.h"

#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {

SgPatterns::SgPatterns() : blank_(SgMarkerPatternOfWord(0)) {}

const MarkerPattern& SgPatterns::OfNumber(int number) {
  if (number != last_number_) {
    last_ = SgMarkerPattern(number);
    last_number_ = number;
  }
  return last_;
}

}  // namespace pleinair::tracker
