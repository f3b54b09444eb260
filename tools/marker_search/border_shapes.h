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
  BorderShape Mirrored() const;  ///< Left and right change places.
  BorderShape Turned() const;    ///< By a quarter.

  /// It is covered by squares of 2×2 modules, each of which overlaps another by half, on from one
  /// to the next: nowhere thinner than 2 modules, and of one piece.
  bool IsThick() const;
  /// Black inside it is closed off from the black around.
  bool HasHole() const;
  /// Equal to itself turned or mirrored in no way.
  bool IsAsymmetric() const;
};

/// All shapes that may stand in a border, each in all its turned and mirrored forms.
struct ShapeLibrary {
  std::vector<BorderShape> large;  ///< 4 or 5 modules both ways, compact, asymmetric.
  std::vector<BorderShape> small;  ///< 2 or 3 modules both ways.
};
ShapeLibrary MakeShapeLibrary();

}  // namespace pleinair::marker_search
