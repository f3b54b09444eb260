#include "content/georeference/stated_crs.h"

#include <cpl_conv.h>

#include <array>

namespace pleinair::content {

StatedCrs ReadStatedCrs(OGRSpatialReferenceH srs) {
  StatedCrs stated;
  if (srs == nullptr) return stated;
  const char* name = OSRGetName(srs);
  stated.name = name != nullptr ? name : "unknown";
  const char* authority = OSRGetAuthorityName(srs, nullptr);
  const char* code = OSRGetAuthorityCode(srs, nullptr);
  if (authority != nullptr && code != nullptr) {
    stated.text = std::string(authority) + ":" + code;
    stated.has_code = true;
    return stated;
  }
  constexpr std::array<const char*, 2> kOptions = {"FORMAT=WKT2_2019", nullptr};
  char* wkt = nullptr;
  if (OSRExportToWktEx(srs, &wkt, kOptions.data()) == OGRERR_NONE && wkt != nullptr) {
    stated.text = wkt;
  }
  CPLFree(wkt);
  return stated;
}

}  // namespace pleinair::content
