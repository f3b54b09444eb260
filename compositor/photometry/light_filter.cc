#include "compositor/photometry/light_filter.h"

#include <cmath>

#include "compositor/photometry/sky_state.h"

namespace pleinair::compositor {
namespace {

LinearRgb Log(LinearRgb c) { return {std::log(c.r), std::log(c.g), std::log(c.b)}; }

}  // namespace

void LightFilter::AddHeading(const HeadingOffset& seen, UtcTime time) {
  heading_offset_.Add(seen.offset.value(), seen.error.value(), time);
}

std::optional<HeadingOffset> LightFilter::Heading(UtcTime time) const {
  if (!heading_offset_.known()) return std::nullopt;
  return HeadingOffset{Radians(heading_offset_.value()), Radians(heading_offset_.ErrorAt(time))};
}

void LightFilter::AddSun(const SkyRadianceScale& seen, UtcTime time) {
  const LinearRgb kept = Log(sky_radiance_scale_), now = Log(seen.scale);
  const double weight = log_sky_.Add(Luminance(now), seen.relative_error, time);
  seen_ = Observed::kSun;
  if (weight == 1.0) {
    sky_radiance_scale_ = seen.scale;  // Exact, without the rounding of a logarithm.
    return;
  }
  const auto mixed = [&](double was, double is) { return std::exp(was + weight * (is - was)); };
  sky_radiance_scale_ = {mixed(kept.r, now.r), mixed(kept.g, now.g), mixed(kept.b, now.b)};
}

std::optional<SkyRadianceScale> LightFilter::SkyBesideSun(UtcTime time) const {
  if (seen_ != Observed::kSun) return std::nullopt;
  return SkyRadianceScale{sky_radiance_scale_, log_sky_.ErrorAt(time)};
}

void LightFilter::Keep(const MeasuredLight& light, const SkyState& skies) {
  reasons_ = light;
  skies_ = skies;
}

void LightFilter::RestoreSources(UtcTime time, MeasuredLight* light) const {
  if (!reasons_ || reasons_->sun_source == MeasuredLight::Source::kDescription) return;
  light->sun_source = reasons_->sun_source;
  light->evidence.edges = reasons_->evidence.edges;
  light->evidence.edges_agreeing = reasons_->evidence.edges_agreeing;
  light->evidence.shade_places = reasons_->evidence.shade_places;
  light->evidence.edges_with_contrast = reasons_->evidence.edges_with_contrast;
  light->sun_to_sky_error =
      seen_ == Observed::kSun ? std::optional(log_sky_.ErrorAt(time)) : std::nullopt;
}

void LightFilter::Recall(UtcTime time, MeasuredLight* light, SkyState* skies) const {
  if (!reasons_) return;
  RestoreSources(time, light);
  light->shaded = reasons_->shaded;
  light->marker_shade = reasons_->marker_shade;
  *skies = skies_;
}

}  // namespace pleinair::compositor
