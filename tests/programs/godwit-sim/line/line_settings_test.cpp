#include "programs/godwit-sim/line/line_settings.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace godwit::sim {
namespace line_settings_test {

using namespace std::chrono_literals;

TEST(line_settings, every_word_is_read_for_both_ways) {
  const auto read =
      parse_line_faults("loss=0.1,dup=0.01,reorder=0.05,late=0.01,delay=15ms,jitter=5ms,biterrors=1e-5,cut");
  ASSERT_TRUE(read) << read.error();
  const line_settings expected{.loss = 0.1,
                               .duplication = 0.01,
                               .reorder = 0.05,
                               .late = 0.01,
                               .bit_errors = 1e-5,
                               .delay = 15ms,
                               .jitter = 5ms,
                               .is_cut = true};
  EXPECT_EQ(read->in, expected);
  EXPECT_EQ(read->out, expected);
}

TEST(line_settings, a_word_may_be_for_one_way_and_a_later_word_overrides) {
  const auto read = parse_line_faults("loss=0.1, out.loss=0.5, in.cut, delay=1.5s");
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(read->in.loss, 0.1);
  EXPECT_EQ(read->out.loss, 0.5);
  EXPECT_TRUE(read->in.is_cut);
  EXPECT_FALSE(read->out.is_cut);
  EXPECT_EQ(read->out.delay, 1500ms);
}

TEST(line_settings, none_is_a_good_line) {
  EXPECT_EQ(parse_line_faults("none").value(), line_faults{});
  EXPECT_EQ(text_of({}), "none");
}

TEST(line_settings, a_mistake_is_named_and_the_form_is_shown) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"", "\"\" is not a fault of a line"},
      {"loss", "\"loss\" is not a share from 0 to 1"},
      {"loss=", "\"loss=\" is not a share"},
      {"loss=1.01", "\"loss=1.01\" is not a share"},
      {"loss=-0.1", "is not a share"},
      {"loss=nan", "is not a share"},
      {"loss=10%", "is not a share"},
      {"delay=15", "\"delay=15\" is not a time up to 60s"},
      {"delay=-1ms", "is not a time"},
      {"jitter=61s", "is not a time"},
      {"lost=0.1", "\"lost=0.1\" is not a fault of a line"},
      {"out.lost=0.1", "\"out.lost=0.1\" is not a fault of a line"},
      {"up.loss=0.1", "\"up.loss=0.1\" is not a fault of a line"},
      {"loss=0.1,,cut", "\"\" is not a fault of a line"},
      {"none,cut", "\"none\" is not a fault of a line"},
  };
  for (const auto& [text, part] : mistakes) {
    const auto read = parse_line_faults(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().find(part), std::string::npos) << read.error();
    EXPECT_NE(read.error().find("loss=0.1,dup=0.01"), std::string::npos) << read.error();
  }
}

RC_GTEST_PROP(line_settings_property, what_is_written_is_read_as_the_same_value, ()) {
  const auto share = rc::gen::map(rc::gen::inRange(0, 1'000'001), [](int n) { return n / 1e6; });
  const auto time = rc::gen::map(rc::gen::inRange<std::int64_t>(0, 60'000'000'001),
                                 [](std::int64_t n) { return std::chrono::nanoseconds(n); });
  const auto any_settings = [&] {
    return line_settings{.loss = *share,
                         .duplication = *share,
                         .reorder = *share,
                         .late = *share,
                         .bit_errors = *share,
                         .delay = *time,
                         .jitter = *time,
                         .is_cut = *rc::gen::arbitrary<bool>()};
  };
  const line_faults faults{any_settings(), any_settings()};
  RC_ASSERT(parse_line_faults(text_of(faults)).value() == faults);
  const line_faults both{faults.in, faults.in};
  RC_ASSERT(parse_line_faults(text_of(both)).value() == both);
}

} // namespace line_settings_test
} // namespace godwit::sim
