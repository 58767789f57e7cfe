#include "programs/godwit-drill/flights/drill_book.hpp"

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace drill_book_test {

using namespace godwit::drill;

flight_outcome outcome(const std::string& name, const std::string& group) {
  flight_outcome result;
  result.name = name;
  result.group = group;
  result.flown_s = 50;
  return result;
}

TEST(drill_book, counts_by_group_and_in_all) {
  drill_book book(true);
  auto first = outcome("a", "px4");
  first.takeovers = 2;
  first.kills = 3;
  first.recovery_ms = 12.5;
  auto second = outcome("b", "rover");
  second.lost = 4;
  second.flaws = {"a report is lost"};
  auto third = outcome("c", "rover");
  third.skipped = "the flight has no such part";
  third.recovery_ms = 99; // of nothing
  for (const auto& each : {first, second, third})
    book.take(each);
  EXPECT_EQ(book.total().flights, 3U);
  EXPECT_EQ(book.total().failed, 1U);
  EXPECT_EQ(book.total().not_tried, 1U);
  EXPECT_EQ(book.total().with_takeover, 1U);
  const auto json = book.to_json(10);
  EXPECT_EQ(json["total"]["lost"], 4);
  EXPECT_EQ(json["total"]["recovery_ms"]["max"], 12.5);
  EXPECT_EQ(json["times_real_time"], 15);
  EXPECT_EQ(json["groups"].size(), 2U);
  EXPECT_EQ(json["groups"][1]["name"], "rover");
  EXPECT_EQ(json["groups"][1]["failed"], 1);
  EXPECT_EQ(json["flights"].size(), 3U);
  const auto table = book.to_table(10);
  for (const auto* each : {"px4", "rover", "all", "12.5", "15 times real time"})
    EXPECT_NE(table.find(each), std::string::npos) << each << '\n' << table;
}

TEST(drill_book, of_many_flights_keeps_those_with_a_flaw) {
  drill_book book(false);
  book.take(outcome("a", "px4"));
  auto bad = outcome("b", "px4");
  bad.flaws = {"it has no end"};
  book.take(bad);
  const auto json = book.to_json(1);
  ASSERT_EQ(json["flights"].size(), 1U);
  EXPECT_EQ(json["flights"][0]["name"], "b");
}

TEST(drill_book, a_failure_is_told_with_its_flaws_its_command_and_its_story) {
  auto bad = outcome("seed 7", "px4");
  bad.flaws = {"it has no end", "report 3 is lost"};
  bad.story = "12 ms: process 1\n";
  bad.again = "godwit-drill simulate --seeds 7";
  const auto text = text_of_failure(bad);
  for (const auto* each : {"FAILED seed 7", "it has no end", "report 3 is lost",
                           "again: godwit-drill simulate --seeds 7", "12 ms: process 1"})
    EXPECT_NE(text.find(each), std::string::npos) << each << '\n' << text;
}

TEST(drill_book, a_long_name_of_a_group_keeps_the_columns_of_its_table_aligned) {
  drill_book book(false);
  book.take(outcome("a", "px4"));
  book.take(outcome("b", "ardupilot/deleted_and_killed"));
  const auto table = book.to_table(1);
  const auto lines = [&] {
    std::vector<std::string> result;
    std::istringstream in(table);
    for (std::string line; std::getline(in, line);)
      result.push_back(line);
    return result;
  }();
  ASSERT_GE(lines.size(), 4U);
  EXPECT_EQ(lines[1].size(), lines[2].size());
  EXPECT_EQ(lines[2].size(), lines[3].size());
}

TEST(drill_page, shows_groups_flaws_and_the_command_that_flies_them_again_as_text) {
  drill_book book(true);
  auto bad = outcome("<b>", "px4");
  bad.flaws = {"a & b are lost"};
  bad.again = "godwit-drill links --only <b>";
  bad.story = "12 ms: </pre><script>";
  bad.recovery_ms = 12.5;
  auto known = outcome("c", "rover");
  known.known = {"as docs/roadmap.md says"};
  book.take(bad);
  book.take(known);
  const auto page = to_html({"godwit-drill links", 2, book});
  for (const auto* each : {"FAILED: 1 of 2 flights", "&lt;b&gt;", "a &amp; b are lost", "links --only &lt;b&gt;",
                           "&lt;script&gt;", "as docs/roadmap.md says", "<svg", ">12.5</td>"})
    EXPECT_NE(page.find(each), std::string::npos) << each << '\n' << page;
  EXPECT_EQ(page.find("<script"), std::string::npos) << page;
  EXPECT_EQ(page.find("http"), page.find("http-equiv")) << "nothing is loaded from elsewhere";
}

} // namespace drill_book_test
