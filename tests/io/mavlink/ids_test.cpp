#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "io/mavlink/ids.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace ids_test {

struct row {
  std::uint32_t id = 0;
  unsigned crc_extra = 0;
  unsigned base_length = 0;
  unsigned full_length = 0;
  std::string name;
};

std::vector<row> published() {
  const auto bytes = test_data("mavlink/mavlink_ids.csv");
  std::istringstream text(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::string line;
  std::getline(text, line); // the names of the columns
  std::vector<row> rows;
  char comma = 0;
  for (row each; text >> each.id >> comma >> each.crc_extra >> comma >> each.base_length >> comma >> each.full_length >>
                 comma >> each.name;)
    rows.push_back(each);
  return rows;
}

TEST(ids, are_all_those_published_with_their_facts) {
  const auto rows = published();
  ASSERT_EQ(rows.size(), known_id_count);
  for (const row& each : rows) {
    const auto* const info = find_message(each.id);
    ASSERT_NE(info, nullptr) << each.name;
    EXPECT_EQ(info->id, each.id);
    EXPECT_EQ(info->crc_extra, each.crc_extra) << each.name;
    EXPECT_EQ(info->base_length, each.base_length) << each.name;
    EXPECT_EQ(info->full_length, each.full_length) << each.name;
    EXPECT_EQ(info->name, each.name);
  }
}

TEST(ids, not_published_are_not_found_whatever_their_page) {
  std::map<std::uint32_t, bool> known;
  for (const row& each : published())
    known[each.id] = true;
  for (std::uint32_t id = 0; id < 1U << 24U; ++id)
    if (find_message(id) != nullptr && !known.contains(id))
      FAIL() << id;
}

TEST(ids, have_slots_without_gaps) {
  std::size_t slot = 0;
  for (const auto& each : known_ids())
    EXPECT_EQ(slot_of(each), slot++);
}

} // namespace ids_test
} // namespace godwit::io::mavlink
