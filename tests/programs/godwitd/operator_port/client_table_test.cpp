#include "programs/godwitd/operator_port/client_table.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace client_table_test {

using namespace godwit::operator_port;
using boost::asio::ip::make_address;

TEST(client_table, has_a_bound_for_all_and_one_for_each_address) {
  const auto table = std::make_shared<client_table>(3, 2);
  std::vector<std::shared_ptr<void>> places{table->admit(make_address("10.0.0.1")),
                                            table->admit(make_address("10.0.0.1"))};
  EXPECT_EQ(table->admit(make_address("10.0.0.1")), nullptr) << "two from there";
  places.push_back(table->admit(make_address("10.0.0.2")));
  EXPECT_NE(places.back(), nullptr);
  EXPECT_EQ(table->admit(make_address("10.0.0.3")), nullptr) << "three in all";
  EXPECT_EQ(table->now(), 3U);
}

TEST(client_table, a_place_is_free_again_when_it_is_given_back) {
  const auto table = std::make_shared<client_table>(1, 1);
  auto place = table->admit(make_address("::1"));
  EXPECT_EQ(table->admit(make_address("::1")), nullptr);
  place.reset();
  EXPECT_EQ(table->now(), 0U);
  EXPECT_NE(table->admit(make_address("::1")), nullptr);
}

TEST(client_table, an_ipv6_network_of_64_bits_has_the_share_of_one_address) {
  const auto table = std::make_shared<client_table>(4, 2);
  const std::vector<std::shared_ptr<void>> places{table->admit(make_address("2001:db8:1:2::1")),
                                                  table->admit(make_address("2001:db8:1:2:ffff::9"))};
  EXPECT_NE(places.back(), nullptr);
  EXPECT_EQ(table->admit(make_address("2001:db8:1:2::77")), nullptr);
  EXPECT_NE(table->admit(make_address("2001:db8:1:3::1")), nullptr);
}

TEST(client_table, an_ipv4_client_of_an_ipv6_socket_has_the_share_of_its_ipv4_address) {
  const auto table = std::make_shared<client_table>(4, 1);
  const auto place = table->admit(make_address("::ffff:10.0.0.1"));
  EXPECT_EQ(table->admit(make_address("10.0.0.1")), nullptr);
  EXPECT_NE(table->admit(make_address("::ffff:10.0.0.2")), nullptr);
}

TEST(client_table, the_last_places_are_kept_for_this_computer) {
  const auto table = std::make_shared<client_table>(8, 8);
  std::vector<std::shared_ptr<void>> places;
  for (auto place = table->admit(make_address("10.0.0.1")); place != nullptr;
       place = table->admit(make_address("10.0.0.1")))
    places.push_back(place);
  EXPECT_EQ(places.size(), 7U);
  EXPECT_NE(table->admit(make_address("127.0.0.1")), nullptr);
}

} // namespace client_table_test
