#include "compositor/light/daylight/coefficient_worker.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace pleinair::compositor {
namespace {

// Max. consecutive computations that newer requests may abort.
constexpr int kMaxGivenUp = 2;

}  // namespace

class CoefficientWorker::Work {
 public:
  Work() : thread_([this] { Run(); }) {}

  ~Work() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
      stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  struct Wish {
    std::shared_ptr<const LightSolver> solver;
    Vec3 up;
    CoefficientOptions options;
    CoefficientProgress progress;
  };

  void Want(Wish wish) {
    {
      const std::lock_guard lock(mutex_);
      wish_ = std::move(wish);
      share_ = 0.0;
      if (given_up_ < kMaxGivenUp) stop_ = true;
    }
    changed_.notify_all();
  }

  std::shared_ptr<const SolvedCoefficients> Newest() const {
    const std::lock_guard lock(mutex_);
    return newest_;
  }

  double progress() const {
    const std::lock_guard lock(mutex_);
    return share_;
  }

 private:
  void Run() {
    while (true) {
      Wish wish;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ending_ || wish_; });
        if (ending_) return;
        wish = *std::exchange(wish_, std::nullopt);
        stop_ = false;
      }
      wish.options.stop = &stop_;
      auto made = std::make_shared<const DaylightCoefficients>(
          wish.solver->Coefficients(wish.up, wish.options, [&](double share) {
            if (wish.progress) wish.progress(share);
            const std::lock_guard lock(mutex_);
            if (!wish_) share_ = share;
          }));
      const std::lock_guard lock(mutex_);
      // After a stop, the result may be incomplete.
      given_up_ = stop_ ? given_up_ + 1 : 0;
      if (stop_) continue;
      newest_ = std::make_shared<const SolvedCoefficients>(
          SolvedCoefficients{std::move(wish.solver), std::move(made)});
      if (!wish_) share_ = 1.0;
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool ending_ = false;
  std::optional<Wish> wish_;  // Not started yet.
  int given_up_ = 0;          // Consecutive aborted computations.
  double share_ = 1.0;
  std::shared_ptr<const SolvedCoefficients> newest_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;  // Last, because it uses the other members.
};

CoefficientWorker::CoefficientWorker() : work_(std::make_unique<Work>()) {}
CoefficientWorker::~CoefficientWorker() = default;

void CoefficientWorker::Want(std::shared_ptr<const LightSolver> solver, Vec3 up,
                             const CoefficientOptions& options, CoefficientProgress progress) {
  work_->Want({std::move(solver), up, options, std::move(progress)});
}

std::shared_ptr<const SolvedCoefficients> CoefficientWorker::Newest() const {
  return work_->Newest();
}

double CoefficientWorker::progress() const { return work_->progress(); }

}  // namespace pleinair::compositor
