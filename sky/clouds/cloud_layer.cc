#include "sky/clouds/cloud_layer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace pleinair::clouds {
namespace {

struct KindDefaults {
  CloudKind kind;
  const char* name;
  double cover, optical_depth, base_m, thickness_m, cell_m;
};
constexpr std::array<KindDefaults, 6> kKinds = {{
    {CloudKind::kCumulus, "cumulus", 0.5, 20.0, 1200.0, 500.0, 800.0},
    {CloudKind::kStratocumulus, "stratocumulus", 0.5, 12.0, 900.0, 300.0, 1500.0},
    {CloudKind::kStratus, "stratus", 1.0, 8.0, 500.0, 300.0, 6000.0},
    {CloudKind::kAltocumulus, "altocumulus", 0.5, 4.0, 3500.0, 200.0, 400.0},
    {CloudKind::kCirrus, "cirrus", 0.5, 0.5, 8000.0, 500.0, 5000.0},
    // A slab has no cells.
    {CloudKind::kSlab, "slab", 1.0, 8.0, 1000.0, 300.0, 1000.0},
}};

const KindDefaults& DefaultsOf(CloudKind kind) {
  return *std::find_if(kKinds.begin(), kKinds.end(),
                       [kind](const KindDefaults& known) { return known.kind == kind; });
}

std::string Shown(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

/// A piece of the user's text, short enough for a message of one line.
std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text.substr(0, 60)) quoted += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return quoted + "\"";
}

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A decimal number that fills all of `text`.
template <typename Number>
std::optional<Number> ParseWhole(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<void> SetFact(std::string_view key, std::string_view value, CloudLayerFacts* facts) {
  const auto repeated = [key] {
    return InputError({}, std::string(key) + " is given twice", "keep one of them");
  };
  const auto no_number = [key, value](const char* remedy) {
    return InputError({}, std::string(key) + " " + Quoted(value) + " is not a number", remedy);
  };
  if (key == "kind") {
    if (facts->kind) return repeated();
    PLEINAIR_ASSIGN_OR_RETURN(facts->kind, ParseCloudKind(value));
    return {};
  }
  if (key == "seed") {
    if (facts->seed) return repeated();
    facts->seed = ParseWhole<std::int64_t>(value);
    if (!facts->seed) return no_number("give a whole number of at most 18 digits");
    return {};
  }
  for (const CloudNumber& number : kCloudNumbers) {
    if (key != number.key) continue;
    std::optional<double>& fact = facts->*number.fact;
    if (fact) return repeated();
    fact = ParseWhole<double>(value);
    if (!fact) return no_number("write it like 0.5");
    return CheckCloudNumber(number, *fact);
  }
  return InputError({}, "a cloud layer has no key " + Quoted(key),
                    std::string("known are ") + kCloudKeys);
}

}  // namespace

double CloudyDepth(const CloudLayer& layer) { return std::min(0.3, 0.5 * layer.optical_depth); }

const char* NameOf(CloudKind kind) { return DefaultsOf(kind).name; }

Result<CloudKind> ParseCloudKind(std::string_view name) {
  std::string known;
  for (const KindDefaults& kind : kKinds) {
    if (name == kind.name) return kind.kind;
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
  }
  return InputError({}, "there is no kind of cloud " + Quoted(name), "choose among " + known);
}

Result<void> CheckCloudNumber(const CloudNumber& number, double value) {
  if (value >= number.lowest && value <= number.highest) return {};
  return InputError({}, std::string(number.key) + " " + Shown(value) + " is impossible",
                    "give a number from " + Shown(number.lowest) + " to " + Shown(number.highest) +
                        " (" + number.unit + ")");
}

