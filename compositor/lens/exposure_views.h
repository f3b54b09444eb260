#pragma once

#include <span>
#include <vector>

#include "compositor/lens/camera_motion.h"
#include "compositor/lens/lens_views.h"
#include "compositor/lens/pinhole_image.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_camera.h"
#include "compositor/surfaces/image_tiles.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// A frame with the view that it shows, the lens that it is seen through, and the camera's motion
/// while it is exposed.
struct LensFrame {
  const FrameUniforms& frame;
  const shadows::View& view;
  ThinLens lens = {};  ///< Without an aperture: all is in focus.
  CameraMotion motion = {};
};

/// How far what a frame shows is spread, render pixels.
struct FrameSpread {
  double circle_px = 0.0;  ///< Diameter of the largest circle of confusion.
  double streak_px = 0.0;  ///< Length of the longest streak.
};

/// Length of the longest streak that the motion draws in a frame: the path of a point in the image
/// over the exposure, render pixels. Points at the corners of the rectangles, at both ends of the
/// range of distances, are followed. Between them the motion of a rigid scene is smooth.
double LongestStreak_px(const RenderCamera& camera, const CameraMotion& motion,
                        std::span<const PixelRect> within, const DioptreRange& range);

/// The views whose mean is what the lens draws while the camera moves: `count` places on the stop,
/// each at its own time of the exposure. Times are the middles of equal parts. Their order is that
/// of the digit-reversed numbers of base 2 (J. G. van der Corput, 1935), so that neither radius nor
/// angle on the stop runs with them. Without motion all have the frame's time.
AveragedViews ExposureViews(const LensFrame& lens_frame, const RenderCamera& camera, int count);

}  // namespace pleinair::compositor
