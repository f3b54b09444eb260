#include "app/clouds/recorded_light.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <tuple>

#include "app/output/light_csv_file.h"
#include "app/output/scratch_folder.h"
#include "app/replay/replay.h"
#include "base/units.h"
#include "base/utc_time.h"
#include "compositor/light/sky_table.h"
#include "devices/recordings/recording.h"
#include "files/text_file.h"
#include "scene/sun_over_place.h"
#include "sky/daylight.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Source = compositor::FrameLight::Source;

constexpr std::size_t kMaxLightBytes = std::size_t{256} << 20;

tl::unexpected<Error> NoReport(const fs::path& file) {
  return InputError(file.string(), "does not state place and time of a replay",
                    "give the folder that 'pleinair replay' wrote, or the recording");
}

Result<scene::PlaceTime> PlaceOf(const fs::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text,
                            files::ReadWholeFile(file, files::kMaxDescriptionBytes));
  const Json json = Json::parse(text, nullptr, false);
  const Json* place = nullptr;
  if (json.is_object() && json.contains("place_time")) place = &json["place_time"];
  if (place == nullptr || !place->is_object()) return NoReport(file);
  scene::PlaceTime found;
  for (const auto& [key, value, most] : {std::tuple{"latitude_deg", &found.latitude_deg, 90.0},
                                         std::tuple{"longitude_deg", &found.longitude_deg, 180.0},
                                         std::tuple{"height_m", &found.height_m, 20'000.0}}) {
    if (!place->contains(key) || !(*place)[key].is_number()) return NoReport(file);
    *value = (*place)[key].get<double>();
    if (!(*value >= -most && *value <= most)) return NoReport(file);
  }
  if (!place->contains("start") || !(*place)["start"].is_string()) return NoReport(file);
  auto start = UtcTime::Parse((*place)["start"].get<std::string>());
  if (!start) return NoReport(file);
  found.start = *start;
  return found;
}

Result<RecordedLight> ReplayedLightOf(const RecordedLightRequest& request) {
  devices::RecordingOptions opening;
  if (!request.scene.empty()) opening.scene = request.scene;
  if (!request.calibration.empty()) opening.calibration = request.calibration;
  RecordedLight light;
  {
    PLEINAIR_ASSIGN_OR_RETURN(const devices::Recording recording,
                              devices::OpenRecording(request.recording, opening));
    if (recording.scene) light.turbidity = recording.scene->turbidity;
  }
  PLEINAIR_ASSIGN_OR_RETURN(const ScratchFolder scratch, ScratchFolder::Create());
  ReplayOptions options;
  options.recording = request.recording;
  options.scene = opening.scene;
  options.calibration = opening.calibration;
  options.output = scratch.path() / "replay";
  options.write.video = false;
  PLEINAIR_ASSIGN_OR_RETURN(const ReplayReport report, Replay(options));
  light.rows = report.light_changes.rows;
  light.place_time = report.scene.place_time;
  if (light.rows.empty()) {
    return InputError(request.recording, "has no frame whose light can be followed",
                      "show the marker, and give the scene phantoms and an object");
  }
  return light;
}

}  // namespace

Result<RecordedLight> ReadRecordedLight(const RecordedLightRequest& request) {
  const fs::path folder = request.recording;
  const fs::path table = folder / "light.csv", report = folder / "report.json";
  std::error_code ignored;
  if (!fs::exists(table, ignored)) {
    if (!fs::exists(report, ignored)) return ReplayedLightOf(request);
    return InputError(folder.string(), "has no light.csv",
                      "replay the recording with phantoms and an object in view");
  }
  RecordedLight light;
  PLEINAIR_ASSIGN_OR_RETURN(light.place_time, PlaceOf(report));
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadWholeFile(table, kMaxLightBytes));
  PLEINAIR_ASSIGN_OR_RETURN(light.rows, ParseLightCsv(text, table.string()));
  if (light.rows.empty()) return InputError(table.string(), "has no frame", "film for 10 s");
  return light;
}

Result<std::vector<clouds::FilmLight>> FramesOf(const RecordedLight& light,
                                                const std::string& recording) {
  std::vector<clouds::FilmLight> frames;
  frames.reserve(light.rows.size());
  std::size_t held = 0, stated = 0;
  for (const LightRow& row : light.rows) {
    if (row.source == Source::kHeld) ++held;
    if (row.source == Source::kStated) ++stated;
    if (row.source != Source::kSurfaces && row.source != Source::kColors) continue;
    frames.push_back(
        {1e-9 * static_cast<double>(row.timestamp_ns), Luminance(row.sun), Luminance(row.sky)});
  }
  const std::size_t all = light.rows.size();
  if (stated > 0) {
    return InputError(recording, "has the light of stated layers of clouds, not that of the film",
                      "replay with --light-changes follow");
  }
  if (held == all) {
    return InputError(recording, "has one light for all frames",
                      "replay with --light-changes follow");
  }
  if (2 * frames.size() < all - held || frames.empty()) {
    return InputError(recording, "does not tell sun from sky: its light is known in total only",
                      "film surfaces in sun and in shade together, and describe what casts the "
                      "shadow as phantom");
  }
  return frames;
}

Result<clouds::FilmSky> ClearSkyOver(const RecordedLight& light, const std::string& recording) {
  constexpr double kLowest_deg = 2.0;
  const scene::PlaceTime place = light.place_time;
  const double middle_s = 0.5e-9 * static_cast<double>(light.rows.front().timestamp_ns +
                                                       light.rows.back().timestamp_ns);
  const sky::SunPosition sun = scene::SunOver(place, place.start.PlusSeconds(middle_s));
  if (sun.ToSun().xyz.z < std::sin(kLowest_deg * kRadiansPerDegree)) {
    return InputError(recording, "has the sun below 2° of elevation", "film by day");
  }
  clouds::FilmSky sky;
  sky.clear = sky::CreateDaylight({sky::SkyCondition::kClear, light.turbidity.value_or(0.0)})
                  ->ForSun(sun.ToSun(), sun.distance_au);
  sky.sun_at = [place](double seconds) {
    return scene::SunOver(place, place.start.PlusSeconds(seconds)).ToSun();
  };
  sky.ground_albedo = compositor::kLandAlbedo;
  return sky;
}

}  // namespace pleinair::app
