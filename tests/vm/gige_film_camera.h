#pragma once

#include <memory>
#include <vector>

#include "base/image.h"

namespace pleinair::vm {

/// A GigE Vision camera in this process that plays grey images of one size in a loop. It replaces
/// the pattern of Aravis' test camera (ArvGvFakeCamera).
class GigeFilmCamera {
 public:
  /// `address`: of an interface in the network namespace, one camera per address. Null if Aravis
  /// cannot open it.
  static std::unique_ptr<GigeFilmCamera> Start(const char* address, const char* serial,
                                               std::vector<GreyImage> pictures);
  ~GigeFilmCamera();
  GigeFilmCamera(const GigeFilmCamera&) = delete;
  GigeFilmCamera& operator=(const GigeFilmCamera&) = delete;

 private:
  struct Player;
  explicit GigeFilmCamera(std::unique_ptr<Player> player);

  std::unique_ptr<Player> player_;
};

}  // namespace pleinair::vm
