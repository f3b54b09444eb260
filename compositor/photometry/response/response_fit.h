#pragma once

#include "base/camera_response.h"
#include "compositor/photometry/response/response_chart.h"

namespace pleinair::compositor {

/// Response of a camera as far as a chart shows it.
struct ResponseEstimate {
  /// sRGB unless `conclusive`.
  CameraResponse response;
  /// The chart has a white, at least three fields a frame, and no shadow that the model lacks.
  bool usable = false;
  /// The evidence for another curve than sRGB is strong.
  bool conclusive = false;
  /// Logarithm of the evidence for another curve over that for sRGB (Bayes factor).
  double log_evidence = 0.0;
  /// Standard deviation of the logarithm of light relative to that of the marker's white, mean over
  /// the pixel values of the chart.
  double log_error = 0.0;
};

/// Estimates the response as a maximum a posteriori fit:
///
///     log linear_sRGB(code) + δ(code) = log(exp(g + log ρ + e + p) (of_sun + K of_sky) + h)
///
/// - δ is the deviation from the sRGB curve: piecewise linear between nine pixel values, with a
///   Gaussian process as its prior (Rasmussen & Williams 2006, eq. 4.9).
/// - g is the exposure of a frame and channel; K is the sky's strength relative to the sun.
/// - e is the error of a described albedo. The marker's white has none.
/// - p is the error of the modelled light on surfaces that are not parallel to the marker.
/// - h is veiling glare and what raises the blacks, linear. It is part of the found response: less
///   light than h is encoded as no light.
///
/// Each curve is fitted with a sun and without one, and the likelier fit counts. sRGB holds unless
/// the evidence is strong, by Laplace's method (MacKay 2003, ch. 27) for the curve alone. The model
/// is ours. Its curves include those of Grossberg & Nayar 2004, "Modeling the Space of Camera
/// Response Functions".
ResponseEstimate FitResponse(const ResponseChart& chart);

}  // namespace pleinair::compositor
