#include "content/georeference/vector_formats.h"

#include <cpl_conv.h>
#include <ogrsf_frmts.h>

#include <mutex>

namespace pleinair::content {

void RegisterVectorFormats() {
  static std::once_flag once;
  std::call_once(once, [] {
    CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "FALSE");
    RegisterOGRGeoJSON();
    RegisterOGRGeoPackage();
    RegisterOGRShape();
    RegisterOGRFlatGeobuf();
    RegisterOGRKML();
    RegisterOGRGPX();
    RegisterOGRCSV();
    RegisterOGRDXF();
  });
}

}  // namespace pleinair::content
