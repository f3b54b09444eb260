#include "app/bench/cloud_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "base/units.h"
#include "sky/clouds/cloud_field.h"
#include "sky/clouds/cloud_slab.h"
#include "sky/clouds/photon_paths.h"
#include "sky/clouds/tilted_columns.h"

namespace pleinair::app {
namespace {

constexpr std::array kCloudBenchDepths = {1.0, 8.0, 32.0};
constexpr std::array kCloudBenchElevations = {90.0, 30.0};
constexpr std::array kCloudBenchKinds = {
    clouds::CloudKind::kCumulus, clouds::CloudKind::kStratocumulus, clouds::CloudKind::kStratus,
    clouds::CloudKind::kAltocumulus, clouds::CloudKind::kCirrus};
constexpr std::uint64_t kCloudBenchSeed = 20120626;

Vec3 SouthernSunAt(double elevation_deg) {
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {std::cos(elevation), 0.0, std::sin(elevation)};
}

/// Runs the methods of one case and prints their rows.
class CloudCase {
 public:
  CloudCase(std::string name, const std::function<void(const CloudBenchRow&)>& print)
      : name_(std::move(name)), print_(print) {}

  void Add(const char* method, const std::function<clouds::PhotonFluxes()>& run) {
    const auto start = std::chrono::steady_clock::now();
    const clouds::PhotonFluxes found = run();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    if (!reference_) reference_ = found.transmitted;
    print_({name_, method, found.reflected, found.transmitted, found.direct, *reference_,
            *reference_ > 0.0 ? found.transmitted / *reference_ - 1.0 : 0.0, taken.count()});
  }

 private:
  std::string name_;
  const std::function<void(const CloudBenchRow&)>& print_;
  std::optional<double> reference_;  // By the first method.
};

clouds::PhotonFluxes FluxesOf(const clouds::LayerShares& shares) {
  return {shares.reflected, shares.Transmitted(), shares.direct, 0.0, 0.0};
}

void BenchSlab(double depth, double elevation_deg, int photons,
               const std::function<void(const CloudBenchRow&)>& print) {
  const Vec3 sun = SouthernSunAt(elevation_deg);
  clouds::CloudVolume slab;
  slab.extinction = [depth](Vec3) { return depth; };
  slab.most_extinction = depth;
  slab.top_m = 1.0;
  CloudCase scene(fmt::format("slab {:g} at {:g}", depth, elevation_deg), print);
  scene.Add("photons", [&] { return clouds::TracePhotons(slab, sun, photons, kCloudBenchSeed); });
  scene.Add("table", [&] {
    return FluxesOf({clouds::SlabTable::Water().Reflected(depth, sun.z),
                     clouds::Unscattered(depth, sun.z), 0.0});
  });
  scene.Add("delta-Eddington", [&] {
    return FluxesOf({clouds::DeltaEddingtonReflected(clouds::kWaterAsymmetry, depth, sun.z),
                     clouds::Unscattered(depth, sun.z), 0.0});
  });
}

void BenchStep(double elevation_deg, int photons,
               const std::function<void(const CloudBenchRow&)>& print) {
  using clouds::StepCloud;
  const Vec3 sun = SouthernSunAt(elevation_deg);
  constexpr int kColumns = 1000;
  const auto place = [](int i) { return (i + 0.5) * StepCloud::kPeriod_m / kColumns; };
  const auto column = [&](int i) { return StepCloud::Depth(place(i)); };
  CloudCase scene(fmt::format("step at {:g}", elevation_deg), print);
  scene.Add("photons", [&] {
    return clouds::TracePhotons(StepCloud::Volume(), sun, photons, kCloudBenchSeed);
  });
  scene.Add("columns", [&] {
    return FluxesOf(clouds::SharesOfTiltedColumns(
        clouds::SlabTable::Water(), sun.z, kColumns,
        [&](int i) { return StepCloud::DepthAlong(place(i), sun); }, column));
  });
  scene.Add("vertical columns", [&] {
    return FluxesOf(clouds::SharesOfTiltedColumns(
        clouds::SlabTable::Water(), sun.z, kColumns, [&](int i) { return column(i) / sun.z; },
        column));
  });
}

void BenchKind(clouds::CloudKind kind, double elevation_deg, int photons,
               const std::function<void(const CloudBenchRow&)>& print) {
  clouds::CloudLayerFacts facts;
  facts.kind = kind;
  const clouds::CloudLayer layer = *clouds::MakeCloudLayer(facts);
  const auto field = clouds::CloudField::Of(layer);
  const bool is_ice = kind == clouds::CloudKind::kCirrus;
  const Vec3 sun = SouthernSunAt(elevation_deg);
  clouds::CloudVolume volume;
  volume.extinction = [&](Vec3 at) { return field->Extinction(at, 0.0); };
  volume.most_extinction = field->MostExtinction();
  volume.bottom_m = layer.base_m;
  volume.top_m = layer.base_m + layer.thickness_m;
  volume.side_m = std::max(clouds::kCoverSquare_m, 3.0 * layer.cell_m);  // A period.
  volume.asymmetry = is_ice ? clouds::kIceAsymmetry : clouds::kWaterAsymmetry;
  const clouds::SlabTable& table = is_ice ? clouds::SlabTable::Ice() : clouds::SlabTable::Water();
  constexpr int kSide = 100;
  const auto place = [&](int i) {
    return Vec3{(i % kSide + 0.5) / kSide * volume.side_m,
                (std::floor(1.0 * i / kSide) + 0.5) / kSide * volume.side_m, 0.0};
  };
  CloudCase scene(fmt::format("{} at {:g}", clouds::NameOf(kind), elevation_deg), print);
  scene.Add("photons", [&] { return clouds::TracePhotons(volume, sun, photons, kCloudBenchSeed); });
  scene.Add("columns", [&] {
    return FluxesOf(clouds::SharesOfTiltedColumns(
        table, sun.z, kSide * kSide, [&](int i) { return field->DepthAlong(place(i), sun, 0.0); },
        [&](int i) { return field->ColumnDepth(place(i).x, place(i).y, 0.0); }));
  });
}

}  // namespace

void RunCloudBench(int photons, const std::function<void(const CloudBenchRow&)>& print) {
  for (const double depth : kCloudBenchDepths) {
    for (const double elevation : kCloudBenchElevations) {
      BenchSlab(depth, elevation, photons, print);
    }
  }
  for (const double elevation : kCloudBenchElevations) BenchStep(elevation, photons, print);
  for (const clouds::CloudKind kind : kCloudBenchKinds) {
    for (const double elevation : kCloudBenchElevations) BenchKind(kind, elevation, photons, print);
  }
}

int CountCloudBenchRows() {
  const auto suns = static_cast<int>(kCloudBenchElevations.size());
  const auto slabs = static_cast<int>(kCloudBenchDepths.size());
  const auto kinds = static_cast<int>(kCloudBenchKinds.size());
  return suns * (3 * slabs + 3 + 2 * kinds);
}

}  // namespace pleinair::app
