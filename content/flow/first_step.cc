#include "content/flow/first_step.h"

#include <limits>

namespace pleinair::content {

Vec3 FirstStep(FieldProbe* probe, Vec3 point, Seconds time, double step_s,
               std::uint64_t* field_reads) {
  constexpr int kSubsteps = 8;
  constexpr double kLeft = std::numeric_limits<double>::quiet_NaN();
  const double h = step_s / kSubsteps;
  const auto read = [&](const Vec3& at, Vec3* k) {
    ++*field_reads;
    return probe->Sample(at, time, k) != PointState::kNoFlow;
  };
  for (int i = 0; i < kSubsteps; ++i) {
    Vec3 k1, k2, k3, k4;
    if (!read(point, &k1) || !read(point + k1 * (0.5 * h), &k2) ||
        !read(point + k2 * (0.5 * h), &k3) || !read(point + k3 * h, &k4)) {
      return {kLeft, kLeft, kLeft};
    }
    point = point + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
  }
  Vec3 ignored;
  return probe->Sample(point, time, &ignored) == PointState::kFlow ? point
                                                                   : Vec3{kLeft, kLeft, kLeft};
}

}  // namespace pleinair::content
