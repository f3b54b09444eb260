#include "devices/cameras/live_camera.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "devices/cameras/loss_counter.h"
#include "tests/devices/cameras/fake_camera_device.h"

namespace pleinair::devices {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using Kind = CameraEvent::Kind;

constexpr milliseconds kLong{20000};  // Reached only by a failing test.

std::unique_ptr<LiveCamera> Open(FakeCamera* camera, milliseconds stall_limit = milliseconds(1500),
                                 std::vector<ControlRequest> controls = {}) {
  LiveCameraOptions options;
  options.uri = {CameraUri::Backend::kV4l2, CameraUri::Key::kNode, "/dev/video0"};
  options.stall_limit = stall_limit;
  options.controls = std::move(controls);
  auto opened =
      LiveCamera::OpenWith(options, [camera](const CameraUri& uri, const FormatRequest& requested) {
        return camera->Open(uri, requested);
      });
  return opened ? *std::move(opened) : nullptr;
}

/// Waits for an event of this kind and returns the kinds of all events until then.
std::vector<Kind> KindsUntil(LiveCamera* camera, Kind last) {
  std::vector<Kind> kinds;
  const auto end = std::chrono::steady_clock::now() + kLong;
  while (std::chrono::steady_clock::now() < end) {
    for (const CameraEvent& event : camera->TakeEvents()) kinds.push_back(event.kind);
    if (!kinds.empty() && kinds.back() == last) break;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return kinds;
}

TEST(LiveCamera, GivesTheNewestFrameAndCountsThoseThatNobodyTook) {
  FakeCamera fake;
  const auto camera = Open(&fake);
  for (int i = 0; i < 10; ++i) fake.Send(i, static_cast<std::uint8_t>(100 + i));
  fake.WaitUntilEmpty();
  const auto frame = camera->NextWithin(kLong);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->grey(0, 0), 109);
  EXPECT_EQ(frame->loss.not_taken, 9);
  EXPECT_EQ(frame->lost_before, 9);
  EXPECT_EQ(frame->timestamp_ns, 9 * FakeCamera::kPeriod_ns);
  EXPECT_EQ(frame->stamp_meaning, StampMeaning::kExposureStart);
  fake.Send(10, 200);
  const auto next = camera->NextWithin(kLong);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->lost_before, 0);
  EXPECT_EQ(next->index, frame->index + 1);
}

TEST(LiveCamera, TellsLossByNumberAndDamageApart) {
  FakeCamera fake;
  const auto camera = Open(&fake);
  fake.Send(0, 10);
  ASSERT_TRUE(camera->NextWithin(kLong));
  fake.Send(1, 11, /*damaged=*/true);
  fake.Send(4, 12);
  const auto frame = camera->NextWithin(kLong);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->grey(0, 0), 12) << "a damaged picture was delivered";
  EXPECT_EQ(frame->loss, (FrameLoss{.by_number = 2, .damaged = 1}));
  EXPECT_EQ(frame->index, 4);
  const CameraCounts counts = camera->counts();
  EXPECT_EQ(counts.loss, (FrameLoss{.by_number = 2, .damaged = 1}));
  EXPECT_EQ(counts.delivered, 2);
}

TEST(LiveCamera, StartsWithoutACameraSaysSoAndTakesItWhenItComes) {
  FakeCamera fake;
  fake.Unplug();
  const auto camera = Open(&fake);
  EXPECT_THAT(KindsUntil(camera.get(), Kind::kWaiting), ElementsAre(Kind::kWaiting));
  EXPECT_FALSE(camera->NextWithin(milliseconds(1)));
  fake.Plug();
  fake.Send(0, 50);
  EXPECT_TRUE(camera->NextWithin(kLong));
  EXPECT_THAT(KindsUntil(camera.get(), Kind::kConnected), ElementsAre(Kind::kConnected));
}

