#include "programs/godwit-sim/vehicle/world/way.hpp"

#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim {
namespace {

constexpr int answers_for_each_solution = 50; // a second at 50 steps
// Nearer than this, which happens close to a pole only, each step counts.
constexpr double min_distance_to_reuse_m = 5'000;

} // namespace

course way::from(const position& here) {
  if (is_nearby(here, to_))
    return course_nearby(here, to_);
  if (answers_left_ == 0) {
    exact_ = between(here, to_);
    answers_left_ = exact_.distance_m > min_distance_to_reuse_m ? answers_for_each_solution : 1;
  }
  --answers_left_;
  return exact_;
}

} // namespace godwit::sim
