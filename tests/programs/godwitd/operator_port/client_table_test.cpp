#include "programs/godwitd/operator_port/client_table.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace client_table_test {

using namespace godwit;
using namespace godwit::operator_port;
using boost::asio::ip::make_address;

TEST(client_table, has_a_bound_for_all_and_one_for_each_address) {
  const auto table = std::make_shared<client_table>(3, 2);
  std::vector<std::shared_ptr<io::http::client_place>> places{table->admit(make_address("10.0.0.1")),
                                                              table->admit(make_address("10.0.0.1"))};
  for (const auto& each : places)
    each->prove("s1");
  EXPECT_EQ(table->admit(make_address("10.0.0.1")), nullptr) << "two from there";
  places.push_back(table->admit(make_address("10.0.0.2")));
  ASSERT_NE(places.back(), nullptr);
  places.back()->prove("s2");
  EXPECT_EQ(table->admit(make_address("10.0.0.3")), nullptr) << "three in all";
  EXPECT_EQ(table->now(), 3U);
}

TEST(client_table, a_place_is_free_again_when_it_is_given_back) {
  const auto table = std::make_shared<client_table>(1, 1);
  auto place = table->admit(make_address("::1"));
  place->prove("s1");
  EXPECT_EQ(table->admit(make_address("::1")), nullptr);
  place.reset();
  EXPECT_EQ(table->now(), 0U);
  EXPECT_NE(table->admit(make_address("::1")), nullptr);
}

TEST(client_table, an_ipv6_network_of_64_bits_has_the_share_of_one_address) {
  const auto table = std::make_shared<client_table>(4, 2);
  const std::vector<std::shared_ptr<io::http::client_place>> places{table->admit(make_address("2001:db8:1:2::1")),
                                                                    table->admit(make_address("2001:db8:1:2:ffff::9"))};
  ASSERT_NE(places.back(), nullptr);
  for (const auto& each : places)
    each->prove("s1");
  EXPECT_EQ(table->admit(make_address("2001:db8:1:2::77")), nullptr);
  EXPECT_NE(table->admit(make_address("2001:db8:1:3::1")), nullptr);
}

TEST(client_table, an_ipv4_client_of_an_ipv6_socket_has_the_share_of_its_ipv4_address) {
  const auto table = std::make_shared<client_table>(4, 1);
  const auto place = table->admit(make_address("::ffff:10.0.0.1"));
  place->prove("s1");
  EXPECT_EQ(table->admit(make_address("10.0.0.1")), nullptr);
  EXPECT_NE(table->admit(make_address("::ffff:10.0.0.2")), nullptr);
}

// A connection that is noted when it is ended.
struct held {
  held(const std::shared_ptr<client_table>& table, const std::string& from) : place(table->admit(make_address(from))) {
    if (place)
      place->end_connection = [this] { has_ended = true; };
  }
  std::shared_ptr<io::http::client_place> place;
  bool has_ended = false;
};

TEST(client_table, the_last_places_are_kept_for_this_computer) {
  const auto table = std::make_shared<client_table>(8, 8);
  std::vector<std::unique_ptr<held>> others;
  for (int i = 0; i < 20; ++i)
    others.push_back(std::make_unique<held>(table, "10.0.0." + std::to_string(i)));
  EXPECT_EQ(table->now(), 7U);
  const held here(table, "127.0.0.1");
  ASSERT_NE(here.place, nullptr);
  for (int i = 0; i < 20; ++i)
    others.push_back(std::make_unique<held>(table, "10.0.1." + std::to_string(i)));
  EXPECT_FALSE(here.has_ended) << "it gives way to nobody from elsewhere";
}

TEST(client_table, when_all_are_taken_the_longest_without_a_session_gives_way_and_nobody_with_one) {
  const auto table = std::make_shared<client_table>(8, 8);
  held anna(table, "10.0.0.1");
  anna.place->prove("s1");
  std::vector<std::unique_ptr<held>> idle;
  for (int i = 0; i < 6; ++i)
    idle.push_back(std::make_unique<held>(table, "10.0.0.9"));
  const held bob(table, "10.0.0.2");
  ASSERT_NE(bob.place, nullptr);
  EXPECT_TRUE(idle[0]->has_ended);
  EXPECT_FALSE(idle[1]->has_ended);
  EXPECT_FALSE(anna.has_ended);
  EXPECT_EQ(table->gave_way(), 1U);
  for (auto& each : idle)
    each->place->prove("s2");
  bob.place->prove("s3");
  EXPECT_EQ(held(table, "10.0.0.3").place, nullptr) << "all have a session";
}

TEST(client_table, addresses_that_hold_all_places_and_come_again_at_once_do_not_displace_who_comes_from_another) {
  const auto table = std::make_shared<client_table>(48, 24);
  std::vector<std::unique_ptr<held>> attack;
  const auto come_again = [&](int times) {
    for (int i = 0; i < times; ++i)
      attack.push_back(
          std::make_unique<held>(table, i % 2 == 0 ? "2001:db8:1::1" : "2001:db8:2::" + std::to_string(i + 1)));
  };
  come_again(100);
  const held anna(table, "10.0.0.1");
  ASSERT_NE(anna.place, nullptr);
  come_again(1'000); // while she shakes hands and logs in
  EXPECT_FALSE(anna.has_ended);
}

TEST(client_table, an_address_that_has_its_share_displaces_its_own_alone) {
  const auto table = std::make_shared<client_table>(8, 2);
  const held other(table, "10.0.0.2");
  held first(table, "10.0.0.1");
  held second(table, "10.0.0.1");
  first.place->prove("s1");
  const held third(table, "10.0.0.1");
  ASSERT_NE(third.place, nullptr);
  EXPECT_TRUE(second.has_ended);
  EXPECT_FALSE(first.has_ended);
  EXPECT_FALSE(other.has_ended);
}

TEST(client_table, all_websockets_of_a_session_end_with_it_and_who_logs_out_gets_an_answer) {
  const auto table = std::make_shared<client_table>(8, 8);
  held anna(table, "10.0.0.1");
  held also(table, "10.0.0.2");
  held asks(table, "10.0.0.2");
  held bob(table, "10.0.0.1");
  for (auto* each : {&anna, &also, &bob})
    each->place->is_websocket = true;
  for (auto* each : {&anna, &also, &asks})
    each->place->prove("s1");
  bob.place->prove("s2");
  table->end_session("s1");
  EXPECT_TRUE(anna.has_ended);
  EXPECT_TRUE(also.has_ended);
  EXPECT_FALSE(asks.has_ended);
  EXPECT_FALSE(bob.has_ended);
}

} // namespace client_table_test
