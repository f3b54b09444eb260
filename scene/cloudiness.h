#pragma once

#include <optional>
#include <string_view>

#include "scene/scene_description.h"

namespace pleinair::scene {

/// The words that ParseCloudiness knows, for messages.
inline constexpr const char* kCloudinessWords =
    "clear, hazy, few, scattered, partly cloudy, broken, overcast";

/// The sky that a free text in English means, whatever its case; nothing where no word is known.
/// Aviation's words are taken by their share of covered sky (WMO-No. 306, code table 2700: few
/// 1–2 eighths, scattered 3–4, broken 5–7, overcast 8) in the classes of the IES Lighting Handbook
/// (clear 0–0.3, partly cloudy 0.4–0.7, overcast 0.8–1). Where several are said the cloudier
/// wins, and haze wins over clear ("none, hazy").
std::optional<Cloudiness> ParseCloudiness(std::string_view text);

}  // namespace pleinair::scene
