#include "sky/clouds/cloud_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "base/parallel_for.h"
#include "sky/clouds/cloud_slab.h"
#include "sky/clouds/higher_orders.h"
#include "sky/clouds/layer_march.h"
#include "sky/clouds/tilted_columns.h"

namespace pleinair::clouds {
namespace {

using std::numbers::pi;

const SlabTable& TableOf(const CloudField& field) {
  return field.layer().kind == CloudKind::kCirrus ? SlabTable::Ice() : SlabTable::Water();
}

/// Means over the area.
LayerShares SharesOf(const CloudField& field, Direction<World> to_sun, double seconds) {
  constexpr int kSamples = 100;
  // The square is a period of fields with such cells. The same columns then give steady means.
  constexpr double kMaxPeriodicCell_m = 8000.0;
  const double age_s = field.layer().cell_m > kMaxPeriodicCell_m ? seconds : 0.0;
  const auto place = [](int i) {
    const int column = i % kSamples, row = i / kSamples;
    return Vec3{((column + 0.5) / kSamples - 0.5) * kCoverSquare_m,
                ((row + 0.5) / kSamples - 0.5) * kCoverSquare_m, 0.0};
  };
  return SharesOfTiltedColumns(
      TableOf(field), to_sun.xyz.z, kSamples * kSamples,
      [&](int i) { return field.DepthAlong(place(i), to_sun.xyz, age_s); },
      [&](int i) { return field.ColumnDepth(place(i).x, place(i).y, age_s); });
}

std::vector<LayerShares> SharesOf(const CloudFields& fields, Direction<World> to_sun,
                                  double seconds) {
  std::vector<LayerShares> shares;
  shares.reserve(fields.size());
  for (const auto& field : fields) shares.push_back(SharesOf(*field, to_sun, seconds));
  return shares;
}

/// `of_layer`: SharesOf().
AreaLight AreaLightOf(const CloudFields& fields, const std::vector<LayerShares>& of_layer,
                      const sky::SkyModel& clear, double ground_albedo) {
  const std::size_t count = fields.size();
  // From the highest base down, whatever the order of the fields.
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return fields[a]->layer().base_m > fields[b]->layer().base_m;
  });
  std::vector<LayerShares> shares;
  shares.reserve(count);
  for (const std::size_t i : order) shares.push_back(of_layer[i]);
  LinearRgb sun = clear.SunNormalIrradiance() * std::max(0.0, clear.ToSun().xyz.z);
  std::vector<LinearRgb> from_sun_down, from_sun_up;
  from_sun_down.reserve(count);
  from_sun_up.reserve(count);
  for (const LayerShares& share : shares) {
    from_sun_down.push_back(sun * std::max(0.0, 1.0 - share.reflected - share.direct));
    from_sun_up.push_back(sun * share.reflected);
    sun = sun * share.direct;
  }
  // down[i] arrives at layer i, down[count] at the ground; up[i] arrives at layer i from below.
  std::vector<LinearRgb> down(count + 1), up(count + 1);
  down[0] = clear.SkyHorizontalIrradiance();
  constexpr int kSweeps = 400;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < count; ++i) {
      const double s = shares[i].diffuse_reflected;
      down[i + 1] = down[i] * (1.0 - s) + up[i] * s + from_sun_down[i];
    }
    LinearRgb rising = (down[count] + sun) * ground_albedo;
    for (std::size_t i = count; i-- > 0;) {
      up[i] = rising;
      const double s = shares[i].diffuse_reflected;
      rising = rising * (1.0 - s) + down[i] * s + from_sun_up[i];
    }
  }
  AreaLight light;
  light.layers.resize(count);
  for (std::size_t i = 0; i < count; ++i) light.layers[order[i]] = {down[i], up[i]};
  light.sun_horizontal = sun;
  light.sky_horizontal = down[count];
  return light;
}

}  // namespace

AreaLight ComputeAreaLight(const CloudFields& fields, const sky::SkyModel& clear,
                           double ground_albedo, double seconds) {
  return AreaLightOf(fields, SharesOf(fields, clear.ToSun(), seconds), clear, ground_albedo);
}

namespace {

/// The clear sky's light that a slab scatters downwards, relative to that of a uniform sky of the
/// same illuminance. Clear skies are brightest near the horizon and the sun.
class ClearSkyShape {
 public:
  ClearSkyShape(const sky::SkyModel& clear, const SlabTable& table) {
    constexpr int kRings = 48, kSectors = 64;
    std::array<double, kRings> rings{};
    double total = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
      const double up = CosineOf(ring, kRings), level = std::sqrt(1.0 - up * up);
      for (int sector = 0; sector < kSectors; ++sector) {
        const double azimuth = 2.0 * pi * (sector + 0.5) / kSectors;
        rings[ring] += Luminance(
            clear.SkyRadiance({{level * std::sin(azimuth), level * std::cos(azimuth), up}}));
      }
      total += rings[ring];
    }
    for (std::size_t i = 0; i < factors_.size(); ++i) {
      const double depth = DepthAt(static_cast<double>(i));
      double through = 0.0, uniform = 0.0;
      for (int ring = 0; ring < kRings; ++ring) {
        const double kept = std::exp(-depth / CosineOf(ring, kRings));
        through += total > 0.0 ? kept * rings[ring] / total : kept / kRings;
        uniform += kept / kRings;
      }
      const double transmitted = 1.0 - table.DiffuseReflected(depth);
      factors_[i] = std::max(0.0, (transmitted - through) / (transmitted - uniform));
    }
  }

