#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace pleinair::app {

/// A bar on standard error, drawn only on a terminal: empty at first, then at most ten times a
/// second, and when all is done; its line is wiped when it goes. Of several that live at once only
/// the first is drawn.
class ProgressBar {
 public:
  /// `unit`: what is counted, in the plural.
  ProgressBar(std::string label, std::optional<std::int64_t> total, std::string unit = "frames");
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void Advance();

  /// The line as it is drawn: for a total, a bar with the share done and the seconds still to go.
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
