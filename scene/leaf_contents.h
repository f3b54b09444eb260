#pragma once

#include <array>
#include <string>
#include <string_view>

#include "base/error.h"

namespace pleinair::scene {

/// Constituents of a leaf per leaf area, and its structure.
struct LeafContents {
  double chlorophyll_ug_cm2 = 0.0;  ///< a and b.
  double carotenoids_ug_cm2 = 0.0;
  double anthocyanins_ug_cm2 = 0.0;
  double brown = 0.0;      ///< Brown pigments, arbitrary unit.
  double water_cm = 0.0;   ///< Equivalent thickness.
  double dry_g_cm2 = 0.0;  ///< Dry matter.
  double structure = 1.5;  ///< N: number of plates that scatter like the leaf.
  bool operator==(const LeafContents&) const = default;
};

enum class LeafModel {
  kProspectD,  ///< N plates, at every nanometre (compositor/leaf/prospect.h).
  kPlate,      ///< One plate at three wavelengths (compositor/leaf/plate.h).
};

inline constexpr const char* kProspectDName = "prospect-d";
inline constexpr const char* kPlateName = "plate";

constexpr std::string_view NameOf(LeafModel model) {
  return model == LeafModel::kPlate ? kPlateName : kProspectDName;
}

/// A leaf and the model that computes its color.
struct Leaf {
  LeafModel model = LeafModel::kProspectD;
  LeafContents contents;
  /// Refractive index of red, green and blue; kPlate only. The defaults reproduce Table 1 of Miao
  /// et al. 2016, which was made with them.
  std::array<double, 3> refractive_index{1.483, 1.431, 1.527};
  bool operator==(const Leaf&) const = default;
};

/// A key of LeafContents with its range, for readers and messages.
struct LeafQuantity {
  const char* key;
  double LeafContents::*value;
  double low, high;
  const char* unit;
  const char* remedy;  ///< The likely mistake.
};

inline constexpr std::array<LeafQuantity, 7> kLeafQuantities = {{
    {"chlorophyll_ug_cm2", &LeafContents::chlorophyll_ug_cm2, 0.0, 150.0, " µg/cm²",
     "a tenth of mg/m²?"},
    {"carotenoids_ug_cm2", &LeafContents::carotenoids_ug_cm2, 0.0, 50.0, " µg/cm²",
     "a tenth of mg/m²?"},
    {"anthocyanins_ug_cm2", &LeafContents::anthocyanins_ug_cm2, 0.0, 40.0, " µg/cm²",
     "a tenth of mg/m²?"},
    {"brown", &LeafContents::brown, 0.0, 5.0, "", "0 is none, 1 much"},
    {"water_cm", &LeafContents::water_cm, 0.0, 0.1, " cm", "milligrams per cm², or millimetres?"},
    {"dry_g_cm2", &LeafContents::dry_g_cm2, 0.0, 0.05, " g/cm²", "milligrams?"},
    {"structure", &LeafContents::structure, 1.0, 4.0, "", "maize has 1.5, thick leaves 2.5"},
}};

/// Errors (input): `value` is not within the range of the quantity. `where` locates it.
Result<void> CheckLeafQuantity(const LeafQuantity& quantity, double value,
                               const std::string& where);

inline constexpr double kMinLeafRefraction = 1.1, kMaxLeafRefraction = 2.0;

/// Chlorophyll in µg/cm² from a reading of the SPAD-502 meter, 0…82. The equation is
/// 10^(SPAD^0.265) µmol/m², at 893 g/mol. Source: Markwell, Osterman & Mitchell 1995, "Calibration
/// of the Minolta SPAD-502 leaf chlorophyll meter", Photosynthesis Research 46. Errors (input): out
/// of range. `where` locates the reading.
Result<double> ChlorophyllOfSpad(double spad, const std::string& where);

}  // namespace pleinair::scene
