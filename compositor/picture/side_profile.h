#pragma once

#include <optional>
#include <vector>

#include "base/frames.h"
#include "compositor/lens/exposure_fit.h"
#include "compositor/lens/focus_fit.h"
#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// Mean brightness of the pixels at about one distance from an edge.
struct ProfileBin {
  double distance_px = 0.0, value = 0.0, pixels = 0.0;
};

/// Brightness across one side of the outer black square, within half of its band's width.
struct SideProfile {
  BlurReading place;      ///< Frame, side, distance and speed; the blur is not read yet.
  double reach_px = 0.0;  ///< The narrowest of the side.
  std::vector<ProfileBin> bins;
};

/// The marker's poses a moment before and after a frame.
struct MarkerMotion {
  Transform<Camera, Marker> before, after;
  double seconds = 0.0;  ///< Between the two.
};

/// Reads the sides of the marker that are free and large enough, at most four. Without `motion`
/// their speed is 0. Frame and time stay 0.
std::vector<SideProfile> ReadSideProfiles(const MarkerInImage& marker,
                                          const std::optional<MarkerMotion>& motion);

/// The blur of a side: fits the profile of a disc, whose diameter is free, after the lens's own
/// Gaussian. The levels of black and white and the place of the edge are free, too. Below the own
/// blur it is a narrower Gaussian. Nothing where the profile is no such edge, or where the disc is
/// wider than what is seen of it.
std::optional<BlurReading> ReadBlur(const SideProfile& profile, double own_blur_px);

/// Focus and aperture by the profiles of all frames, in order. The lens's own blur, which all
/// share, is found by repetition. `readings` receives what was read last; it may be null. Errors:
/// as FitFocus().
FocusFit MeasureFocus(const std::vector<SideProfile>& profiles, double fx, const KnownLens& known,
                      std::vector<BlurReading>* readings);

/// The time of exposure by the same profiles, with their speeds. `own_blur_px`: the lens's own blur
/// by MeasureFocus(); 0: it is found by repetition. Errors: as FitExposure().
ExposureFit MeasureExposure(const std::vector<SideProfile>& profiles, double own_blur_px,
                            double frame_interval_s);

}  // namespace pleinair::compositor
