#pragma once

#include <string>

#include "accuracy/scene.h"
#include "accuracy/sweeps.h"

namespace pleinair::accuracy {

/// Frames a second of the films below.
inline constexpr double kFilmRate_hz = 30.0;

/// A hand-held film of one marker at 30 frames a second, with the blur of 10 ms of exposure:
/// "sequence" (300 frames), or "sequence_occl" (200), in which hands and bars come and go over the
/// marker, up to 62 % of its border.
FrameRun MakeFilm(const std::string& name, const CameraModel& camera, const SweepOptions& options);

}  // namespace pleinair::accuracy
