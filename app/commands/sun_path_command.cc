#include "app/commands/sun_path_command.h"

#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "app/sun/sun_path_diagram.h"
#include "base/atomic_file.h"
#include "export/images/image_writer.h"

namespace pleinair::app {

Result<void> WriteSunPath(const sky::Observer& observer, const SunPathOptions& options) {
  const std::filesystem::path file = options.file;
  const bool svg = file.extension() == ".svg";
  if (!svg && file.extension() != ".png") {
    return InputError(options.file, "is neither SVG nor PNG",
                      "name a file that ends in .svg or .png");
  }
  const exports::VectorDrawing drawing =
      DrawSunPath({observer, options.year, options.offset, options.model, options.moment});
  if (svg) {
    PLEINAIR_RETURN_IF_ERROR(
        WriteFileAtomically(file, exports::DrawingSvg(drawing, options.size_px)));
  } else {
    const std::filesystem::path temporary = TemporarySibling(file);
    const Result<void> written =
        exports::WritePng(temporary, exports::RasterizeDrawing(drawing, options.size_px).view());
    if (!written) {
      Error error = written.error();
      error.where = options.file;
      return tl::make_unexpected(error);
    }
    PLEINAIR_RETURN_IF_ERROR(CommitFile(temporary, file));
  }
  if (options.json) {
    const nlohmann::json object = {{"file", options.file},
                                   {"lat", ToDegrees(observer.latitude)},
                                   {"lon", ToDegrees(observer.longitude)},
                                   {"year", options.year},
                                   {"utc_offset", ToString(options.offset)},
                                   {"projection", "stereographic"}};
    std::cout << object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  }
  return {};
}

}  // namespace pleinair::app
