#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/camera_image.h"
#include "base/error.h"
#include "base/image.h"
#include "devices/films/display_turn.h"
#include "devices/films/film_colors.h"
#include "devices/films/libav_pointer.h"

namespace pleinair::devices {

/// A converted frame.
struct FilmPicture {
  RgbImage rgb;
  DeepImage deep;  ///< Empty if the film's pixels have 8 bits and are not converted.
};

/// Converts decoded frames to RGB images in Rec.709 primaries, turned as the film wants to be
/// shown.
///
/// Standard dynamic range in Rec.709 primaries keeps its signal: R'G'B' by the film's matrix and
/// range (ITU-T H.273, 8.3). Everything else goes through linear light: E = transfer(R'G'B'), the
/// matrix of primaries, then the curve of FilmColors::curve(). Light above 1 and negative light, of
/// colors that Rec.709 lacks, are clipped. The depth of the film is kept in 16 bits, beside the
/// image rounded to 8.
class FilmPictures {
 public:
  FilmPictures(std::string name, FilmColors colors, DisplayTurn turn);

  /// Errors: a pixel format that cannot be converted.
  Result<FilmPicture> Convert(const AVFrame& frame);

 private:
  void ThroughLight(DeepImage* signal) const;

  std::string name_;
  FilmColors colors_;
  DisplayTurn turn_;
  LibavPointer<SwsContext> scaler_;
  std::vector<float> light_;            // Light of each 16-bit signal. Empty without a conversion.
  std::vector<std::uint16_t> encoded_;  // Index: light's square root × (size - 1).
};

}  // namespace pleinair::devices
