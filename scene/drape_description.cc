#include "scene/drape_description.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "base/srgb.h"
#include "scene/scene_description.h"

namespace pleinair::scene {

std::optional<LinearRgb> ParseHexColor(const std::string& text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::uint32_t value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data() + 1, end, value, 16);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  const auto linear = [&](int shift) { return LinearFromSrgb(((value >> shift) & 255U) / 255.0); };
  return LinearRgb{linear(16), linear(8), linear(0)};
}

std::string HexColor(const LinearRgb& color) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", Srgb8FromLinear(color.r),
                Srgb8FromLinear(color.g), Srgb8FromLinear(color.b));
  return text.data();
}

const char* NameOf(InkBlend blend) {
  switch (blend) {
    case InkBlend::kStain:
      return "stain";
    case InkBlend::kPaint:
      return "paint";
    case InkBlend::kGlow:
      return "glow";
  }
  return "stain";
}

const char* NameOf(HiddenInk hidden) { return hidden == HiddenInk::kHide ? "hide" : "ghost"; }

const char* NameOf(DrapeSearch search) {
  switch (search) {
    case DrapeSearch::kAuto:
      return "auto";
    case DrapeSearch::kExact:
      return "exact";
    case DrapeSearch::kScreen:
      return "screen";
  }
  return "auto";
}

std::vector<std::string> NamesOfPhantoms(const SceneContent& scene) {
  std::vector<std::string> names;
  for (const ModelReference& phantom : scene.phantoms) {
    names.push_back(!phantom.name.empty() ? phantom.name
                    : phantom.surface     ? phantom.surface->name
                                          : phantom.file.stem().string());
  }
  return names;
}

Result<void> CompleteDrapes(const std::filesystem::path& folder, SceneContent* scene) {
  const std::vector<std::string> names = NamesOfPhantoms(*scene);
  for (DrapeDescription& drape : scene->drapes) {
    drape.source.file = (folder / drape.source.file).lexically_normal();
    if (drape.on == kOnTop || drape.on == kOnLowest ||
        std::find(names.begin(), names.end(), drape.on) != names.end()) {
      continue;
    }
    std::string known = "known are top, lowest";
    for (const std::string& name : names) known += ", " + name;
    return InputError(drape.where,
                      "\"on\" is \"" + drape.on.substr(0, 60) + "\", which is no phantom",
                      known.substr(0, 300));
  }
  return {};
}

}  // namespace pleinair::scene
