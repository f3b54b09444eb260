#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace pleinair::app {

/// A progress bar on standard error, only on a terminal. It is drawn at the start, then at most ten
/// times a second, and at the end. The destructor clears its line. If several exist at once, only
/// the first is drawn.
class ProgressBar {
 public:
  /// `unit`: the counted items, in the plural.
  ProgressBar(std::string label, std::optional<std::int64_t> total, std::string unit = "frames");
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void Advance();

  /// The line as drawn. With a total: a bar with the share done and the remaining seconds.
  static std::string Line(const std::string& label, std::int64_t done,
                          std::optional<std::int64_t> total, double elapsed_s,
                          const std::string& unit = "frames");

 private:
  void Draw(double elapsed_s) const;

  using Clock = std::chrono::steady_clock;
  std::string label_;
  std::optional<std::int64_t> total_;
  std::string unit_;
  std::int64_t done_ = 0;
  bool is_drawn_;
  Clock::time_point start_;
  Clock::time_point last_drawn_;
};

}  // namespace pleinair::app
