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
    int x = 0, y = 0;  ///< Module of its top-left corner, from the black square's.
    bool IsLarge() const { return shape.Width() > 3 || shape.Height() > 3; }
  };

  BorderLayout();

  /// The shapes of a border; none where one of them breaks the rules.
  static std::optional<BorderLayout> Of(const tracker::sg::Border& border);

  /// `large_shapes` large shapes (fewer if there is no room) and as many small ones as fit.
  static BorderLayout Random(const ShapeLibrary& library, int large_shapes, RandomDraws* draws);

  /// This one with one thing changed: a shape moved, turned, mirrored, reshaped, added, removed, or
  /// changed for another.
  BorderLayout Varied(const ShapeLibrary& library, RandomDraws* draws) const;

  /// At least so many modules look otherwise after each turn and mirroring.
  bool IsAsymmetric(int modules) const;

  /// Puts a shape where it lies in the band and has black around it; false where it cannot be.
  bool Add(const Placed& placed);
  void Remove(std::size_t index);

  const std::vector<Placed>& shapes() const { return shapes_; }
  /// Valid as long as this layout is unchanged.
  tracker::sg::Border border() const;

 private:
  bool Fits(const Placed& placed) const;
  void Draw(const Placed& placed, char value);
  void AddSmallShapes(const ShapeLibrary& library, int tries, RandomDraws* draws);

  std::vector<Placed> shapes_;
  std::array<std::string, kEdge> rows_;
};

}  // namespace pleinair::marker_search
