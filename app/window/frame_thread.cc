#include "app/window/frame_thread.h"

#include <chrono>
#include <utility>

namespace pleinair::app {

FrameThread::FrameThread(LiveSession& session) : session_(session), thread_([this] { Run(); }) {}

FrameThread::~FrameThread() { Stop(); }

void FrameThread::Stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void FrameThread::Run() {
  while (!stop_ && !session_.finished()) {
    auto drawn = session_.Draw(std::chrono::milliseconds(50));
    if (!drawn) {
      const std::lock_guard lock(mutex_);
      error_ = std::move(drawn).error();
      break;
    }
    if (*drawn) frames_.Give(*std::move(*drawn));
  }
  // Another thread may end the session and its context.
  session_.LetGo();
  ended_ = true;
}

std::optional<DrawnFrame> FrameThread::Take() {
  return frames_.TakeWithin(std::chrono::milliseconds(0));
}

std::optional<Error> FrameThread::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

}  // namespace pleinair::app
