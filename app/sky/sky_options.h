#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options/observer_options.h"
#include "app/sky/sky_files.h"
#include "app/sky/sky_moments.h"
#include "base/error.h"
#include "sky/clouds/cloud_layer.h"
#include "sky/sky_model.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Options of `pleinair sky`, as written.
struct SkyOptions {
  /// Place and time, or the sun itself.
  struct Span {
    ObserverOptions observer;
    std::string time, until, day, utc_offset, sun;
    double step_s = 300.0;
  };

  struct Aerosol {
    std::optional<double> beta, alpha, scale_height_m, single_scattering_albedo, asymmetry;
  };

  struct Model {
    std::string name = "atmosphere";
    sky::SkyConditions conditions;
    std::optional<double> zenith_luminance_cd_m2, sky_illuminance_lx;
    Aerosol aerosol;
  };

  /// Options of an image or video.
  struct Picture {
    std::string projection;
    std::optional<int> size_px;
    double centre_azimuth_deg = 90.0;
    bool disc = false, no_disc = false;
    std::optional<double> ev100;
    double scale = 1.0;
    double frames_per_second = 24.0;
  };

  Span span;
  Model model;
  Picture picture;
  /// Layers of clouds, as written, and their shadow at points.
  struct Clouds {
    std::vector<std::string> layers;
    double seconds = 0.0;
    std::string shadow_at;
  };

  std::string csv;
  Clouds clouds;
  bool json = false;
  std::string output;

  /// True for a span or a day, false for one time.
  bool Many() const { return !span.until.empty() || !span.day.empty(); }
  /// True if the result is an image or a video, not a table or text.
  bool IsPicture() const;
};

/// Adds the options to `command`; `options` must outlive it.
void AddSkyOptions(CLI::App& command, SkyOptions& options);

/// Errors (input): a given option is not used by the selected model or result.
Result<void> CheckUseOfSkyOptions(const CLI::App& command, const SkyOptions& options,
                                  sky::SkyModelName name);

/// The selected atmosphere and clouds.
sky::SkyConditions ChosenConditions(const SkyOptions::Model& given);

/// The layers of clouds. Errors (input): as clouds::ParseCloudLayer(), more than four.
Result<std::vector<clouds::CloudLayer>> ChosenClouds(const SkyOptions::Clouds& given);

/// One time, or all times of a span. Errors (input): invalid time.
Result<std::vector<SkyMoment>> ChosenMoments(const SkyOptions::Span& span);

/// The image or, for several times, the video. Errors (input): an invalid name.
Result<SkyFileOptions> ChosenFile(const SkyOptions& options);

}  // namespace pleinair::app
