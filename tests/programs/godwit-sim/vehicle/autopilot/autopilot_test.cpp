#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

#include <gtest/gtest.h>

namespace godwit::sim {
namespace refused_orders_test {

TEST(refused_orders, are_refused_so_many_times) {
  refused_orders orders;
  orders.refuse(300, 2, 2);
  EXPECT_EQ(orders.take(300), 2);
  EXPECT_EQ(orders.take(400), std::nullopt);
  EXPECT_EQ(orders.take(300), 2);
  EXPECT_EQ(orders.take(300), std::nullopt);
}

TEST(refused_orders, are_refused_from_now_on_until_they_no_longer_are) {
  refused_orders orders;
  orders.refuse(300, 4, -1);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(orders.take(300), 4);
  orders.refuse(300, 4, 0);
  EXPECT_EQ(orders.take(300), std::nullopt);
}

} // namespace refused_orders_test
} // namespace godwit::sim
