#include "sky/sun/sun_models.h"

// Stands in for sun_position_precise.cc where ERFA is missing.

namespace pleinair::sky {

bool HasPreciseSun() { return false; }

namespace internal {

AirlessSun PreciseSun(const Observer& observer, UtcTime time) { return PaperSun(observer, time); }

}  // namespace internal
}  // namespace pleinair::sky
