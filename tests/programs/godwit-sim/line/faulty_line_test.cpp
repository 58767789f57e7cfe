#include "programs/godwit-sim/line/faulty_line.hpp"
#include "tests/support/time_units.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace godwit::sim {
namespace faulty_line_test {

using godwit::tests::ms;
constexpr int many = 10'000;

// A line that writes down what it delivers; a frame is its number, as eight bytes.
struct listened_line {
  struct arrival {
    way to;
    std::uint64_t number;
    std::int64_t at_ns;
    bool is_damaged;
    bool operator==(const arrival&) const = default;
  };

  explicit listened_line(const std::string& faults, std::uint64_t seed = 1)
      : line(seed, [this](way to, std::span<const std::byte> frame, bool is_damaged) {
          std::uint64_t number = 0;
          std::memcpy(&number, frame.data(), sizeof number);
          arrivals.push_back({to, number, now_ns, is_damaged});
        }) {
    line.set(parse_line_faults(faults).value());
  }

  void send(way to, std::uint64_t number) { line.send(to, std::as_bytes(std::span(&number, 1)), now_ns); }
  void advance(std::int64_t by_ns) {
    const auto until = now_ns + by_ns;
    while (line.next_deadline_ns() <= until) {
      now_ns = std::max(now_ns, line.next_deadline_ns());
      line.on_time(now_ns);
    }
    now_ns = until;
  }
  // Sends so many, one each millisecond, and waits until all is over.
  void send_many(way to, int count) {
    for (int n = 0; n < count; ++n) {
      send(to, static_cast<std::uint64_t>(n));
      advance(ms);
    }
    advance(200'000 * ms);
  }
  [[nodiscard]] std::vector<std::uint64_t> numbers() const {
    std::vector<std::uint64_t> result;
    for (const auto& each : arrivals)
      result.push_back(each.number);
    return result;
  }

  std::int64_t now_ns = 0;
  std::vector<arrival> arrivals;
  faulty_line line;
};

TEST(faulty_line, a_good_line_delivers_at_once_and_has_nothing_to_wait_for) {
  listened_line on("none");
  on.send(way::out, 7);
  ASSERT_EQ(on.arrivals.size(), 1U);
  EXPECT_EQ(on.arrivals[0], (listened_line::arrival{way::out, 7, 0, false}));
  EXPECT_EQ(on.line.next_deadline_ns(), faulty_line::never);
}

TEST(faulty_line, as_many_are_lost_as_the_share_says) {
  listened_line on("loss=0.3");
  on.send_many(way::out, many);
  const auto& counted = on.line.counters(way::out);
  EXPECT_NEAR(static_cast<double>(counted.lost), 0.3 * many, 0.02 * many);
  EXPECT_EQ(counted.delivered, on.arrivals.size());
  EXPECT_EQ(counted.sent, counted.delivered + counted.lost);
}

TEST(faulty_line, a_doubled_frame_comes_twice) {
  listened_line on("dup=1");
  on.send(way::in, 1);
  on.send(way::in, 2);
  EXPECT_EQ(on.numbers(), (std::vector<std::uint64_t>{1, 1, 2, 2}));
  EXPECT_EQ(on.line.counters(way::in).duplicated, 2U);
}

TEST(faulty_line, a_delayed_frame_comes_after_its_delay_and_not_before) {
  listened_line on("delay=15ms");
  on.send(way::out, 1);
  on.advance(14 * ms);
  EXPECT_TRUE(on.arrivals.empty());
  on.advance(ms);
  ASSERT_EQ(on.arrivals.size(), 1U);
  EXPECT_EQ(on.arrivals[0].at_ns, 15 * ms);
}

TEST(faulty_line, jitter_keeps_the_order_and_stays_within_its_bound) {
  listened_line on("delay=20ms,jitter=10ms");
  on.send_many(way::out, many);
  EXPECT_TRUE(std::is_sorted(on.arrivals.begin(), on.arrivals.end(),
                             [](const auto& a, const auto& b) { return a.number < b.number; }));
  ASSERT_EQ(on.arrivals.size(), static_cast<std::size_t>(many));
  for (const auto& each : on.arrivals) {
    const auto took = each.at_ns - static_cast<std::int64_t>(each.number) * ms;
    ASSERT_GE(took, 20 * ms);
    ASSERT_LE(took, 30 * ms);
  }
}

TEST(faulty_line, a_frame_that_is_held_back_is_overtaken_and_comes_all_the_same) {
  listened_line on("reorder=0.1");
  on.send_many(way::in, many);
  EXPECT_FALSE(std::is_sorted(on.arrivals.begin(), on.arrivals.end(),
                              [](const auto& a, const auto& b) { return a.number < b.number; }));
  EXPECT_EQ(on.arrivals.size(), static_cast<std::size_t>(many));
  EXPECT_NEAR(static_cast<double>(on.line.counters(way::in).reordered), 0.1 * many, 0.02 * many);
}

TEST(faulty_line, a_late_frame_comes_a_second_and_a_half_after_those_that_overtake_it) {
  listened_line on("late=0.1");
  on.send_many(way::in, many);
  EXPECT_EQ(on.arrivals.size(), static_cast<std::size_t>(many));
  std::size_t late = 0;
  for (const auto& each : on.arrivals) {
    const auto took = each.at_ns - static_cast<std::int64_t>(each.number) * ms;
    ASSERT_TRUE(took == 0 || took == 1'500 * ms) << took;
    late += took != 0 ? 1 : 0;
  }
  EXPECT_EQ(late, on.line.counters(way::in).late);
  EXPECT_NEAR(static_cast<double>(late), 0.1 * many, 0.02 * many);
}

TEST(faulty_line, so_many_bits_are_turned_as_the_share_says_and_a_damaged_frame_is_marked) {
  std::uint64_t turned = 0;
  std::uint64_t marked = 0;
  faulty_line line(1, [&](way, std::span<const std::byte> frame, bool is_damaged) {
    std::uint64_t here = 0;
    for (const auto each : frame)
      here += static_cast<std::uint64_t>(__builtin_popcount(std::to_integer<unsigned>(each)));
    turned += here;
    marked += is_damaged ? 1 : 0;
    EXPECT_EQ(is_damaged, here != 0);
  });
  line.set(*parse_line_faults("biterrors=0.001"));
  const std::array<std::byte, 100> zeros{};
  for (int n = 0; n < many; ++n)
    line.send(way::out, zeros, 0);
  const double bits = 800.0 * many;
  EXPECT_NEAR(static_cast<double>(turned), 0.001 * bits, 0.0001 * bits);
  EXPECT_EQ(line.counters(way::out).damaged, marked);
  EXPECT_EQ(line.counters(way::out).delivered, static_cast<std::uint64_t>(many));
}

TEST(faulty_line, with_a_bit_error_share_of_one_every_bit_is_turned) {
  std::vector<std::byte> seen;
  faulty_line line(1, [&](way, std::span<const std::byte> frame, bool) { seen.assign(frame.begin(), frame.end()); });
  line.set(*parse_line_faults("biterrors=1"));
  line.send(way::out, std::array<std::byte, 3>{}, 0);
  EXPECT_EQ(seen, std::vector(3, std::byte{0xff}));
}

TEST(faulty_line, nothing_comes_through_a_line_that_is_cut_until_it_is_restored) {
  listened_line on("cut");
  on.send(way::in, 1);
  on.send(way::out, 2);
  EXPECT_TRUE(on.arrivals.empty());
  EXPECT_EQ(on.line.counters(way::in).cut, 1U);
  on.line.restore();
  on.send(way::in, 3);
  EXPECT_EQ(on.numbers(), std::vector<std::uint64_t>{3});
}

TEST(faulty_line, a_cut_for_some_time_ends_by_itself) {
  listened_line on("none");
  on.line.cut(on.now_ns + 5 * ms);
  on.send(way::out, 1);
  on.advance(5 * ms);
  EXPECT_FALSE(on.line.is_cut(way::out, on.now_ns));
  on.send(way::out, 2);
  EXPECT_EQ(on.numbers(), std::vector<std::uint64_t>{2});
}

TEST(faulty_line, one_way_can_be_cut_alone) {
  listened_line on("none");
  on.line.cut(way::in, on.now_ns + 5 * ms);
  EXPECT_TRUE(on.line.is_cut(way::in, on.now_ns));
  EXPECT_FALSE(on.line.is_cut(way::out, on.now_ns));
  on.line.restore();
  EXPECT_FALSE(on.line.is_cut(way::in, on.now_ns));
}

TEST(faulty_line, what_is_under_way_is_lost_when_it_arrives_during_a_cut) {
  listened_line on("delay=10ms");
  on.send(way::out, 1); // arrives at 10 ms, during the cut
  on.advance(ms);
  on.send(way::out, 2); // arrives at 11 ms, when it is over
  on.line.cut(on.now_ns + 10 * ms - 1);
  on.advance(20 * ms);
  EXPECT_EQ(on.numbers(), std::vector<std::uint64_t>{2});
}

TEST(faulty_line, each_way_has_its_own_faults_and_counters) {
  listened_line on("out.loss=1,in.delay=5ms");
  on.send(way::out, 1);
  on.send(way::in, 2);
  on.advance(5 * ms);
  EXPECT_EQ(on.numbers(), std::vector<std::uint64_t>{2});
  EXPECT_EQ(on.line.counters(way::out).lost, 1U);
  EXPECT_EQ(on.line.counters(way::in).lost, 0U);
}

TEST(faulty_line, what_is_under_way_is_bounded_and_what_is_too_much_is_counted) {
  listened_line on("delay=60s");
  for (std::uint64_t n = 0; n < faulty_line::max_waiting + 10; ++n)
    on.send(way::out, n);
  EXPECT_EQ(on.line.counters(way::out).overflowed, 10U);
  on.advance(60'000 * ms);
  EXPECT_EQ(on.arrivals.size(), faulty_line::max_waiting);
}

TEST(faulty_line, a_line_that_gets_better_delivers_what_is_under_way_first) {
  listened_line on("delay=10ms");
  on.send(way::out, 1);
  on.line.set({});
  on.send(way::out, 2);
  on.advance(10 * ms);
  EXPECT_EQ(on.numbers(), (std::vector<std::uint64_t>{1, 2}));
}

TEST(faulty_line, what_is_due_goes_before_what_is_sent_later_also_when_time_was_not_told) {
  listened_line on("delay=10ms");
  on.send(way::out, 1);
  on.line.set({});
  on.now_ns = 50 * ms;
  on.send(way::out, 2);
  EXPECT_EQ(on.numbers(), (std::vector<std::uint64_t>{1, 2}));
}

RC_GTEST_PROP(faulty_line_property, every_frame_is_accounted_for_and_the_same_seed_gives_the_same, ()) {
  const auto text = *rc::gen::element<std::string>("loss=0.3,dup=0.2,reorder=0.2,delay=3ms,jitter=9ms",
                                                   "out.loss=0.9,in.cut", "dup=1,biterrors=0.01", "reorder=1");
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto gaps = *rc::gen::container<std::vector<std::uint16_t>>(rc::gen::inRange<std::uint16_t>(0, 50));
  const auto run = [&] {
    auto on = std::make_unique<listened_line>(text, seed);
    for (std::size_t n = 0; n < gaps.size(); ++n) {
      on->send(n % 3 == 0 ? way::in : way::out, n);
      on->advance(gaps[n] * ms);
      if (gaps[n] == 7)
        on->line.cut(on->now_ns + 20 * ms);
    }
    on->advance(1'000 * ms);
    return on;
  };
  const auto first = run();
  for (const auto to : {way::in, way::out}) {
    const auto& counted = first->line.counters(to);
    RC_ASSERT(counted.sent + counted.duplicated == counted.delivered + counted.lost + counted.cut + counted.overflowed);
  }
  RC_ASSERT(first->line.next_deadline_ns() == faulty_line::never);
  RC_ASSERT(first->arrivals == run()->arrivals);
}

TEST(faulty_line, who_sends_is_not_handed_what_comes_the_other_way) {
  faulty_line* itself = nullptr;
  std::int64_t now_ns = 0;
  int deep = 0;
  int deepest = 0;
  // Like a vehicle that answers each frame that comes in, twice.
  faulty_line line(1, [&](way to, std::span<const std::byte> frame, bool) {
    if (to == way::out)
      return;
    deepest = std::max(deepest, ++deep);
    itself->send(way::out, frame, now_ns);
    itself->send(way::out, frame, now_ns);
    --deep;
  });
  itself = &line;
  line.set(parse_line_faults("delay=10ms").value());
  const std::array<std::byte, 12> frame{};
  for (int i = 0; i < 5; ++i)
    line.send(way::in, frame, 0);
  line.send(way::out, frame, 0);
  now_ns = 20 * ms;
  line.on_time(now_ns);
  EXPECT_EQ(deepest, 1);
}

} // namespace faulty_line_test
} // namespace godwit::sim
