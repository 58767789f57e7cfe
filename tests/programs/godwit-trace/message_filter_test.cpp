#include "programs/godwit-trace/message_filter.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace message_filter_test {

using namespace io::mavlink;

TEST(message_filter, empty_lists_want_all) {
  EXPECT_TRUE(message_filter().wants(frame_of(heartbeat{}, 0, {255, 0}).view()));
  EXPECT_TRUE(message_filter({}, {}, {}).wants_sender({0, 255}));
}

TEST(message_filter, name_system_and_component_must_all_be_wanted) {
  const std::vector<std::string> names{"HEARTBEAT"};
  const std::vector<std::uint8_t> systems{1, 255};
  const std::vector<std::uint8_t> components{1};
  const message_filter filter(*name_filter::parse(names), systems, components);
  EXPECT_TRUE(filter.wants(frame_of(heartbeat{}, 0, {1, 1}).view()));
  EXPECT_TRUE(filter.wants(frame_of(heartbeat{}, 0, {255, 1}).view()));
  EXPECT_FALSE(filter.wants(frame_of(heartbeat{}, 0, {2, 1}).view()));
  EXPECT_FALSE(filter.wants(frame_of(heartbeat{}, 0, {1, 2}).view()));
  EXPECT_FALSE(filter.wants(frame_of(attitude{}, 0, {1, 1}).view()));
  EXPECT_TRUE(filter.wants_sender({1, 1}));
}

} // namespace message_filter_test
} // namespace godwit::trace_tool::test
