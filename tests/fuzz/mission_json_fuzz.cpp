// Any bytes as a mission, and as the other documents of the missions service: an error with a sentence, or a value that
// keeps the rules and is written and read as itself.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/rules.hpp"
#include "actors/domain/mission/write.hpp"

namespace {

using namespace godwit::mission;

[[noreturn]] void finding(const char* what) {
  std::fprintf(stderr, "finding: %s\n", what);
  std::abort();
}

template <class T>
void check(std::string_view text) {
  const auto value = read<T>(text);
  if (!value) {
    const auto& error = value.error();
    if (error.problems.empty() || error.message().empty() || error.problems.size() > max_document_problems ||
        error.sample.size() > max_document_sample)
      finding("an error without a sentence, or beyond its bounds");
    return;
  }
  if (!broken_rules(*value).empty())
    finding("what was read breaks a rule");
  const auto again = read<T>(to_text(*value));
  if (!again || !(*again == *value))
    finding("written and read again it is another value");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check<document>(text);
  check<assignment_list>(text);
  check<waypoint_insert>(text);
  check<progress_batch>(text);
  check<map_object_page>(text);
  check<problem>(text);
  return 0;
}
