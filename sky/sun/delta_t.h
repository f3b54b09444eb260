#pragma once

namespace pleinair::sky {

/// TT − UT1 in seconds, by the polynomials of Espenak & Meeus 2006, "Five Millennium Canon of Solar
/// Eclipses" (NASA/TP-2006-214141), §2.7. Theirs cover −500 to 2150 and beyond; these start at 1600
/// and return the value of 1600 before. Within 1 s from 1900 to the present; later values are a
/// forecast.
double DeltaTSeconds(double decimal_year);

}  // namespace pleinair::sky
