// Velocities of NetCDF files, written here by the format's rules.
#include "content/flow/files/flow_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "content/flow/files/cf_time.h"
#include "content/flow/files/field_source.h"
#include "content/flow/files/velocity_units.h"
#include "content/flow/line_integrator.h"
#include "tests/content/flow/flow_files.h"
#include "tests/netcdf_writer.h"

namespace pleinair::content {
namespace {

using ::testing::HasSubstr;
using tests::NetCdfWriter;

std::vector<double> Steps(double first, double step, int count) {
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back(first + step * i);
  return nodes;
}

/// A wind over 20° x 16° around longitude 0, in metres per second.
Vec2 Wind(double longitude, double latitude) {
  return {10.0 + 3.0 * std::sin(0.2 * latitude), 4.0 * std::cos(0.3 * longitude)};
}

struct WindFile {
  std::function<double(double)> longitude = [](double l) { return l; };
  bool from_north = false;
  std::string unit = "m s-1";
  double per_unit = 1.0;
  NetCdfWriter::Type type = NetCdfWriter::Type::kDouble;
  double scale = 1.0, offset = 0.0;
};

std::string WindNetCdf(const WindFile& kind) {
  NetCdfWriter file;
  std::vector<double> longitudes = Steps(-10.0, 0.5, 41), latitudes = Steps(42.0, 0.5, 33);
  if (kind.from_north) std::reverse(latitudes.begin(), latitudes.end());
  std::vector<double> stated, u, v;
  for (const double l : longitudes) stated.push_back(kind.longitude(l));
  for (const double latitude : latitudes) {
    for (const double longitude : longitudes) {
      const Vec2 wind = Wind(longitude, latitude);
      u.push_back((wind.x / kind.per_unit - kind.offset) / kind.scale);
      v.push_back((wind.y / kind.per_unit - kind.offset) / kind.scale);
    }
  }
  file.AddAxis("lat", latitudes, {{"units", "degrees_north"}});
  file.AddAxis("lon", stated, {{"units", "degrees_east"}});
  NetCdfWriter::Numbers numbers;
  if (kind.type == NetCdfWriter::Type::kShort) {
    numbers = {{"scale_factor", kind.scale}, {"add_offset", kind.offset}, {"_FillValue", -32768}};
  }
  file.AddVariable({"u10",
                    {"lat", "lon"},
                    u,
                    {{"standard_name", "eastward_wind"}, {"units", kind.unit}},
                    numbers,
                    kind.type});
  file.AddVariable({"v10",
                    {"lat", "lon"},
                    v,
                    {{"standard_name", "northward_wind"}, {"units", kind.unit}},
                    numbers,
                    kind.type});
  return file.Bytes();
}

class FlowFilesOfWind : public FlowFiles {
 protected:
  std::vector<FlowLine> LinesOf(const WindFile& kind) {
    const FlowFile flow = Read(Write("wind.nc", WindNetCdf(kind)));
    std::vector<Seed> seeds;
    for (const double longitude : {-8.0, -0.25, 0.0, 5.0}) {
      seeds.push_back({flow.chart.FromFile({kind.longitude(longitude), 50.0, 0.0}), 0.0});
    }
    return TraceLines(*flow.field, seeds, {.direction = LineDirection::kBoth}).value();
  }

