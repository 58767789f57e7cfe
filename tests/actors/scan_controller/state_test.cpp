#include "actors/scan_controller/state.hpp"

#include <gtest/gtest.h>

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "tests/actors/scan_controller/scan_world.hpp"

namespace scan_controller_state_test {

using namespace godwit;
using namespace godwit::scan_controller;
using namespace godwit::test;

TEST(scan_state, what_is_written_is_read_again) {
  scan_world w;
  for (int i = 1; i <= 8; ++i)
    w.see(thing(i));
  ASSERT_TRUE(w.say(2, decision::decline).is_taken);
  scan_controller::state read;
  ASSERT_TRUE(io::read_json(nlohmann::json::parse(io::to_json(w.state)), read));
  EXPECT_TRUE(io::equal(read, w.state));
}

TEST(scan_state, of_what_is_closed_only_so_much_is_kept_and_what_is_confirmed_longest) {
  scan_world w;
  for (int i = 0; i < static_cast<int>(max_closed) + 10; ++i) {
    const auto number = w.see(thing(i)).point;
    w.wait(13 * second); // five in a minute at most
    if (i == 0) {
      ASSERT_TRUE(w.say(number, decision::confirm).is_taken);
    }
  }
  w.wait(61 * second);
  EXPECT_EQ(w.state.closed.size(), max_closed);
  EXPECT_EQ(w.state.closed.front().outcome, point_outcome::confirmed);
  EXPECT_EQ(core::view_of(w.state, w.now()).confirmed.size(), 1U);
}

} // namespace scan_controller_state_test