TEST(LiveCamera, ComesBackByIdentityAfterAnUnplugAndHoldsItsControlsAgain) {
  FakeCamera fake;
  const auto camera = Open(&fake, milliseconds(1500), {{CameraControl::kExposure, 0.01}});
  fake.Send(0, 50);
  ASSERT_TRUE(camera->NextWithin(kLong));
  EXPECT_EQ(fake.requested_uri(), "v4l2:/dev/video0");
  fake.Unplug();
  KindsUntil(camera.get(), Kind::kWaiting);
  fake.Plug();
  KindsUntil(camera.get(), Kind::kConnected);
  EXPECT_EQ(fake.requested_uri(), "v4l2:serial=0001");
  fake.Send(0, 60);
  const auto frame = camera->NextWithin(kLong);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->grey(0, 0), 60);
  EXPECT_EQ(frame->lost_before, 0) << "what was not made cannot be lost";
  EXPECT_EQ(frame->index, 1) << "frames go on counting";
  EXPECT_EQ(camera->counts().connections, 2);
  EXPECT_EQ(fake.locked().size(), 1U);
  ASSERT_EQ(camera->ControlResults().size(), 1U);
  EXPECT_TRUE(camera->ControlResults()[0].locked);
}

TEST(LiveCamera, NoticesASilentCameraOpensItAnewAndSaysWhenItRecovers) {
  FakeCamera fake;
  const auto camera = Open(&fake, milliseconds(150));
  fake.Send(0, 50);
  ASSERT_TRUE(camera->NextWithin(kLong));
  EXPECT_THAT(KindsUntil(camera.get(), Kind::kStalled),
              ElementsAre(Kind::kConnected, Kind::kStalled));
  while (fake.opened() < 2) std::this_thread::sleep_for(milliseconds(5));
  fake.Send(0, 51);
  ASSERT_TRUE(camera->NextWithin(kLong));
  EXPECT_THAT(KindsUntil(camera.get(), Kind::kRecovered), ElementsAre(Kind::kRecovered));
  EXPECT_EQ(camera->counts().stalls, 1);
}

TEST(LiveCamera, StopsFromAnyThreadWhileAnotherWaits) {
  for (int round = 0; round < 50; ++round) {
    FakeCamera fake;
    auto camera = Open(&fake);
    std::thread stopper([&] { camera->Stop(); });
    const auto frame = camera->Next();
    stopper.join();
    ASSERT_TRUE(frame);
    EXPECT_FALSE(*frame);
    EXPECT_TRUE(camera->stopped());
  }
}

TEST(LiveCamera, FailsAtOnceWhereItIsNotToWait) {
  FakeCamera fake;
  fake.Unplug();
  LiveCameraOptions options;
  options.wait_for_camera = false;
  const auto opened =
      LiveCamera::OpenWith(options, [&](const CameraUri& uri, const FormatRequest& requested) {
        return fake.Open(uri, requested);
      });
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().what, "there is no such camera");
}

TEST(LossCounter, SeesLossByStampsAloneOnceItKnowsThePeriod) {
  LossCounter counter(2'000'000'000);
  int by_time = 0;
  std::int64_t stamp_ns = 0;
  for (int number = 0; number < 40; ++number) {
    // Every fifth frame is lost before the driver numbers it.
    stamp_ns += number % 4 == 3 ? 66'000'000 : 33'000'000;
    const FrameLoss loss = counter.Add(number, stamp_ns);
    EXPECT_EQ(loss.by_number, 0);
    by_time += loss.by_time;
  }
  EXPECT_GE(by_time, 8);
  EXPECT_LE(by_time, 10);
}

TEST(LossCounter, CountsNothingForASteadyCameraThatJitters) {
  LossCounter counter(2'000'000'000);
  for (int number = 0; number < 100; ++number) {
    const std::int64_t jitter_ns = number * 7919 % 13 * 1'000'000;
    EXPECT_EQ(counter.Add(number, number * 33'000'000LL + jitter_ns), FrameLoss{});
  }
}

TEST(LossCounter, FollowsACameraThatSlowsDownInTheDark) {
  LossCounter counter(2'000'000'000);
  std::int64_t stamp_ns = 0;
  for (int number = 0; number < 20; ++number) counter.Add(number, stamp_ns += 33'000'000);
  int by_time = 0;
  for (int number = 20; number < 60; ++number) {
    by_time += counter.Add(number, stamp_ns += 66'000'000).by_time;
  }
  EXPECT_LE(by_time, 5);
}

}  // namespace
}  // namespace pleinair::devices
