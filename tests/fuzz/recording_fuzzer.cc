#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "devices/images/image_file.h"
#include "devices/recordings/euroc.h"
#include "devices/recordings/recording_manifest.h"
#include "scene/scene_facts.h"

// Passes the same bytes to every parser of a recording's files; most formats reject the others
// early. An accepted file must be consistent with its header.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pleinair::devices;  // NOLINT(google-build-using-namespace)
  using pleinair::scene::CompleteScene;
  using pleinair::scene::ParseScene;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (const auto manifest = ParseRecordingManifest(bytes, "recording.json")) {
    if (manifest->frame_rate_hz && !(*manifest->frame_rate_hz > 0.0)) std::abort();
  }
  if (const auto facts = ParseScene(bytes, "scene")) {
    const auto scene = CompleteScene(*facts, "scene");
    if (scene && !(scene->marker.size_m > 0.0)) std::abort();
  }
  if (const auto frames = ParseEurocTable(bytes, "data.csv")) {
    if (frames->empty()) std::abort();
  }
  if (const auto image = InspectImage(bytes, "picture")) {
    if (image->width < 1 || image->width > kMaxImageSide) std::abort();
  }
  return 0;
}
