#include "content/georeference/vector_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "tests/source_tree.h"
#include "tests/temporary_folder.h"

namespace pleinair::content {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::Content;
using tests::MessageOf;
using tests::TemporaryFolder;

/// Small maps.
fs::path Map(const std::string& name) {
  return tests::SourceTree() / "tests" / "fuzz" / "corpus" / "map" / name;
}

/// A coordinate as the WKB of line.gpkg has it, little endian.
std::string Bytes(double value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string WithNumber(std::string bytes, double from, double to) {
  const std::size_t at = bytes.find(Bytes(from));
  EXPECT_NE(at, std::string::npos);
  if (at != std::string::npos) bytes.replace(at, sizeof to, Bytes(to));
  return bytes;
}

TEST(VectorLayer, ReadsAGeoPackageWithItsCrsAndNames) {
  const auto layers = ReadVectorLayers(Map("line.gpkg"));
  ASSERT_TRUE(layers) << layers.error().Message();
  ASSERT_EQ(layers->size(), 1U);
  const VectorLayer& roads = layers->front();
  EXPECT_EQ(roads.name, "roads");
  EXPECT_EQ(roads.crs, "EPSG:4326");
  ASSERT_EQ(roads.features.size(), 1U);
  EXPECT_EQ(roads.features[0].name, "axis");
  ASSERT_EQ(roads.features[0].parts.size(), 1U);
  const GeometryPart& part = roads.features[0].parts[0];
  EXPECT_EQ(part.kind, PartKind::kLine);
  ASSERT_EQ(part.points.size(), 2U);
  EXPECT_EQ(part.points[0].x, 14.4213);
  EXPECT_EQ(part.points[1].y, 50.09);
}

TEST(VectorLayer, ListsTheLayersThatAGeoPackageHas) {
  EXPECT_THAT(MessageOf(ReadVectorLayers(Map("line.gpkg"), {.layer = "pipes"})),
              HasSubstr("has no layer \"pipes\"; its layers are: roads"));
}

// A file that lost some bytes is an error, never a part of the map.
TEST(VectorLayer, RefusesAGeoPackageThatIsCutShort) {
  const TemporaryFolder folder;
  const std::string whole = Content(Map("line.gpkg"));
  for (std::size_t size = 1; size < whole.size(); size += 117) {
    SCOPED_TRACE(size);
    const fs::path file = folder.Write("short.gpkg", whole.substr(0, size));
    const auto layers = ReadVectorLayers(file);
    ASSERT_FALSE(layers);
    EXPECT_THAT(layers.error().Message(), StartsWith(file.string() + ": "));
    EXPECT_EQ(layers.error().kind, ErrorKind::kInput);
  }
}

TEST(VectorLayer, NamesTheFeatureWhoseCoordinateIsNoNumber) {
  const std::string whole = Content(Map("line.gpkg"));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    const TemporaryFolder folder;
    const fs::path file = folder.Write("bad.gpkg", WithNumber(whole, 50.09, bad));
    EXPECT_THAT(MessageOf(ReadVectorLayers(file)), HasSubstr("feature 0 has a coordinate"));
  }
  EXPECT_THAT(MessageOf(ReadVectorLayers(Map("far.geojson"))),
              HasSubstr("feature 0 has a coordinate"));
}

TEST(VectorLayer, ReadsRingsOfAShapefileAndNeedsItsIndexOnDisk) {
  const auto layers = ParseVectorLayers(Content(Map("area.shp")), "area.shp");
  ASSERT_TRUE(layers) << layers.error().Message();
  ASSERT_EQ(layers->front().features.size(), 1U);
  const GeometryPart& ring = layers->front().features[0].parts.at(0);
  EXPECT_EQ(ring.kind, PartKind::kRing);
  EXPECT_EQ(ring.points.size(), 4U);
  EXPECT_TRUE(layers->front().crs.empty());
  const TemporaryFolder folder;
  const fs::path alone = folder.Write("area.shp", Content(Map("area.shp")));
  EXPECT_THAT(MessageOf(ReadVectorLayers(alone)), HasSubstr("area.shx"));
  EXPECT_FALSE(fs::exists(folder / "area.shx"));
}

TEST(VectorLayer, NumbersFeaturesWithAndWithoutGeometry) {
  const auto layers = ReadVectorLayers(Map("mixed.geojson"));
  ASSERT_TRUE(layers) << layers.error().Message();
  const std::vector<MapFeature>& features = layers->front().features;
  ASSERT_EQ(features.size(), 4U);
  EXPECT_TRUE(features[0].has_heights);
  EXPECT_EQ(features[1].parts.at(0).kind, PartKind::kRing);
  EXPECT_EQ(features[2].parts.at(0).kind, PartKind::kLine);
  EXPECT_TRUE(features[3].parts.empty());
  EXPECT_EQ(features[3].number, 3U);
}

// Formats that follow links to other files or hosts are not opened, whatever their ending.
TEST(VectorLayer, OpensNoFormatThatLinksToOtherFiles) {
  const TemporaryFolder folder;
  const std::string vrt = "<OGRVRTDataSource><OGRVRTLayer name=\"roads\"><SrcDataSource>" +
                          Map("line.gpkg").string() +
                          "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>";
  for (const char* name : {"map.vrt", "map.geojson", "map.gpkg"}) {
    EXPECT_FALSE(ReadVectorLayers(folder.Write(name, vrt))) << name;
  }
  EXPECT_FALSE(ReadVectorLayers("/vsicurl/http://127.0.0.1:9/map.geojson"));
  EXPECT_FALSE(ReadVectorLayers("{\"type\":\"Point\",\"coordinates\":[14,50]}"));
}

TEST(VectorLayer, RefusesCollectionsThatAreNestedTooDeeply) {
  const TemporaryFolder folder;
  std::string text = R"({"type":"Point","coordinates":[14,50]})";
  for (int i = 0; i < 60; ++i) {
    text.insert(0, R"({"type":"GeometryCollection","geometries":[)").append("]}");
  }
  EXPECT_THAT(MessageOf(ReadVectorLayers(folder.Write("deep.geojson", text))),
              AnyOf(HasSubstr("nested"), HasSubstr("cannot be read"), HasSubstr("damaged")));
}

}  // namespace
}  // namespace pleinair::content
