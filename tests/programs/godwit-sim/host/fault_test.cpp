#include "programs/godwit-sim/host/fault.hpp"

#include <gtest/gtest.h>

namespace godwit::sim {
namespace host_fault_test {

using namespace std::chrono_literals;

TEST(fault, every_form_is_read) {
  const std::pair<const char*, fault::any> forms[] = {
      {"faults loss=0.1,delay=15ms", fault::set_line{parse_line_faults("loss=0.1,delay=15ms").value()}},
      {"faults none", fault::set_line{}},
      {"cut", fault::cut{}},
      {"cut 5s", fault::cut{5s}},
      {"restore", fault::restore{}},
      {"reboot", fault::reboot{}},
      {"gps lost", fault::gps{true}},
      {"gps back", fault::gps{false}},
      {"way blocked", fault::way{true}},
      {"way free", fault::way{false}},
      {"  battery   12.5 ", fault::battery{12.5}},
      {"say  PreArm: <b>x</b> = 1", fault::say{"PreArm: <b>x</b> = 1"}},
      {"refuse 300", fault::refuse{300, 2, -1}},
      {"refuse MISSION_START=FAILED", fault::refuse{300, 4, -1}},
      {"refuse MAV_CMD_MISSION_START=MAV_RESULT_TEMPORARILY_REJECTED 2", fault::refuse{300, 1, 2}},
      {"refuse component_arm_disarm=77", fault::refuse{400, 77, -1}},
      {"accept MISSION_START", fault::refuse{300, 0, 0}},
  };
  for (const auto& [text, expected] : forms) {
    const auto read = parse_fault(text);
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(*read, expected) << text;
    EXPECT_FALSE(sentence_of(*read).empty());
  }
}

TEST(fault, a_mistake_is_named_and_the_form_is_shown) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"", "\"\" is not a fault; one of: faults"},
      {"explode", "\"explode\" is not a fault; one of: faults"},
      {"reboot now", "\"reboot now\" is not a fault"},
      {"faults", "loss=0.1,dup=0.01"},
      {"faults loss=2", "\"loss=2\" is not a share from 0 to 1"},
      {"cut now", "\"now\" is not a time"},
      {"gps", "\"\" does not name what happens to the GPS: lost or back"},
      {"way out", "\"out\" does not name the state of the way: blocked or free"},
      {"battery full", "\"full\" is not a charge of a battery: 0 to 100"},
      {"battery 101", "\"101\" is not a charge"},
      {"say", "\"\" is no text of an autopilot"},
      {"refuse", "\"\" is not a command"},
      {"refuse FLY", "\"FLY\" is not a command"},
      {"refuse 65536", "\"65536\" is not a command"},
      {"refuse 300=NO", "\"NO\" is not an answer"},
      {"refuse 300=256", "\"256\" is not an answer"},
      {"refuse 300 often", "\"often\" does not name how often"},
      {"accept", "\"\" is not a command"},
  };
  for (const auto& [text, part] : mistakes) {
    const auto read = parse_fault(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().find(part), std::string::npos) << read.error();
  }
}

TEST(fault, one_may_come_by_itself_at_a_time) {
  const auto read = parse_timed_fault("1.5s = gps lost");
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(read->after, 1500ms);
  EXPECT_EQ(read->what, fault::any(fault::gps{true}));
  const auto refusal = parse_timed_fault("2min=refuse 300=4");
  ASSERT_TRUE(refusal) << refusal.error();
  EXPECT_EQ(refusal->what, fault::any(fault::refuse{300, 4, -1}));
  for (const char* text : {"", "gps lost", "30=gps lost", "soon=gps lost", "30s"})
    EXPECT_FALSE(parse_timed_fault(text)) << text;
}

TEST(fault, it_is_told_in_words) {
  EXPECT_EQ(sentence_of(fault::cut{5s}), "the line is cut for 5 s");
  EXPECT_EQ(sentence_of(fault::battery{20}), "the battery is set to 20 %");
  EXPECT_EQ(sentence_of(fault::refuse{300, 2, 3}), "the command 300 is answered with 2, 3 times");
}

} // namespace host_fault_test
} // namespace godwit::sim
