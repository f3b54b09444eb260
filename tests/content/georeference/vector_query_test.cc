// Filters, attributes, mended areas and further formats of maps of vectors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "content/georeference/line_file.h"
#include "content/georeference/vector_layer.h"
#include "tests/temporary_folder.h"

namespace pleinair::content {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Optional;
using tests::MessageOf;
using tests::TemporaryFolder;

constexpr const char* kPlan = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"status":"new","Depth":-1.25,"colour":"#102030"},
 "geometry":{"type":"LineString","coordinates":[[14.42,50.08],[14.43,50.09]]}},
{"type":"Feature","properties":{"status":"old","Depth":2},
 "geometry":{"type":"Point","coordinates":[14.42,50.08]}},
{"type":"Feature","properties":{"status":"new","Depth":null},
 "geometry":{"type":"Point","coordinates":[14.44,50.08]}}]})";

TEST(VectorQuery, SelectsFeaturesByTheirAttributes) {
  const TemporaryFolder folder;
  const auto file = folder.Write("plan.geojson", kPlan);
  const auto numbers = [&](const std::string& where) {
    std::vector<double> first_longitudes;
    const auto layers = ReadVectorLayers(file, {.where = where});
    EXPECT_TRUE(layers) << layers.error().Message();
    for (const MapFeature& feature : layers->at(0).features) {
      EXPECT_EQ(feature.number, first_longitudes.size());
      first_longitudes.push_back(feature.parts.at(0).points.at(0).x);
    }
    return first_longitudes;
  };
  EXPECT_THAT(numbers("status = 'new'"), ElementsAre(14.42, 14.44));
  EXPECT_THAT(numbers("depth < 0 OR status = 'old'"), ElementsAre(14.42, 14.42));
  EXPECT_THAT(numbers("status = 'gone'"), ElementsAre());
}

TEST(VectorQuery, NamesTheFieldsWhereOneIsMissing) {
  const TemporaryFolder folder;
  const auto file = folder.Write("plan.geojson", kPlan);
  EXPECT_THAT(MessageOf(ReadVectorLayers(file, {.where = "phase = 1"})),
              AllOf(HasSubstr("plan.geojson: layer \"plan\" cannot be filtered"),
                    HasSubstr("its fields are: status, Depth, colour")));
  EXPECT_THAT(MessageOf(ReadVectorLayers(file, {.where = "status ="})),
              HasSubstr("cannot be filtered"));
  EXPECT_THAT(MessageOf(ReadVectorLayers(file, {.fields = {"height"}})),
              HasSubstr("has no field \"height\"; its fields are: status, Depth, colour"));
}

TEST(VectorQuery, ReadsAttributesInAnyCaseOfLetters) {
  const TemporaryFolder folder;
  const auto layers =
      ReadVectorLayers(folder.Write("plan.geojson", kPlan), {.fields = {"depth", "colour"}});
  ASSERT_TRUE(layers) << layers.error().Message();
  const auto& features = layers->at(0).features;
  EXPECT_THAT(features.at(0).values,
              ElementsAre(Optional(std::string("-1.25")), Optional(std::string("#102030"))));
  EXPECT_THAT(features.at(1).values, ElementsAre(Optional(std::string("2")), std::nullopt));
  EXPECT_THAT(features.at(2).values, ElementsAre(std::nullopt, std::nullopt));
}

/// Area inside the rings, by the shoelace formula; rings of holes run the other way.
double AreaOf(const MapFeature& feature) {
  double area = 0.0;
  for (const GeometryPart& part : feature.parts) {
    EXPECT_EQ(part.kind, PartKind::kRing);
    for (std::size_t i = 1; i < part.points.size(); ++i) {
      const MapPoint &a = part.points[i - 1], &b = part.points[i];
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
  }
  return area;
}

TEST(VectorQuery, MendsAreasWhoseRingsCrossThemselves) {
  const TemporaryFolder folder;
  // A bow tie of two triangles, each with the area 1, and a square.
  const auto file = folder.Write("ties.geojson", R"({"type":"GeometryCollection","geometries":[
{"type":"Polygon","coordinates":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]},
{"type":"Polygon","coordinates":[[[4,0],[5,0],[5,1],[4,1],[4,0]]]}]})");
  const auto as_is = ReadVectorLayers(file);
  ASSERT_TRUE(as_is);
  EXPECT_EQ(as_is->at(0).features.at(0).parts.at(0).points.size(), 5U);
  const auto bow = folder.Write(
      "bow.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]})");
  const auto mended = ReadVectorLayers(bow, {.mend_areas = true});
  ASSERT_TRUE(mended);
  const MapFeature& feature = mended->at(0).features.at(0);
  EXPECT_TRUE(feature.mended);
  EXPECT_EQ(feature.parts.size(), 2U);
  EXPECT_NEAR(std::fabs(AreaOf(feature)), 2.0, 1e-12);
  const auto square = folder.Write(
      "square.geojson", R"({"type":"Polygon","coordinates":[[[4,0],[5,0],[5,1],[4,1],[4,0]]]})");
  const auto whole = ReadVectorLayers(square, {.mend_areas = true});
  ASSERT_TRUE(whole);
  EXPECT_FALSE(whole->at(0).features.at(0).mended);
}

