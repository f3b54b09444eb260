#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::clouds {

enum class CloudKind { kCumulus, kStratocumulus, kStratus, kAltocumulus, kCirrus, kSlab };

/// Most layers of one sky.
inline constexpr int kMaxCloudLayers = 4;

/// Clouds and gaps that pass a place at known times. In a strip along the wind, the noise of the
/// field is raised (clouds) or lowered (gaps) by `shifts`. The strip passes the place (east_m,
/// north_m) at `seconds`; in between, shifts are linear. They fade out over width_m to both sides
/// and beyond both ends. Empty lists: the field as it is.
struct CloudPassing {
  double east_m = 0.0, north_m = 0.0;  ///< From the place of the layer's description.
  double width_m = 800.0;              ///< From the middle of the strip to its border.
  std::vector<double> seconds;         ///< Rising.
  std::vector<double> shifts;          ///< One each, in standard deviations of the noise.
  bool operator==(const CloudPassing&) const = default;
};
inline constexpr std::size_t kMaxPassingTimes = 4096;
inline constexpr double kMaxPassingShift = 20.0;
inline constexpr double kMaxPassing_m = 40'000.0;  ///< Wind times the span of the seconds.

/// Errors (input, without a place): lists of different lengths, too long, times that do not rise,
/// shifts, places or a width out of range, a single time.
Result<void> CheckPassing(const CloudPassing& passing);

/// A layer of clouds over a place, as the user describes it.
struct CloudLayer {
  CloudKind kind = CloudKind::kCumulus;
  /// Share of level ground below cloud, 0…1, within a square of kCoverSquare_m around the place at
  /// 0 s. A column is cloudy where its vertical optical depth exceeds CloudyDepth().
  double cover = 0.5;
  double optical_depth = 20.0;  ///< Vertical, mean over the cloudy columns.
  double base_m = 1200.0;       ///< Above the place.
  double thickness_m = 500.0;
  double cell_m = 800.0;               ///< Width of a cell: a cloud and its gap.
  double wind_m_s = 0.0;               ///< Speed of the layer.
  double wind_from_deg = 0.0;          ///< Azimuth that the wind comes from, from true north.
  std::int64_t seed = 1;               ///< Another seed gives another field.
  double east_m = 0.0, north_m = 0.0;  ///< Displacement of the field at 0 s.
  CloudPassing passing = {};           ///< Needs wind.
  bool operator==(const CloudLayer&) const = default;
};

inline constexpr double kCoverSquare_m = 20'000.0;

/// Vertical optical depth above which a column counts as cloudy: 0.3, or half of the mean in layers
/// that are thinner than twice that.
double CloudyDepth(const CloudLayer& layer);

/// What a user stated of a layer.
struct CloudLayerFacts {
  std::optional<CloudKind> kind;
  std::optional<double> cover, optical_depth, base_m, thickness_m, cell_m, wind_m_s, wind_from_deg;
  std::optional<std::int64_t> seed;
  std::optional<double> east_m, north_m;
  CloudPassing passing = {};
};

/// A number of the description: its key, range and unit.
struct CloudNumber {
  const char* key;
  double lowest, highest;
  const char* unit;
  std::optional<double> CloudLayerFacts::*fact;
};
inline constexpr std::array<CloudNumber, 9> kCloudNumbers = {{
    {"cover", 0.0, 1.0, "share of level ground", &CloudLayerFacts::cover},
    {"optical_depth", 0.0, 200.0, "vertical", &CloudLayerFacts::optical_depth},
    {"base_m", 50.0, 20'000.0, "metres", &CloudLayerFacts::base_m},
    {"thickness_m", 10.0, 10'000.0, "metres", &CloudLayerFacts::thickness_m},
    {"cell_m", 50.0, 50'000.0, "metres", &CloudLayerFacts::cell_m},
    {"wind_m_s", 0.0, 100.0, "metres a second", &CloudLayerFacts::wind_m_s},
    {"wind_from_deg", -360.0, 360.0, "degrees from true north", &CloudLayerFacts::wind_from_deg},
    {"east_m", -1e6, 1e6, "metres", &CloudLayerFacts::east_m},
    {"north_m", -1e6, 1e6, "metres", &CloudLayerFacts::north_m},
}};

/// All keys of the description, for messages.
inline constexpr const char* kCloudKeys =
    "kind, cover, optical_depth, base_m, thickness_m, cell_m, wind_m_s, wind_from_deg, seed, "
    "east_m, north_m";

const char* NameOf(CloudKind kind);
/// Errors (input, without a place): an unknown kind.
Result<CloudKind> ParseCloudKind(std::string_view name);

/// Errors (input, without a place): the number is outside its range or not finite.
Result<void> CheckCloudNumber(const CloudNumber& number, double value);

/// The layer with the defaults of its kind. Errors (input, without a place): no kind, a number
/// outside its range, a slab that does not cover everything, CheckPassing(), passing clouds without
/// wind or over more than kMaxPassing_m.
Result<CloudLayer> MakeCloudLayer(const CloudLayerFacts& facts);

/// Parses "kind=slab,optical_depth=8,base_m=1000". Errors (input, without a place): no `key=value`,
/// an unknown or repeated key, a value that is no number; as MakeCloudLayer().
Result<CloudLayer> ParseCloudLayer(std::string_view text);

}  // namespace pleinair::clouds
