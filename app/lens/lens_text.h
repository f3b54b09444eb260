#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/lens_description.h"
#include "session/lens_measurement.h"

namespace pleinair::app {

/// The measured lens as one JSON object, with what the recording's metadata state beside it.
/// Unknown numbers are null, and so is a focus at infinity in metres.
std::string LensJsonText(const session::MeasuredLens& measured,
                         const std::optional<scene::LensDescription>& metadata);

/// The same as text, some lines.
std::string LensText(const session::MeasuredLens& measured,
                     const std::optional<scene::LensDescription>& metadata);

/// The readings: frame,timestamp_s,side,distance_m,blur_px.
std::string ReadingsCsv(const std::vector<compositor::BlurReading>& readings);

/// The readings over the reciprocal distance, and the parabola through them, as inline SVG.
std::string ReadingsPlot(const session::MeasuredLens& measured);

}  // namespace pleinair::app
