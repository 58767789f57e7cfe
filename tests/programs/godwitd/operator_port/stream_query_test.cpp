#include "programs/godwitd/operator_port/stream_query.hpp"

#include <gtest/gtest.h>

namespace stream_query_test {

using namespace godwit::operator_port;
using godwit::telemetry_stream::topic;

TEST(stream_query, names_topics_each_with_how_often_a_second_at_most) {
  const auto read = read_topics("/api/v1/stream?topics=position@5,flight,attitude@0.5");
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->size(), 3U);
  EXPECT_EQ((*read)[0].what, topic::position);
  EXPECT_EQ((*read)[0].interval_ns, 200'000'000);
  EXPECT_EQ((*read)[1].what, topic::flight);
  EXPECT_EQ((*read)[1].interval_ns, 0);
  EXPECT_EQ((*read)[2].interval_ns, 2'000'000'000);
}

TEST(stream_query, without_a_word_it_is_all_topics) {
  EXPECT_EQ(read_topics("/api/v1/stream")->size(), godwit::telemetry_stream::topic_count);
}

TEST(stream_query, what_is_wrong_is_named_with_what_there_is_and_without_foreign_text) {
  for (const auto* wrong :
       {"?", "?topics", "?topics=", "?topics=positions", "?topics=position@", "?topics=position@0",
        "?topics=position@-1", "?topics=position@1e9", "?topics=position@nan", "?topics=position@1x",
        "?topics=position&x=1", "?x=1", "?topics=,", "?topics=position,,flight"})
    EXPECT_FALSE(read_topics(std::string("/s") + wrong)) << wrong;
  EXPECT_NE(read_topics("/s?topics=positions").error().find("no topic positions; there are clock, link, position"),
            std::string::npos);
  EXPECT_EQ(read_topics("/s?topics=%22<script>").error().find('<'), std::string::npos);
  std::string many = "/s?topics=";
  for (int i = 0; i < 100; ++i)
    many += "log,";
  EXPECT_FALSE(read_topics(many));
}

} // namespace stream_query_test
