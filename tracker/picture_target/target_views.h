#pragma once

#include "base/image.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// Edge of the window that is described, in SURF scales, of targets and of the frames in which they
/// are looked for. The paper has 20; what covers a part of a target spoils fewer of the smaller.
inline constexpr float kTargetDescriptorWindow_scales = 15.0F;

/// The view that shows the picture as it is, near.
inline constexpr int kFrontalView = 0;

/// Fills `views`, `keypoints` and `descriptors` of a target from its picture and its shape: the
/// keypoints of the picture as it looks under tilts up to about 75° in all directions, near and
/// far, that come back whatever the blur, the noise, the exact distance and what lies around. SURF
/// bears turns in the picture's plane and about 30° of tilt itself; the rest is covered by views,
/// after Yu & Morel, "ASIFT" (2011). Takes some seconds.
void FillTargetViews(PictureTarget* target);

}  // namespace pleinair::tracker
