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

/// Shows the progress of a pass over a recording (session::PassMonitor), and stops the pass on
/// Ctrl-C.
class PassBar {
 public:
  /// `work`: name of the work, for the error of a stopped pass.
  PassBar(std::string label, std::string work) : label_(std::move(label)), work_(std::move(work)) {}

  /// The result refers to this bar.
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
