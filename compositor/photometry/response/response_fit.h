#pragma once

#include "base/camera_response.h"
#include "compositor/photometry/response/response_chart.h"

namespace pleinair::compositor {

/// Response of a camera as far as a chart shows it.
struct ResponseEstimate {
  /// sRGB unless `conclusive`.
  CameraResponse response;
  /// The chart has a white, at least two other fields, and no shadow that the model lacks.
  bool usable = false;
  /// The evidence for another curve than sRGB is strong.
  bool conclusive = false;
  /// Logarithm of the evidence for another curve over that for sRGB (Bayes factor).
  double log_evidence = 0.0;
  /// Standard deviation of the logarithm of light beside that of the marker's white, mean over the
  /// pixel values of the chart.
  double log_error = 0.0;
};

/// Estimates the response as a maximum a posteriori fit:
///
///     log linear_sRGB(code) + δ(code) = log(exp(g + log ρ + e + p) (of_sun + K of_sky) + h)
///
/// δ is the deviation from the sRGB curve: piecewise linear between nine pixel values, with a
/// Gaussian process as its prior (Rasmussen & Williams 2006, eq. 4.9). g is the exposure of a frame
/// and channel, K the sky's strength beside the sun, e the error of a described albedo, p that of
/// the modelled light on surfaces that lie otherwise than the marker. The marker's white has no
/// error. h is the lens's glare and what raises the blacks; it becomes part of the response. For
/// either curve the likelier of a place with a sun and one without counts. sRGB holds unless the
/// evidence, by Laplace's method (MacKay 2003, ch. 27) for the curve alone, is strong. The model is
/// ours; the family of curves is wide enough for those of Grossberg & Nayar 2004, "Modeling the
/// Space of Camera Response Functions".
ResponseEstimate FitResponse(const ResponseChart& chart);

}  // namespace pleinair::compositor
