#pragma once

// Internal: between the .cc files of this module; not installed.

#include <Eigen/Core>

#include <array>
#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/golay/soft_golay_decoder.h"
#include "tracker/marker_pattern.h"
#include "tracker/surf_golay/cell_light.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// What the code cells of a marker look like.
struct CellReading {
  std::array<float, sg::kCodeCells> white{};      ///< Share of white: 0 black, 1 white.
  std::array<float, sg::kCodeCells> deviation{};  ///< … and its standard deviation.
  std::array<float, sg::kCodeCells> misfit{};     ///< Left-over inside a cell beyond noise.
  std::array<float, sg::kCodeCells> witness{};    ///< Log-likelihood ratio by single pixels.
  std::array<bool, sg::kCodeCells> observed{};    ///< Any pixel tells of it.
  CellLikelihoods likelihoods{};
  bool glaring = false;  ///< Some cells are whiter than white or drowned: light that a shiny marker
                         ///< throws back.
};

/// Reads the cells of a marker whose border has been fitted. The image is linear in the cells'
/// shares of white, each blurred as the image is, so that all 24 are solved for together: cells
/// that are barely larger than a pixel, or than the blur, are read without taking their
/// neighbours' light for their own. Cells that are covered, or drowned in glare, come out as
/// neither black nor white, or uneven, or unseen: their likelihoods are near 0.
class CellReader {
 public:
  /// `blank` is the marker with all code cells black; `fit` has evaluated it on `seen` (in linear
  /// light) at `state`. With glare, smooth light on top of what is printed is solved for as well.
  void ReadCells(const MarkerPattern& blank, const BlockFit& fit, const ObservedPatch& observed,
                 const BlockFitState& state, const MarkerLight& light, bool with_glare,
                 CellReading* reading);

 private:
  struct Pixel {
    std::array<std::uint8_t, 9> cell;
    std::array<float, 9> share;
    int cells = 0;
    float value = 0.0F;
    std::int16_t node = 0;  ///< First of the four nodes of glare around it.
    std::array<float, 4> node_share{};
    float least = -1.0F;  ///< Of a clipped pixel on clipping white: its share is at least this.
  };
  void Gather(const MarkerPattern& blank, const BlockFit& fit, const ObservedPatch& observed,
              const BlockFitState& state, const MarkerLight& light, bool with_glare);
  using CellFlags = std::array<bool, sg::kCodeCells>;
  /// Least squares of the cells' shares, and of smooth glare on top where asked.
  bool Solve(bool with_glare, const CellFlags& known_white, Eigen::VectorXd* found,
             Eigen::MatrixXd* inverse);
  bool SolveWithGlare(Eigen::VectorXd* found, Eigen::MatrixXd* inverse);
  static double GlareAt(const Pixel& pixel, const Eigen::VectorXd& found);
  /// How likely each cell is black, white or covered, given what the cells around it look like.
  /// Deviation of a cell's share of white that no noise tells.
  struct Unevenness {
    double black, white;
  };
  static void Judge(const Unevenness& systematic, const std::array<double, sg::kCodeCells>& glare,
                    CellReading* reading);

  std::vector<Pixel> pixels_;
  bool drowned_ = false;  ///< Some pixels are brighter than white and than the image can hold.
};

}  // namespace pleinair::tracker
