// Places for property tests: anywhere, and often where things go wrong: at the antimeridian, at the poles, on the
// equator. Include gtest before this. Thread: pure.
#pragma once

#include <rapidcheck.h>

#include "actors/domain/geo/point.hpp"

namespace godwit::tests {

[[nodiscard]] rc::Gen<geo::point> anywhere();

[[nodiscard]] rc::Gen<double> number_between(double low, double high);

} // namespace godwit::tests
