#pragma once

#include "base/image.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// Edge of the descriptor window in SURF scales, for targets and for the frames in which they are
/// searched. The paper has 20; an occluder affects fewer of the smaller windows.
inline constexpr float kTargetDescriptorWindow_scales = 15.0F;

/// The frontal, near view.
inline constexpr int kFrontalView = 0;

/// Fills `views`, `keypoints` and `descriptors` of a target from its image and shape. It simulates
/// tilts up to about 75° in all directions, at several distances, and keeps the keypoints that are
/// repeatable under blur, noise, small changes of distance and different surroundings. SURF itself
/// tolerates in-plane rotation and about 30° of tilt; the views cover the rest, after Yu & Morel,
/// "ASIFT" (2011). Takes some seconds.
void FillTargetViews(PictureTarget* target);

}  // namespace pleinair::tracker
