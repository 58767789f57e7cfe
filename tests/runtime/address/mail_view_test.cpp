#include "runtime/address/mail_view.hpp"

#include <gtest/gtest.h>

#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"
#include "runtime/supervision/messages.hpp"

namespace mail_view_test {

using namespace godwit::runtime;

using deaf_handle = mailbox<tells<child_event>>;

class deaf final : public actor_base<deaf_handle> {
public:
  using actor_base::actor_base;

protected:
  behavior_type handlers() override {
    return {on<child_event>([](const child_event&) {})};
  }
};

TEST(mail_view, what_waits_is_what_was_taken_in_and_not_handled_yet) {
  simulated_disk disk;
  simulation world(disk, 1);
  const auto one = world.actors().add<deaf>({.name = "one"}, {});
  const auto other = world.actors().add<deaf>({.name = "other"}, {});
  world.start();
  world.run_until_idle();
  for (int i = 0; i < 5; ++i)
    world.tell(other, child_event{});
  auto seen = look_at_mail(world.actors());
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].actor, "one");
  EXPECT_EQ(seen[0].waiting, 0U);
  EXPECT_EQ(seen[1].waiting, 5U);
  EXPECT_EQ(seen[1].counted.accepted, 5U);
  world.run_until_idle();
  seen = look_at_mail(world.actors());
  EXPECT_EQ(seen[1].waiting, 0U);
  EXPECT_EQ(seen[1].counted.handled, 5U);
}

TEST(mail_view, what_is_parked_between_two_incarnations_waits) {
  simulated_disk disk;
  simulation world(disk, 1);
  const auto who = world.actors().add<deaf>({.name = "one"}, {});
  world.tell(who, child_event{});
  EXPECT_EQ(look_at_mail(world.actors()).front().waiting, 1U);
  world.start();
  world.run_until_idle();
  EXPECT_EQ(look_at_mail(world.actors()).front().waiting, 0U);
}

} // namespace mail_view_test
