// What is written into the audit: what of it, of whom, and how much.
#include "actors/operator_bridge/audit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/actors/operator_bridge/bridge_world.hpp"

namespace godwit::operator_bridge::tests {
namespace audit_test {

using operators::command_kind;
using operators::role;

std::uint64_t rows_of(const bridge_world& world, const std::string& name) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(world.audit, [&](const auto& each) { return each.second.who.name == name; }));
}

TEST(operator_audit, strangers_fill_neither_the_disk_nor_the_rows_of_others) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto rows = world.audit.size();
  for (int i = 0; i < 10'000; ++i)
    (void)world.say(world.command({"m" + std::to_string(i), role::engineer, "s1234"}, command_kind::start));
  EXPECT_LE(world.rows_written, rows + 10);
  world.pass(2 * s);
  (void)world.say(world.command({"m", role::engineer, "s1234"}, command_kind::start));
  EXPECT_EQ(world.rows(), rows + 10'001) << "none is forgotten";
}

TEST(operator_audit, three_thousand_refused_commands_of_a_viewer_in_a_second_are_a_few_rows_and_delay_nobody_else) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto eve = world.log_in("eve", role::viewer);
  const auto before = world.rows_written;
  for (int i = 0; i < 3'000; ++i) {
    const audit_note said{eve, "override " + std::to_string(i), "refused", "reason " + std::to_string(i)};
    world.execute(world.decides().on_note(said, world.now));
    world.now.monotonic_ns += s / 3'000;
    world.now.wall_ns += s / 3'000;
  }
  EXPECT_LE(world.rows_written - before, 22U);
  EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::check)), verdict::taken);
  EXPECT_EQ(world.audit.rbegin()->second.who.name, "anna") << "her row waits for nobody's";
  EXPECT_EQ(world.audit.rbegin()->second.count, 1U);
  for (int i = 0; i < 3; ++i)
    world.pass(s);
  EXPECT_EQ(world.rows(), before + 3'001) << "none is forgotten, also when nothing comes after it";
}

TEST(operator_audit, what_somebody_is_refused_takes_no_room_from_what_the_same_person_does) {
  bridge_world world;
  const auto anna = world.pilot();
  for (int i = 0; i < 200; ++i)
    world.execute(world.decides().on_note({anna, "try " + std::to_string(i), "refused", {}}, world.now));
  const auto before = rows_of(world, "anna");
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(world.say_all_the_way(world.command(anna, command_kind::check, "c" + std::to_string(i))), verdict::taken);
  EXPECT_EQ(rows_of(world, "anna"), before + 50);
}

TEST(operator_audit, more_people_than_are_told_apart_share_what_is_left_and_nothing_of_them_is_forgotten) {
  bridge_world world;
  constexpr auto people = 4 * audit::max_shares;
  for (std::size_t i = 0; i < people; ++i)
    for (int n = 0; n < 30; ++n)
      world.execute(world.decides().on_note(
          {{"p" + std::to_string(i), role::operator_, "mavlink"}, "do", "refused", {}}, world.now));
  EXPECT_LE(world.rows_written, 20 * (audit::max_shares + 1));
  for (int i = 0; i < 60; ++i)
    world.pass(s);
  EXPECT_EQ(world.rows(), 30 * people);
}

TEST(operator_audit, rows_alike_within_a_minute_are_one) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto before = world.audit.size();
  for (int i = 0; i < 5; ++i) {
    (void)world.say_all_the_way(world.command(anna, command_kind::check));
    world.pass(s);
  }
  ASSERT_EQ(world.audit.size(), before + 1);
  EXPECT_EQ(world.audit.rbegin()->second.count, 5U);
  EXPECT_EQ(world.audit.rbegin()->second.at_ns, world.now.wall_ns - s);
}

TEST(operator_audit, acts_alike_with_another_in_between_are_two) {
  bridge_world world;
  const auto anna = world.pilot();
  const auto before = world.audit.size();
  for (const auto act : {control_act::give, control_act::take, control_act::give}) {
    (void)world.control(anna, act);
    world.pass(s);
  }
  ASSERT_EQ(world.audit.size(), before + 3);
  EXPECT_EQ(world.audit.rbegin()->second.what, "give control");
  EXPECT_EQ(world.audit.rbegin()->second.count, 1U);
}

TEST(operator_audit, is_read_by_operators) {
  bridge_world world;
  const auto anna = world.log_in("anna");
  EXPECT_EQ(world.decides().on_read_audit({anna}, world.now).second.refusal, "");
  const auto eve = world.log_in("eve", role::viewer);
  EXPECT_NE(world.decides().on_read_audit({eve}, world.now).second.refusal, "");
  EXPECT_NE(world.decides().on_read_audit({{"m", role::engineer, "s99"}}, world.now).second.refusal, "");
}

TEST(operator_audit, goes_on_with_its_numbers_after_a_restart) {
  bridge_world world;
  const auto anna = world.log_in("anna");
  const auto last = world.audit.rbegin()->first;
  world.crash();
  (void)world.control(anna, control_act::take);
  EXPECT_EQ(world.audit.rbegin()->first, last + 1);
}

TEST(operator_audit, rows_that_an_earlier_version_kept_in_its_state_are_moved_to_the_table) {
  const nlohmann::json row{{"number", 7}, {"at_ns", 1}, {"what", "start"}, {"outcome", "taken"}, {"count", 1}};
  const auto moved =
      durable_core::migrate({{"last_row", 8}, {"audit", {row}}, {"strangers", nlohmann::json::array()}}, 1);
  ASSERT_TRUE(moved);
  EXPECT_EQ(*moved, (nlohmann::json{{"last_row", 8}, {"unmoved", {row}}}));
  bridge_world world;
  world.durable.last_row = 8;
  (void)durable_core::apply(world.durable, audited{{.what = "stop", .outcome = "taken"}}, 5); // one of its events
  ASSERT_EQ(world.durable.unmoved.size(), 1U);
  EXPECT_EQ(world.durable.unmoved.front().number, 9U);
  core next(world.set, world.durable, world.now);
  const auto wanted = next.on_start(world.now);
  ASSERT_EQ(wanted.size(), 1U);
  const auto& event = std::get<rows_moved>(std::get<note>(wanted.front()).what);
  EXPECT_EQ(event.rows.size(), 1U);
  (void)durable_core::apply(world.durable, event, 6);
  EXPECT_TRUE(world.durable.unmoved.empty());
  EXPECT_EQ(world.durable.last_row, 9U);
}

} // namespace audit_test
} // namespace godwit::operator_bridge::tests
