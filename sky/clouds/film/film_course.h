#pragma once

#include <vector>

#include "base/error.h"

namespace pleinair::clouds {

/// Light of one frame of a film: what level ground has of sun and of sky, in one unit that the
/// camera's exposure multiplies.
struct FilmLight {
  double seconds = 0.0;
  double sun = 0.0, sky = 0.0;
};

/// What clouds left of the light of a clear sky, frame by frame.
struct FilmCourse {
  std::vector<double> seconds;
  std::vector<double> sun;  ///< Transmittance of the clouds for sunlight, 0…1.
  std::vector<double> sky;  ///< Skylight over that of the clear sky; empty: exposure unknown.
  double noise = 0.0;       ///< Standard deviation of `sun` from frame to frame.
  /// Sun over sky in the brightest frames, over that of the clear sky. About 1 / 1.3 in gaps
  /// between clouds, whose light raises the sky.
  double top_ratio = 1.0;

  double Span() const { return seconds.back() - seconds.front(); }
  /// True if the brightest frames have the clear sun. Where the sun changes, they have, unless
  /// next to nothing is left of it.
  bool SeesClearSun() const;
  /// True if the sun does not change by more than a tenth.
  bool IsSteady() const;
};

/// Linear between the values at `times`, which rise; that of the nearest end outside.
double ValueAt(const std::vector<double>& times, const std::vector<double>& values, double time);

/// Least frames and least time of a film that is fitted.
inline constexpr std::size_t kMinFilmFrames = 10;
inline constexpr double kMinFilm_s = 2.0;

/// The course of a film. `clear_sun_over_sky`: the ratio of both on level ground under the clear
/// sky of the film's time, above 0.
///
/// The camera's exposure is taken as steady where the sky changes by less than a factor of 2, since
/// passing clouds change it by less. Then T = a/a_top. Else only the ratio counts,
/// T = (a/b)/(a/b)_top, and the course has no sky. "top" is the mean of frames within 15 % of the
/// largest sun.
///
/// Errors (input, without a place): fewer frames or a shorter film than the least; no skylight.
Result<FilmCourse> MakeFilmCourse(const std::vector<FilmLight>& frames, double clear_sun_over_sky);

}  // namespace pleinair::clouds
