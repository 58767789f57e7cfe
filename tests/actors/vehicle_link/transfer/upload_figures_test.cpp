// What the windowed upload promises, held against vehicles with the timing of real ones: 200 seeds each, virtual time.
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/upload_figures.hpp"

namespace godwit::tests {
namespace upload_figures_test {

constexpr int seeds = 200;

// Items sent, of those in the plan. At 20 % each item costs 1.25 sendings; what was sent after a lost one is the rest.
constexpr double most_sent = 3;

struct promise {
  double loss;
  double at_most_s; // median
};

void holds_promise(const upload_peer& peer, const promise& each, int items, int runs) {
  const auto measured = measure_uploads(peer, network(each.loss), items, runs);
  ::testing::Test::RecordProperty(std::string(peer.name) + "_" + std::to_string(items) + "_" +
                                      std::to_string(static_cast<int>(each.loss * 100)) + "_ms",
                                  static_cast<int>(measured.median_s * 1e3));
  EXPECT_LE(measured.median_s, each.at_most_s) << peer.name << ", loss " << each.loss;
  EXPECT_LE(measured.sent_ratio, each.loss == 0 ? 1 : most_sent) << peer.name << ", loss " << each.loss;
  EXPECT_EQ(measured.failures, 0) << peer.name << ", loss " << each.loss;
  EXPECT_EQ(measured.untruthful, 0) << peer.name << ", loss " << each.loss;
}

TEST(upload_figures, px4_takes_100_items_in_five_round_trips_and_in_one_and_a_half_seconds_at_20_percent_loss) {
  for (const promise& each : {promise{0, 0.151}, promise{0.05, 0.35}, promise{0.1, 0.7}, promise{0.2, 1.5}})
    holds_promise(px4_peer(), each, 100, seeds);
}

// What the vehicle repeats by itself is no round trip, and the round trip is known soon though all is sent repeatedly.
TEST(upload_figures, the_slowest_of_200_uploads_at_20_percent_loss_takes_three_times_as_long_and_no_more) {
  EXPECT_LE(measure_uploads(px4_peer(), network(0.2), 100, seeds).worst_s, 4.5);
  EXPECT_LE(measure_uploads(copter_peer(), network(0.2), 100, seeds).worst_s, 9);
}

TEST(upload_figures, copter_takes_100_items_at_one_message_a_turn) {
  for (const promise& each : {promise{0, 0.3}, promise{0.05, 0.95}, promise{0.1, 1.55}, promise{0.2, 3.2}})
    holds_promise(copter_peer(), each, 100, seeds);
}

TEST(upload_figures, rover_is_kept_busy_in_each_of_its_turns) { holds_promise(rover_peer(), {0, 2.3}, 100, seeds); }

TEST(upload_figures, a_thousand_items_take_ten_times_as_long_and_no_more) {
  constexpr int runs = 20;
  for (const promise& each : {promise{0, 0.8}, promise{0.05, 2.5}, promise{0.1, 5}, promise{0.2, 12}})
    holds_promise(px4_peer(), each, 1'000, runs);
  for (const promise& each : {promise{0, 3}, promise{0.05, 10}, promise{0.1, 15}, promise{0.2, 28}})
    holds_promise(copter_peer(), each, 1'000, runs);
  holds_promise(rover_peer(), {0, 23}, 1'000, runs);
}

TEST(upload_figures, a_slow_half_duplex_line_is_filled_and_hardly_more_is_sent_over_it) {
  constexpr double line_time_s = 1.2; // of 100 items and their requests, at 57600 baud
  for (const auto& peer : {px4_peer(), copter_peer()}) {
    SCOPED_TRACE(peer.name);
    const auto clean = measure_uploads(peer, radio(0), 100, 5);
    EXPECT_LE(clean.median_s, 1.25 * line_time_s);
    const auto thousand = measure_uploads(peer, radio(0), 1'000, 2);
    EXPECT_LE(thousand.median_s, 1.25 * 11.6);
    for (const double loss : {0.0, 0.05}) {
      const auto ahead = measure_uploads(peer, radio(loss), 100, seeds);
      const auto one_by_one = measure_uploads(request_by_request(peer), radio(loss), 100, seeds);
      EXPECT_EQ(ahead.failures, 0);
      EXPECT_EQ(ahead.untruthful, 0);
      EXPECT_LE(ahead.median_bytes, 1.5 * one_by_one.median_bytes) << "loss " << loss;
    }
  }
}

// What goes over the line until all is sent; what resolving costs depends on which acknowledgement was lost.
std::vector<double> bytes_of_uploads(const upload_peer& peer, double loss, int items, int runs) {
  std::vector<double> result;
  for (int seed = 1; seed <= runs; ++seed) {
    transfer_world world(peer.server_profile, peer.profile, radio(loss), static_cast<std::uint64_t>(seed));
    (void)world.upload(mission_of(items, static_cast<std::uint64_t>(seed)));
    const auto until_settling = world.ours().bytes_when_settling;
    result.push_back(static_cast<double>(until_settling != 0 ? until_settling : world.ours().line.bytes()));
  }
  return result;
}

TEST(upload_figures, no_single_upload_over_a_slow_line_sends_half_again_as_much_as_request_by_request) {
  for (const auto& peer : {px4_peer(), copter_peer()}) {
    SCOPED_TRACE(peer.name);
    for (const auto& [items, runs] : {std::pair{100, seeds}, std::pair{1'000, 20}}) {
      const auto one_by_one = bytes_of_uploads(request_by_request(peer), 0.05, items, runs);
      const auto mean = std::accumulate(one_by_one.begin(), one_by_one.end(), 0.0) / runs;
      for (const double bytes : bytes_of_uploads(peer, 0.05, items, runs))
        EXPECT_LE(bytes, 1.5 * mean);
    }
  }
}

} // namespace upload_figures_test
} // namespace godwit::tests
