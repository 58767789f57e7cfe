// What is written into the audit: what of it, of whom, and how much.
#include "actors/operator_bridge/audit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/actors/operator_bridge/bridge_desk.hpp"

namespace godwit::operator_bridge::tests {
namespace audit_test {

using operators::command_kind;
using operators::role;

std::uint64_t rows_of(const bridge_desk& desk, const std::string& name) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(desk.audit, [&](const auto& each) { return each.second.who.name == name; }));
}

TEST(operator_audit, strangers_fill_neither_the_disk_nor_the_rows_of_others) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto rows = desk.audit.size();
  for (int i = 0; i < 10'000; ++i)
    (void)desk.say(desk.command({"m" + std::to_string(i), role::engineer, "s1234"}, command_kind::start));
  EXPECT_LE(desk.rows_written, rows + 10);
  desk.pass(2 * s);
  (void)desk.say(desk.command({"m", role::engineer, "s1234"}, command_kind::start));
  EXPECT_EQ(desk.rows(), rows + 10'001) << "none is forgotten";
}

TEST(operator_audit, three_thousand_refused_commands_of_a_viewer_in_a_second_are_a_few_rows_and_delay_nobody_else) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto eve = desk.log_in("eve", role::viewer);
  const auto before = desk.rows_written;
  for (int i = 0; i < 3'000; ++i) {
    const audit_note said{eve, "override " + std::to_string(i), "refused", "reason " + std::to_string(i)};
    desk.execute(desk.decides().on_note(said, desk.now));
    desk.now.monotonic_ns += s / 3'000;
    desk.now.wall_ns += s / 3'000;
  }
  EXPECT_LE(desk.rows_written - before, 22U);
  EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::check)), verdict::taken);
  EXPECT_EQ(desk.audit.rbegin()->second.who.name, "anna") << "her row waits for nobody's";
  EXPECT_EQ(desk.audit.rbegin()->second.count, 1U);
  for (int i = 0; i < 3; ++i)
    desk.pass(s);
  EXPECT_EQ(desk.rows(), before + 3'001) << "none is forgotten, also when nothing comes after it";
}

TEST(operator_audit, what_somebody_is_refused_takes_no_room_from_what_the_same_person_does) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  for (int i = 0; i < 200; ++i)
    desk.execute(desk.decides().on_note({anna, "try " + std::to_string(i), "refused", {}}, desk.now));
  const auto before = rows_of(desk, "anna");
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(desk.say_all_the_way(desk.command(anna, command_kind::check, "c" + std::to_string(i))), verdict::taken);
  EXPECT_EQ(rows_of(desk, "anna"), before + 50);
}

TEST(operator_audit, more_people_than_are_told_apart_share_what_is_left_and_nothing_of_them_is_forgotten) {
  bridge_desk desk;
  constexpr auto people = 4 * audit::max_shares;
  for (std::size_t i = 0; i < people; ++i)
    for (int n = 0; n < 30; ++n)
      desk.execute(desk.decides().on_note({{"p" + std::to_string(i), role::operator_, "mavlink"}, "do", "refused", {}},
                                          desk.now));
  EXPECT_LE(desk.rows_written, 20 * (audit::max_shares + 1));
  for (int i = 0; i < 60; ++i)
    desk.pass(s);
  EXPECT_EQ(desk.rows(), 30 * people);
}

TEST(operator_audit, rows_alike_within_a_minute_are_one) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto before = desk.audit.size();
  for (int i = 0; i < 5; ++i) {
    (void)desk.say_all_the_way(desk.command(anna, command_kind::check));
    desk.pass(s);
  }
  ASSERT_EQ(desk.audit.size(), before + 1);
  EXPECT_EQ(desk.audit.rbegin()->second.count, 5U);
  EXPECT_EQ(desk.audit.rbegin()->second.at_ns, desk.now.wall_ns - s);
}

TEST(operator_audit, acts_alike_with_another_in_between_are_two) {
  bridge_desk desk;
  const auto anna = desk.pilot();
  const auto before = desk.audit.size();
  for (const auto act : {control_act::give, control_act::take, control_act::give}) {
    (void)desk.control(anna, act);
    desk.pass(s);
  }
  ASSERT_EQ(desk.audit.size(), before + 3);
  EXPECT_EQ(desk.audit.rbegin()->second.what, "give control");
  EXPECT_EQ(desk.audit.rbegin()->second.count, 1U);
}

TEST(operator_audit, is_read_by_operators) {
  bridge_desk desk;
  const auto anna = desk.log_in("anna");
  EXPECT_EQ(desk.decides().on_read_audit({anna}, desk.now).second.refusal, "");
  const auto eve = desk.log_in("eve", role::viewer);
  EXPECT_NE(desk.decides().on_read_audit({eve}, desk.now).second.refusal, "");
  EXPECT_NE(desk.decides().on_read_audit({{"m", role::engineer, "s99"}}, desk.now).second.refusal, "");
}

TEST(operator_audit, goes_on_with_its_numbers_after_a_restart) {
  bridge_desk desk;
  const auto anna = desk.log_in("anna");
  const auto last = desk.audit.rbegin()->first;
  desk.crash();
  (void)desk.control(anna, control_act::take);
  EXPECT_EQ(desk.audit.rbegin()->first, last + 1);
}

TEST(operator_audit, rows_that_an_earlier_version_kept_in_its_state_are_moved_to_the_table) {
  const nlohmann::json row{{"number", 7}, {"at_ns", 1}, {"what", "start"}, {"outcome", "taken"}, {"count", 1}};
  const auto moved =
      durable_core::migrate({{"last_row", 8}, {"audit", {row}}, {"strangers", nlohmann::json::array()}}, 1);
  ASSERT_TRUE(moved);
  EXPECT_EQ(*moved, (nlohmann::json{{"last_row", 8}, {"unmoved", {row}}}));
  bridge_desk desk;
  desk.durable.last_row = 8;
  (void)durable_core::apply(desk.durable, audited{{.what = "stop", .outcome = "taken"}}, 5); // one of its events
  ASSERT_EQ(desk.durable.unmoved.size(), 1U);
  EXPECT_EQ(desk.durable.unmoved.front().number, 9U);
  core next(desk.set, desk.durable, desk.now);
  const auto wanted = next.on_start(desk.now);
  ASSERT_EQ(wanted.size(), 1U);
  const auto& event = std::get<rows_moved>(std::get<note>(wanted.front()).what);
  EXPECT_EQ(event.rows.size(), 1U);
  (void)durable_core::apply(desk.durable, event, 6);
  EXPECT_TRUE(desk.durable.unmoved.empty());
  EXPECT_EQ(desk.durable.last_row, 9U);
}

} // namespace audit_test
} // namespace godwit::operator_bridge::tests
