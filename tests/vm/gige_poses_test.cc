// Runs with simulated GigE Vision cameras, one of which plays images with known poses.
#include <gtest/gtest.h>

#include "tests/vm/camera_helpers.h"
#include "tests/vm/courtyard_film.h"
#include "tests/vm/gige_film_camera.h"

namespace pleinair::vm {
namespace {

TEST(GigE, WhatIsRecordedLiveReplaysToIdenticalPosesAndTheseAreRight) {
  const CourtyardFilm film = OpenCourtyardFilm();
  // aravis-camera-test adds this address.
  const auto playing = GigeFilmCamera::Start("127.0.0.3", "FILM", film.pictures);
  ASSERT_NE(playing, nullptr);
  const auto camera = Open(Options("aravis:Aravis-Fake-FILM", devices::PixelFormat::kGrey8,
                                   film.camera.width, film.camera.height, 5.0));
  ASSERT_NE(camera, nullptr);
  ExpectRightPosesAndTheSameInReplay(camera.get(), film, film.pictures);
}

}  // namespace
}  // namespace pleinair::vm
