#pragma once

#include <cstdint>

#include "devices/frame_source.h"

namespace pleinair::devices {

/// Frame counts since the start.
struct CameraCounts {
  std::int64_t delivered = 0;
  FrameLoss loss;
  int connections = 0;
  int stalls = 0;
};

/// Network statistics of a GigE camera; zero for others.
struct TransportCounts {
  std::int64_t completed = 0;
  std::int64_t damaged = 0;    ///< Frames with packets that never arrived.
  std::int64_t underruns = 0;  ///< Frames for which no buffer was free.
  std::int64_t resent_packets = 0;
  std::int64_t missing_packets = 0;
  int packet_size = 0;
};

}  // namespace pleinair::devices
