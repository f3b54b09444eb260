#include "sky/clouds/cloud_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pleinair::clouds {
namespace {

/// Hash of a lattice point: 32 bits by the finalizer of MurmurHash3.
std::uint32_t HashOf(std::uint64_t seed, int x, int y) {
  std::uint32_t h = static_cast<std::uint32_t>(seed) ^ static_cast<std::uint32_t>(seed >> 32);
  h ^= static_cast<std::uint32_t>(x) * 0x9e3779b1u;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h ^= static_cast<std::uint32_t>(y) * 0xc2b2ae35u;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  return h ^ (h >> 13);
}

int Wrapped(int cell, int cells) {
  const int rest = cell % cells;
  return rest < 0 ? rest + cells : rest;
}

/// Sixteen directions: without trigonometry, and without a preferred axis.
constexpr std::array<std::array<float, 2>, 16> kGradients = {{
    {1.0F, 0.0F},
    {0.923880F, 0.382683F},
    {0.707107F, 0.707107F},
    {0.382683F, 0.923880F},
    {0.0F, 1.0F},
    {-0.382683F, 0.923880F},
    {-0.707107F, 0.707107F},
    {-0.923880F, 0.382683F},
    {-1.0F, 0.0F},
    {-0.923880F, -0.382683F},
    {-0.707107F, -0.707107F},
    {-0.382683F, -0.923880F},
    {0.0F, -1.0F},
    {0.382683F, -0.923880F},
    {0.707107F, -0.707107F},
    {0.923880F, -0.382683F},
}};

float Slope(const NoiseLattice& lattice, int x, int y, float dx, float dy) {
  const auto& g =
      kGradients[HashOf(lattice.seed, Wrapped(x, lattice.cells_u), Wrapped(y, lattice.cells_v)) &
                 15U];
  return g[0] * dx + g[1] * dy;
}

float Faded(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

}  // namespace

std::uint64_t MixSeeds(std::uint64_t seed, std::uint64_t other) {
  // Steele, Lea & Flood 2014 (SplitMix64).
  std::uint64_t z = seed + 0x9e3779b97f4a7c15u * (other + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

float GradientNoise(const NoiseLattice& lattice, float u, float v) {
  const float x = u * static_cast<float>(lattice.cells_u);
  const float y = v * static_cast<float>(lattice.cells_v);
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float dx = x - static_cast<float>(x0), dy = y - static_cast<float>(y0);
  const float fx = Faded(dx), fy = Faded(dy);
  const float a = Slope(lattice, x0, y0, dx, dy);
  const float b = Slope(lattice, x0 + 1, y0, dx - 1.0F, dy);
  const float c = Slope(lattice, x0, y0 + 1, dx, dy - 1.0F);
  const float d = Slope(lattice, x0 + 1, y0 + 1, dx - 1.0F, dy - 1.0F);
  const float low = a + fx * (b - a), high = c + fx * (d - c);
  return 1.5F * (low + fy * (high - low));
}

float CellularNoise(const NoiseLattice& lattice, float u, float v) {
  const float x = u * static_cast<float>(lattice.cells_u);
  const float y = v * static_cast<float>(lattice.cells_v);
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  float nearest2 = 4.0F;
  for (int cell = 0; cell < 9; ++cell) {
    const int cx = x0 + cell % 3 - 1, cy = y0 + cell / 3 - 1;
    const std::uint32_t h =
        HashOf(lattice.seed, Wrapped(cx, lattice.cells_u), Wrapped(cy, lattice.cells_v));
    const float px = static_cast<float>(cx) + static_cast<float>(h & 0xffffU) / 65536.0F - x;
    const float py = static_cast<float>(cy) + static_cast<float>(h >> 16) / 65536.0F - y;
    nearest2 = std::min(nearest2, px * px + py * py);
  }
  return 1.0F - std::sqrt(nearest2);
}

}  // namespace pleinair::clouds
