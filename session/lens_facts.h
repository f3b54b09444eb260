#pragma once

#include <string_view>

namespace pleinair::session {

/// Where focus and aperture, or the exposure, may come from, as users choose it.
enum class LensFactMode {
  kAuto,      ///< Stated by scene or options, else by the recording or its frames, else measured.
  kOff,       ///< From nowhere: they are not used.
  kStated,    ///< Stated by scene or options.
  kMeasured,  ///< Measured in the frames of a recording (session/lens_measurement.h).
};

/// "auto", "off", "stated" or "measured"; kAuto for every other name.
LensFactMode LensFactModeOf(std::string_view name);

/// Which of these sources is in use.
enum class LensFactSource { kOff, kStated, kMetadata, kMeasured };

/// As reports name it.
const char* NameOf(LensFactSource source);

}  // namespace pleinair::session
