#pragma once

#include <memory>

#include "base/vector.h"
#include "content/flow/grid_field.h"
#include "content/flow/grid_place.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// Samples one window of a field, point by point, and remembers the last cell: fast for points that
/// are near each other. One for each thread.
class FieldProbe {
 public:
  virtual ~FieldProbe() = default;

  /// `velocity` is set unless there is no flow.
  virtual PointState Sample(const Vec3& point, Seconds time, Vec3* velocity) = 0;
  virtual std::unique_ptr<FieldProbe> Copy() const = 0;
};

std::unique_ptr<FieldProbe> MakeProbe(const GridField& field, const FieldWindow& window);

/// A steady state of any field. Errors: those of reading.
Result<std::unique_ptr<FieldProbe>> MakeFrozenProbe(const VectorField& field, Seconds time);

}  // namespace pleinair::content
