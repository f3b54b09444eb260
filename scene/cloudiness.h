#pragma once

#include <optional>
#include <string_view>

#include "scene/scene_description.h"

namespace pleinair::scene {

/// The words that ParseCloudiness() accepts, for messages.
inline constexpr const char* kCloudinessWords =
    "clear, hazy, few, scattered, partly cloudy, broken, overcast";

/// Cloudiness of a free English text, case-insensitive; nullopt if it has no known word. Aviation
/// terms map by their share of covered sky (WMO-No. 306, code table 2700: few 1–2 eighths,
/// scattered 3–4, broken 5–7, overcast 8) to the classes of the IES Lighting Handbook (clear 0–0.3,
/// partly cloudy 0.4–0.7, overcast 0.8–1). If several terms occur, the cloudiest wins, and haze
/// wins over clear ("none, hazy").
std::optional<Cloudiness> ParseCloudiness(std::string_view text);

}  // namespace pleinair::scene
