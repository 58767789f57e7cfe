#include <gtest/gtest.h>

#include "tests/actors/domain/geo/places.hpp"

namespace godwit::tests {

namespace {

constexpr int steps = 1'000'000;

geo::point point_at(double latitude_deg, double longitude_deg) { return {latitude_deg, longitude_deg}; }

} // namespace

rc::Gen<double> number_between(double low, double high) {
  return rc::gen::map(rc::gen::inRange(0, steps + 1),
                      [=](int step) { return low + (high - low) * static_cast<double>(step) / steps; });
}

rc::Gen<geo::point> anywhere() {
  const auto latitude = rc::gen::oneOf(number_between(-90, 90), number_between(89.99, 90), number_between(-90, -89.99),
                                       number_between(-0.001, 0.001), rc::gen::element(-90.0, 0.0, 90.0, 84.0, -80.0));
  const auto longitude = rc::gen::oneOf(number_between(-180, 180), number_between(179.999, 180),
                                        number_between(-180, -179.999), rc::gen::element(-180.0, 0.0, 180.0, 6.0));
  return rc::gen::apply(point_at, latitude, longitude);
}

} // namespace godwit::tests
