#include "app/terminal/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <utility>

namespace pleinair::app {
namespace {
constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};

std::atomic<int> alive{0};
}  // namespace

ProgressBar::ProgressBar(std::string label, std::optional<std::int64_t> total, std::string unit)
    : label_(std::move(label)),
      total_(total),
      unit_(std::move(unit)),
      is_drawn_(alive++ == 0 && isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_drawn_(start_) {
  if (is_drawn_) Draw(0.0);
}

ProgressBar::~ProgressBar() {
  --alive;
  if (is_drawn_) std::cerr << "\r\033[K" << std::flush;
}

void ProgressBar::Advance() {
  ++done_;
  if (!is_drawn_) return;
  const auto now = Clock::now();
  // Items completed faster than the redraw interval appear at its end.
  if (done_ != total_ && now - last_drawn_ < kRedraw) return;
  last_drawn_ = now;
  Draw(std::chrono::duration<double>(now - start_).count());
}

void ProgressBar::Draw(double elapsed_s) const {
  std::cerr << "\r\033[K" << Line(label_, done_, total_, elapsed_s, unit_) << std::flush;
}

std::string ProgressBar::Line(const std::string& label, std::int64_t done,
                              std::optional<std::int64_t> total, double elapsed_s,
                              const std::string& unit) {
  // A unit in the plural, such as "frames".
  const auto counted = [&](std::int64_t count) {
    return std::to_string(count) + " " + (count == 1 ? unit.substr(0, unit.size() - 1) : unit);
  };
  if (!total || *total <= 0) return done == 0 ? label : label + " " + counted(done);
  const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(*total));
  const int filled = static_cast<int>(share * kBarWidth);
  std::string line = label + " [" + std::string(filled, '#') +
                     std::string(kBarWidth - filled, '.') + "] " +
                     std::to_string(static_cast<int>(share * 100)) + " % of " + counted(*total);
  if (share > 0.0 && share < 1.0) {
    line += ", " + std::to_string(std::lround(elapsed_s / share * (1.0 - share))) + " s to go";
  }
  return line;
}

}  // namespace pleinair::app
