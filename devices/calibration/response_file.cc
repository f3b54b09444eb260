#include "devices/calibration/response_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/json_fields.h"
#include "files/text_file.h"

namespace pleinair::devices {
namespace {

constexpr double kMinGamma = 0.2, kMaxGamma = 5.0;
constexpr std::size_t kMaxSamples = 65'536;

/// A power law, sampled densely enough that the interpolation error is negligible.
CameraResponse PowerResponse(double gamma) {
  constexpr int kSteps = 255;
  std::vector<double> encoded, light;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = static_cast<double>(i) / kSteps;
    const double value = std::pow(at, gamma);
    // Samples that a float cannot distinguish from 0 or 1 are left out; the curve interpolates
    // there.
    if (i != 0 && i != kSteps && (value < 1e-5 || value > 1.0 - 1e-5)) continue;
    encoded.push_back(at);
    light.push_back(value);
  }
  return *CameraResponse::FromSamples(encoded, {light, light, light});
}

Result<CameraResponse> SampledResponse(const files::JsonFields& fields) {
  PLEINAIR_ASSIGN_OR_RETURN(const auto encoded, fields.Numbers("encoded"));
  if (!encoded) {
    return fields.Fail("encoded", "is missing", "list the encoded values, from 0 to 1, rising");
  }
  std::array<std::vector<double>, 3> light;
  PLEINAIR_ASSIGN_OR_RETURN(const auto grey, fields.Numbers("light"));
  constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    PLEINAIR_ASSIGN_OR_RETURN(const auto of_channel, fields.Numbers(kChannels[c]));
    if (!of_channel && !grey) {
      return fields.Fail(kChannels[c], "is missing", "give light, or red, green and blue");
    }
    light[c] = of_channel ? *of_channel : *grey;
    if (light[c].size() != encoded->size()) {
      return fields.Fail(of_channel ? kChannels[c] : "light",
                         "has " + std::to_string(light[c].size()) + " values for " +
                             std::to_string(encoded->size()) + " in encoded",
                         "give one light for each encoded value");
    }
  }
  if (encoded->size() > kMaxSamples) {
    return fields.Fail("encoded", "has more than 65536 values", "256 are enough");
  }
  auto response = CameraResponse::FromSamples(*encoded, light);
  if (!response) {
    return fields.Fail("encoded", "and the light do not both rise from 0 to 1",
                       "write pixel values / 255 and light / the brightest, in rising order");
  }
  return *response;
}

/// Keys of a kind of response; for an unknown kind, all keys.
std::span<const std::string_view> KeysOf(std::string_view kind) {
  static constexpr std::array<std::string_view, 7> kAll{"response", "encoded", "light", "red",
                                                        "green",    "blue",    "gamma"};
  static constexpr std::array<std::string_view, 2> kPower{"response", "gamma"};
  const std::span<const std::string_view> all(kAll);
  if (kind == "srgb") return all.first(1);
  if (kind == "samples") return all.first(6);
  if (kind == "gamma") return kPower;
  return all;
}

/// An unused key is probably a typing error.
Result<void> CheckKeys(const files::Json& document, const files::JsonFields& fields,
                       std::span<const std::string_view> known) {
  if (!document.is_object()) return {};
  for (const auto& [key, value] : document.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string names;
    for (const std::string_view name : known) names.append(names.empty() ? "" : ", ").append(name);
    return fields.Fail(key.substr(0, 64), "is not known here", "known are " + names);
  }
  return {};
}

}  // namespace

Result<CameraResponse> ReadCameraResponse(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(file, files::kMaxDescriptionBytes));
  const std::string name = file.string();
  PLEINAIR_ASSIGN_OR_RETURN(const files::Json document, files::ParseJson(bytes, name));
  const files::JsonFields fields(document, name);
  PLEINAIR_ASSIGN_OR_RETURN(const auto kind, fields.Text("response"));
  PLEINAIR_RETURN_IF_ERROR(CheckKeys(document, fields, KeysOf(kind.value_or(""))));
  if (kind == "srgb") return CameraResponse();
  if (kind == "samples") return SampledResponse(fields);
  if (kind != "gamma") {
    return fields.Fail("response", kind ? "is not known" : "is missing",
                       "known are srgb, gamma and samples (docs/guide/reference/recordings.md)");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const auto gamma, fields.Number("gamma"));
  if (!gamma || *gamma < kMinGamma || *gamma > kMaxGamma) {
    return fields.Fail("gamma", gamma ? "is out of range" : "is missing",
                       "give the exponent from pixel value to light, 0.2 to 5; 2.2 is usual");
  }
  return PowerResponse(*gamma);
}

std::string CameraResponseText(const CameraResponse& response) {
  if (response.IsSrgb()) return "{\"response\": \"srgb\"}\n";
  constexpr int kStep = 5, kLast = 255;  // 255 is a multiple of 5.
  // Samples that rise less would be refused.
  constexpr double kMinRise = 1e-5;
  const auto light = [&](int code, int c) {
    return code == 0 ? 0.0 : code == kLast ? 1.0 : static_cast<double>(response.Linear(c)[code]);
  };
  const auto rises = [&](int from, int to) {
    return light(to, 0) - light(from, 0) > kMinRise && light(to, 1) - light(from, 1) > kMinRise &&
           light(to, 2) - light(from, 2) > kMinRise;
  };
  std::vector<int> codes{0};
  for (int code = kStep; code < kLast; code += kStep) {
    if (rises(codes.back(), code) && rises(code, kLast)) codes.push_back(code);
  }
  codes.push_back(kLast);
  const auto list = [&](const auto& value) {
    std::string text;
    for (const int code : codes)
      text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", value(code));
    return text;
  };
  std::string text = "{\"response\": \"samples\",\n \"encoded\": [" +
                     list([](int code) { return code / 255.0; }) + "]";
  constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    text += fmt::format(",\n \"{}\": [{}]", kChannels[c],
                        list([&](int code) { return light(code, c); }));
  }
  return text + "}\n";
}

}  // namespace pleinair::devices
