#pragma once

#include "sky/clouds/cloud_layer.h"

namespace pleinair::clouds {

/// Henyey & Greenstein 1941: p = (1 − g²) / (1 + g² − 2 g cos θ)^1.5, mean 1 over the sphere.
double HenyeyGreenstein(double asymmetry, double cosine);

/// Phase function of cloud droplets of a diameter of 5…50 µm, mean 1 over the sphere: the sum of a
/// Henyey–Greenstein and a Draine lobe by Jendersie & d'Eon 2023, "An approximate Mie scattering
/// function for fog and cloud rendering", SIGGRAPH Talks, Eqs. (4)–(7). It has fogbow and glory.
double DropletPhase(double diameter_um, double cosine);

/// The droplets of the water clouds, µm. Larger ones have an aureole narrower than a pixel of a sky
/// map, in which an integral over the map would miss light.
inline constexpr double kDropletDiameter_um = 10.0;

/// The first scattering of a kind: Henyey–Greenstein for cirrus, DropletPhase() for the others.
double CloudPhase(CloudKind kind, double cosine);

}  // namespace pleinair::clouds
