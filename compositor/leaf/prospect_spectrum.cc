#include <array>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "compositor/leaf/prospect.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compositor/leaf/prospect_spectrum.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#ifndef COMPOSITOR_LEAF_SPECTRUM_TABLE
#define COMPOSITOR_LEAF_SPECTRUM_TABLE
namespace pleinair::compositor {

/// LeafBandAt() by quantity; every column is padded so that whole vectors can be read.
struct SpectrumTable {
  static constexpr std::size_t kPadding = 16;
  std::array<std::vector<double>, kLeafConstituents> absorption;
  std::vector<double> entering, diffuse, n2;  ///< PlateSurface; `entering` of the first plate.
};

/// Coefficients of PlateSurface and LayerTransmittance() for one leaf.
struct SpectrumLeaf {
  std::array<double, kLeafConstituents> contents{};  ///< Divided by N.
  double plates_behind = 0.0;                        ///< N − 1.
  std::array<double, 18> series{};                   ///< Coefficients of E₁; k¹ at index 1.
};

}  // namespace pleinair::compositor
#endif

HWY_BEFORE_NAMESPACE();
namespace pleinair::compositor {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// LayerTransmittance().
template <class D, class V>
V Theta(D d, const SpectrumLeaf& leaf, V k) {
  const V one = hn::Set(d, 1.0);
  const V left = hn::Exp(d, hn::Neg(k));
  V series = hn::Zero(d);
  for (std::size_t n = leaf.series.size() - 1; n > 0; --n) {
    series = hn::Mul(hn::Add(series, hn::Set(d, leaf.series[n])), k);
  }
  const V logarithm = hn::Log(d, hn::Max(k, hn::Set(d, 1e-300)));
  const V e1 = hn::Sub(hn::Sub(series, hn::Set(d, std::numbers::egamma)), logarithm);
  const V thin = hn::MulAdd(hn::Mul(k, k), e1, hn::Mul(hn::Sub(one, k), left));
  // Abramowitz & Stegun 5.1.56.
  V over = hn::Add(k, hn::Set(d, 8.5733287401));
  over = hn::MulAdd(over, k, hn::Set(d, 18.0590169730));
  over = hn::MulAdd(over, k, hn::Set(d, 8.6347608925));
  over = hn::MulAdd(over, k, hn::Set(d, 0.2677737343));
  V under = hn::Add(k, hn::Set(d, 9.5733223454));
  under = hn::MulAdd(under, k, hn::Set(d, 25.6329561486));
  under = hn::MulAdd(under, k, hn::Set(d, 21.0996530827));
  under = hn::MulAdd(under, k, hn::Set(d, 3.9584969228));
  const V thick = hn::Mul(left, hn::NegMulAdd(k, hn::Sub(one, hn::Div(over, under)), one));
  return hn::IfThenElse(hn::Le(k, one), thin, thick);
}

/// StackOptics() at the bands from `at` on.
template <class D>
void Stack(D d, const SpectrumTable& table, const SpectrumLeaf& leaf, std::size_t at,
           double* optics) {
  using V = hn::Vec<D>;
  const V one = hn::Set(d, 1.0);
  V k = hn::Zero(d);
  for (std::size_t i = 0; i < kLeafConstituents; ++i) {
    k = hn::MulAdd(hn::Set(d, leaf.contents[i]), hn::LoadU(d, &table.absorption[i][at]), k);
  }
  const V theta = Theta(d, leaf, k);
  const V n2 = hn::LoadU(d, &table.n2[at]), diffuse = hn::LoadU(d, &table.diffuse[at]);
  const V entering = hn::LoadU(d, &table.entering[at]);
  const V inside = hn::Sub(n2, diffuse);
  const V kept = hn::Mul(theta, inside);
  // PlateOptics() for both kinds of plates.
  const V through = hn::Div(hn::Mul(diffuse, theta), hn::NegMulAdd(kept, kept, hn::Mul(n2, n2)));
  const V first_t = hn::Mul(hn::Mul(through, entering), n2);
  const V first_r = hn::Add(hn::Sub(one, entering), hn::Mul(hn::Mul(through, entering), kept));
  const V t = hn::Mul(hn::Mul(through, diffuse), n2);
  const V r = hn::Add(hn::Sub(one, diffuse), hn::Mul(hn::Mul(through, diffuse), kept));
  const V absorbed = hn::Sub(hn::Sub(one, r), t);
  const V behind = hn::Set(d, leaf.plates_behind);
  const V clear_t = hn::Div(t, hn::MulAdd(hn::Sub(one, t), behind, t));
  // What a stack that absorbs nothing would divide by 0 is not used.
  const V product = hn::Mul(hn::Mul(hn::Add(one, hn::Add(r, t)), hn::Add(one, hn::Sub(r, t))),
                            hn::Mul(hn::Sub(one, hn::Sub(r, t)), absorbed));
  const V delta = hn::Sqrt(hn::Max(product, hn::Zero(d)));
  const V squares = hn::Sub(hn::Mul(r, r), hn::Mul(t, t));
  const V a = hn::Div(hn::Add(hn::Add(one, squares), delta), hn::Add(r, r));
  const V ratio = hn::Div(hn::Add(t, t), hn::Add(hn::Sub(one, squares), delta));
  const V beta = hn::Exp(d, hn::Mul(behind, hn::Log(d, hn::Max(ratio, hn::Set(d, 1e-300)))));
  const V a2 = hn::Mul(a, a), b2 = hn::Mul(beta, beta);
  const V share = hn::Div(one, hn::Sub(a2, b2));
  const auto clear = hn::Lt(absorbed, hn::Set(d, 1e-12));
  const V others_t =
      hn::IfThenElse(clear, clear_t, hn::Mul(hn::Mul(beta, hn::Sub(a2, one)), share));
  const V others_r =
      hn::IfThenElse(clear, hn::Sub(one, clear_t), hn::Mul(hn::Mul(a, hn::Sub(one, b2)), share));
  const V between = hn::Div(first_t, hn::NegMulAdd(others_r, r, one));
  hn::StoreInterleaved2(hn::MulAdd(hn::Mul(between, others_r), t, first_r),
                        hn::Mul(between, others_t), d, optics);
}

void Spectrum(const SpectrumTable& table, const SpectrumLeaf& leaf, std::size_t first,
              LeafOptics* optics, std::size_t count) {
  const hn::CappedTag<double, 8> d;
  const std::size_t lanes = hn::Lanes(d);
  static_assert(sizeof(LeafOptics) == 2 * sizeof(double));
  std::array<double, 16> last{};
  for (std::size_t i = 0; i < count; i += lanes) {
    const bool whole = i + lanes <= count;
    Stack(d, table, leaf, first + i, whole ? &optics[i].reflectance : last.data());
    if (whole) continue;
    for (std::size_t k = i; k < count; ++k) {
      optics[k] = {last[2 * (k - i)], last[2 * (k - i) + 1]};
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pleinair::compositor
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::compositor {
namespace {

const SpectrumTable& LeafSpectrumTable() {
  static const SpectrumTable kTable = [] {
    SpectrumTable table;
    const auto column = [](const auto& value_of) {
      std::vector<double> values(kLeafBands + SpectrumTable::kPadding, 1.0);
      for (std::size_t i = 0; i < kLeafBands; ++i) {
        values[i] = value_of(LeafBandAt(kFirstLeafNm + static_cast<int>(i)));
      }
      return values;
    };
    for (std::size_t k = 0; k < kLeafConstituents; ++k) {
      table.absorption[k] = column([k](const LeafBand& band) { return band.absorption[k]; });
    }
    table.entering = column([](const LeafBand& band) { return band.first.entering; });
    table.diffuse = column([](const LeafBand& band) { return band.inner.diffuse; });
    table.n2 = column([](const LeafBand& band) { return band.inner.n2; });
    return table;
  }();
  return kTable;
}

}  // namespace

HWY_EXPORT(Spectrum);

void ProspectSpectrum(const scene::LeafContents& contents, int first_nm,
                      std::span<LeafOptics> optics) {
  SpectrumLeaf leaf;
  leaf.contents = {contents.chlorophyll_ug_cm2,
                   contents.carotenoids_ug_cm2,
                   contents.anthocyanins_ug_cm2,
                   contents.brown,
                   contents.water_cm,
                   contents.dry_g_cm2};
  for (double& value : leaf.contents) value /= contents.structure;
  leaf.plates_behind = contents.structure - 1.0;
  double factorial = 1.0;
  for (std::size_t n = 1; n < leaf.series.size(); ++n) {
    const auto number = static_cast<double>(n);
    factorial *= number;
    leaf.series[n] = (n % 2 == 1 ? 1.0 : -1.0) / (number * factorial);
  }
  HWY_DYNAMIC_DISPATCH(Spectrum)
  (LeafSpectrumTable(), leaf, static_cast<std::size_t>(first_nm - kFirstLeafNm), optics.data(),
   optics.size());
}

}  // namespace pleinair::compositor
#endif  // HWY_ONCE
