#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "compositor/photometry/sky_state.h"
#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"
#include "session/background_light.h"
#include "tests/compositor/light/light_scenes.h"
#include "tests/small_camera.h"
#include "tests/yard_scene.h"

namespace pleinair::session {
namespace {

using compositor::testing::PhotographedYard;
using std::chrono::milliseconds;

constexpr const char* kNoon = "2025-09-14T11:05:00Z";

/// A box on level ground.
BackgroundLight::Setup BoxOnGround() {
  using compositor::testing::BoxModel;
  using compositor::testing::Ground;
  BackgroundLight::Setup setup;
  setup.camera = tests::SmallCameraOptions().camera;
  setup.scene = tests::SmallCameraOptions().scene;
  setup.scene.place_time.start = *UtcTime::Parse(kNoon);
  setup.scene.phantoms.emplace_back();
  setup.scene.objects.emplace_back();
  setup.placed = {
      compositor::testing::Phantom(Ground(0.6, {0.3F, 0.3F, 0.3F})),
      compositor::testing::Object(BoxModel({0, 0, 0}, {0.3, 0.3, 0.3}, {0.5F, 0.4F, 0.3F}))};
  setup.edit = UneditedScene(setup.scene, {});
  setup.skies.source = compositor::DescribedSky(setup.scene);
  setup.time = *UtcTime::Parse(kNoon);
  return setup;
}

TEST(BackgroundLight, LightsTheGroundWhereItWasMovedTo) {
  BackgroundLight::Setup setup = BoxOnGround();
  setup.scene.phantoms[0].surface = scene::GroundSurface(4.0, 0.0, false);
  setup.edit = UneditedScene(setup.scene, {});
  auto light = BackgroundLight::Create(setup);
  ASSERT_TRUE(light) << light.error().Message();
  const auto ground_m = [](const BakedLighting& lit) {
    return lit.meshes.at(0).positions.at(0)[2];
  };
  std::shared_ptr<const BakedLighting> in_use = (*light)->Take();
  ASSERT_NE(in_use, nullptr);
  ASSERT_TRUE(in_use->meshes.at(0).is_phantom);
  EXPECT_EQ(ground_m(*in_use), 0.0F);
  SceneEdit edit = setup.edit;
  edit.phantoms[0].translation_m.z = -0.25;
  (*light)->SetEdit(edit);
  while (ground_m(*in_use) == 0.0F) {
    if (auto newest = (*light)->Take()) in_use = newest;
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_EQ(ground_m(*in_use), -0.25F);
}

TEST(BackgroundLight, GoesOnWithTheLastPlacementWhereTheNextCannotBeLit) {
  BackgroundLight::Setup setup = BoxOnGround();
  setup.scene.phantoms[0].surface = scene::GroundSurface(4.0, 0.0, false);
  setup.edit = UneditedScene(setup.scene, {});
  auto light = BackgroundLight::Create(setup);
  ASSERT_TRUE(light) << light.error().Message();
  const auto await = [&](const auto& is_wanted) -> std::shared_ptr<const BakedLighting> {
    // A sanitizer build on a busy machine needs about ten seconds per light.
    for (int i = 0; i < 60'000; ++i) {
      if (auto newest = (*light)->Take(); newest && is_wanted(*newest)) return newest;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return nullptr;
  };
  SceneEdit edit = setup.edit;
  edit.phantoms[0].translation_m.z = -0.25;
  edit.objects[0].scale = std::numeric_limits<double>::infinity();
  (*light)->SetEdit(edit);
  const UtcTime later = setup.time.PlusSeconds(2 * 3600);
  (*light)->SetTime(later);
  const auto follows_the_sun =
      await([&](const auto& lit) { return lit.request.time == later && lit.request.coefficients; });
  ASSERT_NE(follows_the_sun, nullptr);
  EXPECT_EQ(follows_the_sun->objects, setup.edit.objects);
  // Nothing of the refused edit is left in the next one.
  edit = setup.edit;
  edit.objects[0].translation_m = {-0.3, 0.1, 0.0};
  (*light)->SetEdit(edit);
  const auto moved = await([&](const auto& lit) { return lit.objects == edit.objects; });
  ASSERT_NE(moved, nullptr);
  EXPECT_EQ(moved->meshes.at(0).positions.at(0)[2], 0.0F);
}

TEST(BackgroundLight, RelightsAMovedObjectWhileOthersLookOn) {
  const BackgroundLight::Setup setup = BoxOnGround();
  SceneEdit edit = setup.edit;
  auto light = BackgroundLight::Create(setup);
  ASSERT_TRUE(light) << light.error().Message();
  std::shared_ptr<const BakedLighting> in_use = (*light)->Take();
  ASSERT_NE(in_use, nullptr) << "the first light is there at once";
  const auto until_coefficients = [&] {
    int seen_without = 0;
    while (!in_use->request.coefficients || in_use->objects != edit.objects) {
      if (auto newest = (*light)->Take()) in_use = newest;
      seen_without += in_use->request.coefficients ? 0 : 1;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return seen_without;
  };
  EXPECT_GT(until_coefficients(), 0) << "frames were drawn before, by light that was traced";
  const auto before = in_use;
  edit.objects[0].translation_m = {-0.3, 0.1, 0.0};
  (*light)->SetEdit(edit);
  EXPECT_EQ((*light)->Take(), nullptr) << "asking does not wait; the last light stays";
  EXPECT_GT(until_coefficients(), 0);
  EXPECT_NE(in_use->request.solver, before->request.solver);
  while ((*light)->progress().coefficients < 1.0) std::this_thread::sleep_for(milliseconds(1));
  (*light)->Stop();
  // The result equals a computation from scratch for that position.
  compositor::CoefficientOptions options;
  options.convergence = edit.convergence;
  const auto fresh = in_use->request.solver->Coefficients(
      scene::MarkerFromWorld(setup.scene.marker) * Vec3{0, 0, 1}, options, {});
  const auto meshes =
      in_use->request.solver->Relight(fresh, in_use->daylight, in_use->marker_from_world);
  ASSERT_EQ(meshes.size(), in_use->meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    EXPECT_EQ(meshes[i].ambient_with, in_use->meshes[i].ambient_with);
  }
}

TEST(BackgroundLight, LeavesTheShadeOfTreesOutUnderTheSunOfAnotherHour) {
  BackgroundLight::Setup setup = BoxOnGround();
  const Vec3 to_sun = scene::MarkerFromWorld(setup.scene.marker) *
                      scene::SunOver(setup.scene.place_time, setup.time).ToSun().xyz;
  const std::vector<compositor::SunlitSample> surface_samples{{{0, 0, 0}, 0.2, 0.01}};
  setup.skies.sun_transmittance = std::make_shared<const compositor::SunTransmittanceMap>(
      compositor::BuildSunTransmittanceMap(to_sun, surface_samples));
  auto light = BackgroundLight::Create(setup);
  ASSERT_TRUE(light) << light.error().Message();
  const auto has_map = [&](double later_s, double heading_deg) {
    SceneEdit edit = setup.edit;
    edit.later_s = later_s;
    edit.heading_deg = heading_deg;
    (*light)->SetEdit(edit);
    // A sanitizer build on a busy machine needs about ten seconds per light.
    for (int i = 0; i < 60'000; ++i) {
      const auto newest = (*light)->Take();
      if (newest && newest->request.time == setup.time.PlusSeconds(later_s) &&
          std::fabs(ToDegrees(newest->request.marker.heading) - heading_deg) < 1e-9) {
        return newest->request.skies.sun_transmittance != nullptr;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    ADD_FAILURE() << "no light came";
    return false;
  };
  EXPECT_TRUE(has_map(300, 0)) << "five minutes move the sun by little more than a degree";
  EXPECT_FALSE(has_map(2 * 3600, 0));
  EXPECT_TRUE(has_map(299, 0)) << "it is still there for the hour that it was made for";
  EXPECT_FALSE(has_map(299, 30));
}

/// Waits for a light that satisfies a condition, without a timeout. A sanitizer build on a busy
/// machine needs about ten seconds per light.
template <typename Condition>
std::shared_ptr<const BakedLighting> Await(BackgroundLight& light, const Condition& is_wanted) {
  while (true) {
    auto newest = light.Take();
    if (newest && is_wanted(*newest)) return newest;
    std::this_thread::sleep_for(milliseconds(1));
  }
}

double SunToSkyOf(const compositor::SkyState& skies, const BakedLighting& at) {
  return compositor::SunToSky(compositor::ScaledSky(
      *skies.source->ForSun(at.sun.ToSun(), at.sun.distance_au), skies.scale, {1.0, 1.0, 1.0}));
}

TEST(BackgroundLight, TakesTheSkyThatIsGiven) {
  BackgroundLight::Setup setup = BoxOnGround();
  for (const double ratio : {2.0, 0.0}) {
    setup.light.overrides.sun_to_sky = ratio;
    auto light = BackgroundLight::Create(setup);
    ASSERT_TRUE(light) << light.error().Message();
    const auto first = (*light)->Take();
    ASSERT_NE(first, nullptr);
    EXPECT_NEAR(SunToSkyOf(first->request.skies, *first), ratio, 0.01 * ratio + 1e-9);
  }
}

TEST(BackgroundLight, KeepsTheCoefficientsOfTheSceneAsItBeganAlone) {
  const auto cache =
      std::filesystem::path(testing::TempDir()) / ("live_light_cache_" + std::to_string(getpid()));
  const auto kept = [&] {
    using Iterator = std::filesystem::directory_iterator;
    return std::filesystem::exists(cache) ? std::distance(Iterator(cache), Iterator()) : 0;
  };
  BackgroundLight::Setup setup = BoxOnGround();
  setup.light.cache = cache;
  setup.light.sky_division = 2;
  {
    auto light = BackgroundLight::Create(setup);
    ASSERT_TRUE(light) << light.error().Message();
    const auto lit =
        Await(**light, [](const auto& l) { return l.request.coefficients != nullptr; });
    EXPECT_EQ(lit->request.coefficients->division, 2);
    EXPECT_EQ(kept(), 1);
    SceneEdit edit = setup.edit;
    edit.objects[0].translation_m = {-0.3, 0.1, 0.0};
    (*light)->SetEdit(edit);
    Await(**light,
          [&](const auto& l) { return l.request.coefficients && l.objects == edit.objects; });
    EXPECT_EQ(kept(), 1) << "of a place that is tried out";
  }
  auto again = BackgroundLight::Create(setup);
  ASSERT_TRUE(again) << again.error().Message();
  const auto lit = Await(**again, [](const auto& l) { return l.request.coefficients != nullptr; });
  EXPECT_TRUE(lit->request.coefficients->from_cache);
  EXPECT_FALSE((*again)->progress().failed_to_keep);
  std::filesystem::remove_all(cache);
}

/// Live light in front of a photographed yard with a small object at its edge.
class LiveYard {
 public:
  /// `off_deg`: error of the described heading. `ground`: in place of a model; null: the model.
  explicit LiveYard(double off_deg, const scene::DescribedSurface* ground = nullptr,
                    const std::filesystem::path& cache = {}) {
    BackgroundLight::Setup setup;
    setup.camera = yard_.camera();
    setup.scene = tests::YardScene(yard_, off_deg, time_);
    setup.placed = PhotographedYard::Phantoms();
    setup.scene.phantoms.resize(setup.placed.size());
    if (ground != nullptr) setup.scene.phantoms[0].surface = *ground;
    setup.scene.objects.emplace_back();
    setup.placed.push_back(compositor::testing::Object(
        compositor::testing::BoxModel({2.4, -2.5, 0.0}, {2.5, -2.4, 0.1}, {0.5F, 0.5F, 0.5F})));
    setup.edit = UneditedScene(setup.scene, {});
    setup.skies.source = compositor::DescribedSky(setup.scene);
    setup.time = time_;
    setup.light.cache = cache;
    setup.light.sky_division = 1;
    light_ = *BackgroundLight::Create(setup);
    light_->SetMarkerReflectance(yard_.marker());
  }

  const PhotographedYard& yard() const { return yard_; }
  BackgroundLight::Progress progress() const { return light_->progress(); }
  BackgroundLight& light() { return *light_; }

  /// Passes enough frames for one light estimate, one minute after the last estimate. Returns the
  /// resulting light.
  std::shared_ptr<const BakedLighting> LookAt(const RgbImage& picture) {
    auto frame = std::make_shared<devices::Frame>();
    frame->rgb = picture;
    time_ = time_.PlusSeconds(61.0);
    int seen = 0;
    do {
      time_ = time_.PlusSeconds(0.5);
      light_->Show(frame, PhotographedYard::Pose(0), time_);
      const int before = seen;
      while (seen == before) {
        std::this_thread::sleep_for(milliseconds(1));
        seen = light_->progress().frames_in_estimate;
      }
    } while (seen > 0);
    // A different light from all earlier requests.
    light_->SetTime(asked_for_ = asked_for_.PlusSeconds(600.0));
    return Await(*light_, [&](const BakedLighting& l) { return l.request.time == asked_for_; });
  }

 private:
  PhotographedYard yard_;
  UtcTime time_ = *UtcTime::Parse("2025-09-14T13:50:00Z");
  UtcTime asked_for_ = time_;
  std::unique_ptr<BackgroundLight> light_;
};

TEST(BackgroundLight, MeasuresTheColorOfGroundWithoutOne) {
  scene::DescribedSurface ground = scene::GroundSurface(10.0, 0.0, false);
  ASSERT_FALSE(ground.has_color);
  ground.reflectance = {0.1, 0.2, 0.5};
  const std::filesystem::path cache =
      std::filesystem::path(testing::TempDir()) / ("color_cache_" + std::to_string(getpid()));
  LiveYard live(0.0, &ground, cache);
  const auto has_coefficients = [](const BakedLighting& lit) {
    return lit.request.coefficients != nullptr;
  };
  Await(live.light(), has_coefficients);
  const auto lit = live.LookAt(live.yard().Photograph(0, {.colors_as_described = true}));
  ASSERT_TRUE(lit->meshes.at(0).is_phantom);
  const auto& measured = lit->meshes.at(0).texturing.reflectance;
  EXPECT_NEAR(measured[0], 0.35, 0.035);
  EXPECT_NEAR(measured[1], 0.33, 0.033);
  EXPECT_NEAR(measured[2], 0.30, 0.030);
  // No other session measures quite these colors: their coefficients are not kept.
  if (!has_coefficients(*lit)) Await(live.light(), has_coefficients);
  const auto kept = std::distance(std::filesystem::directory_iterator(cache), {});
  std::filesystem::remove_all(cache);
  EXPECT_EQ(kept, 1) << "those of the scene as it is described";
}

TEST(BackgroundLight, KeepsWhatFramesToldWhenTheNextOnesTellNothing) {
  constexpr double kOffDeg = 3.0;
  LiveYard live(kOffDeg);
  using Source = compositor::MeasuredLight::Source;
  const auto told = live.LookAt(live.yard().Photograph(0, {.sky_radiance_scale = {2.5, 2.5, 2.5}}));
  const compositor::MeasuredLight measured = live.progress().measured;
  ASSERT_EQ(measured.heading_source, Source::kMeasured);
  EXPECT_NEAR(ToDegrees(measured.heading_offset), -kOffDeg, 0.5);
  ASSERT_EQ(measured.sun_source, Source::kMeasured);
  RgbImage blinded(live.yard().camera().width, live.yard().camera().height, 3);
  std::fill_n(blinded.data(), blinded.size(), std::uint8_t{255});
  const auto blind = live.LookAt(blinded);
  const compositor::MeasuredLight kept = live.progress().measured;
  EXPECT_EQ(blind->request.marker.heading.value(), told->request.marker.heading.value());
  const double ratio = SunToSkyOf(told->request.skies, *told);
  EXPECT_NEAR(SunToSkyOf(blind->request.skies, *told), ratio, 0.02 * ratio);
  scene::SceneDescription clear;
  clear.cloudiness = scene::Cloudiness::kClear;
  EXPECT_GT(SunToSkyOf({compositor::DescribedSky(clear)}, *told), 1.3 * ratio)
      << "it was not as the words say";
  EXPECT_EQ(kept.heading_source, Source::kMeasured);
  EXPECT_GT(kept.heading_error, measured.heading_error) << "as old as it is";
  EXPECT_EQ(kept.sun_source, Source::kMeasured);
  EXPECT_GT(kept.sun_to_sky_error, measured.sun_to_sky_error);
}

}  // namespace
}  // namespace pleinair::session
