// GRIB and GeoTIFF, written by GDAL.
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <string>
#include <vector>

#include "content/flow/files/flow_file.h"
#include "tests/temporary_folder.h"

namespace pleinair::content {
namespace {

constexpr int kColumns = 21, kRows = 13;

/// Wind at 10 m over 10° x 6°, cells of half a degree, north first: u = 10 + column, v = row.
std::string WriteWind(const std::string& file, const char* driver, const std::string& unit) {
  GDALRegister_MEM();
  GDALRegister_GRIB();
  GDALRegister_GTiff();
  GDALDatasetH raster =
      GDALCreate(GDALGetDriverByName("MEM"), "", kColumns, kRows, 2, GDT_Float64, nullptr);
  double place[6] = {-5.25, 0.5, 0.0, 53.25, 0.0, -0.5};
  GDALSetGeoTransform(raster, place);
  GDALSetProjection(raster, SRS_WKT_WGS84_LAT_LONG);
  for (int b = 1; b <= 2; ++b) {
    std::vector<double> values;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column)
        values.push_back(b == 1 ? 10 + column : row);
    }
    GDALRasterBandH band = GDALGetRasterBand(raster, b);
    EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, kColumns, kRows, values.data(), kColumns, kRows,
                           GDT_Float64, 0, 0),
              CE_None);
    if (!unit.empty()) GDALSetRasterUnitType(band, unit.c_str());
  }
  char** options = nullptr;
  if (std::string(driver) == "GRIB") {
    // Momentum (2): components u (2) and v (3), 10 m above the ground.
    const std::string rest = " 2 0 96 0 0 0 1 0 0 0 0 103 0 0 0 0 10 255 0 0 0 0 0";
    options = CSLSetNameValue(options, "DISCIPLINE", "0");
    options = CSLSetNameValue(options, "PDS_PDTN", "0");
    options = CSLSetNameValue(options, "DATA_ENCODING", "IEEE_FLOATING_POINT");
    options = CSLSetNameValue(options, "BAND_1_PDS_TEMPLATE_NUMBERS", ("2 2" + rest).c_str());
    options = CSLSetNameValue(options, "BAND_2_PDS_TEMPLATE_NUMBERS", ("2 3" + rest).c_str());
    options = CSLSetNameValue(options, "IDS",
                              "CENTER=7 SUBCENTER=0 MASTER_TABLE=2 SIGNF_REF_TIME=1 "
                              "REF_TIME=2025-09-14T11:00:00Z PROD_STATUS=0 TYPE=1");
  }
  GDALDatasetH copy = GDALCreateCopy(GDALGetDriverByName(driver), file.c_str(), raster, 0, options,
                                     nullptr, nullptr);
  EXPECT_NE(copy, nullptr);
  GDALClose(copy);
  GDALClose(raster);
  CSLDestroy(options);
  return file;
}

/// At column 4, row 2: 3° W, 52° N; between there and the next column.
void ExpectWind(const FlowFile& flow, double factor) {
  for (const double part : {0.0, 0.5}) {
    const Vec3 at = flow.chart.FromFile({-3.0 + 0.5 * part, 52.0, 0.0});
    const Velocity v = flow.field->At(at, 0.0);
    const Vec3 stretch = flow.field->Stretch(at);
    EXPECT_NEAR(v.x / stretch.x, factor * (14.0 + part), 1e-5);
    EXPECT_NEAR(v.y / stretch.y, factor * 2.0, 1e-5);
  }
}

TEST(FlowRasters, ReadGrib) {
  const tests::TemporaryFolder folder;
  const auto flow = ReadFlowFile(WriteWind((folder / "wind.grib2").string(), "GRIB", ""), {});
  ASSERT_TRUE(flow) << flow.error().Message();
  ExpectWind(*flow, 1.0);
  EXPECT_EQ(flow->first_time->ToString(), "2025-09-14T11:00:00Z");
  EXPECT_EQ(flow->arrays.front(), "UGRD 10-HTGL");
}

TEST(FlowRasters, ReadBandsOfGeoTiff) {
  const tests::TemporaryFolder folder;
  const auto flow = ReadFlowFile(WriteWind((folder / "wind.tif").string(), "GTiff", "knots"), {});
  ASSERT_TRUE(flow) << flow.error().Message();
  ExpectWind(*flow, 1852.0 / 3600.0);
  const auto unknown = ReadFlowFile(WriteWind((folder / "w.tif").string(), "GTiff", "degC"), {});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().Message().find("degC"), std::string::npos);
}

}  // namespace
}  // namespace pleinair::content
