#pragma once

#include <cstdint>
#include <string>

#include "devices/films/film_tags.h"

namespace pleinair::devices {

/// What a film's file says of it.
struct FilmFacts {
  std::string codec;      ///< "hevc", as libavcodec names it.
  std::string colors;     ///< FilmColors::Text().
  bool is_hdr = false;    ///< HLG or PQ: light above reference white is clipped.
  int clockwise_deg = 0;  ///< Turn for display: 0, 90, 180 or 270.
  bool is_mirrored = false;
  std::string sound_codec;  ///< Empty: no sound.
  double duration_s = 0.0;  ///< From the first frame to the last; 0: times are not stored.
  double longest_interval_s = 0.0;
  std::int64_t longest_interval_after = 0;  ///< Frame after which it lies.
  FilmTags tags;
};

}  // namespace pleinair::devices
