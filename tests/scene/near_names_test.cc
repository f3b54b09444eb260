#include "scene/near_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pleinair::scene {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<std::string>& Zones() {
  static const std::vector<std::string> kZones = {"America/New_York", "America/North_Dakota/Center",
                                                  "Asia/Kolkata",     "Etc/UTC",
                                                  "Europe/Prague",    "Europe/Praga",
                                                  "Europe/Rome"};
  return kZones;
}

TEST(NearNames, FindsMisspeltNames) {
  EXPECT_THAT(NearNames("Europe/Roma", Zones()), ElementsAre("Europe/Rome"));
  EXPECT_THAT(NearNames("Europe/Prag", {"Europe/Prague"}), ElementsAre("Europe/Prague"));
  EXPECT_THAT(NearNames("america/new york", Zones()), ElementsAre("America/New_York"));
  EXPECT_THAT(NearNames("Asia/Kalkota", Zones()), ElementsAre("Asia/Kolkata"));
}

TEST(NearNames, FindsAPlaceWithoutItsArea) {
  EXPECT_THAT(NearNames("Rome", Zones()), ElementsAre("Europe/Rome"));
  EXPECT_THAT(NearNames("Asia/Rome", Zones()), ElementsAre("Europe/Rome"));
}

TEST(NearNames, GivesOnlyTheNearest) {
  EXPECT_THAT(NearNames("Europe/Pragu", Zones()), ElementsAre("Europe/Praga", "Europe/Prague"));
  EXPECT_THAT(NearNames("Europe/Praguex", {"Europe/Pragu", "Europe/Prague", "Europe/Pra"}),
              ElementsAre("Europe/Prague"));
}

TEST(NearNames, SuggestsNothingForAnotherWord) {
  EXPECT_THAT(NearNames("Atlantis", Zones()), IsEmpty());
  EXPECT_THAT(NearNames("", Zones()), IsEmpty());
  EXPECT_THAT(NearNames("Rome", {}), IsEmpty());
}

}  // namespace
}  // namespace pleinair::scene
