#include "accuracy/films.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "accuracy/marker_pose.h"
#include "accuracy/sweep_poses.h"

namespace pleinair::accuracy {
namespace {

constexpr int kFilmMarker = 7;
constexpr double kExposure_s = 0.010;
constexpr double kFilmPeriod_s = 4.0;  // Period of an occluder's motion in and out.

/// A sum of sines with random phases: the drift and tremor of a hand.
class Wander {
 public:
  struct Wave {
    double amplitude, frequency_hz;
  };
  Wander(std::initializer_list<Wave> waves, RandomStream* random) {
    for (const Wave wave : waves) waves_.emplace_back(wave, random->Uniform(0, 2 * M_PI));
  }
  double At(double time_s) const {
    double sum = 0.0;
    for (const auto& [wave, phase] : waves_) {
      sum += wave.amplitude * std::sin(2 * M_PI * wave.frequency_hz * time_s + phase);
    }
    return sum;
  }

 private:
  std::vector<std::pair<Wave, double>> waves_;
};

Vec2 MiddleOf(const CameraModel& camera, const MarkerSpec& marker) {
  Vec2 sum;
  for (const Vec2 corner : SquareCorners(camera, marker.camera_from_marker, kMarkerEdge)) {
    sum = sum + corner * 0.25;
  }
  return sum;
}

}  // namespace

FrameRun MakeFilm(const std::string& name, const CameraModel& camera, const SweepOptions& options) {
  const bool covered = name == "sequence_occl";
  const int frames =
      std::max(1, static_cast<int>(std::lround((covered ? 200 : 300) * options.scale)));
  RandomStream random(options.seed, "film/" + name);
  const Wander depth =
      covered ? Wander({{.25, .13}}, &random) : Wander({{.55, .11}, {.12, .37}}, &random);
  const Wander across({{.17, .15}, {.03, .6}, {.004, 2.7}, {.0015, 6.3}}, &random);
  const Wander down({{.15, .12}, {.03, .5}, {.004, 3.1}, {.0015, 7.1}}, &random);
  const Wander tilt({{16, .13}, {3, .8}, {.5, 4.2}}, &random);
  const Wander axis({{1.6, .06}, {.05, 2.0}}, &random);
  const Wander roll({{.7, .09}, {.04, 1.3}, {.008, 5.0}}, &random);
  const double middle_side =
      (covered ? 130.0 : 190.0) / 2.0 * std::exp(0.25) * (camera.height < 600 ? 1.0 : 1.4);
  const double light = random.Uniform(.75, 1.1);
  constexpr std::array<const char*, 4> kPatterns{"hand", "corners4", "sides2opp", "fingers"};
  FrameRun film{true, {}};
  Vec2 last;
  for (int i = 0; i < frames; ++i) {
    const double time_s = i / kFilmRate_hz;
    PlaceWanted place{.number = kFilmMarker};
    place.side_px = middle_side * std::exp(depth.At(time_s));
    place.tilt_deg = std::clamp(22.0 + tilt.At(time_s), 0.0, 60.0);
    place.centre_px =
        Vec2{camera.width * (.5 + across.At(time_s)), camera.height * (.5 + down.At(time_s))};
    place.roll = roll.At(time_s);
    place.tilt_axis = axis.At(time_s);
    FrameSpec frame{.name = fmt::format("{}_{:03}", name, i), .sweep = name, .repeat = i};
    frame.markers = {PlaceMarker(camera, place, &random)};
    if (covered) {
      const int period = static_cast<int>(time_s / kFilmPeriod_s);
      const double share = .62 * std::sin(M_PI * (time_s - period * kFilmPeriod_s) / kFilmPeriod_s);
      if (share > 0.0) {
        frame.markers[0].occluder =
            OccluderSpec{kPatterns[period % 4], share, fmt::format("film{}", period)};
      }
    }
    frame.photo.light = light;
    frame.background = name;
    const Vec2 middle = MiddleOf(camera, frame.markers[0]);
    const Vec2 streak = (middle - last) * (kExposure_s * kFilmRate_hz);
    if (i > 0 && Norm(streak) > 0.15) {
      frame.photo.motion.length_px = Norm(streak);
      frame.photo.motion.angle = std::atan2(streak.y, streak.x);
    }
    last = middle;
    film.frames.push_back(std::move(frame));
  }
  return film;
}

}  // namespace pleinair::accuracy