  double Factor(double depth) const {
    const double last = static_cast<double>(factors_.size()) - 1.001;
    const double place = std::clamp(2.0 * std::log2(std::max(depth, 1e-9) * 32.0), 0.0, last);
    const auto cell = static_cast<std::size_t>(place);
    return factors_[cell] +
           (place - static_cast<double>(cell)) * (factors_[cell + 1] - factors_[cell]);
  }

 private:
  static double DepthAt(double place) { return std::exp2(0.5 * place) / 32.0; }
  /// Rings of equal projected solid angle.
  static double CosineOf(int ring, int rings) { return std::sqrt((ring + 0.5) / rings); }

  std::array<double, 29> factors_{};
};

}  // namespace

struct CloudSky::Optics {
  struct OfLayer {
    HigherOrders orders;
    double scale;  ///< MeanHigherScale().
  };
  std::vector<OfLayer> higher;                 ///< One per layer.
  std::optional<ClearSkyShape> above_highest;  ///< Nothing without layers.
  double global_share = 1.0;                   ///< Share of the clear sky's global illuminance.
};

struct CloudSky::Dome {
  std::once_flag made;
  LinearRgb illuminance;
};

CloudSky::~CloudSky() = default;

CloudSky::CloudSky(std::shared_ptr<const sky::SkyModel> clear, CloudFields fields,
                   double ground_albedo, double seconds)
    : clear_(std::move(clear)),
      fields_(std::move(fields)),
      seconds_(seconds),
      dome_(std::make_unique<Dome>()) {
  std::stable_sort(fields_.begin(), fields_.end(), [](const auto& a, const auto& b) {
    return a->layer().base_m < b->layer().base_m;
  });
  const Direction<World> to_sun = clear_->ToSun();
  sun_transmittance_ = SunTransmittance(fields_, {}, to_sun, seconds);
  const std::vector<LayerShares> shares = SharesOf(fields_, to_sun, seconds);
  area_ = AreaLightOf(fields_, shares, *clear_, ground_albedo);
  const auto optics = std::make_shared<Optics>();
  optics->higher.reserve(fields_.size());
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    HigherOrders orders(fields_[i]->layer().kind, to_sun.xyz.z);
    const double down = (shares[i].Transmitted() - shares[i].direct) * to_sun.xyz.z;
    optics->higher.push_back({orders, MeanHigherScale(*fields_[i], orders, to_sun.xyz, down)});
  }
  if (!fields_.empty()) optics->above_highest.emplace(*clear_, TableOf(*fields_.back()));
  const double sun = Luminance(clear_->SunNormalIrradiance()) * std::max(0.0, to_sun.xyz.z);
  const double above = Luminance(clear_->SkyHorizontalIrradiance()) + sun;
  if (above > 0.0) {
    optics->global_share = Luminance(area_.sky_horizontal + area_.sun_horizontal) / above;
  }
  optics_ = optics;
}

CloudSky::CloudSky(const CloudSky& other, double seconds)
    : clear_(other.clear_),
      fields_(other.fields_),
      seconds_(seconds),
      sun_transmittance_(SunTransmittance(fields_, {}, clear_->ToSun(), seconds)),
      area_(other.area_),
      optics_(other.optics_),
      dome_(std::make_unique<Dome>()) {}

CloudSky::Seen CloudSky::Look(Direction<World> from) const {
  Seen seen;
  if (from.xyz.z < 0.0) return seen;
  // Layers continue to the horizon, where a plane would never be reached.
  constexpr double kMinRise = 0.01;
  const Vec3 view =
      from.xyz.z >= kMinRise ? from.xyz : Normalized({from.xyz.x, from.xyz.y, kMinRise});
  const Vec3 sun = ToSun().xyz;
  const LinearRgb sunlight = sun.z > 0.0 ? clear_->SunNormalIrradiance() : LinearRgb{};
  const bool lit = Luminance(sunlight) > 0.0;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const CloudField& field = *fields_[i];
    const LayerRay ray = MarchLayer(field, optics_->higher[i].orders, {}, view, sun, lit, seconds_);
    if (!ray.cloud_m) continue;
    const double scattered = ray.first + optics_->higher[i].scale * ray.higher;
    double above = 0.0;  // Optical depth of the higher layers towards the sun.
    for (std::size_t j = i + 1; lit && j < fields_.size(); ++j) {
      above += fields_[j]->DepthAlong(*ray.cloud_m, sun, seconds_);
    }
    const double shadow = std::exp(-above);
    const double through = std::exp(-ray.depth);
    const double reflected = TableOf(field).Reflected(ray.depth * view.z, view.z);
    const double shape =
        i + 1 == fields_.size() ? optics_->above_highest->Factor(ray.depth * view.z) : 1.0;
    const LinearRgb cloud =
        sunlight * (shadow * scattered) +
        area_.layers[i].sky_above * (shape * std::max(0.0, 1.0 - reflected - through) / pi) +
        area_.layers[i].ground_below * (reflected / pi);
    seen.clouds = seen.clouds + cloud * seen.clear_share;
    seen.clear_share *= through;
  }
  return seen;
}

