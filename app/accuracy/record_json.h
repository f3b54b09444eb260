#pragma once

#include <string>
#include <string_view>

#include "accuracy/frame_record.h"
#include "accuracy/image_record.h"
#include "base/error.h"

namespace pleinair::app {

/// A frame's record as one line of JSON (docs/guide/reference/accuracy-files.md, records.jsonl).
/// Numbers have the fewest digits that parse back to the same value. `with_times`: include the
/// durations of its stages.
std::string RecordJson(const accuracy::FrameRecord& record, bool with_times);

/// Errors (input): not a line of RecordJson. `where` gives file and line.
Result<accuracy::FrameRecord> ParseRecord(std::string_view line, const std::string& where);

/// A composited image's record as one line (pictures.jsonl).
std::string PictureJson(const accuracy::ImageRecord& record);

/// Errors (input): not a line of PictureJson.
Result<accuracy::ImageRecord> ParsePicture(std::string_view line, const std::string& where);

}  // namespace pleinair::app