Result<void> CheckPassing(const CloudPassing& passing) {
  const std::size_t count = passing.seconds.size();
  if (passing.shifts.size() != count || count == 1 || count > kMaxPassingTimes) {
    return InputError(
        {},
        "passing clouds have " + std::to_string(count) + " seconds and " +
            std::to_string(passing.shifts.size()) + " shifts",
        "give one shift for each of 2 to " + std::to_string(kMaxPassingTimes) + " times");
  }
  const auto outside = [](double value, double most) { return !(std::fabs(value) <= most); };
  constexpr double kMost_m = 1e6, kMost_s = 1e6;
  if (outside(passing.east_m, kMost_m) || outside(passing.north_m, kMost_m)) {
    return InputError({}, "the place of passing clouds is impossible",
                      "give east_m and north_m within " + Shown(kMost_m) + " m");
  }
  if (!(passing.width_m >= 10.0 && passing.width_m <= 10'000.0)) {
    return InputError({}, "width_m " + Shown(passing.width_m) + " of passing clouds is impossible",
                      "give a number from 10 to 10000 (metres)");
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (outside(passing.seconds[i], kMost_s) ||
        (i > 0 && passing.seconds[i] <= passing.seconds[i - 1])) {
      return InputError({}, "seconds of passing clouds do not rise at " + Shown(passing.seconds[i]),
                        "order them, within " + Shown(kMost_s));
    }
    if (outside(passing.shifts[i], kMaxPassingShift)) {
      return InputError({},
                        "shift " + Shown(passing.shifts[i]) + " of passing clouds is impossible",
                        "give a number within " + Shown(kMaxPassingShift));
    }
  }
  return {};
}

Result<CloudLayer> MakeCloudLayer(const CloudLayerFacts& facts) {
  if (!facts.kind) {
    return InputError({}, "a cloud layer has no kind", "give for example kind=cumulus");
  }
  for (const CloudNumber& number : kCloudNumbers) {
    const std::optional<double>& fact = facts.*number.fact;
    if (fact) PLEINAIR_RETURN_IF_ERROR(CheckCloudNumber(number, *fact));
  }
  const KindDefaults& defaults = DefaultsOf(*facts.kind);
  CloudLayer layer;
  layer.kind = *facts.kind;
  layer.cover = facts.cover.value_or(defaults.cover);
  layer.optical_depth = facts.optical_depth.value_or(defaults.optical_depth);
  layer.base_m = facts.base_m.value_or(defaults.base_m);
  layer.thickness_m = facts.thickness_m.value_or(defaults.thickness_m);
  layer.cell_m = facts.cell_m.value_or(defaults.cell_m);
  layer.wind_m_s = facts.wind_m_s.value_or(0.0);
  layer.wind_from_deg = facts.wind_from_deg.value_or(0.0);
  layer.seed = facts.seed.value_or(1);
  layer.east_m = facts.east_m.value_or(0.0);
  layer.north_m = facts.north_m.value_or(0.0);
  layer.passing = facts.passing;
  PLEINAIR_RETURN_IF_ERROR(CheckPassing(layer.passing));
  if (!layer.passing.seconds.empty() && layer.wind_m_s <= 0.0) {
    return InputError({}, "clouds cannot pass without wind", "give wind_m_s");
  }
  if (!layer.passing.seconds.empty() &&
      (layer.passing.seconds.back() - layer.passing.seconds.front()) * layer.wind_m_s >
          kMaxPassing_m) {
    return InputError({}, "passing clouds travel farther than " + Shown(kMaxPassing_m) + " m",
                      "give fewer seconds, or a smaller wind_m_s");
  }
  if (layer.kind == CloudKind::kSlab && layer.cover < 1.0) {
    return InputError({}, "cover " + Shown(layer.cover) + " is impossible for a slab",
                      "leave cover out, or choose another kind");
  }
  return layer;
}

Result<CloudLayer> ParseCloudLayer(std::string_view text) {
  CloudLayerFacts facts;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view item = Trim(text.substr(0, comma));
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) {
      return InputError({}, Quoted(item) + " is not key=value",
                        "write for example kind=cumulus,cover=0.4");
    }
    PLEINAIR_RETURN_IF_ERROR(
        SetFact(Trim(item.substr(0, equals)), Trim(item.substr(equals + 1)), &facts));
    if (comma == text.size()) return MakeCloudLayer(facts);
    text.remove_prefix(comma + 1);
  }
}

}  // namespace pleinair::clouds
