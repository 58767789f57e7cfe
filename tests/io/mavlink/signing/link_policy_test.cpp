#include "io/mavlink/signing/link_policy.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/messages.hpp"

namespace godwit::io::mavlink::test {
namespace link_policy_test {

TEST(mavlink_link_policy, lets_only_the_status_of_the_radio_through_by_default) {
  const unsigned_policy policy;
  EXPECT_TRUE(policy.lets_through(radio_status::message_id));
  EXPECT_FALSE(policy.lets_through(heartbeat::message_id));
  EXPECT_FALSE(policy.lets_through(setup_signing::message_id));
}

TEST(mavlink_link_policy, a_list_of_ids_replaces_the_default) {
  const std::array<std::uint32_t, 2> ids{heartbeat::message_id, 16'777'215};
  const auto policy = unsigned_policy::only(ids);
  ASSERT_TRUE(policy);
  EXPECT_TRUE(policy->lets_through(heartbeat::message_id));
  EXPECT_TRUE(policy->lets_through(16'777'215));
  EXPECT_FALSE(policy->lets_through(radio_status::message_id));
  EXPECT_FALSE(unsigned_policy::only({})->lets_through(0));
}

TEST(mavlink_link_policy, a_list_above_the_bound_is_refused) {
  std::array<std::uint32_t, max_unsigned_ids + 1> ids{};
  EXPECT_FALSE(unsigned_policy::only(ids));
  EXPECT_TRUE(unsigned_policy::only(std::span(ids).first<max_unsigned_ids>()));
}

TEST(mavlink_link_policy, all_is_all) {
  EXPECT_TRUE(unsigned_policy::accept_all().lets_through(heartbeat::message_id));
}

TEST(mavlink_link_policy, the_key_goes_out_over_a_secure_link_only) {
  EXPECT_FALSE(may_go_out(setup_signing::message_id, link_security::open));
  EXPECT_TRUE(may_go_out(setup_signing::message_id, link_security::secure));
  EXPECT_TRUE(may_go_out(heartbeat::message_id, link_security::open));
}

TEST(mavlink_link_policy, the_key_goes_into_no_log) {
  EXPECT_FALSE(may_be_logged(setup_signing::message_id));
  EXPECT_TRUE(may_be_logged(heartbeat::message_id));
}

} // namespace link_policy_test
} // namespace godwit::io::mavlink::test
