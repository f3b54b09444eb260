#include <cstddef>

#include "compositor/models/model.h"

namespace pleinair::compositor {

VertexDetail Middle(const VertexDetail& a, const VertexDetail& b) {
  VertexDetail middle;
  for (std::size_t i = 0; i < middle.uv.size(); ++i) middle.uv[i] = 0.5F * (a.uv[i] + b.uv[i]);
  for (std::size_t i = 0; i < middle.color.size(); ++i) {
    middle.color[i] = 0.5F * (a.color[i] + b.color[i]);
  }
  return middle;
}

}  // namespace pleinair::compositor