  /// `within`: relative to times, and to the length of the lines.
  void ExpectSameLines(const WindFile& kind, double within) {
    constexpr double kLength_m = 1e6;  // From border to border of the wind.
    const auto plain = LinesOf({}), other = LinesOf(kind);
    ASSERT_EQ(plain.size(), 4U);
    ASSERT_EQ(other.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      // The lines end at the same places of the border after the same time.
      EXPECT_NEAR(other[i].times_s.back() / plain[i].times_s.back(), 1.0, within) << i;
      for (const bool last : {false, true}) {
        const Vec3 a = last ? plain[i].points.back() : plain[i].points.front();
        const Vec3 b = last ? other[i].points.back() : other[i].points.front();
        EXPECT_LE(Norm(a - b), within * kLength_m) << i;
      }
    }
  }
};

TEST_F(FlowFilesOfWind, IsTheSameInKnotsAndKilometresPerHour) {
  ExpectSameLines({.unit = "knots", .per_unit = 1852.0 / 3600.0}, 1e-9);
  ExpectSameLines({.unit = "km/h", .per_unit = 1.0 / 3.6}, 1e-9);
}

TEST_F(FlowFilesOfWind, IsTheSameForLongitudesFrom0To360) {
  ExpectSameLines({.longitude = [](double l) { return l < 0.0 ? l + 360.0 : l; }}, 1e-9);
  ExpectSameLines({.longitude = [](double l) { return l + 360.0; }}, 1e-9);
}

TEST_F(FlowFilesOfWind, IsTheSameForRowsFromTheNorth) {
  ExpectSameLines({.from_north = true}, 1e-12);
}

TEST_F(FlowFilesOfWind, IsWithinTheQuantumOfPackedShorts) {
  // Half a quantum of 1 mm/s is 5e-5 of a wind of 10 m/s, in each component.
  ExpectSameLines({.type = NetCdfWriter::Type::kShort, .scale = 0.001, .offset = 5.0}, 1e-4);
}

// Due east along a parallel: the speed in degrees follows from the radius of the parallel.
TEST_F(FlowFiles, AreTrueToScaleOnTheEllipsoid) {
  NetCdfWriter file;
  file.AddAxis("lat", Steps(40.0, 1.0, 21), {{"units", "degrees_north"}});
  file.AddAxis("lon", Steps(0.0, 1.0, 31), {{"units", "degrees_east"}});
  const std::vector<double> ten(21 * 31, 10.0), none(21 * 31, 0.0);
  file.AddVariable(
      {"u", {"lat", "lon"}, ten, {{"standard_name", "eastward_wind"}, {"units", "m s-1"}}});
  file.AddVariable(
      {"v", {"lat", "lon"}, none, {{"standard_name", "northward_wind"}, {"units", "m s-1"}}});
  const FlowFile flow = Read(Write("wind.nc", file.Bytes()));
  const Seconds duration = 3600.0;
  for (const double latitude : {41.0, 50.0, 58.0}) {
    const Seed seed{flow.chart.FromFile({5.0, latitude, 0.0}), 0.0};
    const auto lines =
        TraceLines(*flow.field, std::vector<Seed>{seed}, {.duration_s = duration}).value();
    ASSERT_EQ(lines.size(), 1U);
    const Vec3 end = flow.chart.ToFile(lines[0].points.back());
    const GeodesicWay way = ShortestWay({5.0, latitude, 0.0}, {end.x, end.y, 0.0});
    EXPECT_NEAR(way.distance_m, 10.0 * duration, 0.5);
    EXPECT_NEAR(end.y, latitude, 1e-9);
    EXPECT_NEAR(lines[0].speeds_m_s.back(), 10.0, 1e-9);
  }
}

TEST_F(FlowFiles, CrossTheMeridianOfAGlobe) {
  NetCdfWriter file;
  file.AddAxis("latitude", Steps(-60.0, 2.0, 61), {{"units", "degrees_north"}});
  file.AddAxis("longitude", Steps(0.0, 2.0, 180), {{"units", "degrees_east"}});
  const std::vector<double> ten(61 * 180, 10.0), none(61 * 180, 0.0);
  file.AddVariable({"u10",
                    {"latitude", "longitude"},
                    ten,
                    {{"standard_name", "eastward_wind"}, {"units", "m s**-1"}}});
  file.AddVariable({"v10",
                    {"latitude", "longitude"},
                    none,
                    {{"standard_name", "northward_wind"}, {"units", "m s**-1"}}});
  const FlowFile flow = Read(Write("globe.nc", file.Bytes()));
  const auto lines =
      TraceLines(*flow.field, std::vector<Seed>{{flow.chart.FromFile({359.5, 0.0, 0.0}), 0.0}},
                 {.duration_s = 50000.0});
  ASSERT_EQ(lines->size(), 1U);
  EXPECT_EQ(lines->front().downstream_end, LineEnd::kDuration);
  const double end = flow.chart.ToFile(lines->front().points.back()).x;
  EXPECT_NEAR(std::remainder(end - 359.5, 360.0), 500000.0 / 111319.49, 1e-3);
}

TEST_F(FlowFiles, HaveTimesHeightsAndWalls) {
  NetCdfWriter file;
  file.AddAxis("time", {1.0, 2.0, 4.0},
               {{"units", "hours since 2025-09-14 11:00:00"}, {"standard_name", "time"}});
  file.AddAxis("height", {10.0, 20.0, 40.0}, {{"units", "m"}, {"axis", "Z"}});
  file.AddAxis("y", Steps(0.0, 10.0, 5), {{"units", "m"}, {"axis", "Y"}});
  file.AddAxis("x", Steps(0.0, 10.0, 6), {{"units", "m"}, {"axis", "X"}});
  std::vector<double> u, v, w;
  for (int t = 0; t < 3; ++t) {
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 5; ++j) {
        for (int i = 0; i < 6; ++i) {
          u.push_back(i == 5 ? -999.0 : 1.0 + t);
          v.push_back(0.1 * j);
          w.push_back(0.01 * k);
        }
      }
    }
  }
  const std::vector<std::string> dimensions{"time", "height", "y", "x"};
  file.AddVariable({"u",
                    dimensions,
                    u,
                    {{"standard_name", "x_wind"}, {"units", "m s-1"}},
                    {{"_FillValue", -999.0}},
                    NetCdfWriter::Type::kFloat});
  file.AddVariable({"v",
                    dimensions,
                    v,
                    {{"standard_name", "y_wind"}, {"units", "m s-1"}},
                    {},
                    NetCdfWriter::Type::kFloat});
  file.AddVariable({"w",
                    dimensions,
                    w,
                    {{"standard_name", "upward_air_velocity"}, {"units", "m s-1"}},
                    {},
                    NetCdfWriter::Type::kFloat});
  const FlowFile flow = Read(Write("box.nc", file.Bytes()));
  EXPECT_TRUE(flow.has_heights);
  EXPECT_EQ(flow.first_time->ToString(), "2025-09-14T12:00:00Z");
  EXPECT_THAT(flow.field->times(), ::testing::ElementsAre(0.0, 3600.0, 10800.0));
  EXPECT_THAT(flow.arrays, ::testing::ElementsAre("u", "v", "w"));
  const Velocity at = flow.field->At({10.0, 20.0, 30.0}, 1800.0);
  EXPECT_NEAR(at.x, 1.5, 1e-6);
  EXPECT_NEAR(at.y, 0.2, 1e-6);
  EXPECT_NEAR(at.z, 0.015, 1e-6);
  EXPECT_TRUE(std::isnan(flow.field->At({45.0, 20.0, 30.0}, 0.0).x));
}

