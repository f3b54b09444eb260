#include "tracker/surf_golay/image_search.h"

#include "tracker/surf_golay/cells/decoding_confidence.h"

namespace pleinair::tracker {

void ImageSearch::SetImage(ImageView<const std::uint8_t> grey) {
  found.Clear();
  reader.SetImage(grey);
  upright.SetImage(grey);
}

std::optional<SgReading> ImageSearch::DecodeAsGuessed(const BlockFitState& guess) {
  std::optional<SgReading> reading = reader.DecodeAsGuessed(guess);
  if (!reading) return reading;
  const double correlation = upright.Orientations(reading->corners.px)[0].correlation;
  if (!IsConfident(reading->confidence_bits, reading->visible_fraction, correlation))
    reading.reset();
  return reading;
}

}  // namespace pleinair::tracker
