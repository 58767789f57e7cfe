#include "runtime/trace/reading/record_parser.hpp"

#include <gtest/gtest.h>

namespace record_parser_test {

using namespace godwit::runtime;

constexpr std::string_view rendered =
    R"({"id":7,"cause":3,"actor":"executor","incarnation":2,"sender":"failsafe","duration_ns":1500,)"
    R"("outcome":"crashed","message":{"a":"}","b":[1,{}]}})";

TEST(record_parser, what_the_renderer_writes_is_taken_apart_in_place) {
  record_parser parser;
  record_fields fields;
  ASSERT_TRUE(parser.parse(rendered, fields));
  EXPECT_EQ(fields.id, 7U);
  EXPECT_EQ(fields.cause, 3U);
  EXPECT_EQ(fields.actor, "executor");
  EXPECT_EQ(fields.incarnation, 2U);
  EXPECT_EQ(fields.sender, "failsafe");
  EXPECT_EQ(fields.duration_ns, 1500);
  EXPECT_EQ(fields.how, outcome::crashed);
  EXPECT_FALSE(fields.oversize);
  EXPECT_EQ(fields.body, R"({"a":"}","b":[1,{}]})");
  EXPECT_EQ(fields.body.data(), rendered.data() + rendered.find(R"({"a")"));
}

TEST(record_parser, a_message_that_was_too_long_has_no_body) {
  record_parser parser;
  record_fields fields;
  ASSERT_TRUE(parser.parse(R"({"id":7,"cause":3,"actor":"a","incarnation":2,"sender":"b","duration_ns":1,)"
                           R"("outcome":"handled","oversize":true})",
                           fields));
  EXPECT_TRUE(fields.oversize);
  EXPECT_TRUE(fields.body.empty());
}

TEST(record_parser, the_clocks_of_the_handler_are_read_and_are_0_where_they_are_not_there) {
  record_parser parser;
  record_fields fields;
  ASSERT_TRUE(parser.parse(R"({"id":7,"cause":3,"actor":"a","incarnation":2,"sender":"b","duration_ns":1,)"
                           R"("clock_offset_ns":250,"wall_offset_ns":-3,"outcome":"handled","message":{}})",
                           fields));
  EXPECT_EQ(fields.clock_offset_ns, 250);
  EXPECT_EQ(fields.wall_offset_ns, -3);
  ASSERT_TRUE(
      parser.parse(R"({"wall_offset_ns":5,"clock_offset_ns":4,"outcome":"handled","sender":"b","duration_ns":9,)"
                   R"("message":{},"id":1,"cause":0,"actor":"c","incarnation":4})",
                   fields));
  EXPECT_EQ(fields.clock_offset_ns, 4);
  EXPECT_EQ(fields.wall_offset_ns, 5);
  ASSERT_TRUE(parser.parse(rendered, fields));
  EXPECT_EQ(fields.clock_offset_ns, 0);
  EXPECT_EQ(fields.wall_offset_ns, 0);
}

TEST(record_parser, another_order_and_escapes_mean_the_same) {
  record_parser parser;
  record_fields fields;
  ASSERT_TRUE(parser.parse(R"({ "outcome": "fenced", "sender": "a\"b", "duration_ns": 9, "message": {"x": 1},
                               "id": 1, "cause": 0, "actor": "c", "incarnation": 4 })",
                           fields));
  EXPECT_EQ(fields.sender, "a\"b");
  EXPECT_EQ(fields.how, outcome::fenced);
  EXPECT_EQ(fields.body, R"({"x":1})");
}

// The message itself is not looked at: a cut at a brace within it is not seen here. The checksum of the chunk sees it.
TEST(record_parser, what_is_no_record_is_refused_at_every_cut_and_every_flip) {
  record_parser parser;
  record_fields fields;
  for (std::size_t n = 0; n < rendered.size(); ++n)
    EXPECT_EQ(parser.parse(rendered.substr(0, n), fields), n > rendered.find("message") && rendered[n - 1] == '}') << n;
  for (std::size_t n = 0; n < rendered.size(); ++n) {
    std::string damaged(rendered);
    damaged[n] = static_cast<char>(damaged[n] ^ 0x21);
    (void)parser.parse(damaged, fields); // whatever it says, it reads nothing that is not there
  }
  for (const auto* each : {"", "{}", "[]", "null", R"({"id":"7"})", R"({"id":-1,"cause":0})"})
    EXPECT_FALSE(parser.parse(each, fields)) << each;
}

} // namespace record_parser_test
