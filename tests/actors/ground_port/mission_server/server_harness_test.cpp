// The harness of the fuzzer finds defects: each is planted, and a short run from the kept inputs must meet it.
#include "tests/fuzz/mission_server_harness.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server::fuzz {
namespace server_harness_test {

using bytes = std::vector<std::uint8_t>;

constexpr int rounds = 200; // changes of each input

std::vector<bytes> kept_inputs() {
  std::set<std::filesystem::path> files; // the order of a folder is not the same everywhere
  for (const auto& each : std::filesystem::directory_iterator(GODWIT_TEST_DATA "/fuzz/mission_server"))
    files.insert(each.path());
  std::vector<bytes> result;
  for (const auto& each : files) {
    std::ifstream file(each, std::ios::binary);
    result.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return result;
}

// The first finding of a run that is the same every time.
template <class Server>
std::optional<std::string> first_finding() {
  std::mt19937 random(13);
  for (const auto& kept : kept_inputs())
    for (int round = 0; round < rounds; ++round) {
      auto changed = kept;
      for (int i = 0; i < round % 5; ++i)
        changed.at(random() % changed.size()) = static_cast<std::uint8_t>(random());
      if (auto found = run<Server>(changed).play())
        return found;
    }
  return std::nullopt;
}

TEST(server_harness, finds_nothing_in_the_server) { EXPECT_EQ(first_finding<server>(), std::nullopt); }

struct never_gives_up : server {
  never_gives_up(server_profile vehicle, mavlink::sender self) : server((vehicle.gives_up_ns *= 2, vehicle), self) {}
};
TEST(server_harness, finds_one_that_waits_too_long) {
  EXPECT_EQ(first_finding<never_gives_up>(), "not idle after 10 s of silence");
}

struct has_more_room : server {
  has_more_room(server_profile vehicle, mavlink::sender self) : server((vehicle.capacity += 1, vehicle), self) {}
};
TEST(server_harness, finds_one_that_takes_too_much) {
  EXPECT_EQ(first_finding<has_more_room>(), "a plan for which there is no room");
}

struct is_not_atomic : server {
  is_not_atomic(server_profile vehicle, mavlink::sender self) : server((vehicle.is_atomic = false, vehicle), self) {}
};
TEST(server_harness, finds_one_that_replaces_item_by_item) {
  EXPECT_EQ(first_finding<is_not_atomic>(), "an atomic plan was cut");
}

struct tells_no_change : server {
  using server::server;
  reaction on(mavlink::sender from, const incoming& what, std::int64_t now_ns) {
    auto result = server::on(from, what, now_ns);
    result.changes.clear();
    return result;
  }
};
TEST(server_harness, finds_one_that_changes_its_plan_without_a_word) {
  EXPECT_EQ(first_finding<tells_no_change>(), "not the plan that was completed last");
}

struct answers_everybody : server {
  using server::server;
  reaction on(mavlink::sender from, const incoming& what, std::int64_t now_ns) {
    auto result = server::on(from, what, now_ns);
    for (auto& each : result.messages)
      std::visit([](auto& m) { m.target_component = 77; }, each);
    return result;
  }
};
TEST(server_harness, finds_one_that_answers_somebody_else) {
  EXPECT_EQ(first_finding<answers_everybody>(), "an answer to somebody who has said nothing");
}

struct is_late : server {
  using server::server;
  reaction on_time(std::int64_t /*now_ns*/) { return {}; }
};
TEST(server_harness, finds_one_that_does_nothing_at_its_deadline) {
  EXPECT_EQ(first_finding<is_late>(), "nothing was done at a deadline");
}

} // namespace server_harness_test
} // namespace godwit::ground_port::mission_server::fuzz
