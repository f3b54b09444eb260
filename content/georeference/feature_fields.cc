#include "content/georeference/feature_fields.h"

#include <ogr_feature.h>

#include <utility>

#include "content/georeference/gdal_handles.h"

namespace pleinair::content {
namespace {

constexpr std::size_t kMaxValue = 200;  // Bytes.

std::string FieldsOf(OGRFeatureDefnH layer) {
  std::string names;
  for (int i = 0; i < OGR_FD_GetFieldCount(layer); ++i) {
    names += (names.empty() ? "" : ", ");
    names += OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(layer, i));
  }
  return names.empty() ? "it has none" : "its fields are: " + names.substr(0, 300);
}

}  // namespace

/// Evaluated by GDAL itself, never by the database of a file, which would take any SQL.
struct FeatureFields::Filter {
  OGRFeatureQuery query;
};

FeatureFields::FeatureFields() = default;
FeatureFields::~FeatureFields() = default;
FeatureFields::FeatureFields(FeatureFields&&) noexcept = default;
FeatureFields& FeatureFields::operator=(FeatureFields&&) noexcept = default;

Result<FeatureFields> FeatureFields::Create(OGRFeatureDefnH layer, const VectorQuery& query,
                                            const std::string& where) {
  const std::string name = std::string("layer \"") + OGR_FD_GetName(layer) + "\"";
  FeatureFields fields;
  for (const std::string& wanted : query.fields) {
    const int field = OGR_FD_GetFieldIndex(layer, wanted.c_str());
    if (field < 0) {
      return InputError(where, name + " has no field \"" + wanted.substr(0, 60) + "\"",
                        FieldsOf(layer));
    }
    fields.fields_.push_back(field);
  }
  if (query.where.empty()) return fields;
  fields.filter_ = std::make_unique<Filter>();
  CPLErrorReset();
  if (fields.filter_->query.Compile(OGRFeatureDefn::FromHandle(layer), query.where.c_str()) !=
      OGRERR_NONE) {
    return InputError(where,
                      name + " cannot be filtered by \"" + query.where.substr(0, 100) +
                          "\": " + QuietErrors::Last("it is no condition"),
                      FieldsOf(layer));
  }
  return fields;
}

bool FeatureFields::Selects(OGRFeatureH feature) const {
  return !filter_ || filter_->query.Evaluate(OGRFeature::FromHandle(feature)) != FALSE;
}

std::vector<std::optional<std::string>> FeatureFields::ValuesOf(OGRFeatureH feature) const {
  std::vector<std::optional<std::string>> values;
  values.reserve(fields_.size());
  for (const int field : fields_) {
    std::optional<std::string>& value = values.emplace_back();
    if (!OGR_F_IsFieldSetAndNotNull(feature, field)) continue;
    value = std::string(OGR_F_GetFieldAsString(feature, field)).substr(0, kMaxValue);
  }
  return values;
}

}  // namespace pleinair::content
