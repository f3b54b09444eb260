#include "devices/films/libav_input.h"

#include <string>

namespace pleinair::devices {
namespace {

// Containers of cameras, phones and editors. Playlists and lists of files are not among them: they
// make libavformat open other files.
constexpr const char* kContainers =
    "mov,matroska,avi,mpegts,mpeg,mpegvideo,asf,flv,ogg,mxf,dv,nut,ivf,yuv4mpegpipe";

}  // namespace

LibavPointer<AVFormatContext> OpenLibavInput(const std::filesystem::path& film) {
  av_log_set_level(AV_LOG_QUIET);  // Our errors contain what the user needs.
  AVDictionary* settings = nullptr;
  av_dict_set(&settings, "protocol_whitelist", "file", 0);
  av_dict_set(&settings, "format_whitelist", kContainers, 0);
  AVFormatContext* opened = nullptr;
  // With its scheme an absolute path cannot be mistaken for another protocol.
  const std::string url = "file:" + std::filesystem::absolute(film).string();
  const int code = avformat_open_input(&opened, url.c_str(), nullptr, &settings);
  av_dict_free(&settings);
  return LibavPointer<AVFormatContext>(code < 0 ? nullptr : opened);
}

}  // namespace pleinair::devices
