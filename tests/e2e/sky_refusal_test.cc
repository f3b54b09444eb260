// Tests the command lines that `pleinair sky` rejects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using ::testing::HasSubstr;

class SkyRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(SkyRefusal, IsOneLineAndLeavesNothing) { ExpectRefusal("sky", GetParam()); }

const std::string kPlace = "50,14";
const std::string kNoon = "2025-09-14T11:05:00Z";

INSTANTIATE_TEST_SUITE_P(
    BadInput, SkyRefusal,
    ::testing::Values(
        Refusal{"Nothing", {"-o", "OUT/a.png"}, "needs a place and a time"},
        Refusal{"Latitude", {"--at", "91,0", "--time", kNoon, "-o", "OUT/a.png"}, "lat \"91\""},
        Refusal{"ImpossibleDate",
                {"--at", kPlace, "--time", "2025-02-30T00:00:00Z", "-o", "OUT/a.png"},
                "names a day that does not exist"},
        Refusal{"ImpossibleDay",
                {"--at", kPlace, "--day", "2025-13-01", "--utc-offset", "Z", "-o", "OUT/a.mp4"},
                "is not a day"},
        Refusal{"ImpossibleDayWithoutClock",
                {"--at", kPlace, "--day", "2025-02-30", "-o", "OUT/a.mp4"},
                "is not a day"},
        Refusal{"DayWithoutClock",
                {"--at", kPlace, "--day", "2025-06-21", "-o", "OUT/a.mp4"},
                "--utc-offset"},
        Refusal{"TurbidityTooHigh",
                {"--sun", "180,30", "--turbidity", "1000", "-o", "OUT/a.png"},
                "turbidity 1000 is impossible"},
        Refusal{"TurbidityNegative",
                {"--sun", "180,30", "--turbidity=-2", "-o", "OUT/a.png"},
                "turbidity -2 is impossible"},
        Refusal{"TurbidityNan",
                {"--sun", "180,30", "--turbidity", "nan", "-o", "OUT/a.png"},
                "turbidity"},
        Refusal{"UnknownModel",
                {"--sun", "180,30", "--model", "hosek", "-o", "OUT/a.png"},
                "unknown sky model \"hosek\""},
        Refusal{"Cie16", {"--sun", "180,30", "--model", "cie:16", "-o", "OUT/a.png"}, "\"16\""},
        Refusal{"Cie0", {"--sun", "180,30", "--model", "cie:0", "-o", "OUT/a.png"}, "\"0\""},
        Refusal{"CloudsWithCie",
                {"--sun", "180,30", "--model", "cie:1", "--cloud-cover", "0.5", "-o", "OUT/a.png"},
                "--cloud-cover: has no effect here"},
        Refusal{"UnknownCloud",
                {"--sun", "180,30", "--cloud-layer", "kind=nimbus", "-o", "OUT/a.png"},
                "--cloud-layer: there is no kind of cloud \"nimbus\""},
        Refusal{"UnknownCloudKey",
                {"--sun", "180,30", "--cloud-layer", "kind=slab,hight=2", "-o", "OUT/a.png"},
                "no key \"hight\""},
        Refusal{"PartlyCoveringSlab",
                {"--sun", "180,30", "--cloud-layer", "kind=slab,cover=0.5", "-o", "OUT/a.png"},
                "impossible for a slab"},
        Refusal{"FiveCloudLayers",
                {"--sun", "180,30", "--cloud-layer", "kind=slab", "--cloud-layer", "kind=slab",
                 "--cloud-layer", "kind=slab", "--cloud-layer", "kind=slab", "--cloud-layer",
                 "kind=slab", "-o", "OUT/a.png"},
                "at most four layers"},
        Refusal{"CloudLayerWithCie",
                {"--sun", "180,30", "--model", "cie:1", "--cloud-layer", "kind=slab", "-o",
                 "OUT/a.png"},
                "--cloud-layer: has no effect here"},
        Refusal{"CloudLayerWithCover",
                {"--sun", "180,30", "--cloud-cover", "0.5", "--cloud-layer", "kind=slab", "-o",
                 "OUT/a.png"},
                "--cloud-cover"},
        Refusal{"ShadowWithoutClouds",
                {"--sun", "180,30", "--shadow-at", "points.csv", "-o", "OUT/a.csv"},
                "--shadow-at: has no effect here"},
        Refusal{"ShadowWithoutSun",
                {"--cloud-layer", "kind=slab", "--shadow-at", "points.csv", "-o", "OUT/a.csv"},
                "needs a place and a time"},
        Refusal{"TooManyClouds",
                {"--sun", "180,30", "--cloud-cover", "1.5", "-o", "OUT/a.png"},
                "cloud cover 1.5 is impossible"},
        Refusal{"WhiterThanWhiteGround",
                {"--sun", "180,30", "--albedo", "1.2", "-o", "OUT/a.png"},
                "albedo 1.2 is impossible"},
        Refusal{"AerosolForPerez",
                {"--sun", "180,30", "--model", "perez", "--aerosol-beta", "0.1", "-o", "OUT/a.png"},
                "aerosol"},
        Refusal{"SunAboveTheZenith", {"--sun", "180,95", "-o", "OUT/a.png"}, "180,95"},
        Refusal{"SunNan", {"--sun", "nan,30", "-o", "OUT/a.png"}, "nan,30"},
        Refusal{"SunWithPlace",
                {"--sun", "180,30", "--at", kPlace, "--time", kNoon, "-o", "OUT/a.png"},
                "--sun"},
        Refusal{"UnknownPicture",
                {"--sun", "180,30", "--model", "perez", "-o", "OUT/a.tiff"},
                "a.tiff: is not a supported picture format"},
        Refusal{"VideoOfOneMoment",
                {"--sun", "180,30", "--model", "perez", "-o", "OUT/a.mp4"},
                "a video of one moment"},
        Refusal{"VideoOfADayInOneStep",
                {"--at", kPlace, "--day", "2025-06-21", "--utc-offset", "Z", "--step", "1e9",
                 "--model", "perez", "--size", "64", "-o", "OUT/a.mp4"},
                "a video of one moment"},
        Refusal{"PictureOfManyMoments",
                {"--at", kPlace, "--day", "2025-06-21", "--utc-offset", "Z", "--model", "perez",
                 "-o", "OUT/a.png"},
                "one picture for many moments"},
        Refusal{"UnknownProjection",
                {"--sun", "180,30", "--projection", "cube", "-o", "OUT/a.png"},
                "--projection"},
        Refusal{"OddMap",
                {"--sun", "180,30", "--model", "perez", "--size", "101", "-o", "OUT/a.exr"},
                "even number"},
        Refusal{
            "HugePicture", {"--sun", "180,30", "--size", "100000", "-o", "OUT/a.png"}, "--size"},
        Refusal{"NanExposure",
                {"--sun", "180,30", "--exposure", "nan", "-o", "OUT/a.png"},
                "--exposure"},
        Refusal{"NoFolder",
                {"--sun", "180,30", "--model", "perez", "--size", "32", "-o", "OUT/none/a.exr"},
                "a.exr: cannot write"},
        Refusal{"NoFolderForVideo",
                {"--at", kPlace, "--from", kNoon, "--to", "2025-09-14T12:05:00Z", "--model",
                 "perez", "--size", "32", "-o", "OUT/none/a.mp4"},
                "a.mp4: cannot write"},
        Refusal{
            "BackwardSpan",
            {"--at", kPlace, "--from", kNoon, "--to", "2025-09-13T00:00:00Z", "-o", "OUT/a.mp4"},
            "lies before"},
        Refusal{"NoStep",
                {"--at", kPlace, "--from", kNoon, "--to", kNoon, "--step", "0", "-o", "OUT/a.mp4"},
                "--step"},
        Refusal{"NoName", {"--sun", "180,30", "-o", ""}, "--output: is given without a value"},
        Refusal{"TurbidityWithCie",
                {"--sun", "180,30", "--model", "cie:12", "--turbidity", "8", "-o", "OUT/a.png"},
                "--turbidity: has no effect here"},
        Refusal{"NoCloudsWithCie",
                {"--sun", "180,30", "--model", "cie:12", "--cloud-cover", "0", "-o", "OUT/a.png"},
                "--cloud-cover: has no effect here"},
        Refusal{"ScaleOfACieSkyWithPerez",
                {"--sun", "180,30", "--model", "perez", "--zenith-luminance", "5000"},
                "perez has its own scale"},
        Refusal{"GroundOfAPerezFisheye",
                {"--sun", "180,30", "--model", "perez", "--albedo", "0.3", "-o", "OUT/a.png"},
                "--albedo: has no effect here"},
        Refusal{"ExposureOfNoPicture",
                {"--sun", "180,30", "--exposure", "12"},
                "--exposure: has no effect here"},
        Refusal{"ExposureOfLight",
                {"--sun", "180,30", "--exposure", "12", "-o", "OUT/a.exr"},
                "--exposure: has no effect here"},
        Refusal{"ScaleOfAPng",
                {"--sun", "180,30", "--scale", "0.1", "-o", "OUT/a.png"},
                "--scale: has no effect here"},
        Refusal{"DiscInATable",
                {"--sun", "180,30", "--disc", "--csv", "OUT/none.csv"},
                "--disc: has no effect here"},
        Refusal{"SizeOfText", {"--sun", "180,30", "--size", "64"}, "--size: has no effect here"},
        Refusal{"ProjectionOfText",
                {"--sun", "180,30", "--projection", "latlong"},
                "--projection: has no effect here"},
        Refusal{"TurnedFisheye",
                {"--sun", "180,30", "--centre-azimuth", "0", "-o", "OUT/a.png"},
                "--centre-azimuth: has no effect here"},
        Refusal{"FpsOfAPicture",
                {"--sun", "180,30", "--fps", "25", "-o", "OUT/a.png"},
                "--fps: has no effect here"},
        Refusal{"StepOfAMoment",
                {"--at", kPlace, "--time", kNoon, "--step", "60"},
                "--step: has no effect here"},
        Refusal{"PressureWithoutAPlace",
                {"--sun", "180,30", "--pressure", "900"},
                "--pressure: has no effect here"},
        Refusal{"TableIntoAPicture",
                {"--sun", "180,30", "--model", "perez", "--csv", "-", "-o", "OUT/a.exr"},
                "a.exr: is the name of a picture"},
        Refusal{"NoSuchTable",
                {"--sun", "180,30", "--model", "perez", "--csv", "OUT/none.csv", "-o", "OUT/a.csv"},
                "none.csv: there is no such file"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(Sky, NamesTheLineOfABrokenTableAndWritesNothing) {
  for (const std::string broken : {"180,91\n", "180\n", "180,1,2\n", "south,30\n", "180,nan\n",
                                   "180,\n", "400,10\n", "\n", "  \r\n"}) {
    ExpectBrokenLineIsNamed({"sky", "--sun", "180,30", "--model", "perez"},
                            "azimuth_deg,elevation_deg\n180,45\n", broken, "10,20\n");
  }
  const TemporaryFolder folder;
  WriteFile(folder / "in.csv", "azimuth_deg,height\n1,2\n");
  EXPECT_THAT(
      RunPleinair({"sky", "--sun", "180,30", "--model", "perez", "--csv", folder / "in.csv"}).err,
      HasSubstr("in.csv:1: the column elevation_deg is missing"));
}

}  // namespace
}  // namespace pleinair::e2e
