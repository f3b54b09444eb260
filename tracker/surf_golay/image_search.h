#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstddef>
#include <optional>
#include <vector>

#include "tracker/surf_golay/found_markers.h"
#include "tracker/surf_golay/sg_reader.h"
#include "tracker/surf_golay/upright_test.h"

namespace pleinair::tracker {

/// State shared by all search methods on one image: decoder, orientation test and results.
struct ImageSearch {
  explicit ImageSearch(const LensGrid& lens) : reader(lens), upright(lens) {}

  /// Starts without markers; `grey` is kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);

  bool Add(const SgReading& reading, DetectionPath path) {
    return found.Add(reading, path, reader.UnreadBorders());
  }
  /// Decodes a hypothesis that is accurate already, with the confidence from the border observed
  /// there.
  std::optional<SgReading> DecodeAsGuessed(const BlockFitState& guess);

  /// Markers whose number could not be decoded although their border is certain: it is open, and
  /// matches pixel by pixel in this orientation alone. The readings' number has no meaning.
  std::vector<FoundMarker> UnreadMarkers();

  SgReader reader;
  UprightTest upright;
  FoundMarkers found;
  std::size_t unread_by_quads = 0;  ///< The first unread borders, which the fast path found.
};

}  // namespace pleinair::tracker
