#include "compositor/photometry/estimate/light_prior.h"

namespace pleinair::compositor {

LightPrior PriorOf(scene::Cloudiness stated) {
  switch (stated) {
    case scene::Cloudiness::kClear:
      return {0.90, 0.06, 0.04, 0.35};
    case scene::Cloudiness::kHazy:
      return {0.85, 0.11, 0.04, 0.6};
    case scene::Cloudiness::kPartlyCloudy:
      break;
    case scene::Cloudiness::kOvercast:
      return {0.04, 0.95, 0.01, 1.2};
  }
  return {0.50, 0.46, 0.04, 1.2};
}

}  // namespace pleinair::compositor
