#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sky/clouds/film/field_in_step.h"
#include "sky/clouds/film/film_course.h"
#include "sky/clouds/film/layer_draws.h"
#include "sky/sky_model.h"

namespace pleinair::clouds {

/// What is known besides the film.
struct FilmLayerFacts {
  std::optional<CloudKind> kind;  ///< Not of slabs.
  std::optional<double> wind_m_s, wind_from_deg;
};

/// The clear sky above the clouds of a film.
struct FilmSky {
  SunAt sun_at;                                ///< Above the horizon.
  std::shared_ptr<const sky::SkyModel> clear;  ///< At the middle of the film.
  double ground_albedo = 0.2;
};

/// How a layer's light differs from that of the film.
struct FilmLayerErrors {
  double sun = 0.0;    ///< Root mean square of the sun, over the clear sun.
  double sky = 0.0;    ///< The same of the sky, over the film's mean sky; 0: sky unknown.
  double light = 0.0;  ///< The same of both together, over the film's mean.
};

/// A layer of clouds that gives the light of a film.
struct FilmLayer {
  enum class Outcome {
    kNoClouds,  ///< The clear sun, all the time.
    kUniform,   ///< Steady light of a sun behind clouds: a slab.
    kPassing,   ///< Clouds and gaps.
  };
  Outcome outcome = Outcome::kNoClouds;
  CloudLayer layer;
  FittedNumber cover, optical_depth;
  FittedNumber cell_over_wind_s;  ///< Time in which a cell passes; 0 for slabs.
  double least_wind_m_s = 0.0;
  /// True if nothing is left of the sun: the optical depth is a lower bound.
  bool is_opaque = false;
  FilmLayerErrors errors;
  FilmCourse light;  ///< The layer's, at times of the film. Slabs have no `sky`.
};

/// Sun over sky on level ground under the clear sky.
double ClearSunOverSky(const sky::SkyModel& clear);

/// Fits one layer to a course.
///
/// 1. LayerDraws gives cover, optical depth and cells per second, with their uncertainty.
/// 2. A place sees how long a cell takes, cell over wind, but neither of them. Without a stated
///    wind, the cell is that of the kind. The wind's direction is not seen. Without a stated one it
///    blows across the direction to the sun.
/// 3. The likeliest draws are brought in step with the film (InStep()). That with the least error
/// of
///    the light is the result. The sky depends on cover and depth, and so decides among them.
///
/// Without a stated kind: cirrus where 95 % of the film keep more than 0.15 of the sun, else
/// cumulus. The course needs its sun above the horizon.
FilmLayer FitFilmLayer(const FilmCourse& course, const FilmLayerFacts& facts, const FilmSky& sky);

}  // namespace pleinair::clouds
