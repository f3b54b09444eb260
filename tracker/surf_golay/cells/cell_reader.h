#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <Eigen/Core>

#include <array>
#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/golay/soft_golay_decoder.h"
#include "tracker/marker_pattern.h"
#include "tracker/surf_golay/cells/cell_light.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// Estimates for the code cells of a marker.
struct CellReading {
  std::array<float, sg::kCodeCells> white{};      ///< Share of white: 0 black, 1 white.
  std::array<float, sg::kCodeCells> deviation{};  ///< … and its standard deviation.
  std::array<float, sg::kCodeCells> misfit{};     ///< Residual inside a cell beyond noise.
  std::array<float, sg::kCodeCells> witness{};    ///< Log-likelihood ratio by single pixels.
  std::array<bool, sg::kCodeCells> observed{};    ///< At least one pixel covers the cell.
  CellLikelihoods likelihoods{};
  bool glaring = false;  ///< Some cells are brighter than white, or saturated: specular reflection
                         ///< on a glossy marker.
};

/// Estimates the cells of a marker whose border has been fitted. The image is linear in the cells'
/// shares of white, each blurred as the image is, so all 24 are solved for together. Cells that are
/// barely larger than a pixel or than the blur are thus read without mixing in their neighbours.
/// Cells that are occluded or saturated by glare come out as neither black nor white, as uneven, or
/// as not observed: their likelihoods are near 0.
class CellReader {
 public:
  /// `blank`: the marker with all code cells black; `fit` has evaluated it on `observed` (linear
  /// light) at `state`. With glare, smooth additional light is solved for as well.
  void ReadCells(const MarkerPattern& blank, const BlockFit& fit, const ObservedPatch& observed,
                 const BlockFitState& state, const MarkerLight& light, bool with_glare,
                 CellReading* reading);

 private:
  struct Pixel {
    std::array<std::uint8_t, 9> cell;
    std::array<float, 9> share;
    int cells = 0;
    float value = 0.0F;
    std::int16_t node = 0;  ///< First of the four glare nodes around it.
    std::array<float, 4> node_share{};
    float least = -1.0F;  ///< For a clipped pixel on clipped white: lower bound of its share of
                          ///< white.
  };
  void Gather(const MarkerPattern& blank, const BlockFit& fit, const ObservedPatch& observed,
              const BlockFitState& state, const MarkerLight& light, bool with_glare);
  using CellFlags = std::array<bool, sg::kCodeCells>;
  /// Least squares for the cells' shares and, if requested, smooth glare.
  bool Solve(bool with_glare, const CellFlags& known_white, Eigen::VectorXd* found,
             Eigen::MatrixXd* inverse);
  bool SolveWithGlare(Eigen::VectorXd* found, Eigen::MatrixXd* inverse);
  static double GlareAt(const Pixel& pixel, const Eigen::VectorXd& found);
  /// Standard deviation of the share of white of black and white cells that noise does not explain.
  struct Unevenness {
    double black, white;
  };
  /// Sets the likelihoods of each cell for black, white and occluded, given the cells around it.
  static void Judge(const Unevenness& systematic, const std::array<double, sg::kCodeCells>& glare,
                    CellReading* reading);

  std::vector<Pixel> pixels_;
  bool drowned_ = false;  ///< Some pixels are brighter than white and clipped.
};

}  // namespace pleinair::tracker
