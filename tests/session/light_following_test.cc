// Follows the light of a recording under a made cloud: sun and sky of each pixel get other weights.

#include "session/light_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/camera_response.h"
#include "compositor/light/light_solver.h"
#include "compositor/photometry/sky_fit.h"
#include "devices/recordings/recording.h"
#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"
#include "session/recording_passes.h"
#include "session/scene_renderer.h"
#include "tests/source_tree.h"

namespace pleinair::session {
namespace {

constexpr std::int64_t kFrames = 18;
constexpr std::int64_t kFrameNs = 250'000'000;

struct Moment {
  double sun = 1.0, sky = 1.0;
};

Moment Steady(std::int64_t) { return {}; }

/// The sun falls to a tenth within a second and a half and returns; the sky rises by a fifth.
Moment Cloud(std::int64_t frame) {
  const double cloud =
      std::clamp(static_cast<double>(std::min(frame - 2, 15 - frame)) / 6.0, 0.0, 1.0);
  return {std::pow(0.1, cloud), 1.0 + 0.2 * cloud};
}

devices::Recording Open() {
  return devices::OpenRecording(tests::SourceTree() / "recordings" / "courtyard_tag36h11").value();
}

/// Frames of the courtyard, again and again, under a cloud.
class CloudedFrames : public devices::FrameSource {
 public:
  explicit CloudedFrames(std::vector<devices::Frame> frames) : frames_(std::move(frames)) {}
  Result<std::optional<devices::Frame>> Next() override {
    if (next_ == frames_.size()) return std::nullopt;
    return frames_[next_++];
  }
  std::optional<std::int64_t> FrameCount() const override { return kFrames; }

