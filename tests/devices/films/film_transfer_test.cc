#include "devices/films/film_transfer.h"

#include <gtest/gtest.h>

#include "base/vector.h"
#include "devices/films/film_colors.h"

namespace pleinair::devices {
namespace {

TEST(FilmTransfer, HlgHasTheValuesOfBt2100AndBt2408) {
  // BT.2100-2, Table 5: the two branches meet at E = 1/12.
  EXPECT_NEAR(LightFromHlg(0.5), 1.0 / 12.0, 1e-12);
  EXPECT_NEAR(LightFromHlg(0.5 + 1e-9), 1.0 / 12.0, 1e-7);
  EXPECT_NEAR(LightFromHlg(1.0), 1.0, 1e-7);
  EXPECT_EQ(LightFromHlg(0.0), 0.0);
  // BT.2408, Table 1, signals in per cent of reflectances.
  const auto signal = [](double reflectance) {
    return 100.0 * HlgFromLight(reflectance * HlgReferenceWhite());
  };
  EXPECT_NEAR(signal(1.00), 75.0, 0.5);
  EXPECT_NEAR(signal(0.90), 73.0, 0.5);
  EXPECT_NEAR(signal(0.83), 71.0, 0.5);
  EXPECT_NEAR(signal(0.18), 38.0, 0.5);
  for (int i = 0; i <= 100; ++i)
    EXPECT_NEAR(HlgFromLight(LightFromHlg(i / 100.0)), i / 100.0, 1e-6);
}

TEST(FilmTransfer, PqHasTheValuesOfBt2100AndBt2408) {
  EXPECT_NEAR(DisplayFromPq_cd_m2(1.0), 10'000.0, 1e-6);
  EXPECT_EQ(DisplayFromPq_cd_m2(0.0), 0.0);
  // BT.2408, Table 1: display light and signal of the same reflectances.
  EXPECT_NEAR(100.0 * PqFromDisplay_cd_m2(203.0), 58.0, 0.5);
  EXPECT_NEAR(100.0 * PqFromDisplay_cd_m2(179.0), 57.0, 0.5);
  EXPECT_NEAR(100.0 * PqFromDisplay_cd_m2(162.0), 56.0, 0.5);
  EXPECT_NEAR(100.0 * PqFromDisplay_cd_m2(26.0), 38.0, 0.5);
  // SMPTE ST 2084, values of common use.
  EXPECT_NEAR(PqFromDisplay_cd_m2(100.0), 0.5081, 1e-4);
  EXPECT_NEAR(PqFromDisplay_cd_m2(1000.0), 0.7518, 1e-4);
  // BT.2100-2, Table 4: the OOTF shows BT.709's white, E = 1/59.5208, at 100 cd/m².
  EXPECT_NEAR(LightFromPq(PqFromDisplay_cd_m2(100.0)), 1.0 / 59.5208, 1e-9);
  EXPECT_NEAR(LightFromPq(1.0), 1.0, 1e-4);
}

TEST(FilmTransfer, Bt709HasItsTwoBranches) {
  EXPECT_NEAR(LightFromBt709(0.081), 0.018, 1e-4);  // The rounded constants leave a step.
  EXPECT_NEAR(LightFromBt709(0.0405), 0.009, 1e-9);
  EXPECT_NEAR(Bt709FromLight(0.18), 0.4090, 1e-4);
  for (int i = 0; i <= 100; ++i) {
    EXPECT_NEAR(LightFromBt709(Bt709FromLight(i / 100.0)), i / 100.0, 1e-4);
  }
}

TEST(FilmTransfer, PrimariesHaveTheMatricesOfBt2407AndBt2087) {
  const Mat3 found = Rec709FromPrimaries({0.708, 0.292, 0.170, 0.797, 0.131, 0.046});
  // BT.2407-0, 2.2.
  const double bt2407[] = {1.6605,  -0.5876, -0.0728, -0.1246, 1.1329,
                           -0.0083, -0.0182, -0.1006, 1.1187};
  // BT.2087-0, Annex 1, M2: the other way.
  const Mat3 bt2087{{0.6274, 0.3293, 0.0433, 0.0691, 0.9195, 0.0114, 0.0164, 0.0880, 0.8956}};
  const Mat3 both = found * bt2087;
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(found.m[i], bt2407[i], 1e-4);
    EXPECT_NEAR(both.m[i], i % 4 == 0 ? 1.0 : 0.0, 5e-4);
  }
}

TEST(FilmTransfer, CurvesAreCameraResponses) {
  for (const FilmCurve curve : {FilmCurve::kBt709, FilmCurve::kGamma22, FilmCurve::kGamma28}) {
    const CameraResponse response = ResponseOf(curve);
    EXPECT_FALSE(response.IsSrgb());
    EXPECT_NEAR(response.Linear(1)[128],
                curve == FilmCurve::kBt709     ? LightFromBt709(128 / 255.0)
                : curve == FilmCurve::kGamma22 ? LightFromGamma(128 / 255.0, 2.2)
                                               : LightFromGamma(128 / 255.0, 2.8),
                1e-6);
  }
  EXPECT_TRUE(ResponseOf(FilmCurve::kSrgb).IsSrgb());
}

}  // namespace
}  // namespace pleinair::devices
