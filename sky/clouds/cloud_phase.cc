#include "sky/clouds/cloud_phase.h"

#include <cmath>

#include "sky/clouds/cloud_slab.h"
#include "sky/henyey_greenstein.h"

namespace pleinair::clouds {

double DropletPhase(double diameter_um, double cosine) {
  const double g_forward = std::exp(-0.0990567 / (diameter_um - 1.67154));
  const double g_draine = std::exp(-2.20679 / (diameter_um + 3.91029) - 0.428934);
  const double alpha = std::exp(3.62489 - 8.29288 / (diameter_um + 5.52825));
  const double draine_share = std::exp(-0.599085 / (diameter_um - 0.641583) - 0.665888);
  // Draine 2003, Eq. (5).
  const double draine = sky::HenyeyGreenstein(g_draine, cosine) * (1.0 + alpha * cosine * cosine) /
                        (1.0 + alpha * (1.0 + 2.0 * g_draine * g_draine) / 3.0);
  return (1.0 - draine_share) * sky::HenyeyGreenstein(g_forward, cosine) + draine_share * draine;
}

double CloudPhase(CloudKind kind, double cosine) {
  return kind == CloudKind::kCirrus ? sky::HenyeyGreenstein(kIceAsymmetry, cosine)
                                    : DropletPhase(kDropletDiameter_um, cosine);
}

}  // namespace pleinair::clouds