TEST_F(FlowFiles, HaveCurvilinearLongitudesAndLatitudes) {
  NetCdfWriter file;
  file.AddDimension("eta", 20);
  file.AddDimension("xi", 30);
  std::vector<double> lon, lat, u, v;
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 30; ++i) {
      lon.push_back(std::fmod(359.8 + 0.01 * i + 0.004 * j, 360.0));
      lat.push_back(50.0 + 0.01 * j - 0.002 * i);
      u.push_back(0.0);
      v.push_back(0.5);
    }
  }
  file.AddVariable(
      {"lon_rho", {"eta", "xi"}, lon, {{"standard_name", "longitude"}, {"units", "degrees_east"}}});
  file.AddVariable(
      {"lat_rho", {"eta", "xi"}, lat, {{"standard_name", "latitude"}, {"units", "degrees_north"}}});
  for (const auto& [name, standard, values] :
       {std::tuple{"ue", "eastward_sea_water_velocity", u},
        std::tuple{"vn", "northward_sea_water_velocity", v}}) {
    file.AddVariable(
        {name,
         {"eta", "xi"},
         values,
         {{"standard_name", standard}, {"units", "m s-1"}, {"coordinates", "lon_rho lat_rho"}}});
  }
  const FlowFile flow = Read(Write("roms.nc", file.Bytes()));
  const auto lines =
      TraceLines(*flow.field, std::vector<Seed>{{flow.chart.FromFile({0.0, 50.05, 0.0}), 0.0}},
                 {.duration_s = 3600.0});
  ASSERT_EQ(lines->size(), 1U);
  const Vec3 end = flow.chart.ToFile(lines->front().points.back());
  EXPECT_NEAR(std::remainder(end.x, 360.0), 0.0, 1e-9);
  EXPECT_NEAR(ShortestWay({0.0, 50.05, 0.0}, {0.0, end.y, 0.0}).distance_m, 1800.0, 0.1);
}