LinearRgb CloudSky::SkyRadiance(Direction<World> from) const {
  const Seen seen = Look(from);
  return clear_->SkyRadiance(from) * seen.clear_share + seen.clouds;
}

sky::XyY CloudSky::At(Direction<World> from) const {
  const Seen seen = Look(from);
  return sky::XyYFromXyz(sky::XyzFromXyY(clear_->At(from)) * seen.clear_share +
                         sky::XyzFromRgb(seen.clouds));
}

LinearRgb CloudSky::SunNormalIrradiance() const {
  return clear_->SunNormalIrradiance() * sun_transmittance_;
}

// Two grids, with weights that add to 1: one of the dome, and a finer one around the sun. There the
// aureole of thin clouds is narrower than the dome's cells.
LinearRgb CloudSky::DomeIlluminance(int rings) const {
  const int sectors = 2 * rings, sun_rings = (5 * rings + 11) / 12, sun_sectors = rings / 2;
  const auto first_sun_ring = static_cast<std::size_t>(rings);
  constexpr double kInner = 3.0 * kRadiansPerDegree, kOuter = 10.0 * kRadiansPerDegree;
  const auto dome_weight = [](double from_sun) {
    const double x = std::clamp((from_sun - kInner) / (kOuter - kInner), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
  };
  const Vec3 sun = ToSun().xyz;
  const Vec3 across = sun.z < 0.999 ? Normalized(Cross(sun, {0.0, 0.0, 1.0})) : Vec3{1.0, 0.0, 0.0};
  const Vec3 upwards = Cross(across, sun);
  std::vector<LinearRgb> sums(static_cast<std::size_t>(rings + sun_rings));
  ParallelFor(sums.size(), 0, [&](std::size_t row) {
    const auto add = [&](Vec3 direction, double weight) {
      if (weight > 0.0) sums[row] = sums[row] + SkyRadiance({direction}) * weight;
    };
    if (row < first_sun_ring) {
      const double zenith = 0.5 * pi * (static_cast<double>(row) + 0.5) / rings;
      const double up = std::cos(zenith), level = std::sin(zenith);
      for (int sector = 0; sector < sectors; ++sector) {
        const double azimuth = 2.0 * pi * (sector + 0.5) / sectors;
        const Vec3 direction{level * std::sin(azimuth), level * std::cos(azimuth), up};
        add(direction, dome_weight(std::acos(std::clamp(Dot(direction, sun), -1.0, 1.0))) * up *
                           level * (0.5 * pi / rings) * (2.0 * pi / sectors));
      }
      return;
    }
    const double x = (static_cast<double>(row - first_sun_ring) + 0.5) / sun_rings;
    const double angle = kOuter * x * x;
    const double solid = std::sin(angle) * 2.0 * kOuter * x / sun_rings * 2.0 * pi / sun_sectors;
    for (int sector = 0; sector < sun_sectors; ++sector) {
      const double about = 2.0 * pi * (sector + 0.5) / sun_sectors;
      const Vec3 direction = sun * std::cos(angle) + across * (std::sin(angle) * std::cos(about)) +
                             upwards * (std::sin(angle) * std::sin(about));
      if (direction.z <= 0.0) continue;
      add(direction, (1.0 - dome_weight(angle)) * solid * direction.z);
    }
  });
  LinearRgb sum;
  for (const LinearRgb& part : sums) sum = sum + part;
  return sum;
}

LinearRgb CloudSky::SkyHorizontalIrradiance() const {
  constexpr int kRings = 96;
  std::call_once(dome_->made, [this] { dome_->illuminance = DomeIlluminance(kRings); });
  return dome_->illuminance;
}

sky::SkyModel::AirBetween CloudSky::AirTo(Direction<World> towards, Metres distance) const {
  AirBetween air = clear_->AirTo(towards, distance);
  air.inscattered = air.inscattered * optics_->global_share;
  return air;
}

std::vector<std::string> CloudSky::Notes() const {
  std::vector<std::string> notes = clear_->Notes();
  if (ToSun().xyz.z <= 0.0) {
    notes.emplace_back("the sun is below the horizon: no direct light reaches the clouds");
  }
  return notes;
}

}  // namespace pleinair::clouds
