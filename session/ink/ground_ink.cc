#include "session/ink/ground_ink.h"

#include <utility>

#include "scene/marker_heading.h"

namespace pleinair::session {

void GroundInk::SetSource(InkSource source) {
  source_ = std::move(source);
  laid_at_.reset();
}

Result<void> GroundInk::Update(std::span<const compositor::PlacedModel> phantoms,
                               const scene::MarkerDescription& marker,
                               compositor::Composer* composer) {
  const Mat3 marker_from_world = scene::MarkerFromWorld(marker);
  if (!source_ || laid_at_ == marker_from_world) return {};
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<compositor::InkShape> ink, source_(phantoms, marker));
  PLEINAIR_RETURN_IF_ERROR(composer->SetInk(ink, marker_from_world));
  laid_at_ = marker_from_world;
  return {};
}

}  // namespace pleinair::session
