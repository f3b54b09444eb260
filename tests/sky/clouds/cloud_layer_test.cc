#include "sky/clouds/cloud_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace pleinair::clouds {
namespace {

using ::testing::HasSubstr;

TEST(CloudLayer, HasTheDefaultsOfItsKind) {
  const CloudLayer cumulus = *ParseCloudLayer("kind=cumulus");
  EXPECT_EQ(cumulus.cover, 0.5);
  EXPECT_EQ(cumulus.optical_depth, 20.0);
  EXPECT_EQ(cumulus.base_m, 1200.0);
  EXPECT_EQ(cumulus.thickness_m, 500.0);
  EXPECT_EQ(cumulus.cell_m, 800.0);
  EXPECT_EQ(cumulus.wind_m_s, 0.0);
  EXPECT_EQ(cumulus.seed, 1);
  EXPECT_EQ(ParseCloudLayer("kind=stratus")->cover, 1.0);
  EXPECT_EQ(ParseCloudLayer("kind=stratus")->cell_m, 6000.0);
  EXPECT_EQ(ParseCloudLayer("kind=stratocumulus")->optical_depth, 12.0);
  EXPECT_EQ(ParseCloudLayer("kind=altocumulus")->base_m, 3500.0);
  EXPECT_EQ(ParseCloudLayer("kind=cirrus")->optical_depth, 0.5);
  EXPECT_EQ(ParseCloudLayer("kind=slab")->cover, 1.0);
}

TEST(CloudLayer, TakesEveryKey) {
  const CloudLayer layer = *ParseCloudLayer(
      " kind = cirrus , cover=0.25,optical_depth=1.5,base_m=9000,thickness_m=800,cell_m=4000,"
      "wind_m_s=30,wind_from_deg=250,seed=-9000000000000000000,east_m=120,north_m=-7.5");
  EXPECT_EQ(layer, (CloudLayer{CloudKind::kCirrus,
                               0.25,
                               1.5,
                               9000,
                               800,
                               4000,
                               30,
                               250,
                               -9'000'000'000'000'000'000,
                               120,
                               -7.5,
                               {}}));
}

struct BadLayer {
  const char* text;
  const char* what;
};
class BadCloudLayer : public ::testing::TestWithParam<BadLayer> {};

TEST_P(BadCloudLayer, IsRefusedInOneLine) {
  const auto layer = ParseCloudLayer(GetParam().text);
  ASSERT_FALSE(layer.has_value());
  EXPECT_EQ(layer.error().kind, ErrorKind::kInput);
  EXPECT_THAT(layer.error().Message(), HasSubstr(GetParam().what));
  EXPECT_EQ(layer.error().Message().find('\n'), std::string::npos);
  EXPECT_FALSE(layer.error().remedy.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Texts, BadCloudLayer,
    ::testing::Values(BadLayer{"", "is not key=value"}, BadLayer{"slab", "is not key=value"},
                      BadLayer{"cover=0.5", "has no kind"},
                      BadLayer{"kind=nimbus", "no kind of cloud \"nimbus\""},
                      BadLayer{"kind=cumulus,hight=3", "no key \"hight\""},
                      BadLayer{"kind=cumulus,cover=1.1", "cover 1.1 is impossible"},
                      BadLayer{"kind=cumulus,cover=-0.1", "cover -0.1 is impossible"},
                      BadLayer{"kind=cumulus,cover=nan", "cover nan is impossible"},
                      BadLayer{"kind=cumulus,cover=half", "cover \"half\" is not a number"},
                      BadLayer{"kind=cumulus,cover=", "cover \"\" is not a number"},
                      BadLayer{"kind=cumulus,,cover=1", "is not key=value"},
                      BadLayer{"kind=slab,cover=0.9", "impossible for a slab"},
                      BadLayer{"kind=slab,optical_depth=201", "optical_depth 201"},
                      BadLayer{"kind=slab,optical_depth=-1", "optical_depth -1"},
                      BadLayer{"kind=slab,base_m=49", "base_m 49"},
                      BadLayer{"kind=slab,base_m=20001", "base_m 20001"},
                      BadLayer{"kind=slab,thickness_m=9", "thickness_m 9"},
                      BadLayer{"kind=slab,thickness_m=1e5", "thickness_m 100000"},
                      BadLayer{"kind=cumulus,cell_m=49", "cell_m 49"},
                      BadLayer{"kind=cumulus,cell_m=5e5", "cell_m 500000"},
                      BadLayer{"kind=cumulus,wind_m_s=101", "wind_m_s 101"},
                      BadLayer{"kind=cumulus,wind_from_deg=361", "wind_from_deg 361"},
                      BadLayer{"kind=cumulus,seed=1.5", "seed \"1.5\" is not a number"},
                      BadLayer{"kind=cumulus,seed=99999999999999999999", "is not a number"},
                      BadLayer{"kind=cumulus,kind=slab", "kind is given twice"},
                      BadLayer{"kind=cumulus,seed=1,seed=1", "seed is given twice"},
                      BadLayer{"kind=cumulus,\n=1", "no key \"?\""}));

TEST(CloudyDepth, IsBelowTheMeanDepth) {
  EXPECT_EQ(CloudyDepth(*ParseCloudLayer("kind=cumulus")), 0.3);
  EXPECT_EQ(CloudyDepth(*ParseCloudLayer("kind=cirrus,optical_depth=0.2")), 0.1);
}

TEST(CloudPassing, IsRefusedWhereItIsImpossible) {
  CloudLayerFacts facts;
  facts.kind = CloudKind::kCumulus;
  facts.wind_m_s = 8.0;
  facts.passing.seconds = {0.0, 10.0};
  facts.passing.shifts = {1.0, -1.0};
  EXPECT_TRUE(MakeCloudLayer(facts).has_value());
  const auto refused = [&](const char* what, const auto& change) {
    CloudLayerFacts bad = facts;
    change(bad);
    const auto layer = MakeCloudLayer(bad);
    ASSERT_FALSE(layer.has_value()) << what;
    EXPECT_THAT(layer.error().Message(), HasSubstr(what));
  };
  refused("without wind", [](CloudLayerFacts& f) { f.wind_m_s = 0.0; });
  refused("3 shifts", [](CloudLayerFacts& f) { f.passing.shifts.push_back(0.0); });
  refused("1 seconds", [](CloudLayerFacts& f) {
    f.passing.seconds = {1.0};
    f.passing.shifts = {1.0};
  });
  refused("do not rise at 10", [](CloudLayerFacts& f) { f.passing.seconds = {10.0, 10.0}; });
  refused("shift 21", [](CloudLayerFacts& f) { f.passing.shifts[0] = 21.0; });
  refused("width_m 0", [](CloudLayerFacts& f) { f.passing.width_m = 0.0; });
  refused("farther than 40000 m", [](CloudLayerFacts& f) { f.passing.seconds[1] = 6000.0; });
  refused("the place", [](CloudLayerFacts& f) { f.passing.east_m = 1e9; });
}

}  // namespace
}  // namespace pleinair::clouds
