#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "base/error.h"

namespace pleinair::app {

/// Shows how a pass over a recording goes on (session::PassMonitor) as a progress bar, and stops
/// the pass on Ctrl-C.
class PassBar {
 public:
  /// `work`: what is worked on, for the error of a pass that was stopped.
  PassBar(std::string label, std::string work) : label_(std::move(label)), work_(std::move(work)) {}

  /// Refers to this bar.
  std::function<Result<void>(std::int64_t, std::optional<std::int64_t>)> Progress() {
    return [this](std::int64_t done, std::optional<std::int64_t> of) {
      if (!bar_) bar_.emplace(label_, of);
      for (; shown_ < done; ++shown_) bar_->Advance();
      return CheckInterrupt(work_);
    };
  }

 private:
  std::string label_;
  std::string work_;
  std::optional<ProgressBar> bar_;
  std::int64_t shown_ = 0;
};

}  // namespace pleinair::app
