#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "tracker/picture_target/target_file.h"
#include "tracker/picture_target/target_quality.h"
#include "tracker/tracker.h"

namespace {

using pleinair::CameraModel;
using pleinair::GreyImage;
using pleinair::Vec2;
namespace tracker = pleinair::tracker;

constexpr std::uint32_t kLookForOneOf = 32;
constexpr std::size_t kLengthAt = 12, kChecksumAt = 16, kHeader = 20;

/// Adds the header that matches the content, so that the code behind it is reached.
std::string Sealed(std::string bytes) {
  if (bytes.size() < kHeader) return bytes;
  const auto length = static_cast<std::uint32_t>(bytes.size() - kHeader);
  const std::uint32_t checksum = tracker::Crc32(std::string_view(bytes).substr(kHeader));
  bytes.replace(0, 12, std::string("PLEINTGT\1\0\0\0", 12));
  std::memcpy(bytes.data() + kLengthAt, &length, sizeof(length));
  std::memcpy(bytes.data() + kChecksumAt, &checksum, sizeof(checksum));
  return bytes;
}

/// Detects a target in its own image and in an image from the bytes, as consecutive frames.
void LookFor(tracker::PictureTarget target, const std::string& bytes) {
  const int width = target.picture.width(), height = target.picture.height();
  const CameraModel camera{.width = width,
                           .height = height,
                           .fx = 1.0 * width,
                           .fy = 1.0 * width,
                           .cx = 0.5 * (width - 1),
                           .cy = 0.5 * (height - 1)};
  GreyImage own = target.picture;
  GreyImage painted(width, height);
  for (std::size_t i = 0; i < painted.size(); ++i) {
    painted.data()[i] = static_cast<std::uint8_t>(bytes[i % bytes.size()]);
  }
  auto following = tracker::Tracker::Create(
      camera, {.families = {},
               .consecutive_frames = true,
               .targets = {std::make_shared<const tracker::PictureTarget>(std::move(target))}});
  if (!following) std::abort();
  for (const GreyImage* frame : {&own, &own, &painted, &own}) {
    const auto observations = (*following)->Track(frame->view());
    if (!observations || observations->size() > 1) std::abort();
    for (const tracker::MarkerObservation& observation : *observations) {
      const tracker::MarkerDetection& seen = observation.detection;
      if (seen.family != "picture" || seen.id != 0 || seen.name.empty()) std::abort();
      if (!(seen.visible_fraction >= 0.0 && seen.visible_fraction <= 1.0)) std::abort();
      for (const float visible : seen.visibility) {
        if (!(visible >= 0.0F && visible <= 1.0F)) std::abort();
      }
      for (const Vec2 corner : seen.corners_px) {
        if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) std::abort();
      }
      for (const double value : observation.pose.covariance) {
        if (!std::isfinite(value)) std::abort();
      }
    }
  }
}

}  // namespace

// Any bytes give a target that can be rated, written and detected, or an error. They are read
// unchanged, and with matching length and checksum.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const std::string& tried : {bytes, Sealed(bytes)}) {
    auto target = tracker::ParseTarget(tried, "target");
    if (!target) {
      if (target.error().what.empty() || target.error().where != "target") std::abort();
      continue;
    }
    if (tracker::SerializeTarget(*target) != tried) std::abort();
    const tracker::TargetQuality quality = tracker::RateTarget(*target);
    if (quality.score < 0 || quality.score > 100) std::abort();
    // Detection takes a hundred times as long as reading.
    if (tracker::Crc32(tried) % kLookForOneOf == 0) LookFor(*std::move(target), tried);
  }
  return 0;
}
