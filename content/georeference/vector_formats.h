#pragma once

// Internal: the drivers of GDAL for vectors.

namespace pleinair::content {

/// Registers those formats alone that are tested: others could follow links to files and hosts.
void RegisterVectorFormats();

}  // namespace pleinair::content
