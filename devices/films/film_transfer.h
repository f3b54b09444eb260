#pragma once

namespace pleinair::devices {

// Transfer functions of films: scene light E (linear) from the signal E' (0…1) and back. Signals
// outside of 0…1 are clamped.

/// ITU-R BT.709-6, item 1.2, inverted: E' = 4.5 E below E = 0.018, else 1.099 E^0.45 - 0.099. The
/// same curve in ITU-R BT.601-7 and BT.2020-2 (for 10 bits).
double LightFromBt709(double signal);
double Bt709FromLight(double light);

/// A power function: E = E'^gamma.
double LightFromGamma(double signal, double gamma);

/// ITU-R BT.2100-2, Table 5, inverse of the HLG reference OETF: E = E'^2 / 3 up to E' = 1/2, else
/// (exp((E' - c) / a) + b) / 12. E = 1 at the signal 1. The scene's light, without the display's
/// OOTF.
double LightFromHlg(double signal);
double HlgFromLight(double light);

/// ITU-R BT.2100-2, Table 4, PQ reference EOTF: display light in cd/m², 0…10000.
double DisplayFromPq_cd_m2(double signal);
double PqFromDisplay_cd_m2(double display_cd_m2);

/// Scene light of a PQ signal: the EOTF, then the inverse of the reference OOTF of BT.2100-2, Table
/// 4, F = G1886[G709[E]] with G709 = 1.099 (59.5208 E)^0.45 - 0.099 above E = 0.0003024, else
/// 267.84 E, and G1886 = 100 E'^2.4. E is 1 at 10000 cd/m².
double LightFromPq(double signal);

/// Scene light of HDR reference white, which becomes 1 of SDR. It is 75 % of the HLG signal. It is
/// 58 % of the PQ signal, 203 cd/m² (ITU-R BT.2408-7, Table 1).
double HlgReferenceWhite();
double PqReferenceWhite();

}  // namespace pleinair::devices
