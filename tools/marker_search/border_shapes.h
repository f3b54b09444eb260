#pragma once

#include <cstdint>
#include <vector>

namespace pleinair::marker_search {

/// A white shape of at most 5×5 modules: bit 5 y + x is the module at column x, row y of its
/// bounding box, whose top-left corner is (0, 0).
struct BorderShape {
  static constexpr int kMax = 5;  ///< Modules along a side.

  std::uint32_t modules = 0;

  bool operator==(const BorderShape&) const = default;
  bool Has(int x, int y) const {
    return x >= 0 && y >= 0 && x < kMax && y < kMax && (modules >> (kMax * y + x) & 1U) != 0;
  }
  int Width() const;
  int Height() const;
  int Area() const;
  BorderShape Mirrored() const;  ///< Swaps left and right.
  BorderShape Turned() const;    ///< By a quarter turn.

  /// True if squares of 2×2 modules cover the shape and each overlaps the next by half. Such a
  /// shape is connected and at least 2 modules thick everywhere.
  bool IsThick() const;
  /// True if the shape encloses black modules.
  bool HasHole() const;
  /// True if no turn or mirroring maps the shape to itself.
  bool IsAsymmetric() const;
};

/// All valid border shapes, each in all its turned and mirrored forms.
struct ShapeLibrary {
  std::vector<BorderShape> large;  ///< 4 or 5 modules wide and high, compact, asymmetric.
  std::vector<BorderShape> small;  ///< 2 or 3 modules wide and high.
};
ShapeLibrary MakeShapeLibrary();

}  // namespace pleinair::marker_search
