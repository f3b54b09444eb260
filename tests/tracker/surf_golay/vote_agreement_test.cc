#include "tracker/surf_golay/vote_agreement.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pleinair::tracker {
namespace {

TEST(VoteAgreement, VectorsFindTheSameVotesAsOneByOne) {
  std::mt19937 random(5);
  const auto draw = [&](float least, float most) {
    return std::uniform_real_distribution<float>(least, most)(random);
  };
  constexpr int kVotes = 203;
  VoteData votes;
  votes.Resize(kVotes);
  int found = 0;
  for (int round = 0; round < 40; ++round) {
    for (int i = 0; i < kVotes; ++i) {
      votes.centre_x[i] = draw(0.0F, 60.0F);
      votes.centre_y[i] = draw(0.0F, 60.0F);
      votes.size_px[i] = draw(20.0F, 90.0F);
      votes.rotation_rad[i] = draw(-3.1F, 3.1F);
      votes.keypoint_x[i] = draw(0.0F, 60.0F);
      votes.keypoint_y[i] = draw(0.0F, 60.0F);
      votes.modules_x[i] = draw(0.0F, 48.0F);
      votes.modules_y[i] = draw(0.0F, 48.0F);
    }
    const VoteSeed seed{.from_modules = {1.1F, 0.2F, draw(0.0F, 9.0F), -0.1F, 0.9F, 6.0F},
                        .centre_y = 30.0F,
                        .rotation_rad = draw(-3.1F, 3.1F),
                        .far_px = 25.0F,
                        .near_px = 20.0F,
                        .min_px = 25.0F,
                        .max_px = 80.0F,
                        .turn_rad = 1.5F};
    const int first = round % 7, last = kVotes - round % 5;
    std::vector<std::int32_t> agreeing(kVotes + kVoteSlack), expected(kVotes + kVoteSlack);
    agreeing.resize(AgreeingVotes(votes, seed, first, last, agreeing.data()));
    expected.resize(AgreeingVotesScalar(votes, seed, first, last, expected.data()));
    EXPECT_EQ(agreeing, expected);
    found += static_cast<int>(expected.size());
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace pleinair::tracker
