#pragma once

#include "sky/clouds/cloud_layer.h"

namespace pleinair::clouds {

/// Phase function of cloud droplets of a diameter of 5…50 µm, mean 1 over the sphere. It is the sum
/// of a Henyey–Greenstein and a Draine lobe, and has fogbow and glory. Jendersie & d'Eon 2023, "An
/// approximate Mie scattering function for fog and cloud rendering", SIGGRAPH Talks, Eqs. (4)–(7).
double DropletPhase(double diameter_um, double cosine);

/// The droplets of the water clouds, µm. Larger ones have an aureole narrower than a pixel of a sky
/// map, in which an integral over the map would miss light.
inline constexpr double kDropletDiameter_um = 10.0;

/// The first scattering of a kind: Henyey–Greenstein for cirrus, DropletPhase() for the others.
double CloudPhase(CloudKind kind, double cosine);

}  // namespace pleinair::clouds
