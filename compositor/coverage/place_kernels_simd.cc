#include "compositor/coverage/place_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compositor/coverage/place_kernels_simd.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

// The same arithmetic as the scalar reference in place_kernels.cc, in whole vectors.
HWY_BEFORE_NAMESPACE();
namespace pleinair::compositor {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void DrawInVectors(const TriangleAtPixel& triangle, const PlacesOfPixel& places) {
  const hn::CappedTag<float, kPlaceBlock> floats;
  const hn::RebindToUnsigned<decltype(floats)> numbers;
  const auto zero = hn::Zero(floats);
  const auto number = hn::Set(numbers, triangle.number);
  const auto farther = hn::Set(floats, 1.0F + kSameDepth);
  const auto nearest = hn::Set(floats, triangle.nearest);
  const auto farthest = hn::Set(floats, triangle.farthest);
  const auto limit = hn::Set(floats, triangle.limit);
  const auto value_at = [&](const TriangleAtPixel::Plane& plane, auto x, auto y) {
    return hn::Add(hn::Set(floats, plane[0]), hn::Add(hn::Mul(x, hn::Set(floats, plane[1])),
                                                      hn::Mul(y, hn::Set(floats, plane[2]))));
  };
  for (std::size_t i = 0; i < places.x.size(); i += hn::Lanes(floats)) {
    const auto x = hn::LoadU(floats, places.x.data() + i);
    const auto y = hn::LoadU(floats, places.y.data() + i);
    const auto nearness = hn::Min(hn::Max(value_at(triangle.nearness, x, y), farthest), nearest);
    const auto before = hn::LoadU(floats, places.nearness.data() + i);
    auto drawn = hn::And(hn::Le(nearness, limit), hn::Gt(nearness, hn::Mul(before, farther)));
    for (std::size_t e = 0; e < 3; ++e) {
      if (!triangle.is_tested[e]) continue;
      const auto side = value_at(triangle.edges[e], x, y);
      drawn = hn::And(drawn, triangle.has_edge[e] ? hn::Ge(side, zero) : hn::Gt(side, zero));
    }
    hn::StoreU(hn::IfThenElse(drawn, nearness, before), floats, places.nearness.data() + i);
    const auto seen = hn::LoadU(numbers, places.triangles.data() + i);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(numbers, drawn), number, seen), numbers,
               places.triangles.data() + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pleinair::compositor
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::compositor {
HWY_EXPORT(DrawInVectors);

DrawAtPlaces FastestDrawAtPlaces() {
  return [](const TriangleAtPixel& triangle, const PlacesOfPixel& places) {
    HWY_DYNAMIC_DISPATCH(DrawInVectors)(triangle, places);
  };
}

}  // namespace pleinair::compositor
#endif  // HWY_ONCE
