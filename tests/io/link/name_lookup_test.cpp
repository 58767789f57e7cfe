#include "io/link/name_lookup.hpp"

#include <future>

#include <boost/asio/executor_work_guard.hpp>
#include <gtest/gtest.h>

#include "tests/io/link/watcher.hpp"

namespace godwit::io::link {
namespace name_lookup_test {

namespace asio = boost::asio;

// A name server that does not answer before it is told to.
struct stuck_server {
  std::promise<void> answer;
  std::shared_future<void> answered = answer.get_future().share();

  [[nodiscard]] blocking_lookup lookup() const {
    return [until = answered](const std::string&) -> found_addresses {
      until.wait();
      return std::vector<asio::ip::address>{asio::ip::address_v4::loopback()};
    };
  }
};

TEST(link_name_lookup, an_address_needs_no_looking_up) {
  asio::io_context io;
  name_lookup lookup(io, [](const std::string&) -> found_addresses { return tl::make_unexpected("asked"); });
  for (const char* text : {"127.0.0.1", "::1"}) {
    std::string found;
    lookup.start(text, [&](const found_addresses& addresses) { found = addresses.value().front().to_string(); });
    EXPECT_EQ(found, text);
  }
}

TEST(link_name_lookup, the_systems_own_names_are_found_ipv4_first) {
  const auto found = ask_system("localhost");
  ASSERT_TRUE(found) << found.error();
  EXPECT_EQ(found->front(), asio::ip::make_address("127.0.0.1"));
}

TEST(link_name_lookup, the_answer_comes_in_the_thread_that_runs_the_context) {
  asio::io_context io;
  const auto work = asio::make_work_guard(io);
  stuck_server server;
  name_lookup lookup(io, server.lookup(), std::make_shared<lookup_places>());
  bool done = false;
  lookup.start("gcs", [&](const found_addresses& addresses) { done = addresses.has_value(); });
  EXPECT_EQ(io.poll(), 0U);
  server.answer.set_value();
  EXPECT_EQ(io.run_one_for(testing::patience), 1U);
  EXPECT_TRUE(done);
}

TEST(link_name_lookup, a_lookup_that_hangs_holds_nobody_up_and_its_late_answer_is_thrown_away) {
  stuck_server server;
  bool done = false;
  {
    asio::io_context io;
    name_lookup lookup(io, server.lookup(), std::make_shared<lookup_places>());
    lookup.start("gcs", [&](const found_addresses&) { done = true; });
  }
  server.answer.set_value();
  EXPECT_FALSE(done);
}

TEST(link_name_lookup, lookups_that_hang_are_bounded_and_their_places_come_back) {
  const auto places = std::make_shared<lookup_places>();
  stuck_server server;
  asio::io_context io;
  std::vector<std::unique_ptr<name_lookup>> lookups;
  std::vector<std::string> refusals;
  for (int n = 0; n <= lookup_places::max_under_way; ++n) {
    lookups.push_back(std::make_unique<name_lookup>(io, server.lookup(), places));
    lookups.back()->start("gcs", [&](const found_addresses& addresses) { refusals.push_back(addresses.error()); });
  }
  EXPECT_EQ(refusals,
            std::vector<std::string>{"gcs: too many host names are being looked up; is the name server down?"});
  lookups.clear();
  EXPECT_FALSE(places->take()) << "who gave up has left his thread behind";
  server.answer.set_value();
  for (int n = 0; n < lookup_places::max_under_way; ++n)
    EXPECT_TRUE(testing::eventually([&] { return places->take(); }));
}

} // namespace name_lookup_test
} // namespace godwit::io::link
