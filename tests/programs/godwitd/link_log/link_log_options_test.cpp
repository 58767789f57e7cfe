#include "programs/godwitd/link_log/link_log_options.hpp"

#include <gtest/gtest.h>

#include "io/mcap/segment_folder.hpp"

namespace link_log_options_test {

using namespace godwit;

constexpr std::uint64_t mib = std::uint64_t{1} << 20U;

TEST(link_log_options, trace_and_both_links_together_keep_to_the_bound_of_the_trace) {
  for (const auto total : {16 * mib, 17 * mib, 256 * mib, 65'536 * mib})
    for (const auto segment : {mib, 8 * mib}) {
      runtime::trace_options trace;
      trace.total_bytes = total;
      trace.segment_bytes = segment;
      const auto links = daemon::share_of(trace);
      EXPECT_LE(trace.total_bytes + 2 * links.total_bytes, total);
      EXPECT_GE(trace.total_bytes, 3 * total / 4);
      EXPECT_LE(2 * trace.segment_bytes, trace.total_bytes) << "a folder holds two files at least";
      EXPECT_LE(2 * links.segment_bytes, links.total_bytes);
      EXPECT_GE(links.segment_bytes, io::mcap::segment_folder::min_segment_bytes);
    }
}

} // namespace link_log_options_test
