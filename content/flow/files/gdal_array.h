#pragma once

// Internal: GDAL's multidimensional arrays.

#include <gdal.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/georeference/gdal_handles.h"
#include "content/georeference/stated_crs.h"

namespace pleinair::content {

struct GroupDeleter {
  void operator()(GDALGroupHS* group) const { GDALGroupRelease(group); }
};
using Group = std::unique_ptr<GDALGroupHS, GroupDeleter>;

/// A dimension of an array.
struct ArrayDimension {
  std::string name, type;
  std::size_t size = 0;
};

/// An array of a file, with what its attributes state.
class GdalArray {
 public:
  /// Empty if the group has none of that name.
  static std::optional<GdalArray> Open(GDALGroupH group, const std::string& name);

  const std::string& name() const { return name_; }
  const std::vector<ArrayDimension>& dimensions() const { return dimensions_; }
  std::string Text(const char* attribute) const;
  std::vector<double> Numbers(const char* attribute) const;
  std::string Unit() const;
  bool is_double() const { return is_double_; }  ///< Doubles, or packed integers.
  bool is_number() const { return is_number_; }
  StatedCrs Crs() const;

  /// The values from `start`, `count` of each dimension, unpacked; not a number where missing.
  /// Unset: the file is damaged.
  std::optional<std::vector<double>> Read(const std::vector<std::size_t>& start,
                                          const std::vector<std::size_t>& count) const;
  std::optional<std::vector<double>> ReadAll() const;

 private:
  struct ArrayDeleter {
    void operator()(GDALMDArrayHS* array) const { GDALMDArrayRelease(array); }
  };

  std::unique_ptr<GDALMDArrayHS, ArrayDeleter> array_;
  std::string name_;
  std::vector<ArrayDimension> dimensions_;
  bool is_double_ = false, is_number_ = false;
  std::vector<double> missing_;
  double min_ = 0.0, max_ = 0.0, scale_ = 1.0, offset_ = 0.0;  // Of packed values.
};

}  // namespace pleinair::content
