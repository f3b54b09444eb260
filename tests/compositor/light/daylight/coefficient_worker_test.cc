#include "compositor/light/daylight/coefficient_worker.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

constexpr Vec3 kUp{0.0, 0.0, 1.0};

/// A box at `x` metres along a yard.
std::shared_ptr<const LightSolver> YardWithABoxAt(double x, double edge_m = 0.2) {
  auto solver = LightSolver::Create(
      {Phantom(Ground(1.0, {0.3F, 0.3F, 0.3F})),
       Object(BoxModel({x, -0.2, 0.0}, {x + 0.4, 0.2, 0.4}, {0.5F, 0.3F, 0.2F}))},
      {.near_edge_m = edge_m, .threads = 2});
  EXPECT_TRUE(solver) << solver.error().Message();
  return solver ? *std::move(solver) : nullptr;
}

/// Waits for an effect of another thread.
template <typename Condition>
void WaitUntil(const Condition& condition) {
  while (!condition()) std::this_thread::yield();
}

CoefficientOptions FewRays() {
  CoefficientOptions options;
  options.rays_per_vertex = 32;
  options.threads = 2;
  return options;
}

TEST(CoefficientWorker, LeavesTheLastLightInUseUntilThatOfAMovedObjectIsWhole) {
  const auto before = YardWithABoxAt(-0.5), after = YardWithABoxAt(0.3);
  const UniformDay day({1000, 2000, 4000}, {6e4, 6e4, 5e4}, {-0.3, -0.5, 0.8});
  CoefficientWorker worker;
  EXPECT_EQ(worker.Newest(), nullptr);
  EXPECT_EQ(worker.progress(), 1.0) << "nothing is wanted";
  worker.Want(before, kUp, FewRays());
  WaitUntil([&] { return worker.Newest() != nullptr; });
  EXPECT_EQ(worker.Newest()->solver, before);

  // The computation is blocked halfway until ten frames have been drawn.
  std::mutex mutex;
  std::condition_variable changed;
  int frames = 0;
  bool in_the_middle = false;
  worker.Want(after, kUp, FewRays(), [&](double share) {
    std::unique_lock lock(mutex);
    if (share > 0.3) in_the_middle = true;
    changed.wait(lock, [&] { return share < 0.3 || frames >= 10; });
  });
  WaitUntil([&] {
    const std::lock_guard lock(mutex);
    return in_the_middle;
  });
  for (int i = 0; i < 10; ++i) {
    const auto in_use = worker.Newest();
    ASSERT_NE(in_use, nullptr);
    EXPECT_EQ(in_use->solver, before);
    EXPECT_LT(worker.progress(), 1.0);
    EXPECT_FALSE(in_use->solver->Relight(*in_use->coefficients, day, Mat3{}).empty());
    const std::lock_guard lock(mutex);
    ++frames;
    changed.notify_all();
  }
  WaitUntil([&] { return worker.Newest()->solver == after; });
  const auto fresh = after->Coefficients(kUp, FewRays(), {});
  EXPECT_EQ(worker.Newest()->coefficients->with.codes(), fresh.with.codes());
  EXPECT_EQ(worker.Newest()->coefficients->without.scales(), fresh.without.scales());
  EXPECT_EQ(worker.progress(), 1.0);
}

TEST(CoefficientWorker, FollowsSomeWayBehindAMotionWithoutARest) {
  std::vector<std::shared_ptr<const LightSolver>> places;
  for (int i = 0; i < 9; ++i) places.push_back(YardWithABoxAt(0.1 * i - 0.6));
  CoefficientWorker worker;
  std::atomic<int> next = 1, whole = 0;
  // The object moves before any computation is complete.
  CoefficientProgress move_on = [&](double share) {
    if (share == 0.0 && next < 9) {
      const int to = next++;
      worker.Want(places[static_cast<std::size_t>(to)], kUp, FewRays(), move_on);
    }
    if (share == 1.0) ++whole;
  };
  worker.Want(places[0], kUp, FewRays(), move_on);
  WaitUntil([&] { return worker.Newest() && worker.Newest()->solver == places[8]; });
  EXPECT_GE(whole, 3) << "every third at least, and the last";
  EXPECT_LT(whole, 9) << "and not those that are of no use any more";
}

TEST(CoefficientWorker, GoesWithoutFinishing) {
  // The computation is long, so that it cannot be complete before the worker is destroyed.
  const auto solver = YardWithABoxAt(0.0, 0.05);
  CoefficientOptions options = FewRays();
  options.rays_per_vertex = 256;
  options.division = 4;
  options.convergence = 1e-9;
  std::atomic<double> share = -1.0;
  {
    CoefficientWorker worker;
    worker.Want(solver, kUp, options, [&](double now) { share = now; });
    WaitUntil([&] { return share >= 0.0; });
  }
  EXPECT_LT(share, 1.0);
}

}  // namespace
}  // namespace pleinair::compositor
