#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/scene.h"
#include "base/camera_model.h"

namespace pleinair::accuracy {

/// Cameras of the built-in sweeps: "640x480" and "1280x720".
const std::vector<std::string>& SweepCameraNames();
CameraModel SweepCamera(const std::string& name);

/// Names of the sweeps by the varied quantity: distance, angle, border, content, blur, noise,
/// light, many, ambiguity, negative, jitter, sequence, sequence_occl, wild. See
/// docs/method/accuracy.md.
const std::vector<std::string>& SweepNames();

struct SweepOptions {
  std::uint64_t seed = 1;
  double scale = 1.0;  ///< Factor on the number of frames of each level; at least one remains.
};

/// The scenes of one sweep, in order. They depend on the seed, the camera and the level, not on
/// other sweeps; a smaller scale gives a subset of the same frames.
std::vector<FrameRun> MakeSweep(const std::string& name, const CameraModel& camera,
                                const SweepOptions& options);

}  // namespace pleinair::accuracy
