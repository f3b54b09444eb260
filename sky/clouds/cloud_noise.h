#pragma once

#include <cstdint>

namespace pleinair::clouds {

/// Noise on a torus, from integer hashes alone: the same on every machine, without files.
///
/// Coordinates count periods: u and v of 0…1 span the torus, and the noise continues beyond. The
/// lattice has `cells_u` × `cells_v` cells, both at least 1.
struct NoiseLattice {
  std::uint64_t seed = 0;
  int cells_u = 1, cells_v = 1;
};

/// Gradient noise (Perlin 2002): mean 0, about −1…1, continuous second derivative.
float GradientNoise(const NoiseLattice& lattice, float u, float v);

/// Cellular noise (Worley 1996): 1 − distance to the nearest of one random point a cell, in cells.
float CellularNoise(const NoiseLattice& lattice, float u, float v);

/// A seed that depends on both numbers.
std::uint64_t MixSeeds(std::uint64_t seed, std::uint64_t other);

}  // namespace pleinair::clouds
