#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/output/light_csv.h"
#include "base/error.h"
#include "scene/scene_description.h"
#include "sky/clouds/film/film_course.h"
#include "sky/clouds/film/film_layer.h"

namespace pleinair::app {

/// The followed light of a recording, with its place and time.
struct RecordedLight {
  std::vector<LightRow> rows;
  scene::PlaceTime place_time;
  std::optional<double> turbidity;  ///< That the scene states; a replay's folder has none.
};

/// How a recording's light is obtained.
struct RecordedLightRequest {
  std::string recording;  ///< Folder of a replay, with light.csv; or a recording.
  std::string scene, calibration;
};

/// Reads light.csv and report.json of a replay's folder. A recording is replayed into a scratch
/// folder instead, without images. Errors: those of replay; a replay without light.csv; files that
/// are not those of a replay.
Result<RecordedLight> ReadRecordedLight(const RecordedLightRequest& request);

/// Sun and sky of the frames in which they were told apart. Errors (input): no such frames, or
/// fewer than half of the frames; light of stated layers; light that was held.
Result<std::vector<clouds::FilmLight>> FramesOf(const RecordedLight& light,
                                                const std::string& recording);

/// The clear sky of the recording's time. Error (input): the sun is below 2°.
Result<clouds::FilmSky> ClearSkyOver(const RecordedLight& light, const std::string& recording);

}  // namespace pleinair::app
