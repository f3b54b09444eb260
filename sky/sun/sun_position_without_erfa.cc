#include "sky/sun/sun_models.h"

// Replaces sun_position_precise.cc in builds without ERFA.

namespace pleinair::sky {

bool HasPreciseSun() { return false; }

namespace internal {

AirlessSun PreciseSun(const Observer& observer, UtcTime time) { return PaperSun(observer, time); }

}  // namespace internal
}  // namespace pleinair::sky
