#pragma once

#include <vector>

#include "base/vector.h"
#include "tracker/surf/quantised_descriptor.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// A keypoint of the border as one view shows it. The view is an affine image of the marker:
/// x = a column + b row + c, y = d column + e row + f.
struct BorderTemplate {
  Vec2 modules;            ///< Where it lies on the marker.
  Vec2 view;               ///< … and in the view, px.
  double scale = 0.0;      ///< SURF scale in the view, px.
  double angle_rad = 0.0;  ///< Dominant direction in the view.
  int view_index = 0;
};

/// A target observed from everywhere: descriptors of its keypoints under tilts up to about 80° in
/// all directions and from near and far, those that come back whatever the content and whatever
/// lies around. SURF bears turns in the image's plane and about 30° of tilt itself; the rest is
/// covered by views, after Yu & Morel, "ASIFT" (2011), table of tilts and directions.
struct BorderTemplates {
  struct View {
    std::array<double, 6> from_modules{};  ///< a b c d e f.
  };
  std::vector<View> views;
  std::vector<BorderTemplate> keypoints;
  std::vector<QuantisedDescriptor> descriptors;  ///< One for each of `keypoints`.
};

/// Those of the S-G marker's border. Takes a fraction of a second.
BorderTemplates MakeBorderTemplates(float descriptor_window_scales,
                                    const sg::Border& border = sg::kBorder);

}  // namespace pleinair::tracker
