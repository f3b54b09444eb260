#pragma once

#include <hwy/highway.h>

#include <gtest/gtest.h>

#include <cstdint>

namespace pleinair::tracker {

/// Runs each test once for every compiled instruction set that this machine supports. Instantiate
/// with testing::ValuesIn(hwy::SupportedAndGeneratedTargets()).
class OnEveryTarget : public testing::TestWithParam<std::int64_t> {
 protected:
  void SetUp() override {
    hwy::SetSupportedTargetsForTest(GetParam());
    hwy::GetChosenTarget().Update(GetParam());
  }
  void TearDown() override {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
};

}  // namespace pleinair::tracker
