#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/sky/sky_exposure.h"
#include "app/sky/sky_moments.h"
#include "app/sky/sky_picture.h"
#include "base/error.h"
#include "sky/sky_model.h"

namespace pleinair::app {

enum class SkyFileKind { kPng, kExr, kHdr, kMp4 };

/// By the name's ending. Errors (input): another one.
Result<SkyFileKind> SkyFileKindOf(const std::string& name);

struct SkyFileOptions {
  std::string file;
  SkyFileKind kind = SkyFileKind::kPng;
  SkyPictureOptions picture;
  std::optional<SkyExposure> exposure;  ///< Of PNG and video; without it AutomaticExposure().
  double scale = 1.0;                   ///< Of EXR and HDR: value per cd/m².
  double frames_per_second = 24.0;      ///< Of a video.
};

/// The exposure that a picture of this sky gets.
SkyExposure ExposureFor(const SkyFileOptions& options, const SkyLight& light);

/// Writes one picture under a temporary name and renames it. Errors as WriteError.
Result<void> WriteSkyPicture(const sky::SkyModel& sky, const SkyLight& light,
                             const SkyFileOptions& options);

/// Writes a time-lapse, a frame a moment. Interrupted, it leaves nothing. Errors: as WriteError and
/// VideoWriter.
Result<void> WriteSkyVideo(const sky::SkySource& source, const std::vector<SkyMoment>& moments,
                           const SkyFileOptions& options);

}  // namespace pleinair::app
