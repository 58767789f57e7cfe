#include "actors/line/line_input.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace line_input_test {

using namespace godwit;
using line::line_input;

TEST(line_input, bytes_and_states_come_back_as_they_were) {
  io::link::arrival came{3, true, {}};
  for (unsigned n = 0; n < 256; ++n)
    came.bytes.push_back(std::byte{static_cast<unsigned char>(n)});
  const auto bytes = std::get<io::link::arrival>(line_input::of(came).news());
  EXPECT_EQ(bytes.peer, 3U);
  EXPECT_TRUE(bytes.is_datagram);
  EXPECT_EQ(bytes.bytes, came.bytes);
  const io::link::link_status down{io::link::link_phase::down, "the cable", 7};
  EXPECT_EQ(std::get<io::link::link_status>(line_input::of(down).news()), down);
}

} // namespace line_input_test
