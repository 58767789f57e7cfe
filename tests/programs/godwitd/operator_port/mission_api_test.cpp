#include "programs/godwitd/operator_port/mission_api.hpp"

#include <atomic>
#include <future>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace godwit::operator_port {
namespace background_worker_test {

// Keeps the worker busy until it is released.
class busy {
public:
  std::function<void()> work() {
    return [released = released_.get_future().share()] { released.wait(); };
  }
  void release() { released_.set_value(); }

private:
  std::promise<void> released_;
};

TEST(background_worker, runs_one_after_the_other_in_a_thread_of_its_own) {
  background_worker worker;
  std::promise<std::thread::id> first;
  std::promise<std::thread::id> second;
  ASSERT_TRUE(worker.run("anna", [&] { first.set_value(std::this_thread::get_id()); }));
  ASSERT_TRUE(worker.run("anna", [&] { second.set_value(std::this_thread::get_id()); }));
  const auto where = first.get_future().get();
  EXPECT_NE(where, std::this_thread::get_id());
  EXPECT_EQ(second.get_future().get(), where);
}

TEST(background_worker, an_address_has_its_share_and_all_together_a_bound) {
  busy first;
  std::atomic<std::size_t> ran = 0;
  background_worker worker;
  const auto count = [&ran] { ++ran; };
  ASSERT_TRUE(worker.run("a", first.work()));
  std::size_t taken = 1;
  for (std::size_t i = 1; i < background_worker::max_waiting_of_one; ++i, ++taken)
    EXPECT_TRUE(worker.run("a", count));
  EXPECT_FALSE(worker.run("a", count));
  for (; taken < background_worker::max_waiting; ++taken)
    EXPECT_TRUE(worker.run(std::to_string(taken), count));
  EXPECT_FALSE(worker.run("another", count));
  first.release();
  std::promise<void> after;
  while (!worker.run("another", [&after] { after.set_value(); }))
    std::this_thread::yield(); // until a place is free
  after.get_future().wait();
  EXPECT_EQ(ran, background_worker::max_waiting - 1);
}

} // namespace background_worker_test
} // namespace godwit::operator_port
