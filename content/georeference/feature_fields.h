#pragma once

// Internal: attributes of features, as GDAL reads them.

#include <ogr_api.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "content/georeference/vector_layer.h"

namespace pleinair::content {

/// The attributes that a query needs of one layer.
class FeatureFields {
 public:
  /// Errors (input): the layer lacks a field, which lists those there are; the filter cannot be
  /// parsed. `where` names the file.
  static Result<FeatureFields> Create(OGRFeatureDefnH layer, const VectorQuery& query,
                                      const std::string& where);
  ~FeatureFields();
  FeatureFields(FeatureFields&&) noexcept;
  FeatureFields& operator=(FeatureFields&&) noexcept;

  /// True if the filter of the query selects the feature.
  bool Selects(OGRFeatureH feature) const;
  /// The values of the query's fields.
  std::vector<std::optional<std::string>> ValuesOf(OGRFeatureH feature) const;

 private:
  struct Filter;
  FeatureFields();

  std::vector<int> fields_;
  std::unique_ptr<Filter> filter_;
};

}  // namespace pleinair::content
