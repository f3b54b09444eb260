#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace pleinair {

/// What Give() does when the queue is full.
enum class WhenFull {
  kReplaceOldest,  ///< Live: drops the oldest item, because the newest frame counts.
  kWait,           ///< Replay: blocks, because no frame may be lost.
  kRefuse,         ///< Recording: drops the new item; the queued ones are worth as much.
};

/// A bounded first-in, first-out queue between two threads.
template <typename T>
class BoundedQueue {
 public:
  BoundedQueue(std::size_t capacity, WhenFull when_full)
      : capacity_(capacity), when_full_(when_full) {}

  /// Appends an item. Returns false if the queue is closed, or full under kRefuse. Blocks under
  /// kWait.
  bool Give(T item) {
    std::unique_lock lock(mutex_);
    if (when_full_ == WhenFull::kWait) {
      changed_.wait(lock, [this] { return items_.size() < capacity_ || closed_; });
    }
    if (closed_) return false;
    if (items_.size() >= capacity_) {
      ++dropped_;
      if (when_full_ == WhenFull::kRefuse) return false;
      items_.pop_front();
    }
    items_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }

  /// Blocks until there is an item. Returns nullopt once the queue is closed and empty.
  std::optional<T> Take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !items_.empty() || closed_; });
    return Pop();
  }

  /// As Take(), but also returns nullopt after `limit` without an item.
  std::optional<T> TakeWithin(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, limit, [this] { return !items_.empty() || closed_; });
    return Pop();
  }

  /// Refuses further items; queued items can still be taken.
  void Close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  /// True if the queue is closed and empty.
  bool finished() const {
    const std::lock_guard lock(mutex_);
    return closed_ && items_.empty();
  }

  /// Number of items dropped since the start.
  std::int64_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  std::optional<T> Pop() {
    if (items_.empty()) return std::nullopt;
    T item = std::move(items_.front());
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  const std::size_t capacity_;
  const WhenFull when_full_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> items_;
  bool closed_ = false;
  std::int64_t dropped_ = 0;
};

}  // namespace pleinair
