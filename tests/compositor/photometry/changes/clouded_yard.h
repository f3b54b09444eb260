#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compositor/light/sampling.h"
#include "compositor/photometry/changes/light_changes.h"
#include "compositor/photometry/changes/light_probes.h"
#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::compositor::testing {

inline const PhotographedYard& Yard() {
  static const PhotographedYard yard;
  return yard;
}

inline constexpr int kYardFrames = 18;
inline constexpr double kYardFrameSeconds = 0.25;

/// Light of a frame: what a cloud and the camera make of it.
struct Moment {
  double sun = 1.0, sky = 1.0, exposure = 1.0;
};

/// The sun falls to a tenth within a second and a half and returns; the sky rises by a fifth.
inline Moment UnderACloud(int frame) {
  const double cloud = std::clamp(std::min(frame - 2, 15 - frame) / 6.0, 0.0, 1.0);
  return {std::pow(0.1, cloud), 1.0 + 0.2 * cloud, 1.0};
}

/// Films the yard from two places in turn.
inline LightProbes FilmYard(const std::function<Moment(int)>& moment,
                            PhotographedYard::Light light = {},
                            const std::function<void(int frame, RgbImage*)>& disturb = {},
                            std::size_t max_readings = 100'000) {
  const PhotographedYard& yard = Yard();
  LightProbes probes(yard.phantoms(), yard.camera(), {}, max_readings);
  for (int frame = 0; frame < kYardFrames; ++frame) {
    const Moment now = moment(frame);
    light.sun_scale = now.sun;
    light.sky_radiance_scale = {now.sky, now.sky, now.sky};
    light.exposure = now.exposure;
    RgbImage image = yard.Photograph(frame % 2, light);
    if (disturb) disturb(frame, &image);
    probes.AddFrame(image.view(), PhotographedYard::Pose(frame % 2), yard.marker(), frame,
                    static_cast<std::int64_t>(1e9 * kYardFrameSeconds * frame));
  }
  return probes;
}

/// The film under a cloud, with nothing else.
inline const LightProbes& CloudedFilm() {
  static const LightProbes film = FilmYard(UnderACloud);
  return film;
}

/// People cover a third of the image from the fifth frame on, in the light of their frame and in
/// clothes of any brightness.
inline void WalkThroughTheSun(int frame, RgbImage* image) {
  if (frame < 5) return;
  const double light = 0.8 * UnderACloud(frame).sun + 0.2 * UnderACloud(frame).sky;
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width() / 3; ++x) {
      const double cloth = 0.02 + 0.003 * ((x / 16 * 53 + y / 16 * 29 + frame) % 160);
      for (int c = 0; c < 3; ++c) {
        (*image)(x + 8 * frame, y, c) = CameraResponse{}.Encoded8(cloth * light, c);
      }
    }
  }
}

/// Which probes of the film under a cloud the sun reaches.
inline const std::vector<bool>& SunlitProbes() {
  static const std::vector<bool> sunlit = [] {
    std::vector<bool> found;
    for (const ProbeLight& light : LightOn(CloudedFilm().probes(), Yard().phantoms(),
                                           Yard().model(), Yard().marker_from_world())) {
      found.push_back(light.IsSunlit());
    }
    return found;
  }();
  return sunlit;
}

/// From frame 5 on (the first is 0), a person hides 35 % of the sunlit probes of CloudedFilm().
/// They differ in each frame, and the cloth has any brightness.
inline void HideSunlitProbes(std::vector<ProbedFrame>* frames) {
  for (std::size_t t = 5; t < frames->size(); ++t) {
    ProbedFrame& frame = (*frames)[t];
    for (std::size_t k = 0; k < frame.probes.size(); ++k) {
      const std::uint32_t probe = frame.probes[k];
      const auto frame_number = static_cast<std::uint32_t>(t);
      if (!SunlitProbes()[probe] || UnitFromHash(Hash(probe, frame_number)) > 0.35) continue;
      const double cloth = std::exp(3.0 * UnitFromHash(Hash(frame_number, probe)) - 2.0);
      for (float& value : frame.linear[k]) value *= static_cast<float>(cloth);
    }
  }
}

/// From frame 3 on (the first is 0), as the cloud comes, a hand covers the marker.
inline void CoverTheMarker(std::vector<ProbedFrame>* frames) {
  for (std::size_t t = 3; t < frames->size(); ++t) {
    ProbedFrame& frame = (*frames)[t];
    std::size_t kept = 0;
    for (std::size_t k = 0; k < frame.probes.size(); ++k) {
      if (CloudedFilm().probes()[frame.probes[k]].surface < 0) continue;
      frame.probes[kept] = frame.probes[k];
      frame.linear[kept++] = frame.linear[k];
    }
    frame.probes.resize(kept);
    frame.linear.resize(kept);
  }
}

/// Exposure factor of a frame at 30 Hz under mains lamps (50 Hz), whose light pulsates at 100 Hz.
inline double UnderLamps(int frame) {
  return 1.0 + 0.1 * std::sin(2.0 * std::numbers::pi * 100.0 / 30.0 * frame);
}

/// Gives the frames the times of a film of 30 Hz.
inline void FilmAt30Hz(std::vector<ProbedFrame>* frames) {
  for (std::size_t t = 0; t < frames->size(); ++t) {
    (*frames)[t].timestamp_ns = static_cast<std::int64_t>(1e9 / 30.0 * static_cast<double>(t));
  }
}

/// Keeps each probe's readings for six frames, as if the camera moved on.
inline void MoveOn(std::vector<ProbedFrame>* frames) {
  for (std::size_t t = 0; t < frames->size(); ++t) {
    ProbedFrame& frame = (*frames)[t];
    std::size_t kept = 0;
    for (std::size_t k = 0; k < frame.probes.size(); ++k) {
      const std::size_t first_seen = frame.probes[k] * 7 % (kYardFrames + 5);
      if (t + 5 < first_seen || t > first_seen) continue;
      frame.probes[kept] = frame.probes[k];
      frame.linear[kept++] = frame.linear[k];
    }
    frame.probes.resize(kept);
    frame.linear.resize(kept);
  }
}

/// Errors of the logarithms of sun and sky.
struct LightErrors {
  double sun_rms = 0.0, sky_rms = 0.0, largest = 0.0;
};

inline LightErrors ErrorsOf(const std::vector<FrameLight>& found,
                            const std::function<Moment(int)>& moment) {
  LightErrors errors;
  for (int frame = 0; frame < kYardFrames; ++frame) {
    const Moment now = moment(frame), first = moment(0);
    const double sun =
        MeanLog(found[frame].sun) - std::log(now.sun * now.exposure / first.exposure);
    const double sky =
        MeanLog(found[frame].sky) - std::log(now.sky * now.exposure / first.exposure);
    errors.sun_rms += sun * sun / kYardFrames;
    errors.sky_rms += sky * sky / kYardFrames;
    errors.largest = std::max({errors.largest, std::fabs(sun), std::fabs(sky)});
  }
  errors.sun_rms = std::sqrt(errors.sun_rms);
  errors.sky_rms = std::sqrt(errors.sky_rms);
  ::testing::Test::RecordProperty("sun_rms", std::to_string(errors.sun_rms));
  ::testing::Test::RecordProperty("sky_rms", std::to_string(errors.sky_rms));
  return errors;
}

}  // namespace pleinair::compositor::testing
