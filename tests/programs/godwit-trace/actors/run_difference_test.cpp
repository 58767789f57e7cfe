#include "programs/godwit-trace/actors/run_difference.hpp"

#include <gtest/gtest.h>

#include "programs/godwit-trace/commands.hpp"
#include "tests/programs/godwit-trace/actors/command_fixture.hpp"
#include "tests/programs/godwit-trace/actors/small_flight.hpp"

namespace godwit::trace_tool {
namespace run_difference_test {

struct row {
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  const char* actor = "";
  const char* sender = "";
  const char* body = "";
};

compared_run run_of(const std::vector<row>& rows, std::vector<std::string> ignored = {}, std::int64_t begin_ns = 0) {
  runtime::name_table names;
  compared_run result(std::move(ignored));
  std::int64_t at_ns = begin_ns;
  for (const auto& each : rows)
    result.add({.id = each.id,
                .cause = each.cause,
                .began_ns = at_ns += 10,
                .actor = names.number(each.actor),
                .sender = names.number(each.sender),
                .type = names.number("t"),
                .body = each.body},
               names);
  return result;
}

const std::vector<row> calm{
    {1, 0, "a", "outside", "x"}, {2, 1, "b", "a", "y"}, {3, 2, "c", "b", "z"}, {4, 0, "a", "outside", "w"}};

TEST(run_difference, times_and_ids_do_not_matter) {
  auto other = calm;
  for (auto& each : other)
    each.id += 100;
  EXPECT_FALSE(first_difference(run_of(calm), run_of(other, {}, 5'000)).has_value());
}

TEST(run_difference, how_the_senders_are_mixed_does_not_matter) {
  auto other = calm;
  std::swap(other[1], other[3]);
  EXPECT_FALSE(first_difference(run_of(calm), run_of(other)).has_value());
}

TEST(run_difference, the_first_cause_is_named_and_not_its_symptoms) {
  auto other = calm;
  other[1].body = "Y";
  other[2].body = "Z";
  const auto found = first_difference(run_of(calm), run_of(other));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->stream, "b <- a");
  EXPECT_EQ(found->a_number, 1U);
  EXPECT_EQ(found->b_number, 1U);
  EXPECT_EQ(found->streams_that_differ, 2U);
}

TEST(run_difference, a_symptom_that_seems_older_is_followed_back_to_its_cause) {
  const std::vector<row> a{{3, 2, "c", "b", "z"}, {2, 1, "b", "a", "y"}}; // the clocks of two threads
  const std::vector<row> b{{3, 2, "c", "b", "Z"}, {2, 1, "b", "a", "Y"}};
  const auto found = first_difference(run_of(a), run_of(b));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->stream, "b <- a");
  EXPECT_EQ(found->a_symptoms.size(), 1U);
}

TEST(run_difference, what_is_missing_on_either_side_is_a_difference) {
  auto shorter = calm;
  shorter.pop_back();
  const auto in_b = first_difference(run_of(calm), run_of(shorter));
  ASSERT_TRUE(in_b.has_value());
  EXPECT_EQ(in_b->a_number, 3U);
  EXPECT_FALSE(in_b->b_number.has_value());
  const auto in_a = first_difference(run_of(shorter), run_of(calm));
  ASSERT_TRUE(in_a.has_value());
  EXPECT_FALSE(in_a->a_number.has_value());
  EXPECT_EQ(in_a->b_number, 3U);
  const auto stream = first_difference(run_of({calm[0]}), run_of({calm[0], calm[1]}));
  ASSERT_TRUE(stream.has_value());
  EXPECT_EQ(stream->stream, "b <- a");
}

TEST(run_difference, ignored_fields_are_ignored_at_any_depth) {
  const std::vector<row> a{{1, 0, "a", "b", R"({"n":1,"in":[{"at":5,"m":2}]})"}};
  const std::vector<row> b{{1, 0, "a", "b", R"({"n":1,"in":[{"at":6,"m":2}]})"}};
  EXPECT_TRUE(first_difference(run_of(a), run_of(b)).has_value());
  EXPECT_FALSE(first_difference(run_of(a, {"at"}), run_of(b, {"at"})).has_value());
}

TEST(diff_command, says_the_message_and_the_fields_that_differ) {
  const tests::trace_folder before;
  const tests::trace_folder after;
  auto changed = tests::first_run();
  changed[4].body = R"({"command":400,"param1":0,"param2":0})";
  tests::write_flight(before.path(), tests::first_run(), {});
  tests::write_flight(after.path(), changed, {});
  const auto same = test::run_command(add_diff_command, {before.path().string(), before.path().string()});
  EXPECT_EQ(same.code, exit_code::ok);
  EXPECT_NE(same.out.find("the same: 12 messages"), std::string::npos);
  const auto other = test::run_command(add_diff_command, {before.path().string(), after.path().string()});
  EXPECT_EQ(other.code, exit_code::failed);
  EXPECT_NE(other.out.find("message 1 of vehicle_link <- executor"), std::string::npos) << other.out;
  EXPECT_NE(other.out.find("/param1: 1 in A, 0 in B"), std::string::npos) << other.out;
}

} // namespace run_difference_test
} // namespace godwit::trace_tool
