#include "tests/vm/gige_film_camera.h"

#include <arv.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace pleinair::vm {

struct GigeFilmCamera::Player {
  std::vector<GreyImage> pictures;
  std::size_t next = 0;
  ArvGvFakeCamera* camera = nullptr;

  /// Called by the camera's thread for every image that it sends.
  static void Fill(ArvBuffer* buffer, void* data, guint32, guint32, ArvPixelFormat) {
    auto* player = static_cast<Player*>(data);
    const GreyImage& image = player->pictures[player->next++ % player->pictures.size()];
    // The buffer has no properties yet, not even the size of its data.
    const std::size_t payload =
        arv_fake_camera_get_payload(arv_gv_fake_camera_get_fake_camera(player->camera));
    auto* bytes =
        static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, nullptr)));
    std::copy_n(image.data(), std::min(payload, image.size()), bytes);
  }
};

GigeFilmCamera::GigeFilmCamera(std::unique_ptr<Player> player) : player_(std::move(player)) {}

GigeFilmCamera::~GigeFilmCamera() { g_object_unref(player_->camera); }

std::unique_ptr<GigeFilmCamera> GigeFilmCamera::Start(const char* address, const char* serial,
                                                      std::vector<GreyImage> pictures) {
  auto player = std::make_unique<Player>();
  player->pictures = std::move(pictures);
  if (player->pictures.empty()) return nullptr;
  player->camera = arv_gv_fake_camera_new(address, serial);
  if (player->camera == nullptr) return nullptr;
  if (!arv_gv_fake_camera_is_running(player->camera)) {
    g_object_unref(player->camera);
    return nullptr;
  }
  arv_fake_camera_set_fill_pattern(arv_gv_fake_camera_get_fake_camera(player->camera),
                                   &Player::Fill, player.get());
  return std::unique_ptr<GigeFilmCamera>(new GigeFilmCamera(std::move(player)));
}

}  // namespace pleinair::vm
