#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options/observer_options.h"
#include "app/sky/sky_files.h"
#include "app/sky/sky_moments.h"
#include "base/error.h"
#include "sky/sky_model.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// What `pleinair sky` was asked for, as written.
struct SkyOptions {
  /// Where and when, or the sun itself.
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

  /// Of a picture or video.
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
  std::string csv;
  bool json = false;
  std::string output;

  /// A span or a day, not one moment.
  bool Many() const { return !span.until.empty() || !span.day.empty(); }
  /// The result is a picture or a video, not a table or text.
  bool IsPicture() const;
};

/// Adds the options to `command`; `options` must outlive it.
void AddSkyOptions(CLI::App& command, SkyOptions& options);

/// Errors (input): an option was given that the chosen model or kind of result makes no use of.
Result<void> CheckUseOfSkyOptions(const CLI::App& command, const SkyOptions& options,
                                  sky::SkyModelName name);

/// The air and the clouds.
sky::SkyConditions ChosenConditions(const SkyOptions::Model& given);

/// One moment, or the many of a span. Errors (input): no such moment.
Result<std::vector<SkyMoment>> ChosenMoments(const SkyOptions::Span& span);

/// The picture or, of many moments, the video. Errors (input): a name that is none.
Result<SkyFileOptions> ChosenFile(const SkyOptions& options);

}  // namespace pleinair::app
