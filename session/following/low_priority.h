#pragma once

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace pleinair::session {

/// Sets the calling thread, and the threads that it starts later, to nice 10 (Linux: niceness per
/// thread). Threads on which a frame waits thus run first. Failure is ignored.
inline void LowerPriority() {
  constexpr int kNice = 10;
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice));
}

}  // namespace pleinair::session
