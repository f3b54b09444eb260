#include "content/flow/field_probe.h"

#include "content/flow/field_sampler.h"

namespace pleinair::content {
namespace {

template <typename Sampler>
class SamplerProbe final : public FieldProbe {
 public:
  explicit SamplerProbe(Sampler sampler) : sampler_(std::move(sampler)) {}
  PointState Sample(const Vec3& point, Seconds time, Vec3* velocity) override {
    return sampler_.Sample(point, time, velocity);
  }
  std::unique_ptr<FieldProbe> Copy() const override {
    return std::make_unique<SamplerProbe>(sampler_);
  }

 private:
  Sampler sampler_;
};

template <typename Sampler>
std::unique_ptr<FieldProbe> ProbeOf(Sampler sampler) {
  return std::make_unique<SamplerProbe<Sampler>>(std::move(sampler));
}

}  // namespace

std::unique_ptr<FieldProbe> MakeProbe(const GridField& field, const FieldWindow& window) {
  return WithGridSampler(field, window, [](auto sampler) { return ProbeOf(std::move(sampler)); });
}

Result<std::unique_ptr<FieldProbe>> MakeFrozenProbe(const VectorField& field, Seconds time) {
  if (const auto* grid = dynamic_cast<const GridField*>(&field)) {
    PLEINAIR_ASSIGN_OR_RETURN(const FieldWindow window, grid->FrozenAt(time));
    return MakeProbe(*grid, window);
  }
  return ProbeOf(AnyFieldSampler(field, true, time));
}

}  // namespace pleinair::content
