#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/marker_search/border_shapes.h"
#include "tools/marker_search/random_draws.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::marker_search {

using tracker::sg::kEdge;

/// White shapes on the band between the rim and the gap of a marker.
class BorderLayout {
 public:
  struct Placed {
    BorderShape shape;
    int x = 0, y = 0;  ///< Module of its top-left corner, relative to the black square's.
    bool IsLarge() const { return shape.Width() > 3 || shape.Height() > 3; }
  };

  BorderLayout();

  /// The layout of a given border. Returns nullopt if one of its shapes breaks the rules.
  static std::optional<BorderLayout> Of(const tracker::sg::Border& border);

  /// Places up to `large_shapes` large shapes, then as many small ones as fit.
  static BorderLayout Random(const ShapeLibrary& library, int large_shapes, RandomDraws* draws);

  /// This layout with one change: a shape is moved, turned, mirrored, replaced, added or removed,
  /// or two shapes are swapped.
  BorderLayout Varied(const ShapeLibrary& library, RandomDraws* draws) const;

  /// True if at least `modules` modules differ after each turn and mirroring.
  bool IsAsymmetric(int modules) const;

  /// Adds a shape. Returns false unless it lies in the band and has a black margin around it.
  bool Add(const Placed& placed);
  void Remove(std::size_t index);

  const std::vector<Placed>& shapes() const { return shapes_; }
  /// Valid until this layout changes.
  tracker::sg::Border border() const;

 private:
  bool Fits(const Placed& placed) const;
  void Draw(const Placed& placed, char value);
  void AddSmallShapes(const ShapeLibrary& library, int tries, RandomDraws* draws);

  std::vector<Placed> shapes_;
  std::array<std::string, kEdge> rows_;
};

}  // namespace pleinair::marker_search
