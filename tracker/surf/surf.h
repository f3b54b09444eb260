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
  /// Each octave has two inner scales: 15 and 21, 27 and 39, 51 and 75 px filters, ...
  int octaves = 3;
  /// Minimum response of a keypoint. 0.0002 detects a Gaussian blob of 21 grey levels of 255; the
  /// response is proportional to the square of the contrast.
  float threshold = 0.0002f;
  int max_keypoints = 500;
  /// Angles are 0: for images without roll.
  bool upright = false;
  /// Adds an octave before the others, on an image of twice the size: for blobs with a sigma of 1.2
  /// px or more, in place of 2.5 px.
  bool double_size = false;
  /// Sampling step of the first octave (and of the doubled one): 1, 2 or 4 px of the image. The
  /// paper has 2.
  int first_step = 1;
  /// Bucket size for an even distribution of keypoints, so that a detailed background does not use
  /// up all of them; 0: the strongest of the whole image.
  int bucket_px = 80;
  /// Edge of the descriptor window, in scales. The paper has 20.
  float descriptor_window_scales = 20;
};

/// Speeded-Up Robust Features (Bay, Ess, Tuytelaars, Van Gool, "Speeded-Up Robust Features (SURF)",
/// Computer Vision and Image Understanding 110(3), 2008). Memory is reused: after the first few
/// images of one size nothing is allocated. One thread.
class Surf {
 public:
  explicit Surf(SurfOptions options);
  ~Surf();
  Surf(Surf&&) noexcept;
  Surf& operator=(Surf&&) noexcept;

  /// Keypoints of a one-channel image, strongest first; none in an empty image. `double_size` false
  /// disables the doubled image of the options. Keypoints for which `unwanted` is true do not count
  /// towards max_keypoints.
  void Detect(ImageView<const std::uint8_t> grey, std::vector<SurfKeypoint>* keypoints,
              bool double_size = true,
              const std::function<bool(const SurfKeypoint&)>& unwanted = nullptr);

  /// Computes the angles and descriptors of keypoints in the image of the last Detect(); the
  /// keypoints may come from elsewhere. descriptors[i] belongs to keypoints[i].
  void Describe(std::vector<SurfKeypoint>* keypoints, std::vector<SurfDescriptor>* descriptors);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pleinair::tracker
