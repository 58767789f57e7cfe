#include "programs/godwit-sim/missions/fault.hpp"

#include <gtest/gtest.h>

namespace godwit::sim::missions {
namespace missions_fault_test {

using namespace std::chrono_literals;

TEST(missions_fault, each_fault_is_read) {
  const std::pair<const char*, fault::any> faults[] = {
      {"refuse", fault::refuse{}},
      {"refuse for 5s", fault::refuse{5s}},
      {"wrong-host", fault::wrong_host{}},
      {"drop", fault::drop{}},
      {"status 500", fault::status{500, {}, false}},
      {"status 429 retry-after 2", fault::status{429, 2, false}},
      {"status 503 retry-after 0 committed", fault::status{503, 0, true}},
      {"lose", fault::lose{}},
      {"delay 250ms", fault::delay{250ms}},
      {"slow 100", fault::slow{100}},
      {"reset", fault::reset{}},
      {"content-type text/html", fault::content_type{"text/html"}},
      {"truncate", fault::truncate{}},
      {"huge", fault::huge{}},
      {"schema", fault::schema{}},
      {"version", fault::version{}},
  };
  for (const auto& [text, what] : faults) {
    const auto rule = parse_fault_rule(text);
    ASSERT_TRUE(rule) << text << ": " << rule.error();
    EXPECT_EQ(*rule, (fault_rule{what, {}, 1, {}})) << text;
  }
  EXPECT_EQ(parse_fault_rule("  status 503   on post-progress from 2 times 3 ").value(),
            (fault_rule{fault::status{}, endpoint::post_progress, 2, 3}));
}

TEST(missions_fault, a_mistake_is_named_with_the_form) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"", "is no fault; there are refuse, wrong-host"},
      {"explode", "\"explode\" is no fault"},
      {"refuse 5s", "refuse for 5s"},
      {"refuse times 2", "refuse for 5s"},
      {"refuse for ever", "a time of up to an hour"},
      {"status", "what comes next is missing; it is a whole number from 400 to 599"},
      {"status 200", "from 400 to 599"},
      {"status 503 retry-after soon", "from 0 to 86400"},
      {"delay", "a time of up to an hour"},
      {"delay 2h", "a time of up to an hour"},
      {"slow 0", "from 1 to"},
      {"content-type", "a media type"},
      {"lose on progress", "get-mission, delete-mission"},
      {"lose from 0", "from 1 to"},
      {"lose times 0", "from 1 to"},
      {"lose sometimes", "WHAT [on CALL] [from N] [times N]"},
      {"lose times 1 on get-mission", "WHAT [on CALL] [from N] [times N]"},
      {"wrong-host on get-mission", "about connections"},
  };
  for (const auto& [text, part] : mistakes) {
    const auto rule = parse_fault_rule(text);
    ASSERT_FALSE(rule) << text;
    EXPECT_NE(rule.error().find(part), std::string::npos) << rule.error();
  }
}

} // namespace missions_fault_test
} // namespace godwit::sim::missions
