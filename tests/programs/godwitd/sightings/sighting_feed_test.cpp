#include <semaphore>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs/godwitd/sightings/sighting_feed.hpp"
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

namespace sighting_line_test {

using namespace godwit;
using daemon::read_sighting;
using nlohmann::json;

json good() {
  return {{"id", "9a6c2b1e-0f4d-4b7a-8c3d-2e1f0a9b8c7d"},
          {"class_group", "vehicle"},
          {"latitude", 47.39895},
          {"longitude", 8.54722},
          {"confidence", 0.9},
          {"at", "1970-01-01T00:00:02Z"}};
}

TEST(sighting_line, a_line_is_a_sighting_of_the_mission) {
  auto line = good();
  line["altitude_m"] = 441.5;
  const auto seen = read_sighting(line.dump(), "7d1c");
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_EQ(seen->id, line["id"]);
  EXPECT_EQ(seen->mission_id, "7d1c");
  EXPECT_EQ(seen->position.latitude_deg, 47.39895);
  EXPECT_EQ(seen->position.altitude_m, 441.5);
  EXPECT_EQ(seen->at_ns, 2'000'000'000);
}

TEST(sighting_line, all_but_the_altitude_has_to_be_there) {
  EXPECT_TRUE(read_sighting(good().dump(), "7d1c"));
  const auto whole = good();
  for (const auto& [key, value] : whole.items()) {
    auto line = whole;
    line.erase(key);
    const auto wrong = read_sighting(line.dump(), "7d1c");
    ASSERT_FALSE(wrong) << key;
    EXPECT_EQ(wrong.error(), "has no \"" + key + "\"");
  }
}

TEST(sighting_line, what_is_wrong_is_named) {
  const std::vector<std::pair<std::string, json>> mistakes{
      {"id", "seven"},     {"id", 7},           {"class_group", 1},     {"latitude", 91},     {"longitude", -181},
      {"confidence", 1.1}, {"at", "yesterday"}, {"altitude_m", "high"}, {"position", "here"}, {"latitude", nullptr}};
  for (const auto& [key, value] : mistakes) {
    auto line = good();
    line[key] = value;
    const auto wrong = read_sighting(line.dump(), "7d1c");
    ASSERT_FALSE(wrong) << key;
    EXPECT_NE(wrong.error().find(key), std::string::npos) << wrong.error();
  }
  EXPECT_FALSE(read_sighting("[]", "7d1c"));
  EXPECT_FALSE(read_sighting("{", "7d1c"));
}

} // namespace sighting_line_test
