#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {

namespace signer_test {

TEST(mavlink_signer, appends_link_timestamp_and_a_right_hash) {
  signer out(counting_key(), link_id{7}, signing_time{0});
  auto frame = golden_heartbeat(signing::on);
  EXPECT_FALSE(frame.is_complete());
  EXPECT_EQ(out.sign(frame, some_day_ns), signing_time_at(some_day_ns));
  ASSERT_TRUE(frame.is_complete());
  EXPECT_EQ(signature_of(frame.view()).link, link_id{7});
  EXPECT_EQ(signature_of(frame.view()).time, signing_time_at(some_day_ns));
  EXPECT_TRUE(frame_hasher(counting_key()).is_right(frame.view()));
  EXPECT_TRUE(crc_matches(frame.view(), heartbeat::crc_extra)); // it covers the flag
}

TEST(mavlink_signer, a_frame_made_again_at_the_same_moment_gets_a_later_timestamp_and_another_hash) {
  signer out(counting_key(), link_id{0}, signing_time{0});
  auto first = golden_heartbeat(signing::on);
  auto again = golden_heartbeat(signing::on);
  ASSERT_TRUE(out.sign(first, some_day_ns));
  EXPECT_EQ(out.sign(again, some_day_ns), later(signing_time_at(some_day_ns), 1));
  EXPECT_NE(signature_of(first.view()).hash, signature_of(again.view()).hash);
}

TEST(mavlink_signer, without_a_timestamp_left_the_frame_stays_as_it_was) {
  signer out(counting_key(), link_id{0}, max_signing_time);
  auto last = golden_heartbeat(signing::on);
  EXPECT_EQ(out.sign(last, some_day_ns), max_signing_time);
  auto frame = golden_heartbeat(signing::on);
  const auto outcome = out.sign(frame, some_day_ns);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(io::name_of(outcome.error()), "timestamps_used_up");
  EXPECT_FALSE(frame.is_complete());
}

TEST(mavlink_signer, each_of_our_messages_is_signed_and_verified) {
  signer out(counting_key(), link_id{0}, signing_time{0});
  frame_hasher in(counting_key());
  std::mt19937_64 random(1);
  known_messages::for_each([&]<message M>() {
    for (int i = 0; i < 20; ++i) {
      auto frame = encode(random_message<M>(random), sender{1, 191}, 9, signing::on);
      ASSERT_TRUE(out.sign(frame, some_day_ns));
      EXPECT_TRUE(in.is_right(frame.view())) << M::message_id;
      EXPECT_TRUE(crc_matches(frame.view(), M::crc_extra)) << M::message_id;
    }
  });
}

} // namespace signer_test

