#include "tracker/surf_golay/vote_agreement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf_golay/vote_agreement.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

int Agreeing(const VoteData& votes, const VoteSeed& seed, int first, int last,
             std::int32_t* agreeing) {
  const hn::CappedTag<float, kVoteSlack> df;
  const hn::RebindToSigned<decltype(df)> di;
  const int lanes = static_cast<int>(hn::Lanes(df));
  const auto set = [&](float value) { return hn::Set(df, value); };
  const auto m0 = set(seed.from_modules[0]), m1 = set(seed.from_modules[1]);
  const auto m2 = set(seed.from_modules[2]), m3 = set(seed.from_modules[3]);
  const auto m4 = set(seed.from_modules[4]), m5 = set(seed.from_modules[5]);
  const auto whole_turn = set(2.0F * 3.14159265F);
  int count = 0;
  for (int j = first; j < last; j += lanes) {
    const auto load = [&](const std::vector<float>& from) { return hn::LoadU(df, &from[j]); };
    const auto x = load(votes.modules_x), y = load(votes.modules_y);
    const auto off_x = hn::Sub(hn::MulAdd(m0, x, hn::MulAdd(m1, y, m2)), load(votes.keypoint_x));
    const auto off_y = hn::Sub(hn::MulAdd(m3, x, hn::MulAdd(m4, y, m5)), load(votes.keypoint_y));
    auto agree = hn::Lt(hn::Max(hn::Abs(off_x), hn::Abs(off_y)), set(seed.near_px));
    if (hn::AllFalse(df, agree)) continue;
    agree = hn::And(agree, hn::FirstN(df, static_cast<std::size_t>(last - j)));
    const auto size = load(votes.size_px);
    const auto turn = hn::Abs(hn::Sub(load(votes.rotation_rad), set(seed.rotation_rad)));
    const auto down = hn::Abs(hn::Sub(load(votes.centre_y), set(seed.centre_y)));
    agree = hn::And(agree, hn::Le(down, set(seed.far_px)));
    agree = hn::And(agree, hn::And(hn::Le(size, set(seed.max_px)), hn::Ge(size, set(seed.min_px))));
    agree = hn::And(agree, hn::Le(hn::Min(turn, hn::Sub(whole_turn, turn)), set(seed.turn_rad)));
    if (hn::AllFalse(df, agree)) continue;
    count += static_cast<int>(
        hn::CompressStore(hn::Iota(di, j), hn::RebindMask(di, agree), di, agreeing + count));
  }
  return count;
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {
HWY_EXPORT(Agreeing);
}  // namespace

void VoteData::Resize(std::size_t count) {
  // The vector loop reads whole vectors at the end.
  for (auto* values : {&centre_x, &centre_y, &size_px, &rotation_rad, &keypoint_x, &keypoint_y,
                       &modules_x, &modules_y}) {
    values->resize(count + kVoteSlack);
  }
}

int AgreeingVotes(const VoteData& votes, const VoteSeed& seed, int first, int last,
                  std::int32_t* agreeing) {
  return HWY_DYNAMIC_DISPATCH(Agreeing)(votes, seed, first, last, agreeing);
}

int AgreeingVotesScalar(const VoteData& votes, const VoteSeed& seed, int first, int last,
                        std::int32_t* agreeing) {
  constexpr float kWholeTurn = 2.0F * std::numbers::pi_v<float>;
  const float* const m = seed.from_modules;
  int count = 0;
  for (int j = first; j < last; ++j) {
    const float turn = std::fabs(votes.rotation_rad[j] - seed.rotation_rad);
    const float x = votes.modules_x[j], y = votes.modules_y[j];
    const float off_x = m[0] * x + m[1] * y + m[2] - votes.keypoint_x[j];
    const float off_y = m[3] * x + m[4] * y + m[5] - votes.keypoint_y[j];
    if (std::fabs(votes.centre_y[j] - seed.centre_y) <= seed.far_px &&
        votes.size_px[j] <= seed.max_px && votes.size_px[j] >= seed.min_px &&
        std::min(turn, kWholeTurn - turn) <= seed.turn_rad && std::fabs(off_x) < seed.near_px &&
        std::fabs(off_y) < seed.near_px) {
      agreeing[count++] = j;
    }
  }
  return count;
}

}  // namespace pleinair::tracker
#endif  // HWY_ONCE
