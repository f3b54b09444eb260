#pragma once

#include <filesystem>

#include "tests/devices/films/made_film.h"

namespace pleinair::e2e {

/// Frames of the films below.
inline constexpr int kPhoneFrames = 3;

/// A film of the bundled recording's first frames, as a phone held upright writes it. It is turned,
/// has a pause after the second frame, sound, place and date.
tests::MadeFilm PhoneFilm();

/// Writes it in sRGB and H.264.
void WritePhoneFilm(const std::filesystem::path& file);

/// Writes it in HLG and HEVC of 10 bits.
void WriteHlgPhoneFilm(const std::filesystem::path& file);

}  // namespace pleinair::e2e