TEST(VectorQuery, ReadsCsvKmlGpxAndDxf) {
  const TemporaryFolder folder;
  const auto only = [](const auto& layers) -> MapFeature {
    EXPECT_TRUE(layers) << layers.error().Message();
    if (!layers) return {};
    EXPECT_EQ(layers->size(), 1U);
    EXPECT_EQ(layers->at(0).features.size(), 1U);
    return layers->at(0).features.at(0);
  };
  const auto csv =
      ReadVectorLayers(folder.Write("pipes.csv", "WKT,depth\n\"LINESTRING (1 2,3 4)\",0.8\n"),
                       {.fields = {"depth"}});
  const MapFeature pipe = only(csv);
  EXPECT_EQ(pipe.parts.at(0).points.at(1), (MapPoint{3, 4, 0}));
  EXPECT_THAT(pipe.values, ElementsAre(Optional(std::string("0.8"))));
  EXPECT_TRUE(csv->at(0).crs.empty());
  const auto kml = ReadVectorLayers(folder.Write("trail.kml",
                                                 R"(<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Folder><name>trail</name><Placemark>
<name>ridge</name><LineString><coordinates>14.42,50.08,200 14.43,50.09,210</coordinates>
</LineString></Placemark></Folder></Document></kml>)"));
  EXPECT_EQ(only(kml).parts.at(0).points.at(1).x, 14.43);
  EXPECT_THAT(kml->at(0).crs_name, HasSubstr("WGS 84"));
  const auto gpx = ReadVectorLayers(folder.Write("walk.gpx", R"(<?xml version="1.0"?>
<gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg>
<trkpt lat="50.08" lon="14.42"></trkpt><trkpt lat="50.09" lon="14.43"></trkpt>
</trkseg></trk></gpx>)"));
  ASSERT_TRUE(gpx) << gpx.error().Message();
  std::size_t features = 0;
  for (const VectorLayer& layer : *gpx) features += layer.features.size();
  EXPECT_EQ(features, 1U);  // The track, without its points.
  const auto dxf = ReadVectorLayers(
      folder.Write("axis.dxf",
                   "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n1.5\n20\n2.5\n30\n0\n11\n4\n21\n5\n"
                   "31\n0\n0\nENDSEC\n0\nEOF\n"));
  EXPECT_EQ(only(dxf).parts.at(0).points.at(0).x, 1.5);
}

TEST(LineFile, WritesAGeoPackageInAnyCrs) {
  const TemporaryFolder folder;
  const Place place{50.0875, 14.4213, 220.0, HeightReference::kSeaLevel};
  const auto transform = MapTransform::Create("EPSG:5514", place, "--crs");
  ASSERT_TRUE(transform);
  const std::vector<WrittenLine> lines{{3, 0, {{14.42, 50.08, 200.5}, {14.43, 50.09, 210.25}}},
                                       {4, 1, {{14.42, 50.085, 201.0}}}};
  const auto file = folder / "lines.gpkg";
  const auto written = WriteGeoPackage(file, "EPSG:5514", *transform, lines);
  ASSERT_TRUE(written) << written.error().Message();
  const auto read = ReadVectorLayers(file, {.fields = {"feature", "part"}});
  ASSERT_TRUE(read) << read.error().Message();
  const VectorLayer& layer = read->at(0);
  EXPECT_EQ(layer.name, "drape");
  EXPECT_EQ(layer.crs, "EPSG:5514");
  ASSERT_EQ(layer.features.size(), 2U);
  EXPECT_THAT(layer.features[1].values,
              ElementsAre(Optional(std::string("4")), Optional(std::string("1"))));
  const MapPoint point = layer.features[0].parts.at(0).points.at(1);
  const auto back = transform->Geodetic(point);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->longitude_deg, 14.43, 2e-8);  // The inverse of Krovak is good to 1 mm.
  EXPECT_NEAR(back->latitude_deg, 50.09, 2e-8);
  EXPECT_NEAR(point.z, 210.25, 1e-9);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& each : std::filesystem::directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(files, 1U);
}

}  // namespace
}  // namespace pleinair::content
