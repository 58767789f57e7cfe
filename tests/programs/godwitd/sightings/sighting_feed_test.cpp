#include "programs/godwitd/sightings/sighting_feed.hpp"

#include <gtest/gtest.h>

#include <semaphore>

#include "tests/programs/godwitd/scratch.hpp"
#include "tests/programs/godwitd/sighting_text.hpp"

namespace sighting_feed_test {

using namespace godwit;
using namespace std::chrono_literals;
using daemon::sighting_feed;
using test::scratch;
using test::sighting_lines;

constexpr auto patience = 20s;

struct reader {
  explicit reader(const std::string& file) : feed(sighting_feed::open(file, "7d1c").value()) {
    feed->start([this] { woken.release(); }, [this](const std::string& why) { complaints.push_back(why); });
  }
  // The next one; nothing at the end.
  std::optional<sighting_feed::numbered> next() {
    for (;;) {
      if (auto each = feed->take())
        return each;
      if (feed->is_over() || !woken.try_acquire_for(patience))
        return std::nullopt;
    }
  }
  std::counting_semaphore<> woken{0};
  std::vector<std::string> complaints; // read when the feed has ended
  std::shared_ptr<sighting_feed> feed;
};

TEST(sighting_feed, all_lines_come_in_their_order_and_then_it_is_over) {
  const scratch folder;
  constexpr int count = 3'000; // more than wait at once
  reader from(folder.write("seen", sighting_lines(count)));
  for (int number = 0; number < count; ++number) {
    const auto each = from.next();
    ASSERT_TRUE(each) << number;
    EXPECT_EQ(each->seen.id, test::sighting_id(number));
    from.feed->resolve(each->number, true);
  }
  EXPECT_FALSE(from.next());
  EXPECT_TRUE(from.feed->is_over());
  EXPECT_EQ(from.feed->counts().recorded, 3'000U);
}

TEST(sighting_feed, what_was_taken_and_not_settled_comes_again_in_its_order) {
  const scratch folder;
  reader from(folder.write("seen", sighting_lines(3)));
  for (int number = 0; number < 3; ++number)
    ASSERT_TRUE(from.next());
  from.feed->resolve(2, true);
  EXPECT_FALSE(from.feed->is_over());
  from.feed->take_back_all();
  EXPECT_EQ(from.next()->number, 1U);
  EXPECT_EQ(from.next()->number, 3U);
  from.feed->take_back(3);
  EXPECT_EQ(from.next()->number, 3U);
  from.feed->resolve(1, true);
  from.feed->resolve(3, false);
  EXPECT_FALSE(from.next());
  EXPECT_EQ(from.feed->counts().recorded, 2U);
  EXPECT_EQ(from.feed->counts().refused, 1U);
}

TEST(sighting_feed, a_line_that_is_no_sighting_is_passed_over_counted_and_named) {
  const scratch folder;
  const auto file = folder.write("seen", "{}\n\n" + sighting_lines(1) + std::string(10'000, 'x') + "\nlast");
  reader from(file);
  ASSERT_TRUE(from.next());
  from.feed->resolve(1, true);
  EXPECT_FALSE(from.next());
  from.feed->stop();
  EXPECT_EQ(from.feed->counts().unreadable, 3U);
  ASSERT_EQ(from.complaints.size(), 3U);
  EXPECT_TRUE(from.complaints[0].starts_with(file + ", line 1: has no \"id\"")) << from.complaints[0];
  EXPECT_NE(from.complaints[1].find("line 4: is longer than"), std::string::npos) << from.complaints[1];
  EXPECT_NE(from.complaints[2].find("line 5: "), std::string::npos) << from.complaints[2];
}

TEST(sighting_feed, it_can_be_stopped_while_nobody_takes_what_it_has_read) {
  const scratch folder;
  reader from(folder.write("seen", sighting_lines(5'000)));
  ASSERT_TRUE(from.next());
  from.feed->stop();
  EXPECT_FALSE(from.feed->is_over());
}

TEST(sighting_feed, a_file_that_can_not_be_read_is_an_error_or_a_complaint) {
  const scratch folder;
  const auto missing = sighting_feed::open(folder.file("none"), "7d1c");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().find("none"), std::string::npos);
  reader from(folder.file(""));
  EXPECT_FALSE(from.next());
  EXPECT_EQ(from.feed->counts().unreadable, 1U);
}

} // namespace sighting_feed_test
