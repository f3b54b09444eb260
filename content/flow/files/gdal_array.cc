#include "content/flow/files/gdal_array.h"

#include <cpl_conv.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pleinair::content {
namespace {

/// NetCDF's usual fill value of floats and doubles, and what rounds to it.
constexpr double kUsualFill = 9.9e36;

struct AttributeDeleter {
  void operator()(GDALAttributeHS* attribute) const { GDALAttributeRelease(attribute); }
};
using Attribute = std::unique_ptr<GDALAttributeHS, AttributeDeleter>;

}  // namespace

StatedCrs GdalArray::Crs() const {
  // A copy of the array's, which it gives away.
  const std::unique_ptr<void, decltype(&OSRRelease)> copy(GDALMDArrayGetSpatialRef(array_.get()),
                                                          &OSRRelease);
  return ReadStatedCrs(copy.get());
}

std::string GdalArray::Text(const char* attribute) const {
  const Attribute found(GDALMDArrayGetAttribute(array_.get(), attribute));
  if (!found) return {};
  const char* text = GDALAttributeReadAsString(found.get());
  return text != nullptr ? std::string(text).substr(0, 1000) : std::string();
}

std::vector<double> GdalArray::Numbers(const char* attribute) const {
  const Attribute found(GDALMDArrayGetAttribute(array_.get(), attribute));
  std::size_t count = 0;
  if (!found) return {};
  double* values = GDALAttributeReadAsDoubleArray(found.get(), &count);
  std::vector<double> numbers(values, values + (values != nullptr ? count : 0));
  CPLFree(values);
  return numbers;
}

std::string GdalArray::Unit() const {
  const char* unit = GDALMDArrayGetUnit(array_.get());
  return unit != nullptr && *unit != '\0' ? std::string(unit).substr(0, 200) : Text("units");
}

std::optional<GdalArray> GdalArray::Open(GDALGroupH group, const std::string& name) {
  GdalArray array;
  array.array_.reset(name.find('/') != std::string::npos
                         ? GDALGroupOpenMDArrayFromFullname(group, name.c_str(), nullptr)
                         : GDALGroupOpenMDArray(group, name.c_str(), nullptr));
  if (!array.array_) return std::nullopt;
  array.name_ = name;
  std::size_t count = 0;
  GDALDimensionH* dimensions = GDALMDArrayGetDimensions(array.array_.get(), &count);
  for (std::size_t i = 0; i < count; ++i) {
    ArrayDimension dimension;
    dimension.name = GDALDimensionGetName(dimensions[i]);
    const char* type = GDALDimensionGetType(dimensions[i]);
    dimension.type = type != nullptr ? type : "";
    dimension.size = static_cast<std::size_t>(GDALDimensionGetSize(dimensions[i]));
    array.dimensions_.push_back(std::move(dimension));
  }
  GDALReleaseDimensions(dimensions, count);
  GDALExtendedDataTypeH type = GDALMDArrayGetDataType(array.array_.get());
  array.is_number_ = GDALExtendedDataTypeGetClass(type) == GEDTC_NUMERIC;
  array.is_double_ =
      array.is_number_ && GDALExtendedDataTypeGetNumericDataType(type) != GDT_Float32;
  GDALExtendedDataTypeRelease(type);
  for (const char* attribute : {"_FillValue", "missing_value"}) {
    for (const double value : array.Numbers(attribute)) array.missing_.push_back(value);
  }
  int has = 0;
  const double no_data = GDALMDArrayGetNoDataValueAsDouble(array.array_.get(), &has);
  if (has != 0) array.missing_.push_back(no_data);
  const double infinity = std::numeric_limits<double>::infinity();
  array.min_ = -infinity;
  array.max_ = infinity;
  const auto first = [&](const char* attribute, double otherwise) {
    const std::vector<double> numbers = array.Numbers(attribute);
    return numbers.empty() ? otherwise : numbers.front();
  };
  array.min_ = first("valid_min", array.min_);
  array.max_ = first("valid_max", array.max_);
  const std::vector<double> range = array.Numbers("valid_range");
  if (range.size() == 2) {
    array.min_ = range[0];
    array.max_ = range[1];
  }
  array.scale_ = first("scale_factor", GDALMDArrayGetScale(array.array_.get(), &has));
  if (array.scale_ == 0.0) array.scale_ = 1.0;
  array.offset_ = first("add_offset", GDALMDArrayGetOffset(array.array_.get(), &has));
  return array;
}

std::optional<std::vector<double>> GdalArray::Read(const std::vector<std::size_t>& start,
                                                   const std::vector<std::size_t>& count) const {
  std::vector<GUInt64> first(start.begin(), start.end());
  std::size_t values = 1;
  for (const std::size_t each : count) values *= each;
  std::vector<double> read(values);
  GDALExtendedDataTypeH type = GDALExtendedDataTypeCreate(GDT_Float64);
  const int done = GDALMDArrayRead(array_.get(), first.data(), count.data(), nullptr, nullptr, type,
                                   read.data(), read.data(), values * sizeof(double));
  GDALExtendedDataTypeRelease(type);
  if (done == 0) return std::nullopt;
  for (double& value : read) {
    const bool missing = !(std::fabs(value) < kUsualFill) || value < min_ || value > max_ ||
                         std::find(missing_.begin(), missing_.end(), value) != missing_.end();
    value = missing ? std::numeric_limits<double>::quiet_NaN() : value * scale_ + offset_;
  }
  return read;
}

std::optional<std::vector<double>> GdalArray::ReadAll() const {
  std::vector<std::size_t> start, count;
  for (const ArrayDimension& dimension : dimensions_) {
    start.push_back(0);
    count.push_back(dimension.size);
  }
  return Read(start, count);
}

}  // namespace pleinair::content
