#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

Vec2 PlaceOnTarget(const TargetView& view, Vec2 in_view) {
  const auto& m = view.from_target;
  const double determinant = m[0] * m[4] - m[1] * m[3];
  const double x = in_view.x - m[2], y = in_view.y - m[5];
  return {(m[4] * x - m[1] * y) / determinant, (m[0] * y - m[3] * x) / determinant};
}

}  // namespace pleinair::tracker
