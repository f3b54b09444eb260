#include "sky/daylight.h"

#include <algorithm>

#include "base/check.h"

namespace pleinair::sky {
namespace {

constexpr double kHazyTurbidity = 3.2;
constexpr double kPartlyCloudyCover = 0.6;

}  // namespace

std::shared_ptr<const SkySource> CreateDaylight(const DaylightOptions& options) {
  SkyConditions conditions;
  switch (options.condition) {
    case SkyCondition::kClear:
      break;
    case SkyCondition::kHazy:
      conditions.turbidity = kHazyTurbidity;
      break;
    case SkyCondition::kPartlyCloudy:
      conditions.cloud_cover = kPartlyCloudyCover;
      break;
    case SkyCondition::kOvercast:
      conditions.cloud_cover = 1.0;
      break;
  }
  if (options.turbidity != 0.0) {
    // Written so that NaN becomes the minimum.
    conditions.turbidity = options.turbidity > kMinTurbidity
                               ? std::min(options.turbidity, kMaxTurbidity)
                               : kMinTurbidity;
  }
  auto source = SkySource::Create({SkyModelKind::kAtmosphere, 0}, conditions);
  CHECK_EQ(source.has_value(), true);
  return *std::move(source);
}

}  // namespace pleinair::sky
