#pragma once

#include <functional>
#include <string>

namespace pleinair::app {

/// One layer under one sun, by one method.
struct CloudBenchRow {
  std::string scene, method;
  double reflected = 0.0;    ///< Share of the sun's light.
  double transmitted = 0.0;  ///< Scattered and direct together.
  double direct = 0.0;
  double reference = 0.0;       ///< `transmitted` by paths of photons.
  double relative_error = 0.0;  ///< Relative to `reference`.
  double ms = 0.0;
};

/// Reflected and transmitted sunlight of slabs, of the step cloud of the I3RC and of each kind of
/// layer. It compares the methods of skies with clouds::TracePhotons(). `photons`: for each
/// reference. `print` receives each row.
void RunCloudBench(int photons, const std::function<void(const CloudBenchRow&)>& print);

/// Number of the rows.
int CountCloudBenchRows();

}  // namespace pleinair::app
