#pragma once

namespace pleinair::sky {

/// TT − UT1 in seconds, by the polynomials of Espenak & Meeus 2006, "Five Millennium Canon of Solar
/// Eclipses" (NASA/TP-2006-214141), §2.7, for the years −500 to 2150 and beyond; here from 1600.
/// Before 1600 it gives the value of 1600. Past: within 1 s from 1900 on; future: a forecast.
double DeltaTSeconds(double decimal_year);

}  // namespace pleinair::sky
