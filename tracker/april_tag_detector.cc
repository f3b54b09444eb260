#include "tracker/april_tag_detector.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/common/image_u8.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>
}

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>

#include "base/pixel_origin.h"

namespace pleinair::tracker {
namespace {

struct Family {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
  /// Correctable bit errors. The sparser the family's codewords, the more can be allowed. With two
  /// corrected bits a random square passes as tag16h5 in one of 17 cases, as tag36h11 in one of
  /// 45,000 (words × patterns × rotations / 2^bits).
  int corrected_bits;
};

constexpr std::array<Family, 4> kFamilies{{
    {"tag36h11", tag36h11_create, tag36h11_destroy, 2},
    {"tag25h9", tag25h9_create, tag25h9_destroy, 1},
    {"tag16h5", tag16h5_create, tag16h5_destroy, 0},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy, 2},
}};

/// Minimum mean distance of a bit from its threshold, in grey levels. The faintest tag in the
/// photographs of tests/tracker/data has 45; underexposed images have less.
constexpr float kMinDecisionMargin = 8.0F;

/// AprilTag thresholds by tiles of 4×4 pixels, and reads out of bounds in images with less than one
/// ring of them. Smaller images are padded to this size.
constexpr int kMinSide_px = 16;

struct FamilyDeleter {
  void (*destroy)(apriltag_family_t*);
  void operator()(apriltag_family_t* family) const { destroy(family); }
};
using FamilyPtr = std::unique_ptr<apriltag_family_t, FamilyDeleter>;

struct DetectorDeleter {
  void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
};

const Family* FindFamily(std::string_view name) {
  const auto* found = std::find_if(kFamilies.begin(), kFamilies.end(),
                                   [&](const Family& family) { return family.name == name; });
  return found == kFamilies.end() ? nullptr : found;
}

std::shared_ptr<const MarkerPattern> MakePattern(apriltag_family_t* family, int id) {
  image_u8_t* image = apriltag_to_image(family, id);
  auto pattern = std::make_shared<MarkerPattern>();
  pattern->modules = family->total_width;
  pattern->edge_modules = family->width_at_border;
  for (int y = 0; y < image->height; ++y) {
    for (int x = 0; x < image->width; ++x) {
      pattern->white.push_back(image->buf[y * image->stride + x] > 127 ? 1 : 0);
    }
  }
  image_u8_destroy(image);
  return pattern;
}

class AprilTagDetector final : public MarkerDetector {
 public:
  explicit AprilTagDetector(const std::vector<const Family*>& families)
      : detector_(apriltag_detector_create()) {
    // Version 3.3 mixes pixel origins when it decimates or refines edges. Without both, all its
    // corners have pixel centres at .5 (tests/tracker/april_tag_detector_test.cc). One thread:
    // otherwise the order of its list depends on timing.
    detector_->quad_decimate = 1.0F;
    detector_->refine_edges = false;
    detector_->nthreads = 1;
    for (const Family* family : families) {
      families_.emplace_back(family->create(), FamilyDeleter{family->destroy});
      apriltag_detector_add_family_bits(detector_.get(), families_.back().get(),
                                        family->corrected_bits);
    }
  }

  std::vector<Candidate> Detect(ImageView<const std::uint8_t> grey) override {
    std::vector<Candidate> candidates;
    if (grey.empty()) return candidates;
    GreyImage padded = PaddedCopy(grey);
    image_u8_t image{padded.width(), padded.height(), padded.width(), padded.data()};
    zarray_t* found = apriltag_detector_detect(detector_.get(), &image);
    for (int i = 0; i < zarray_size(found); ++i) {
      apriltag_detection_t* tag = nullptr;
      zarray_get(found, i, &tag);
      if (tag->decision_margin < kMinDecisionMargin) continue;
      Candidate candidate;
      candidate.detection.family = tag->family->name;
      candidate.detection.id = tag->id;
      candidate.detection.path = DetectionPath::kFast;
      // AprilTag's first corner is the marker's bottom-left; the others follow anticlockwise.
      for (int corner = 0; corner < 4; ++corner) {
        const double* p = tag->p[3 - corner];
        candidate.detection.corners_px[corner] = PixelFromCornerOrigin({p[0], p[1]});
      }
      candidate.pattern = PatternOf(tag->family, tag->id);
      candidates.push_back(std::move(candidate));
    }
    apriltag_detections_destroy(found);
    return candidates;
  }

 private:
  /// Copies, because the library's interface is not const-correct; repeats the last row and column
  /// if the image is too small.
  static GreyImage PaddedCopy(ImageView<const std::uint8_t> grey) {
    GreyImage padded(std::max(grey.width(), kMinSide_px), std::max(grey.height(), kMinSide_px));
    for (int y = 0; y < padded.height(); ++y) {
      const std::uint8_t* source = grey.row(std::min(y, grey.height() - 1));
      std::uint8_t* target = &padded(0, y);
      std::memcpy(target, source, static_cast<std::size_t>(grey.width()));
      std::fill(target + grey.width(), target + padded.width(), source[grey.width() - 1]);
    }
    return padded;
  }

  std::shared_ptr<const MarkerPattern> PatternOf(apriltag_family_t* family, int id) {
    auto& pattern = patterns_[{family, id}];
    if (!pattern) pattern = MakePattern(family, id);
    return pattern;
  }

  std::vector<FamilyPtr> families_;
  std::unique_ptr<apriltag_detector_t, DetectorDeleter> detector_;
  std::map<std::pair<const apriltag_family_t*, int>, std::shared_ptr<const MarkerPattern>>
      patterns_;
};

}  // namespace

std::vector<std::string> AprilTagFamilyNames() {
  std::vector<std::string> names;
  for (const Family& family : kFamilies) names.emplace_back(family.name);
  return names;
}

std::shared_ptr<const MarkerPattern> AprilTagPattern(std::string_view family, int id) {
  const Family* found = FindFamily(family);
  if (found == nullptr) return nullptr;
  const FamilyPtr created(found->create(), FamilyDeleter{found->destroy});
  if (id < 0 || static_cast<std::uint32_t>(id) >= created->ncodes) return nullptr;
  return MakePattern(created.get(), id);
}

Result<std::unique_ptr<MarkerDetector>> CreateAprilTagDetector(
    const std::vector<std::string>& families) {
  std::vector<const Family*> found;
  for (const std::string& name : families) {
    const Family* family = FindFamily(name);
    if (family == nullptr) {
      std::string known = "sg";  // Known to the tracker besides these.
      for (const Family& each : kFamilies) known += ", " + std::string(each.name);
      return InputError("", "unknown marker family \"" + name + "\"", "known are " + known);
    }
    if (std::find(found.begin(), found.end(), family) == found.end()) found.push_back(family);
  }
  return std::unique_ptr<MarkerDetector>(std::make_unique<AprilTagDetector>(found));
}

}  // namespace pleinair::tracker
