#pragma once

#include <vector>

#include "base/vector.h"
#include "tracker/surf/quantised_descriptor.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// A keypoint of the border in one view. A view is an affine image of the marker: x = a column + b
/// row + c, y = d column + e row + f.
struct BorderTemplate {
  Vec2 modules;            ///< Position on the marker,
  Vec2 view;               ///< … and in the view, px.
  double scale = 0.0;      ///< SURF scale in the view, px.
  double angle_rad = 0.0;  ///< Dominant direction in the view.
  int view_index = 0;
};

/// Templates of a target: descriptors of its keypoints in views with tilts up to about 80° in all
/// directions, near and far. Keypoints are kept if they are repeatable with any content and any
/// surroundings. SURF itself tolerates in-plane rotation and about 30° of tilt; the views cover the
/// rest, after Yu & Morel, "ASIFT" (2011), table of tilts and directions.
struct BorderTemplates {
  struct View {
    std::array<double, 6> from_modules{};  ///< a b c d e f.
  };
  std::vector<View> views;
  std::vector<BorderTemplate> keypoints;
  std::vector<QuantisedDescriptor> descriptors;  ///< One for each of `keypoints`.
};

/// Templates of the S-G marker's border. Takes a fraction of a second.
BorderTemplates MakeBorderTemplates(float descriptor_window_scales,
                                    const sg::Border& border = sg::kBorder);

}  // namespace pleinair::tracker
