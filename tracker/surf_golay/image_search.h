#pragma once

// Internal: between the .cc files of this module; not installed.

#include <optional>

#include "tracker/surf_golay/found_markers.h"
#include "tracker/surf_golay/sg_reader.h"
#include "tracker/surf_golay/upright_test.h"

namespace pleinair::tracker {

/// What all ways to find markers in one image share: they read guesses, test which way round the
/// markers lie, and keep what they found.
struct ImageSearch {
  explicit ImageSearch(const LensGrid& lens) : reader(lens), upright(lens) {}

  /// Starts with no marker found; `grey` is kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);

  bool Add(const SgReading& reading, DetectionPath path) {
    return found.Add(reading, path, reader.UnreadBorders());
  }
  /// A reading from a guess that is good already, proved by what is observed of the border at its
  /// place.
  std::optional<SgReading> DecodeAsGuessed(const BlockFitState& guess);

  SgReader reader;
  UprightTest upright;
  FoundMarkers found;
};

}  // namespace pleinair::tracker
