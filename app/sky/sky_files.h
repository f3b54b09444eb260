#pragma once

#include <functional>
#include <memory>
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

/// Selects the kind by the file's extension. Errors (input): another extension.
Result<SkyFileKind> SkyFileKindOf(const std::string& name);

struct SkyFileOptions {
  std::string file;
  SkyFileKind kind = SkyFileKind::kPng;
  SkyPictureOptions picture;
  std::optional<SkyExposure> exposure;  ///< For PNG and video; default: AutomaticExposure().
  double scale = 1.0;                   ///< For EXR and HDR: value per cd/m².
  double frames_per_second = 24.0;      ///< For a video.
};

/// The exposure of an image of this sky.
SkyExposure ExposureFor(const SkyFileOptions& options, const SkyLight& light);

/// Writes one image under a temporary name and renames it. Errors: as WriteError.
Result<void> WriteSkyPicture(const sky::SkyModel& sky, const SkyLight& light,
                             const SkyFileOptions& options);

/// The sky of a moment.
using SkyAt = std::function<std::unique_ptr<sky::SkyModel>(const SkyMoment&)>;

/// Writes a time-lapse with one frame per time. An interruption leaves no file. Errors: as
/// WriteError and VideoWriter.
Result<void> WriteSkyVideo(const SkyAt& sky_at, const std::vector<SkyMoment>& moments,
                           const SkyFileOptions& options);

}  // namespace pleinair::app