/// UTM 33N around 18° east, where grid north lies 2.3° from true north.
std::string UtmNetCdf(const std::string& east_name, const std::string& north_name) {
  NetCdfWriter file;
  file.AddAxis("y", Steps(5540000.0, 200.0, 41),
               {{"units", "m"}, {"standard_name", "projection_y_coordinate"}});
  file.AddAxis("x", Steps(710000.0, 200.0, 41),
               {{"units", "m"}, {"standard_name", "projection_x_coordinate"}});
  file.AddVariable({"crs",
                    {},
                    {0.0},
                    {{"grid_mapping_name", "transverse_mercator"}},
                    {{"scale_factor_at_central_meridian", 0.9996},
                     {"longitude_of_central_meridian", 15.0},
                     {"latitude_of_projection_origin", 0.0},
                     {"false_easting", 500000.0},
                     {"false_northing", 0.0},
                     {"semi_major_axis", 6378137.0},
                     {"inverse_flattening", 298.257223563}}});
  const std::vector<double> five(41 * 41, 5.0), none(41 * 41, 0.0);
  file.AddVariable({"u",
                    {"y", "x"},
                    five,
                    {{"standard_name", east_name}, {"units", "m s-1"}, {"grid_mapping", "crs"}}});
  file.AddVariable({"v",
                    {"y", "x"},
                    none,
                    {{"standard_name", north_name}, {"units", "m s-1"}, {"grid_mapping", "crs"}}});
  return file.Bytes();
}

TEST_F(FlowFiles, TurnTrueEastToTheGridOfAProjection) {
  for (const bool is_true : {true, false}) {
    const FlowFile flow =
        Read(Write("utm.nc", is_true ? UtmNetCdf("eastward_wind", "northward_wind")
                                     : UtmNetCdf("x_wind", "y_wind")));
    ASSERT_EQ(flow.chart.kind(), ChartKind::kProjected);
    const auto lines = TraceLines(*flow.field, std::vector<Seed>{{{714000.0, 5544000.0, 0.0}, 0.0}},
                                  {.duration_s = 20.0});
    const auto frame = OutputFrame::OfFile(flow.chart, {714000.0, 5544000.0, 0.0}, 0.0, "utm.nc");
    ASSERT_TRUE(frame);
    const auto start = frame->Geodetic(lines->front().points.front());
    const auto end = frame->Geodetic(lines->front().points.back());
    const double azimuth_deg = ShortestWay(*start, *end).azimuth_deg;
    // Grid north minus true north: 2.29 degrees there.
    EXPECT_NEAR(azimuth_deg, is_true ? 90.0 : 92.29, is_true ? 0.01 : 0.02);
  }
}

