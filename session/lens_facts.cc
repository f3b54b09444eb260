#include "session/lens_facts.h"

namespace pleinair::session {

LensFactMode LensFactModeOf(std::string_view name) {
  if (name == "off") return LensFactMode::kOff;
  if (name == "stated") return LensFactMode::kStated;
  return name == "measured" ? LensFactMode::kMeasured : LensFactMode::kAuto;
}

const char* NameOf(LensFactSource source) {
  switch (source) {
    case LensFactSource::kOff:
      return "off";
    case LensFactSource::kStated:
      return "stated";
    case LensFactSource::kMetadata:
      return "metadata";
    case LensFactSource::kMeasured:
      break;
  }
  return "measured";
}

}  // namespace pleinair::session
