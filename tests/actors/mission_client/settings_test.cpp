#include "actors/mission_client/settings.hpp"

#include <gtest/gtest.h>

namespace settings_test {

using namespace godwit::mission_client;

TEST(mission_client_settings, the_defaults_can_be_used) { EXPECT_FALSE(objection_to({})); }

TEST(mission_client_settings, what_the_contract_or_reason_forbids_is_objected_to) {
  settings given;
  given.max_tries = 0;
  EXPECT_TRUE(objection_to(given));
  given = {};
  given.total_timeout = given.call_timeout / 2;
  EXPECT_TRUE(objection_to(given));
  given = {};
  given.poll_wait = std::chrono::seconds(0);
  EXPECT_TRUE(objection_to(given));
  given = {};
  given.page_limit = 2'001;
  EXPECT_TRUE(objection_to(given));
  given = {};
  given.batch_limit = 501;
  EXPECT_TRUE(objection_to(given));
}

} // namespace settings_test
