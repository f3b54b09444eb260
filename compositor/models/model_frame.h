#pragma once

#include <optional>

#include "base/up_axis.h"
#include "base/vector.h"

namespace pleinair::compositor {

struct Model;

/// Coordinates of a model's file, and those in which the model is placed.
struct ModelFrame {
  /// Axis of the file that points up. Unset: y for glTF; OBJ has the axes of `placed_up`.
  std::optional<UpAxis> file_up;
  UpAxis placed_up = UpAxis::kZ;  ///< Axis that points up where the model is placed.
  double unit_m = 1.0;            ///< Metres of one unit of the file.
  /// If true, the origin is the centre of the model's bounding box, at its lowest height.
  bool bottom_centre = false;
};

/// Map of a model's positions: linear p + translation.
struct FrameMap {
  Mat3 linear;
  Vec3 translation_m;
};

/// Axis-aligned bounding box, metres.
struct ModelBounds {
  Vec3 min_m, max_m;
  Vec3 Size() const { return max_m - min_m; }
  Vec3 Centre() const { return (min_m + max_m) * 0.5; }
};

/// The box around all triangles. It includes Model::origin_m. A model without triangles has the
/// point of its origin.
ModelBounds BoundsOf(const Model& model);

/// Takes a model as read from its file to `frame`. Positions are relative to Model::origin_m, so
/// that a model in survey coordinates keeps its shape in single precision. Returns the map that all
/// positions took, without Model::origin_m.
FrameMap ApplyFrame(const ModelFrame& frame, Model* model);

/// Returns whether a model that is read as z-up was probably modelled with y up. Either it stands
/// on y = 0 and is centred on z = 0. Or only z divides it into equal halves, as it divides a body
/// that faces x. For files of Blender, whose OBJ export is y-up by default, it suffices that the
/// model does not stand on z = 0.
bool LooksYUp(const Model& model);

}  // namespace pleinair::compositor
