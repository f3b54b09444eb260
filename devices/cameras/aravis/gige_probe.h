#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <netinet/in.h>

#include <cstdint>

namespace pleinair::devices {

/// Checks whether a GigE Vision camera is still reachable, by reading one register (GigE Vision
/// 2.0, §16.2.1, READREG, which needs no control privilege). Aravis' own heartbeat takes 15 s to
/// detect that the camera is gone.
class GigeProbe {
 public:
  explicit GigeProbe(const sockaddr_in& camera);
  ~GigeProbe();
  GigeProbe(const GigeProbe&) = delete;
  GigeProbe& operator=(const GigeProbe&) = delete;

  /// True if the camera's host or the network has reported that there is no camera. No answer is
  /// inconclusive: a camera may be busy. Does not block: it evaluates the reports received since
  /// the last call.
  bool IsRefused();

 private:
  int socket_;
  std::uint16_t number_ = 0;
};

}  // namespace pleinair::devices