TEST_F(FlowFiles, NameWhatIsMissing) {
  NetCdfWriter file;
  file.AddAxis("y", Steps(0.0, 1.0, 4), {{"units", "m"}});
  file.AddAxis("x", Steps(0.0, 1.0, 4), {{"units", "m"}});
  file.AddVariable({"temperature", {"y", "x"}, std::vector<double>(16, 280.0), {{"units", "K"}}});
  EXPECT_THAT(ErrorOf(Write("t.nc", file.Bytes())), HasSubstr("temperature [K]"));
  const auto with = [&](const std::string& unit, double value, std::vector<double> times) {
    NetCdfWriter made;
    made.AddAxis("time", times, {{"units", "seconds since 2025-01-01"}});
    made.AddAxis("y", Steps(0.0, 1.0, 4), {{"units", "m"}});
    made.AddAxis("x", Steps(0.0, 1.0, 4), {{"units", "m"}});
    for (const char* name : {"u", "v"}) {
      made.AddVariable({name,
                        {"time", "y", "x"},
                        std::vector<double>(16 * times.size(), value),
                        {{"units", unit}}});
    }
    return made.Bytes();
  };
  EXPECT_THAT(ErrorOf(Write("a.nc", with("furlongs", 1.0, {0.0}))),
              ::testing::AllOf(HasSubstr("furlongs"), HasSubstr("knots")));
  EXPECT_THAT(ErrorOf(Write("b.nc", with("m/s", 1.0, {0.0, 5.0, 3.0}))), HasSubstr("ascend"));
  EXPECT_THAT(ErrorOf(Write("c.nc", with("m/s", 1e37, {0.0}))), HasSubstr("no velocity"));
  EXPECT_THAT(ErrorOf(Write("d.nc", with("m/s", 1.0, {0.0}).substr(0, 300))), HasSubstr("d.nc"));
  EXPECT_THAT(ErrorOf(Write("e.nc", "no NetCDF")), HasSubstr("e.nc"));
  EXPECT_THAT(ErrorOf(Write("f.txt", "x")), HasSubstr("ending"));
  const std::string good = Write("g.nc", with("m/s", 1.0, {0.0}));
  EXPECT_THAT(ErrorOf(good, {.u = "u"}), HasSubstr("--v"));
  EXPECT_THAT(ErrorOf(good, {.u = "u", .v = "nowhere"}), HasSubstr("nowhere"));
  EXPECT_THAT(ErrorOf((folder_.path() / "none.nc").string()), HasSubstr("does not exist"));
}

TEST(VelocityUnits, KnowTheirSpellings) {
  for (const char* unit : {"m s-1", "m/s", "m s**-1", "[m/s]", "M/S", "metre second-1", "m.s-1"}) {
    EXPECT_EQ(MetresPerSecond(unit), 1.0) << unit;
  }
  for (const char* unit : {"knots", "kt", "knot"}) {
    EXPECT_NEAR(MetresPerSecond(unit).value_or(0.0), 0.514444, 1e-6) << unit;
  }
  EXPECT_NEAR(MetresPerSecond("km/h").value_or(0.0), 1.0 / 3.6, 1e-12);
  EXPECT_FALSE(MetresPerSecond("K"));
  EXPECT_FALSE(MetresPerSecond("m"));
}

TEST(CfTime, KnowsUnitsSinceAMoment) {
  const auto hours = ParseCfTimeUnit("hours since 1900-01-01 00:00:0.0");
  EXPECT_EQ(hours->seconds, 3600.0);
  EXPECT_EQ(hours->since->ToString(), "1900-01-01T00:00:00Z");
  EXPECT_EQ(ParseCfTimeUnit("days since 2000-2-3")->since->ToString(), "2000-02-03T00:00:00Z");
  EXPECT_EQ(ParseCfTimeUnit("seconds since 2025-09-14T13:00:00+02:00")->since->ToString(),
            "2025-09-14T11:00:00Z");
  EXPECT_FALSE(ParseCfTimeUnit("hours"));
  EXPECT_FALSE(ParseCfTimeUnit("fortnights since 2000-01-01"));
}

TEST(StandardNames, HavePartners) {
  EXPECT_EQ(NorthPartner("eastward_wind"), "northward_wind");
  EXPECT_EQ(NorthPartner("x_wind"), "y_wind");
  EXPECT_EQ(NorthPartner("sea_water_x_velocity"), "sea_water_y_velocity");
  EXPECT_EQ(NorthPartner("x_sea_water_velocity"), "y_sea_water_velocity");
  EXPECT_FALSE(NorthPartner("air_temperature"));
  EXPECT_FALSE(NorthPartner("projection_x_coordinate"));
  EXPECT_TRUE(IsTrueEast("eastward_sea_water_velocity"));
  EXPECT_FALSE(IsTrueEast("x_wind"));
}

}  // namespace
}  // namespace pleinair::content
