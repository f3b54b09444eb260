#include "sky/atmosphere/aerosol.h"

#include <algorithm>

namespace pleinair::sky {

Aerosol AerosolOfTurbidity(double turbidity) {
  Aerosol aerosol;
  aerosol.beta = std::max(0.0, 0.04608 * turbidity - 0.04586);
  return aerosol;
}

}  // namespace pleinair::sky
