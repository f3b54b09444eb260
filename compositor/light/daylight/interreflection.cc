#include "compositor/light/daylight/interreflection.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compositor/light/daylight/interreflection.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::compositor {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void AddPlaces(const ReflectingPlace* places, std::size_t count, float* sum) {
  constexpr int kP = CoefficientMatrix::kPatches;
  const hn::CappedTag<float, kP> floats;
  const int lanes = static_cast<int>(hn::Lanes(floats));
  for (std::size_t k = 0; k < count; ++k) {
    const ReflectingPlace& place = places[k];
    const auto wa = hn::Set(floats, place.weights[0]), wb = hn::Set(floats, place.weights[1]),
               wc = hn::Set(floats, place.weights[2]);
    const float* a = place.corners[0]->data();
    const float* b = place.corners[1]->data();
    const float* c = place.corners[2]->data();
    for (int channel = 0; channel < 3; ++channel) {
      const auto share = hn::Set(floats, place.shares[channel]);
      for (int i = channel * kP; i < (channel + 1) * kP; i += lanes) {
        const auto arriving = hn::MulAdd(
            wc, hn::LoadU(floats, c + i),
            hn::MulAdd(wb, hn::LoadU(floats, b + i), hn::Mul(wa, hn::LoadU(floats, a + i))));
        hn::StoreU(hn::MulAdd(share, arriving, hn::LoadU(floats, sum + i)), floats, sum + i);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pleinair::compositor
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::compositor {

HWY_EXPORT(AddPlaces);

void AddInterreflections(std::span<const ReflectingPlace> places, ChunkLight* sum) {
  HWY_DYNAMIC_DISPATCH(AddPlaces)(places.data(), places.size(), sum->data());
}

void AddInterreflectionsScalar(std::span<const ReflectingPlace> places, ChunkLight* sum) {
  constexpr std::size_t kP = CoefficientMatrix::kPatches;
  for (const ReflectingPlace& place : places) {
    for (std::size_t i = 0; i < sum->size(); ++i) {
      float arriving = 0.0F;
      for (std::size_t k = 0; k < 3; ++k) arriving += place.weights[k] * (*place.corners[k])[i];
      (*sum)[i] += place.shares[i / kP] * arriving;
    }
  }
}

}  // namespace pleinair::compositor
#endif  // HWY_ONCE
