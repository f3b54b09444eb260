#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/image.h"
#include "tracker/surf/surf_descriptor.h"
#include "tracker/surf/surf_keypoint.h"

namespace pleinair::tracker {

struct SurfOptions {
  /// Each octave has two scales in its middle: 15 and 21, 27 and 39, 51 and 75 px filters, ...
  int octaves = 3;
  /// Least response of a keypoint. 0.0002 finds a Gaussian blob of 21 grey levels of 255; the
  /// response goes with the square of the contrast.
  float threshold = 0.0002f;
  int max_keypoints = 500;
  /// Angles are 0: for images whose roll is known.
  bool upright = false;
  /// One octave more, in front of the others, on an image of twice the size: for blobs from a
  /// sigma of 1.2 px on, where without it they begin at 2.5 px.
  bool double_size = false;
  /// Samples of the first octave (and of the doubled one), every 1, 2 or 4 px of the image. The
  /// paper has 2.
  int first_step = 1;
  /// Strongest of each bucket kept in fair shares, so that a busy background does not use up the
  /// keypoints; 0: the strongest of all.
  int bucket_px = 80;
  /// Edge of the window that is described, in scales. The paper has 20.
  float descriptor_window_scales = 20;
};

/// Speeded-Up Robust Features (Bay, Ess, Tuytelaars, Van Gool, "Speeded-Up Robust Features (SURF)",
/// Computer Vision and Image Understanding 110(3), 2008). Keeps its memory between calls: images
/// of one size cost no allocation after the first few. One thread.
class Surf {
 public:
  explicit Surf(SurfOptions options);
  ~Surf();
  Surf(Surf&&) noexcept;
  Surf& operator=(Surf&&) noexcept;

  /// Keypoints of an image of one channel, strongest first; none in an empty one. `double_size`
  /// false leaves out the doubled image that the options ask for. Keypoints that are `unwanted`
  /// leave their places among max_keypoints to others.
  void Detect(ImageView<const std::uint8_t> grey, std::vector<SurfKeypoint>* keypoints,
              bool double_size = true,
              const std::function<bool(const SurfKeypoint&)>& unwanted = nullptr);

  /// Fills the angles of keypoints in the image of the last Detect (its own, or others), and
  /// describes them; descriptors[i] belongs to keypoints[i].
  void Describe(std::vector<SurfKeypoint>* keypoints, std::vector<SurfDescriptor>* descriptors);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pleinair::tracker
