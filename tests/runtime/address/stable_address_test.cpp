#include <gtest/gtest.h>

#include "runtime/address/stable_address.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/simulation/simulation.hpp"

namespace stable_address_test {

using namespace godwit::runtime;

// What reached the incarnation that was bound.
struct heard {
  int confirmations = 0;
  int retries = 0;
  std::vector<std::int64_t> durable_upto;
};

caf::behavior listen(caf::event_based_actor*, heard* what) {
  return {[what](const envelope& m) {
    if (m.is<effect_taken>())
      ++what->confirmations;
    else if (m.is<retry_write>())
      ++what->retries;
    else if (m.is<durable>())
      what->durable_upto.push_back(m.as<durable>().upto);
  }};
}

// The argument is passed through spawn: without any, CAF 0.17.6 binds a reference to null on its way to the behaviour.
caf::strong_actor_ptr spawn_listener(caf::actor_system& system, heard& what) {
  return caf::actor_cast<caf::strong_actor_ptr>(system.spawn(listen, &what));
}

TEST(stable_address, keeps_for_an_incarnation_that_is_not_bound_yet_what_the_runtime_told_it) {
  simulated_disk disk;
  simulation world(disk, 1);
  auto pointer = make_stable_address(world.actors().actors(), 77, {.name = "late"});
  auto& address = address_of(pointer);
  (void)address.begin_incarnation();
  address.enqueue(make_internal_mail(effect_taken{1, 0, 5}), nullptr);
  address.enqueue(make_internal_mail(durable{4}), nullptr);
  address.enqueue(make_internal_mail(durable{3}), nullptr);
  address.enqueue(make_internal_mail(retry_write{}), nullptr);
  address.enqueue(make_internal_mail(ping{9}), nullptr); // of no use to anybody any more
  heard what;
  const auto listener = spawn_listener(world.actors().actors(), what);
  address.bind(listener, nullptr);
  world.run_until_idle();
  EXPECT_EQ(what.confirmations, 1);
  EXPECT_EQ(what.retries, 1);
  EXPECT_EQ(what.durable_upto, std::vector<std::int64_t>{4});
  (void)address.kill();
  world.run_until_idle();
  address.close();
}

} // namespace stable_address_test
