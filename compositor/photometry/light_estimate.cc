#include "compositor/photometry/light_estimate.h"

#include <optional>

namespace pleinair::compositor {

void UseHeading(StatedHeading stated, const LightFilter& light_filter, UtcTime time,
                LightEstimate* found) {
  const auto known = stated.is_final ? std::nullopt : light_filter.Heading(time);
  const HeadingOffset offset = known.value_or(HeadingOffset{});
  found->heading = Radians(stated.heading.value() + offset.offset.value());
  found->measured.heading_offset = offset.offset;
  found->measured.heading_error = known ? std::optional(offset.error) : std::nullopt;
  found->measured.heading_source =
      known ? MeasuredLight::Source::kMeasured : MeasuredLight::Source::kDescription;
}

}  // namespace pleinair::compositor
