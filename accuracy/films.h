#pragma once

#include <string>

#include "accuracy/scene.h"
#include "accuracy/sweeps.h"

namespace pleinair::accuracy {

/// Frame rate of the videos below.
inline constexpr double kFilmRate_hz = 30.0;

/// A video of one marker from a hand-held camera at 30 frames per second, with the motion blur of
/// 10 ms of exposure: "sequence" (300 frames), or "sequence_occl" (200), in which hands and bars
/// move over the marker and cover up to 62 % of its border.
FrameRun MakeFilm(const std::string& name, const CameraModel& camera, const SweepOptions& options);

}  // namespace pleinair::accuracy
