#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_marker_pattern.h"
#include "tracker/tracker.h"

namespace {

using pleinair::CameraModel;
using pleinair::GreyImage;
using pleinair::Vec2;
namespace tracker = pleinair::tracker;

constexpr int kMaxWidth = 160, kMaxHeight = 120;

/// Returns the bytes of the input in order, 0 after the end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::uint8_t Next() { return at_ < size_ ? data_[at_++] : 0; }
  std::size_t left() const { return size_ - at_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

void PaintBytes(Bytes* bytes, GreyImage* image) {
  for (std::size_t i = 0; i < image->size(); ++i) image->data()[i] = bytes->Next();
}

/// Draws a marker in a quadrilateral, then spots and bars, all determined by the bytes.
void PaintMarker(Bytes* bytes, GreyImage* image) {
  const int number = (bytes->Next() << 8 | bytes->Next()) % 4096;
  const tracker::MarkerPattern print = tracker::SgMarkerPattern(number);
  const double side = 0.1 * std::min(image->width(), image->height()) * (2 + bytes->Next() % 7);
  std::array<Vec2, 4> quad;
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner = tracker::kSquareCorners[i];
    quad[i] = {0.5 * (image->width() + side * corner.x) + 0.15 * (bytes->Next() % 128 - 64.0),
               0.5 * (image->height() - side * corner.y) + 0.15 * (bytes->Next() % 128 - 64.0)};
  }
  const pleinair::Mat3 marker_from_pixel = tracker::Adjugate(tracker::HomographyToQuad(quad));
  const int black = bytes->Next() / 2, white = black + bytes->Next() / 2;
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width(); ++x) {
      const Vec2 at = tracker::Apply(marker_from_pixel, {1.0 * x, 1.0 * y});
      const double extent = print.Extent(), per_unit = print.modules / (2.0 * extent);
      (*image)(x, y) = static_cast<std::uint8_t>((black + white) / 2);
      if (!(std::fabs(at.x) < extent && std::fabs(at.y) < extent)) continue;
      const int column = std::min(print.modules - 1, static_cast<int>((at.x + extent) * per_unit));
      const int row = std::min(print.modules - 1, static_cast<int>((extent - at.y) * per_unit));
      (*image)(x, y) =
          static_cast<std::uint8_t>(print.white[row * print.modules + column] != 0 ? white : black);
    }
  }
  while (bytes->left() >= 5) {
    const int x0 = bytes->Next() % image->width(), y0 = bytes->Next() % image->height();
    const int x1 = std::min(image->width(), x0 + 1 + bytes->Next() % 64);
    const int y1 = std::min(image->height(), y0 + 1 + bytes->Next() % 64);
    const std::uint8_t code = bytes->Next();
    for (int y = y0; y < y1; ++y) std::fill(&(*image)(x0, y), &(*image)(x0, y) + x1 - x0, code);
  }
}

/// Creating a tracker that searches for borders is slow, so it is reused. Each input must find it
/// in its initial state. Empty frames make it forget its markers and return to the same point in
/// its search cycle.
class KeptTracker {
 public:
  KeptTracker(const CameraModel& camera, const tracker::TrackerOptions& options)
      : tracker_(*tracker::Tracker::Create(camera, options)), empty_(camera.width, camera.height) {}

  tracker::Tracker& get() { return *tracker_; }

  void Renew(int frames_seen) {
    constexpr int kRound = 15;  // After this number of frames every search has been repeated.
    for (int frame = frames_seen; frame % kRound != 0 || !tracker_->Lost().empty(); ++frame) {
      if (!tracker_->Track(empty_.view())->empty()) std::abort();
    }
  }

 private:
  std::unique_ptr<tracker::Tracker> tracker_;
  GreyImage empty_;
};

void Check(const pleinair::Result<std::vector<tracker::MarkerObservation>>& observations) {
  if (!observations) std::abort();
  for (const tracker::MarkerObservation& observation : *observations) {
    const tracker::MarkerDetection& seen = observation.detection;
    if (seen.family != "sg" || seen.id < 0 || seen.id > 4095) std::abort();
    if (!(seen.visible_fraction >= 0.0 && seen.visible_fraction <= 1.0)) std::abort();
    const auto blocks = static_cast<std::size_t>(seen.visibility_side) * seen.visibility_side;
    if (seen.visibility.size() != blocks) std::abort();
    for (const float visible : seen.visibility) {
      if (!(visible >= 0.0F && visible <= 1.0F)) std::abort();
    }
    for (const Vec2 corner : seen.corners_px) {
      if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) std::abort();
    }
    for (const double value : observation.pose.covariance) {
      if (!std::isfinite(value)) std::abort();
    }
    if (!(observation.pose.best.camera_from_marker.translation_m.z > 0.0)) std::abort();
  }
}

}  // namespace

// Any small image gives a list of valid markers, alone and as one of several consecutive frames.
// The first byte selects the kind of image and tracker, the next two the size.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t kind = bytes.Next();
  const bool marker = (kind & 1U) != 0, consecutive = (kind & 2U) != 0, bends = (kind & 4U) != 0;
  // Trackers that search for borders receive images of one size; others are created for each input.
  const bool search = (kind & 8U) != 0;
  const std::uint8_t width_byte = bytes.Next(), height_byte = bytes.Next();
  const int width = search ? kMaxWidth : 1 + width_byte % kMaxWidth;
  const int height = search ? kMaxHeight : 1 + height_byte % kMaxHeight;
  const CameraModel camera{.width = width,
                           .height = height,
                           .fx = 150,
                           .fy = 150,
                           .cx = 0.5 * (width - 1),
                           .cy = 0.5 * (height - 1),
                           .distortion = {bends && !search ? -0.2 : 0.0, 0, 0, 0, 0, 0, 0, 0}};
  const tracker::TrackerOptions options{
      .families = {"sg"},
      .marker_size_m = 0.1,
      .consecutive_frames = consecutive,
      .sg = {.strategy = search ? tracker::SgStrategy::kHybrid : tracker::SgStrategy::kFast,
             .numbers_in_use = {}}};
  static std::array<std::unique_ptr<KeptTracker>, 2> searching;
  std::unique_ptr<KeptTracker> own;
  std::unique_ptr<KeptTracker>& used = search ? searching[consecutive ? 1 : 0] : own;
  if (used == nullptr) used = std::make_unique<KeptTracker>(camera, options);
  tracker::Tracker& tracker = used->get();

  GreyImage image(width, height);
  if (marker) {
    PaintMarker(&bytes, &image);
  } else {
    PaintBytes(&bytes, &image);
  }
  Check(tracker.Track(image.view()));
  if (!consecutive) return 0;
  // The next frames: shifted by a pixel, then upside down.
  GreyImage moved = image;
  std::copy(image.data(), image.data() + image.size() - 1, moved.data() + 1);
  Check(tracker.Track(moved.view()));
  std::reverse(moved.data(), moved.data() + moved.size());
  Check(tracker.Track(moved.view()));
  for (const tracker::LostMarker& lost : tracker.Lost()) {
    if (lost.frames < 1 || lost.frames > 2) std::abort();
  }
  if (search) used->Renew(3);
  return 0;
}
