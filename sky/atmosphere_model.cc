#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "sky/atmosphere/atmosphere.h"
#include "sky/dome.h"
#include "sky/sky_sources.h"

namespace pleinair::sky::internal {
namespace {

class AtmosphereModel : public SkyModel {
 public:
  AtmosphereModel(std::shared_ptr<const AtmosphereTables> tables, Direction<World> to_sun,
                  double distance_au)
      : tables_(std::move(tables)),
        to_sun_(to_sun),
        distance_au_(distance_au),
        sun_normal_(RgbInGamut(SunXyz(*tables_, to_sun, distance_au))) {}

  LinearRgb SkyRadiance(Direction<World> from) const override {
    return RgbInGamut(Sky().Xyz(from));
  }
  XyY At(Direction<World> from) const override { return XyYFromXyz(Sky().Xyz(from)); }
  LinearRgb SunNormalIrradiance() const override { return sun_normal_; }
  LinearRgb SkyHorizontalIrradiance() const override {
    Sky();
    return sky_horizontal_;
  }
  Direction<World> ToSun() const override { return to_sun_; }
  AirBetween AirTo(Direction<World> towards, Metres distance) const override {
    std::call_once(aerial_made_, [this] { aerial_.emplace(*tables_, to_sun_, distance_au_); });
    return {aerial_->Transmittance(towards, distance), aerial_->Inscattered(towards, distance)};
  }

 private:
  /// Computed on first use: a caller that needs the sun alone does not pay for it.
  const AtmosphereSky& Sky() const {
    std::call_once(sky_made_, [this] {
      sky_.emplace(tables_, to_sun_, distance_au_);
      sky_horizontal_ = IntegrateProjectedDome(
          [this](Direction<World> from) { return RgbInGamut(sky_->Xyz(from)); });
    });
    return *sky_;
  }

  std::shared_ptr<const AtmosphereTables> tables_;
  Direction<World> to_sun_;
  double distance_au_;
  LinearRgb sun_normal_;
  mutable std::once_flag sky_made_, aerial_made_;
  mutable std::optional<AtmosphereSky> sky_;
  mutable std::optional<AerialPerspective> aerial_;
  mutable LinearRgb sky_horizontal_;
};

/// The tables of an atmosphere. Sources of the same air share them while any of them lives, since
/// they take a quarter of a second.
std::shared_ptr<const AtmosphereTables> TablesOf(const Aerosol& aerosol, double ground_albedo) {
  struct Shared {
    Aerosol aerosol;
    double ground_albedo;
    std::weak_ptr<const AtmosphereTables> tables;
  };
  static std::mutex mutex;
  static std::vector<Shared> all;
  const auto find = [&]() -> std::shared_ptr<const AtmosphereTables> {
    for (const Shared& shared : all) {
      if (shared.aerosol != aerosol || shared.ground_albedo != ground_albedo) continue;
      if (auto tables = shared.tables.lock()) return tables;
    }
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex);
    if (auto tables = find()) return tables;
  }
  // Others need not wait for tables of other air.
  auto made = std::make_shared<const AtmosphereTables>(aerosol, ground_albedo);
  const std::lock_guard lock(mutex);
  if (auto tables = find()) return tables;
  std::erase_if(all, [](const Shared& shared) { return shared.tables.expired(); });
  all.push_back({aerosol, ground_albedo, made});
  return made;
}

class AtmosphereSource : public SkySource {
 public:
  explicit AtmosphereSource(const SkyConditions& conditions)
      : tables_(TablesOf(conditions.aerosol.value_or(
                             AerosolOfTurbidity(conditions.turbidity.value_or(kDefaultTurbidity))),
                         conditions.ground_albedo)) {}

  std::unique_ptr<SkyModel> ForSun(Direction<World> to_sun, double distance_au) const override {
    return std::make_unique<AtmosphereModel>(tables_, to_sun, distance_au);
  }

 private:
  std::shared_ptr<const AtmosphereTables> tables_;
};

}  // namespace

std::shared_ptr<const SkySource> MakeAtmosphereSource(const SkyConditions& conditions) {
  return std::make_shared<AtmosphereSource>(conditions);
}

}  // namespace pleinair::sky::internal