 private:
  std::vector<devices::Frame> frames_;
  std::size_t next_ = 0;
};

/// The bundled recording's frames with weighted light. Light of the pixel's surface: the described
/// clear sky's sun where no phantom occludes it, and a sky that depends on the slope alone.
std::vector<devices::Frame> Film(const std::function<Moment(std::int64_t)>& moment) {
  devices::Recording recording = Open();
  const scene::SceneDescription scene = *recording.scene;
  const CameraModel camera = recording.camera;
  std::vector<devices::Frame> originals;
  while (auto frame = recording.frames->Next().value()) originals.push_back(*std::move(frame));
  // Poses of the unchanged frames.
  auto without_objects = scene;
  without_objects.objects.clear();
  const auto tracking = Pipeline::Create(camera, without_objects).value();
  std::vector<Transform<Camera, Marker>> poses;
  for (const devices::Frame& frame : originals) {
    EXPECT_TRUE(tracking->Track(frame));
    poses.push_back(tracking->PoseIn(frame)->observation.camera_from_marker);
  }
  std::vector<compositor::PlacedModel> phantoms;
  for (const auto& phantom : scene.phantoms)
    phantoms.push_back(PlaceModel(phantom, true, scene.marker).value());
  const auto solver = compositor::LightSolver::Create(phantoms, {.rays_per_vertex = 16}).value();
  const sky::SunPosition position = scene::SunOver(scene.place_time, scene.place_time.start);
  const auto day = compositor::DescribedSky(scene)->ForSun(position.ToSun(), position.distance_au);
  const Mat3 marker_from_world = scene::MarkerFromWorld(scene.marker);
  const Vec3 to_sun = marker_from_world * day->ToSun().xyz;
  const Vec3 up = marker_from_world * Vec3{0.0, 0.0, 1.0};
  const LinearRgb sun = day->SunNormalIrradiance(), sky = day->SkyHorizontalIrradiance();
  const CameraResponse srgb;
  std::vector<devices::Frame> frames;
  for (std::int64_t index = 0; index < kFrames; ++index) {
    const std::size_t original = static_cast<std::size_t>(index) % originals.size();
    devices::Frame frame = originals[original];
    frame.index = index;
    frame.timestamp_ns = index * kFrameNs;
    const Moment now = moment(index);
    const auto marker_from_camera = poses[original].Inverse();
    for (int y = 0; now.sun < 1.0 && y < frame.rgb.height(); ++y) {
      for (int x = 0; x < frame.rgb.width(); ++x) {
        const Vec2 ray = UndistortPixel(camera, {static_cast<double>(x), static_cast<double>(y)});
        const auto seen = solver->phantoms().First(
            {marker_from_camera.translation_m},
            Normalized(marker_from_camera.rotation * Vec3{ray.x, ray.y, 1.0}));
        const Vec3 normal = seen ? seen->normal : up;
        const double cosine = std::max(0.0, Dot(normal, to_sun));
        const bool lit =
            cosine > 0.0 && (!seen || solver->phantoms().IsUnoccluded(seen->point, to_sun));
        const LinearRgb of_sun = sun * ((lit ? cosine : 0.0) + 0.05);
        const LinearRgb of_sky = sky * (0.5 + 0.5 * Dot(normal, up));
        const LinearRgb factor = (of_sun * now.sun + of_sky * now.sky) / (of_sun + of_sky);
        const std::array<double, 3> factors{factor.r, factor.g, factor.b};
        for (int c = 0; c < 3; ++c) {
          std::uint8_t& code = frame.rgb(x, y, c);
          code = srgb.Encoded8(srgb.Linear(c)[code] * factors[c], c);
        }
      }
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

struct Composed {
  std::vector<RgbImage> images;
  std::vector<LightSummary> light;
};

Composed ComposeFilm(const std::vector<devices::Frame>& film, LightChangeMode mode) {
  const devices::Recording opened = Open();
  PipelineOptions options;
  options.light.changes = mode;
  const auto pipeline = Pipeline::Create(opened.camera, *opened.scene, options).value();
  const auto recording = [&] {
    devices::Recording again = Open();
    again.frames = std::make_unique<CloudedFrames>(film);
    return again;
  };
  Composed composed;
  EXPECT_TRUE(TrackRecording(*pipeline, recording()));
  EXPECT_TRUE(EstimateLight(*pipeline, recording()));
  EXPECT_TRUE(ComposeFrames(*pipeline, recording(),
                            [&](const devices::Frame&, ComposedFrame frame) -> Result<void> {
                              composed.images.push_back(std::move(frame.image));
                              composed.light.push_back(*frame.light);
                              return {};
                            }));
  return composed;
}

TEST(LightFollowing, FadesTheSunUnderACloud) {
  // The cloud's light is not that of the solver, so that the bounds are wide.
  const std::vector<devices::Frame> film = Film(Cloud);
  const Composed followed = ComposeFilm(film, LightChangeMode::kFollow);
  ASSERT_EQ(followed.light.size(), static_cast<std::size_t>(kFrames));
  const LightSummary& first = followed.light[0];
  const auto sun = [&](int frame) {
    return std::exp(MeanLog(followed.light[frame].frame.sun_on_white / first.frame.sun_on_white));
  };
  const auto sky = [&](int frame) {
    return std::exp(MeanLog(followed.light[frame].frame.sky_on_white / first.frame.sky_on_white));
  };
  for (const int under : {8, 9}) {
    EXPECT_GT(sun(under), 0.03) << under;
    EXPECT_LT(sun(under), 0.2) << under;
    EXPECT_NEAR(sky(under), 1.2, 0.5) << under;
  }
  for (const int before_or_after : {1, 2, 15, 16, 17}) {
    EXPECT_NEAR(sun(before_or_after), 1.0, 0.1) << before_or_after;
    EXPECT_NEAR(sky(before_or_after), 1.0, 0.1) << before_or_after;
  }
  const Composed held = ComposeFilm(film, LightChangeMode::kHold);
  for (const LightSummary& light : held.light) {
    EXPECT_NEAR(MeanLog(light.frame.sun_on_white / light.frame.sky_on_white),
                MeanLog(held.light[0].frame.sun_on_white / held.light[0].frame.sky_on_white), 1e-9)
        << "one light";
  }
  EXPECT_FALSE(std::equal(held.images[8].data(), held.images[8].data() + held.images[8].size(),
                          followed.images[8].data()));
}

TEST(LightFollowing, ChangesNothingInSteadyLight) {
  const std::vector<devices::Frame> film = Film(Steady);
  const Composed followed = ComposeFilm(film, LightChangeMode::kFollow);
  const Composed held = ComposeFilm(film, LightChangeMode::kHold);
  ASSERT_EQ(followed.images.size(), held.images.size());
  for (std::size_t i = 0; i < held.images.size(); ++i) {
    EXPECT_TRUE(std::equal(held.images[i].data(), held.images[i].data() + held.images[i].size(),
                           followed.images[i].data()))
        << i;
  }
}

}  // namespace
}  // namespace pleinair::session
