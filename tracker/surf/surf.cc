#include "tracker/surf/surf.h"

#include <utility>

#include "tracker/surf/box_levels.h"
#include "tracker/surf/double_size.h"
#include "tracker/surf/fast_hessian.h"
#include "tracker/surf/integral_image.h"
#include "tracker/surf/keypoint_selection.h"
#include "tracker/surf/surf_description.h"
#include "tracker/surf/surf_orientation.h"

namespace pleinair::tracker {

struct Surf::State {
  SurfOptions options;
  IntegralImage integral;
  FastHessian hessian;
  Image<std::uint8_t> doubled;
  IntegralImage doubled_integral;
  FastHessian doubled_hessian;
  KeypointSelection selection;
  BoxLevels levels;
};

Surf::Surf(SurfOptions options) : state_(std::make_unique<State>()) {
  CHECK_GE(options.octaves, 0);
  CHECK_GE(options.first_step, 1);
  CHECK_GT(options.descriptor_window_scales, 0.0f);
  state_->options = options;
}
Surf::~Surf() = default;
Surf::Surf(Surf&&) noexcept = default;
Surf& Surf::operator=(Surf&&) noexcept = default;

void Surf::Detect(ImageView<const std::uint8_t> grey, std::vector<SurfKeypoint>* keypoints,
                  bool double_size, const std::function<bool(const SurfKeypoint&)>& unwanted) {
  State& s = *state_;
  keypoints->clear();
  s.integral.Compute(grey);
  s.levels.Reset(&s.integral);
  if (s.options.double_size && double_size) {
    DoubleSize(grey, &s.doubled);
    s.doubled_integral.Compute(s.doubled.view());
    // The samples are as far apart in the given image as those of the undoubled octaves. Twice the
    // density costs 3 ms more (640x480) and finds no more keypoints (docs/method/surf.md).
    s.doubled_hessian.Detect(s.doubled_integral, 1, 2 * s.options.first_step, s.options.threshold,
                             keypoints);
    for (SurfKeypoint& keypoint : *keypoints) {
      keypoint.x /= 2;
      keypoint.y /= 2;
      keypoint.scale /= 2;
    }
  }
  s.hessian.Detect(s.integral, s.options.octaves, s.options.first_step, s.options.threshold,
                   keypoints);
  if (unwanted) std::erase_if(*keypoints, unwanted);
  s.selection.KeepFairShares(grey.width(), grey.height(), s.options.bucket_px,
                             s.options.max_keypoints, keypoints);
}

void Surf::Describe(std::vector<SurfKeypoint>* keypoints,
                    std::vector<SurfDescriptor>* descriptors) {
  State& s = *state_;
  descriptors->resize(keypoints->size());
  if (s.integral.width() == 0 || s.integral.height() == 0) {
    for (SurfDescriptor& descriptor : *descriptors) descriptor.fill(0);
    return;
  }
  for (std::size_t i = 0; i < keypoints->size(); ++i) {
    SurfKeypoint& keypoint = (*keypoints)[i];
    keypoint.angle_rad = s.options.upright
                             ? 0.0f
                             : DominantDirection(&s.levels, keypoint.x, keypoint.y, keypoint.scale);
    (*descriptors)[i] = DescribeKeypoint(&s.levels, keypoint, s.options.descriptor_window_scales);
  }
}

}  // namespace pleinair::tracker