namespace signing_clock_test {

constexpr std::int64_t hour_ns = 3600 * second_ns;
constexpr signing_time start = signing_time_at(some_day_ns);

TEST(mavlink_signing_clock, follows_the_wall_clock) {
  signing_clock clock(signing_time{0});
  EXPECT_EQ(clock.next(some_day_ns), start);
  EXPECT_EQ(clock.next(some_day_ns + second_ns), later(start, signing_units_per_s));
}

TEST(mavlink_signing_clock, goes_on_by_one_when_the_wall_clock_stands_still_or_is_set_back) {
  signing_clock clock(signing_time{0});
  EXPECT_EQ(clock.next(some_day_ns), start);
  EXPECT_EQ(clock.next(some_day_ns), later(start, 1));
  EXPECT_EQ(clock.next(some_day_ns - hour_ns), later(start, 2));
  EXPECT_EQ(clock.now(some_day_ns - hour_ns), later(start, 3));
  EXPECT_EQ(clock.next(0), later(start, 3));
  EXPECT_EQ(clock.next(some_day_ns + second_ns), later(start, signing_units_per_s));
}

TEST(mavlink_signing_clock, follows_a_wall_clock_that_is_set_forward) {
  signing_clock clock(signing_time{0});
  ASSERT_TRUE(clock.next(0)); // never set, as after a start without a network
  EXPECT_EQ(clock.next(some_day_ns), start);
}

TEST(mavlink_signing_clock, begins_at_the_ceiling_of_an_earlier_life_when_that_is_ahead_of_the_wall_clock) {
  const signing_time ceiling = later(start, 300'000);
  signing_clock clock(ceiling);
  EXPECT_EQ(clock.next(some_day_ns), ceiling);
  EXPECT_EQ(clock.next(some_day_ns + second_ns), later(ceiling, 1));
  EXPECT_EQ(clock.next(some_day_ns + 10 * second_ns), later(start, 10 * signing_units_per_s)); // true time again
}

TEST(mavlink_signing_clock, begins_at_the_wall_clock_when_that_is_ahead_of_the_ceiling) {
  signing_clock clock(earlier(start, 1));
  EXPECT_EQ(clock.next(some_day_ns), start);
}

TEST(mavlink_signing_clock, signs_at_the_newest_time_of_the_other_end_and_judges_by_its_own) {
  signing_clock clock(signing_time{0});
  ASSERT_EQ(clock.next(some_day_ns), start);
  const auto ahead = later(start, 75 * signing_units_per_s);
  clock.follow(ahead);
  clock.follow(start); // an older one
  EXPECT_EQ(clock.now(some_day_ns), later(start, 1));
  EXPECT_EQ(clock.next(some_day_ns), ahead);
  EXPECT_EQ(clock.next(some_day_ns), later(ahead, 1));
  EXPECT_EQ(clock.now(some_day_ns), later(start, 3));
  EXPECT_EQ(clock.followed_ahead(some_day_ns) / signing_units_per_s, 74U);
  EXPECT_EQ(clock.next(some_day_ns + 100 * second_ns), later(start, 100 * signing_units_per_s))
      << "ours is ahead again";
  EXPECT_EQ(clock.followed_ahead(some_day_ns + 100 * second_ns), 0U);
}

TEST(mavlink_signing_clock, reserves_what_it_signs_with_also_while_it_follows_somebody) {
  signing_clock clock(signing_time{0});
  clock.follow(later(start, 75 * signing_units_per_s));
  EXPECT_EQ(clock.wanted_reservation(some_day_ns),
            later(start, 75 * signing_units_per_s + signing_clock::reserve_ahead));
}

TEST(mavlink_signing_clock, a_new_life_is_not_beyond_its_reservation_before_it_signs) {
  signing_clock clock(later(start, 5));
  EXPECT_FALSE(clock.is_beyond_reservation());
  ASSERT_TRUE(clock.next(some_day_ns));
  EXPECT_TRUE(clock.is_beyond_reservation());
}

TEST(mavlink_signing_clock, wants_5_s_at_once_and_again_when_half_of_it_is_left) {
  signing_clock clock(signing_time{0});
  const auto first = clock.wanted_reservation(some_day_ns);
  ASSERT_EQ(first, later(start, signing_clock::reserve_ahead));
  clock.reserved(*first);
  EXPECT_FALSE(clock.wanted_reservation(some_day_ns));
  EXPECT_FALSE(clock.wanted_reservation(some_day_ns + 2'499'000'000));
  EXPECT_EQ(clock.wanted_reservation(some_day_ns + 2'500'000'000), later(*first, signing_clock::ask_when_left));
}

TEST(mavlink_signing_clock, has_one_reservation_under_way_at_a_time) {
  signing_clock clock(signing_time{0});
  const auto first = clock.wanted_reservation(some_day_ns);
  ASSERT_TRUE(first);
  EXPECT_FALSE(clock.wanted_reservation(some_day_ns + hour_ns));
  clock.reserved(*first);
  EXPECT_TRUE(clock.wanted_reservation(some_day_ns + hour_ns));
}

TEST(mavlink_signing_clock, asks_again_for_a_reservation_that_failed) {
  signing_clock clock(signing_time{0});
  const auto first = clock.wanted_reservation(some_day_ns);
  clock.reservation_failed();
  EXPECT_EQ(clock.wanted_reservation(some_day_ns), first);
}

TEST(mavlink_signing_clock, goes_on_from_memory_while_the_disk_is_down_and_says_so) {
  signing_clock clock(signing_time{0});
  clock.reserved(*clock.wanted_reservation(some_day_ns));
  ASSERT_TRUE(clock.next(some_day_ns));
  EXPECT_FALSE(clock.is_beyond_reservation());
  const auto never_comes = clock.wanted_reservation(some_day_ns + 4 * second_ns);
  ASSERT_TRUE(never_comes);
  EXPECT_EQ(clock.next(some_day_ns + 5 * second_ns - 10'000), later(start, signing_clock::reserve_ahead - 1));
  EXPECT_FALSE(clock.is_beyond_reservation()); // the last one that was reserved
  EXPECT_EQ(clock.next(some_day_ns + 5 * second_ns), later(start, signing_clock::reserve_ahead));
  EXPECT_TRUE(clock.is_beyond_reservation());
  EXPECT_TRUE(clock.next(some_day_ns + 60 * second_ns));
  EXPECT_TRUE(clock.is_beyond_reservation());
  clock.reserved(*never_comes); // it came, too late to be enough
  EXPECT_TRUE(clock.is_beyond_reservation());
  clock.reserved(*clock.wanted_reservation(some_day_ns + 60 * second_ns));
  EXPECT_FALSE(clock.is_beyond_reservation());
}

TEST(mavlink_signing_clock, never_reserves_further_ahead_than_5_s_from_what_is_used) {
  signing_clock clock(signing_time{0});
  for (std::int64_t t = some_day_ns; t < some_day_ns + 60 * second_ns; t += second_ns / 10) {
    const auto used = clock.next(t);
    const auto wanted = clock.wanted_reservation(t);
    if (wanted) {
      EXPECT_LE(units(*wanted), units(*used) + signing_clock::reserve_ahead + 1);
      clock.reserved(*wanted);
    }
  }
}

TEST(mavlink_signing_clock, ends_with_the_last_timestamp_that_there_is) {
  signing_clock clock(earlier(max_signing_time, 1));
  EXPECT_EQ(clock.next(some_day_ns), earlier(max_signing_time, 1));
  EXPECT_EQ(clock.wanted_reservation(some_day_ns), max_signing_time);
  EXPECT_EQ(clock.next(some_day_ns), max_signing_time);
  EXPECT_FALSE(clock.next(some_day_ns));
  EXPECT_EQ(clock.now(some_day_ns), max_signing_time);
}

// What the owner of a clock does, with a disk that answers when the test lets it, and lives that end at any moment.
struct owner {
  std::int64_t wall_ns = some_day_ns;
  signing_time durable{0};             // what is on the disk
  std::optional<signing_time> written; // under way to it
  signing_clock clock{durable};

  void ask() {
    if (const auto wanted = clock.wanted_reservation(wall_ns))
      written = wanted;
  }
  void disk_answers() {
    if (!written)
      return;
    durable = *written;
    clock.reserved(durable);
    written.reset();
  }
  void disk_fails() {
    if (written)
      clock.reservation_failed();
    written.reset();
  }
  // A write that was under way may have reached the disk without our hearing of it.
  void restart(bool write_reached_disk) {
    if (written && write_reached_disk)
      durable = *written;
    written.reset();
    clock = signing_clock(durable);
  }
};

enum step : int { sign, wait_short, jump_forward, jump_back, disk_answers, disk_fails, restart, steps };
using sequence = std::vector<std::pair<int, int>>;

sequence any_sequence() {
  return *rc::gen::container<sequence>(rc::gen::pair(rc::gen::inRange<int>(0, steps), rc::gen::inRange(0, 10'000)));
}

void change_wall(owner& o, int what, std::int64_t amount) {
  if (what == wait_short)
    o.wall_ns += amount * 1'000'000;
  if (what == jump_forward)
    o.wall_ns += amount * 1000 * second_ns;
  if (what == jump_back)
    o.wall_ns -= amount * 1000 * second_ns;
}

// The owner waits for the disk before it signs, as one can who has the time: no crash or clock brings a value twice.
RC_GTEST_PROP(mavlink_signing_clock_property, timestamps_rise_over_all_lives, ()) {
  owner o;
  std::optional<signing_time> last;
  for (const auto& [what, amount] : any_sequence()) {
    change_wall(o, what, amount);
    if (what == restart)
      o.restart(amount % 2 == 0);
    if (what != sign)
      continue;
    for (int i = 0; i <= amount % 100; ++i) {
      o.ask();
      o.disk_answers();
      const auto time = o.clock.next(o.wall_ns);
      RC_ASSERT(time.has_value());
      RC_ASSERT(!last || *time > *last);
      RC_ASSERT(!o.clock.is_beyond_reservation());
      last = time;
    }
  }
}

// The owner never waits. Then only a value that was given out beyond the reservation, and that no reservation covered
// afterwards, can come again in a later life; the clock says so at the time.
RC_GTEST_PROP(mavlink_signing_clock_property, what_a_reservation_covers_never_comes_again, ()) {
  owner o;
  signing_time floor{0}; // above what earlier lives gave out and had reserved
  std::optional<signing_time> last;
  bool was_beyond = false;
  for (const auto& [what, amount] : any_sequence()) {
    change_wall(o, what, amount);
    if (what == disk_answers)
      o.disk_answers();
    if (what == disk_fails)
      o.disk_fails();
    if (what == restart) {
      const auto highest = last ? later(*last, 1) : signing_time{0};
      RC_ASSERT(was_beyond == (highest > o.durable));
      o.restart(amount % 2 == 0);
      floor = std::max(floor, std::min(highest, o.durable));
      last.reset();
    }
    if (what == sign) {
      o.ask();
      const auto time = o.clock.next(o.wall_ns);
      RC_ASSERT(time.has_value());
      RC_ASSERT(!last || *time > *last);
      RC_ASSERT(*time >= floor);
      last = time;
    }
    was_beyond = o.clock.is_beyond_reservation();
  }
}

} // namespace signing_clock_test

} // namespace godwit::io::mavlink::test
