#include "actors/executor/flight/authority_text.hpp"

#include <gtest/gtest.h>

namespace authority_text_test {

using namespace godwit;
using namespace godwit::executor;

struct stands {
  state durable;
  flight_context flight{settings{}, durable};
};

TEST(authority_text, nobody_has_a_vehicle_of_which_no_flight_is_watched) {
  EXPECT_EQ(authority_text(stands().flight), "nobody");
}

TEST(authority_text, in_a_flight_that_is_not_watched_yet_it_is_unclear) {
  stands s;
  s.durable.status.in_flight = true;
  EXPECT_EQ(authority_text(s.flight), "unclear");
}

TEST(authority_text, while_it_is_watched_it_is_who_the_modes_say) {
  stands s;
  s.durable.status.in_flight = true;
  s.flight.authority.begin({flight::mode_kind::mission, 4});
  EXPECT_EQ(authority_text(s.flight), "godwit");
  for (const auto& [who, text] :
       {std::pair{flight::holder::person, "person"}, {flight::holder::autopilot_failsafe, "autopilot_failsafe"}}) {
    s.flight.authority.take_away(who);
    EXPECT_EQ(authority_text(s.flight), text);
  }
}

TEST(authority_text, what_waits_for_a_hand_back_is_who_had_it_also_after_the_landing) {
  stands s;
  for (const auto& [cause, text] : {std::pair{pause_cause::taken_over, "person"},
                                    {pause_cause::failsafe, "failsafe"},
                                    {pause_cause::autopilot_failsafe, "autopilot_failsafe"}}) {
    s.durable.status.cause = cause;
    EXPECT_EQ(authority_text(s.flight), text);
  }
}

TEST(authority_text, a_failsafe_that_acts_has_it_whatever_else_is_known) {
  stands s;
  s.durable.status.in_flight = true;
  s.flight.authority.begin({flight::mode_kind::mission, 4});
  s.flight.failsafe_status.emplace();
  EXPECT_EQ(authority_text(s.flight), "godwit");
  s.flight.failsafe_status->reacts.emplace();
  EXPECT_EQ(authority_text(s.flight), "failsafe");
}

} // namespace authority_text_test
