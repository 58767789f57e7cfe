#include "io/prometheus/text.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace text_test {

using namespace godwit::io::prometheus;

TEST(prometheus_text, a_family_has_its_help_and_type_once_before_its_samples) {
  text_writer out;
  out.begin("a_total", metric_kind::counter, "Of all.");
  out.add(1, {{"actor", "x"}});
  out.add(2U, {{"actor", "y"}, {"kind", "z"}});
  out.one("b_ratio", metric_kind::gauge, "Of one.", 0.5);
  EXPECT_EQ(out.text(), "# HELP a_total Of all.\n# TYPE a_total counter\na_total{actor=\"x\"} 1\n"
                        "a_total{actor=\"y\",kind=\"z\"} 2\n"
                        "# HELP b_ratio Of one.\n# TYPE b_ratio gauge\nb_ratio 0.5\n");
}

TEST(prometheus_text, a_family_without_samples_is_left_out) {
  text_writer out;
  out.begin("none", metric_kind::gauge, "Of nothing.");
  out.one("b", metric_kind::gauge, "Of one.", 7);
  EXPECT_EQ(out.text(), "# HELP b Of one.\n# TYPE b gauge\nb 7\n");
}

TEST(prometheus_text, a_label_or_a_help_can_not_end_its_line) {
  text_writer out;
  out.begin("a", metric_kind::gauge, "\"One\"\nand \\.");
  out.add(1, {{"why", "it said \"no\"\n\\"}});
  EXPECT_EQ(out.text(), "# HELP a \"One\"\\nand \\\\.\n# TYPE a gauge\na{why=\"it said \\\"no\\\"\\n\\\\\"} 1\n");
}

TEST(prometheus_text, numbers_are_written_so_that_they_are_read_back_as_they_were) {
  text_writer out;
  out.begin("a", metric_kind::gauge, "x");
  out.add(0.1);
  out.add(std::numeric_limits<std::uint64_t>::max());
  out.add(std::nan(""));
  out.add(-std::numeric_limits<double>::infinity());
  EXPECT_EQ(out.text(), "# HELP a x\n# TYPE a gauge\na 0.1\na 18446744073709551615\na NaN\na -Inf\n");
}

} // namespace text_test
