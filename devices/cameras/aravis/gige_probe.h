#pragma once

// Internal: between the .cc files of this module; not installed.

#include <netinet/in.h>

#include <cstdint>

namespace pleinair::devices {

/// Asks a GigE Vision camera for one register (GigE Vision 2.0, §16.2.1, READREG of the control
/// channel privilege, which anybody may read), to know whether anybody is there. Aravis' own
/// heartbeat takes 15 s to say that nobody is.
class GigeProbe {
 public:
  explicit GigeProbe(const sockaddr_in& camera);
  ~GigeProbe();
  GigeProbe(const GigeProbe&) = delete;
  GigeProbe& operator=(const GigeProbe&) = delete;

  /// Whether its machine or the network says that there is no camera. Silence says nothing: a
  /// camera may be busy. Does not wait: what came since the last question counts.
  bool IsRefused();

 private:
  int socket_;
  std::uint16_t number_ = 0;
};

}  // namespace pleinair::devices
