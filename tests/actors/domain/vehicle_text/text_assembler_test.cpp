#include "actors/domain/vehicle_text/text_assembler.hpp"

#include <algorithm>
#include <string_view>

#include <gtest/gtest.h>

namespace godwit::flight {
namespace text_assembler_test {

using messages = std::vector<vehicle_message>;

constexpr std::int64_t second_ns = 1'000'000'000;
const std::string fifty(50, 'x');

io::mavlink::statustext piece_of(std::string_view what, std::uint16_t id, std::uint8_t number) {
  io::mavlink::statustext result{.severity = 4, .id = id, .chunk_seq = number};
  std::copy_n(what.begin(), std::min(what.size(), result.text.size()), result.text.begin());
  return result;
}

TEST(text_assembler, a_text_without_an_id_is_whole_also_with_fifty_characters) {
  text_assembler texts;
  EXPECT_EQ(texts.take(piece_of("Arming motors", 0, 0), 0), (messages{{4, "Arming motors"}}));
  EXPECT_EQ(texts.take(piece_of(fifty, 0, 0), 0), (messages{{4, fifty}}));
}

TEST(text_assembler, pieces_of_one_id_are_one_text_that_ends_with_the_first_that_is_not_full) {
  text_assembler texts;
  EXPECT_EQ(texts.take(piece_of(fifty, 7, 0), 0), messages{});
  EXPECT_EQ(texts.take(piece_of(fifty, 7, 1), 0), messages{});
  EXPECT_EQ(texts.take(piece_of("end", 7, 2), 0), (messages{{4, fifty + fifty + "end"}}));
  EXPECT_EQ(texts.take(piece_of(fifty, 8, 0), 0), messages{});
  EXPECT_EQ(texts.take(piece_of("", 8, 1), 0), (messages{{4, fifty}})) << "its length is a multiple of fifty";
}

TEST(text_assembler, a_lost_piece_shows_as_dots) {
  text_assembler texts;
  EXPECT_EQ(texts.take(piece_of(fifty, 7, 0), 0), messages{});
  EXPECT_EQ(texts.take(piece_of("end", 7, 2), 0), (messages{{4, fifty + "..."}, {4, "...end"}}));
  EXPECT_EQ(texts.take(piece_of(fifty, 8, 0), 0), messages{});
  EXPECT_EQ(texts.take(piece_of("another", 0, 0), 0), (messages{{4, fifty + "..."}, {4, "another"}}));
}

TEST(text_assembler, a_text_whose_end_does_not_come_is_told_without_it) {
  text_assembler texts;
  EXPECT_EQ(texts.take(piece_of(fifty, 7, 0), 0), messages{});
  EXPECT_EQ(texts.take_late(second_ns - 1), std::nullopt);
  EXPECT_EQ(texts.take_late(second_ns), (vehicle_message{4, fifty + "..."}));
  EXPECT_EQ(texts.take_late(9 * second_ns), std::nullopt);
}

TEST(text_assembler, a_text_without_an_end_is_cut_at_its_bound) {
  text_assembler texts;
  for (std::uint8_t number = 0; number + 1 < text_assembler::max_pieces; ++number)
    EXPECT_EQ(texts.take(piece_of(fifty, 7, number), 0), messages{});
  const auto told = texts.take(piece_of(fifty, 7, text_assembler::max_pieces - 1), 0);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front().text.size(), 50 * text_assembler::max_pieces + 3);
}

} // namespace text_assembler_test
} // namespace godwit::flight
