// Any order of kills, throws, pilots, pauses, assignments, cut lines and faults of the service, on every vehicle, on
// the real composition: what must hold whatever happens. `godwit-drill simulate` flies the same seeds.
//
// TEST_SEED=n runs flight n first, TEST_FULL=1 many more of them.
#include <gtest/gtest.h>

#include "programs/godwit-drill/flights/random_flight.hpp"
#include "tests/support/run_options.hpp"

namespace random_flight_test {

using namespace godwit;
using namespace godwit::tests;

TEST(random_flight, keeps_its_promises_whatever_happens) {
  const std::uint64_t flights = is_full_run() ? 5'000 : 60;
  for (auto seed = first_seed(); seed < first_seed() + flights; ++seed) {
    const auto outcome = drill::fly_random(seed, std::nullopt, {});
    for (const auto& flaw : outcome.flaws)
      ADD_FAILURE() << flaw;
    ASSERT_TRUE(outcome.held()) << "again: godwit-drill simulate --seeds " << seed << "\n" << outcome.story;
  }
}

} // namespace random_flight_test
