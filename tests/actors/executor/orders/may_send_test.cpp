#include "actors/executor/may_send.hpp"

#include <gtest/gtest.h>

#include "actors/executor/tasks/steps.hpp"
#include "actors/vehicle_link/order_check.hpp"
#include "tests/actors/domain/control_authority/vehicles.hpp"

namespace godwit::executor {
namespace may_send_test {

constexpr std::int64_t s = 1'000'000'000;
constexpr flight::flight_mode hold{flight::mode_kind::hold, 5};

flight::control_authority ours() {
  flight::control_authority result;
  result.begin(hold);
  return result;
}

flight::control_authority somebody_elses() {
  auto result = ours();
  result.take_away(flight::holder::person);
  return result;
}

intended_order start(std::int64_t looked_ns, std::int64_t now_ns) {
  return {
      .kind = order_kind::moves, .flies_plan = true, .looked_ns = looked_ns, .proof_from_ns = now_ns - proof_counts_ns};
}

evidence proved(std::int64_t at_ns) {
  evidence result;
  result.plan.prove(at_ns, at_ns);
  return result;
}

TEST(may_send, what_stops_the_vehicle_goes_out_whoever_has_it) {
  EXPECT_EQ(may_send({.kind = order_kind::stops}, somebody_elses(), {}, 100 * s), permission::may);
}

TEST(may_send, nothing_that_moves_the_vehicle_goes_out_while_somebody_else_has_it) {
  EXPECT_EQ(may_send(start(100 * s, 100 * s), somebody_elses(), proved(99 * s), 100 * s), permission::not_ours);
}

TEST(may_send, a_plan_is_flown_only_when_it_was_proved_lately) {
  EXPECT_EQ(may_send(start(100 * s, 100 * s), ours(), {}, 100 * s), permission::prove);
  EXPECT_EQ(may_send(start(100 * s, 100 * s), ours(), proved(97 * s), 100 * s), permission::prove);
  EXPECT_EQ(may_send(start(100 * s, 100 * s), ours(), proved(98 * s), 100 * s), permission::may);
}

TEST(may_send, a_sign_of_another_plan_undoes_a_proof_that_was_begun_before) {
  auto seen = proved(99 * s);
  seen.plan.doubt(99 * s);
  EXPECT_EQ(may_send(start(100 * s, 100 * s), ours(), seen, 100 * s), permission::prove);
  seen.plan.prove(99 * s + 1, 99 * s + 2);
  EXPECT_EQ(may_send(start(100 * s, 100 * s), ours(), seen, 100 * s), permission::may);
}

TEST(may_send, an_order_that_moves_the_vehicle_needs_a_look_that_is_not_older_than_a_second) {
  EXPECT_EQ(may_send(start(0, 100 * s), ours(), proved(99 * s), 100 * s), permission::look);
  EXPECT_EQ(may_send(start(99 * s - 1, 100 * s), ours(), proved(99 * s), 100 * s), permission::look);
  EXPECT_EQ(may_send(start(99 * s, 100 * s), ours(), proved(99 * s), 100 * s), permission::may);
}

TEST(may_send, a_hold_for_what_goes_on_by_itself_needs_a_look_as_well) {
  EXPECT_EQ(may_send({.kind = order_kind::holds}, ours(), {}, 100 * s), permission::look);
  EXPECT_EQ(may_send({.kind = order_kind::holds, .looked_ns = 100 * s}, ours(), {}, 100 * s), permission::may);
}

TEST(may_send, nothing_goes_on_by_itself_out_of_a_hold_that_may_be_somebody_elses) {
  constexpr flight::flight_mode brake{flight::mode_kind::hold, 17};
  auto order = start(100 * s, 100 * s);
  auto who = ours();
  who.expect({brake.custom_mode}, 0, 200 * s);
  who.on_mode(flight::tests::copter, brake, false, s);
  EXPECT_EQ(may_send(order, who, proved(99 * s), 100 * s), permission::may) << "an operator's";
  order.is_by_itself = true;
  EXPECT_EQ(may_send(order, who, proved(99 * s), 100 * s), permission::uncertain);
  who.acknowledge();
  EXPECT_EQ(may_send(order, who, proved(99 * s), 100 * s), permission::may);
}

TEST(may_send, an_act_of_somebody_else_after_the_look_needs_another_one) {
  auto seen = proved(99 * s);
  seen.foreign_ns = 99 * s + s / 2;
  EXPECT_EQ(may_send(start(99 * s + s / 4, 100 * s), ours(), seen, 100 * s), permission::look);
}

// The process was stopped between the decision and the line.
TEST(order_check, after_a_stall_of_more_than_a_second_no_order_that_moves_the_vehicle_goes_out) {
  vehicle_link::order_check link;
  link.heard(5, false);
  const vehicle_link::seen_state moving{5, false, 0, 0, 100 * s};
  EXPECT_TRUE(link.why_not(moving, 101 * s).empty());
  EXPECT_FALSE(link.why_not(moving, 101 * s + 1).empty());
  const vehicle_link::seen_state stopping{5, false, 0, 0, 0};
  EXPECT_TRUE(link.why_not(stopping, 110 * s).empty()) << "a stop goes out";
}

TEST(order_check, an_order_that_does_not_know_what_somebody_else_did_does_not_go_out) {
  vehicle_link::order_check link;
  link.heard(5, false);
  link.heard_foreign(100 * s);
  EXPECT_FALSE(link.why_not(vehicle_link::seen_state{5, false, 0, 0, 99 * s}, 100 * s).empty());
  EXPECT_TRUE(link.why_not(vehicle_link::seen_state{5, false, 0, 100 * s, 99 * s}, 100 * s).empty());
  EXPECT_TRUE(link.why_not(vehicle_link::seen_state{5, false, 0, 0, 100 * s + 1}, 100 * s + 1).empty())
      << "it was looked at since";
  EXPECT_TRUE(link.why_not(vehicle_link::seen_state{5, false, 0, 0, 0}, 100 * s).empty()) << "a stop goes out";
}

} // namespace may_send_test
} // namespace godwit::executor
