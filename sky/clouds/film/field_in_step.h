#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/frames.h"
#include "sky/clouds/cloud_field.h"
#include "sky/clouds/film/film_course.h"

namespace pleinair::clouds {

/// Direction to the sun at a time of the film, s.
using SunAt = std::function<Direction<World>(double seconds)>;

/// A field that passes the place in step with a film.
struct FieldInStep {
  std::shared_ptr<const CloudField> field;
  std::vector<double> sun;  ///< SunTransmittance() at the seconds of the course.
  double sun_rms = 1.0;     ///< Root mean square of its difference from the course.
};

/// Brings a layer in step with a course. The layer needs wind, and cells of up to 8 km.
///
/// - The field is displaced so that what passes the place resembles the course most: the least mean
///   square difference among displacements 200 m apart over a period of the field.
/// - Passing clouds (CloudPassing) are added, so that the sun at the place follows the course. Each
///   shift changes in steps by the sign of the sun's difference at its time. Steps grow where the
///   sign stays and shrink where it changes (Riedmiller & Braun 1993, "Rprop"). In full shade and
///   in full sun, where the sun does not depend on the shift, it stays.
FieldInStep InStep(const CloudLayer& layer, const FilmCourse& course, const SunAt& sun_at);

/// The wind that a course needs at least, m/s: no cloud and no gap is narrower than three columns
/// of the field.
double LeastWind(const FilmCourse& course);

}  // namespace pleinair::clouds
