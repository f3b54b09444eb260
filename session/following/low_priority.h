#pragma once

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace pleinair::session {

/// Gives the calling thread, and the threads that it starts, a lower priority than that of all on
/// which a frame waits. Linux counts niceness per thread. A refusal only costs time.
inline void LowerPriority() {
  constexpr int kNice = 10;
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice));
}

}  // namespace pleinair::session
