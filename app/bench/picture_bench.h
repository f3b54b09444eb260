#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// What a benchmark that compares methods in made scenes draws, and how often.
struct PictureBench {
  std::vector<std::string> scenes;   ///< Names; empty: all.
  std::vector<std::string> methods;  ///< Names; empty: the benchmark's own.
  int width = 320, height = 240;
  int rounds = 5;  ///< All methods are timed in turn; the median counts.
};

/// The options that such benchmarks have in common, as given.
struct PictureBenchArguments {
  PictureBench bench;
  std::string size;
  bool quick = false, json = false;
};

/// Adds --scenes, --size, --rounds, --quick and --json. `quick_text`: what --quick does.
void AddPictureBenchOptions(CLI::App& command, std::span<const std::string_view> scenes,
                            const std::string& quick_text, PictureBenchArguments* arguments);

/// Applies --size and --quick (96×72 pixels, one round), and drops repeated names. Error (input):
/// --size is no size.
Result<void> SettlePictureBench(PictureBenchArguments* arguments);

/// Number of steps of such a benchmark's progress bar: each scene's truth and each row.
std::int64_t CountBenchSteps(const PictureBench& bench, std::size_t all_scenes,
                             std::size_t all_methods);

/// Prints the rows of a table on standard output, the head before the first one.
class BenchTable {
 public:
  /// An empty head: none is printed, as for rows of JSON.
  explicit BenchTable(std::string head) : head_(std::move(head)) {}
  void Print(const std::string& row);

 private:
  std::string head_;
};

}  // namespace pleinair::app
