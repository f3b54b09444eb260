#include "compositor/photometry/changes/forward_light.h"

#include <cmath>

#include "compositor/photometry/changes/forward_filter.h"

namespace pleinair::compositor {

ForwardLight::ForwardLight() : filter_(std::make_unique<ForwardFilter>()) {}

ForwardLight::~ForwardLight() = default;

void ForwardLight::Start() { filter_->Start(LogLight::Zero(), 0.0); }

void ForwardLight::Start(const FrameLight& next) {
  LogLight log;
  log << std::log(next.sun.r), std::log(next.sun.g), std::log(next.sun.b), std::log(next.sky.r),
      std::log(next.sky.g), std::log(next.sky.b);
  filter_->Start(log, next.log_ratio_error);
}

void ForwardLight::AddProbe(const ProbeLight& light) { filter_->AddProbe(light); }

FrameLight ForwardLight::Add(const ProbedFrame& frame) { return filter_->Add(frame); }

bool ForwardLight::changes() const { return filter_->changes(); }

}  // namespace pleinair::compositor
