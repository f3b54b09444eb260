#include "accuracy/background.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "accuracy/random.h"
#include "base/vector.h"

namespace pleinair::accuracy {
namespace {

/// Adds random values on a grid of spacing `cell_px`, smoothly interpolated.
void AddNoise(double cell_px, double amplitude, RandomStream* random, Image<float>* log_light) {
  const int width = log_light->width(), height = log_light->height();
  const int columns = static_cast<int>(width / cell_px) + 3;
  const int rows = static_cast<int>(height / cell_px) + 3;
  std::vector<float> nodes(static_cast<std::size_t>(columns) * rows);
  for (float& node : nodes) node = random->NormalFromWord();
  const double shift_x = random->Uniform(), shift_y = random->Uniform();
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  for (int y = 0; y < height; ++y) {
    const double v = y / cell_px + shift_y;
    const int row = static_cast<int>(v);
    const auto down = static_cast<float>(smooth(v - row));
    for (int x = 0; x < width; ++x) {
      const double u = x / cell_px + shift_x;
      const int column = static_cast<int>(u);
      const auto across = static_cast<float>(smooth(u - column));
      const float* at = &nodes[static_cast<std::size_t>(row) * columns + column];
      const float upper = at[0] + across * (at[1] - at[0]);
      const float lower = at[columns] + across * (at[columns + 1] - at[columns]);
      (*log_light)(x, y) += static_cast<float>(amplitude) * (upper + down * (lower - upper));
    }
  }
}

/// A flat object in front of the ground. Its own rotated coordinates are -1…1 in both axes.
struct Thing {
  enum Kind { kBox, kDisc, kGrating, kCheckers, kSigns, kFrame };
  Kind kind;
  Vec2 middle;
  double half_width, half_height, turn;
  double tone, other_tone;
  int cells;
  std::uint32_t word;
};

/// Whether a cell of an object has its second tone.
bool HasOtherTone(const Thing& thing, int column, int row) {
  if (thing.kind == Thing::kGrating) return column % 2 != 0;
  if (thing.kind == Thing::kCheckers) return (column + row) % 2 != 0;
  if (thing.kind != Thing::kSigns) return false;
  // One bit per cell: as irregular as text, or as a marker's code.
  return Philox(
             {static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), thing.word, 0},
             {0, 0})[0] %
             2 !=
         0;
}

/// The tones of an object's cells, row by row.
std::vector<double> CellTones(const Thing& thing) {
  std::vector<double> tones;
  for (int row = 0; row < thing.cells; ++row) {
    for (int column = 0; column < thing.cells; ++column) {
      tones.push_back(HasOtherTone(thing, column, row) ? thing.other_tone : thing.tone);
    }
  }
  return tones;
}

/// The tone at a point of an object; negative outside it.
double ToneOf(const Thing& thing, const std::vector<double>& cells, double u, double v) {
  if (std::fabs(u) > 1.0 || std::fabs(v) > 1.0) return -1.0;
  if (thing.kind == Thing::kDisc) return u * u + v * v <= 1.0 ? thing.tone : -1.0;
  // A picture frame or a window: the closed square that detectors search for.
  if (thing.kind == Thing::kFrame) {
    return std::max(std::fabs(u), std::fabs(v)) > 0.8 ? thing.tone : thing.other_tone;
  }
  const auto cell = [&](double at) {
    return std::min(static_cast<int>((at + 1.0) * 0.5 * thing.cells), thing.cells - 1);
  };
  return cells[static_cast<std::size_t>(cell(v)) * thing.cells + cell(u)];
}

Thing RandomThing(int width, int height, RandomStream* random) {
  Thing thing;
  thing.kind = static_cast<Thing::Kind>(random->Below(6));
  thing.middle = {width * random->Uniform(), height * random->Uniform()};
  const double size = height * 0.25 * std::pow(random->Uniform(), 1.5) + 5.0;
  thing.half_width = size;
  thing.half_height = thing.kind >= Thing::kCheckers ? size : size * random->Uniform(0.2, 2.0);
  thing.turn = random->Uniform(0, 2 * M_PI);
  thing.tone = std::pow(random->Uniform(), 2.2) * 0.9 + 0.01;
  thing.other_tone = std::pow(random->Uniform(), 2.2) * 0.9 + 0.01;
  thing.cells = 3 + random->Below(12);
  thing.word = random->Word();
  return thing;
}

void Paint(const Thing& thing, Image<float>* light) {
  constexpr int kSamples = 3;
  const std::vector<double> cells = CellTones(thing);
  const double cosine = std::cos(thing.turn), sine = std::sin(thing.turn);
  const double reach = std::hypot(thing.half_width, thing.half_height) + 1.0;
  const int left = std::max(0, static_cast<int>(thing.middle.x - reach));
  const int right = std::min(light->width() - 1, static_cast<int>(thing.middle.x + reach));
  const int top = std::max(0, static_cast<int>(thing.middle.y - reach));
  const int bottom = std::min(light->height() - 1, static_cast<int>(thing.middle.y + reach));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double from_x = x - thing.middle.x, from_y = y - thing.middle.y;
      // More than a pixel's half diagonal outside it.
      if (std::fabs(from_x * cosine + from_y * sine) > thing.half_width + 1.0 ||
          std::fabs(from_y * cosine - from_x * sine) > thing.half_height + 1.0) {
        continue;
      }
      double sum = 0.0;
      int inside = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const int column = k % kSamples, row = k / kSamples;
        const double dx = x + (column + 0.5) / kSamples - 0.5 - thing.middle.x;
        const double dy = y + (row + 0.5) / kSamples - 0.5 - thing.middle.y;
        const double tone = ToneOf(thing, cells, (dx * cosine + dy * sine) / thing.half_width,
                                   (dy * cosine - dx * sine) / thing.half_height);
        if (tone < 0.0) continue;
        sum += tone;
        ++inside;
      }
      constexpr double kAll = kSamples * kSamples;
      (*light)(x, y) = static_cast<float>((*light)(x, y) * (1.0 - inside / kAll) + sum / kAll);
    }
  }
}

}  // namespace

Image<float> MakeBackground(int width, int height, std::uint64_t seed, std::string_view key) {
  RandomStream random(seed, "background/" + std::string(key));
  Image<float> light(width, height);
  const double roughness = random.Uniform(0.5, 0.8);  // Amplitude ratio of successive octaves.
  double amplitude = random.Uniform(0.25, 0.8);
  double cell_px = height / 2.0;
  while (cell_px > 1.5) {
    AddNoise(cell_px, amplitude, &random, &light);
    amplitude *= roughness;
    cell_px /= 2.0;
  }
  const double middle = std::log(random.Uniform(0.05, 0.4));
  const double slope = random.Uniform(-0.8, 0.8);  // Brighter at the top or at the bottom.
  for (int y = 0; y < height; ++y) {
    const double ramp = slope * (y / (height - 1.0) - 0.5);
    for (int x = 0; x < width; ++x) {
      light(x, y) = static_cast<float>(std::clamp(std::exp(middle + ramp + light(x, y)), 0.0, 1.0));
    }
  }
  const int things = random.Below(60);
  for (int i = 0; i < things; ++i) Paint(RandomThing(width, height, &random), &light);
  return light;
}

}  // namespace pleinair::accuracy
