#pragma once

#include <string>
#include <string_view>

#include "accuracy/frame_record.h"
#include "accuracy/image_record.h"
#include "base/error.h"

namespace pleinair::app {

/// A frame's record as one line of JSON (docs/guide/reference/accuracy-files.md, records.jsonl).
/// Numbers are the shortest that read back the same. `with_times`: what its stages took.
std::string RecordJson(const accuracy::FrameRecord& record, bool with_times);

/// Errors (input): not what RecordJson writes; `where` names file and line.
Result<accuracy::FrameRecord> ParseRecord(std::string_view line, const std::string& where);

/// A composed picture's record as one line (pictures.jsonl).
std::string PictureJson(const accuracy::ImageRecord& record);

/// Errors (input): not what PictureJson writes.
Result<accuracy::ImageRecord> ParsePicture(std::string_view line, const std::string& where);

}  // namespace pleinair::app
