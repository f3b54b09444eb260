#pragma once

// Internal: owners of GDAL's objects, shared by the .cc files of this folder.

#include <cpl_error.h>
#include <gdal.h>

#include <algorithm>
#include <memory>
#include <string>

namespace pleinair::content {

struct DatasetDeleter {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, DatasetDeleter>;

/// GDAL's messages become ours; nothing goes to standard error.
class QuietErrors {
 public:
  QuietErrors() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietErrors() { CPLPopErrorHandler(); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

  /// The last message on one line, or `otherwise`.
  static std::string Last(const std::string& otherwise) {
    std::string message = CPLGetLastErrorMsg();
    std::replace(message.begin(), message.end(), '\n', ' ');
    while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
    return message.empty() ? otherwise : message.substr(0, 300);
  }
};

}  // namespace pleinair::content
