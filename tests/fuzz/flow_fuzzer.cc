#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "content/flow/files/vtk_flow.h"
#include "content/flow/line_integrator.h"

// Any bytes give a field or an error, never a crash. So does following a line through it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pleinair::content;  // NOLINT(google-build-using-namespace)
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto flow = ParseVtkFlow(bytes, "flow.vti", {});
  if (!flow) {
    if (flow.error().what.empty()) std::abort();
    return 0;
  }
  const Box box = flow->field->bounds();
  const std::vector<Seed> seeds{{(box.min + box.max) * 0.5}};
  const auto lines =
      TraceLines(*flow->field, seeds, {.length_m = 3.0 * flow->field->cell_m(), .threads = 1});
  if (!lines && lines.error().what.empty()) std::abort();
  return 0;
}
