// An assertion that stays on in every build.
//
// For broken invariants of our own, never for input: it prints where and what in one sentence to stderr and ends the
// process with abort(), because a process that has lost track of its own rules must not go on flying on them. The
// service manager starts it again and the journal brings the state back. Thread: any.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace godwit::runtime {

[[noreturn]] inline void assertion_failed(const char* file, int line, const char* condition,
                                          std::string_view sentence) {
  std::fprintf(stderr, "%s:%d: broken invariant: %.*s (%s)\n", file, line, static_cast<int>(sentence.size()),
               sentence.data(), condition);
  std::fflush(stderr);
  std::abort();
}

} // namespace godwit::runtime

// SENTENCE is a literal or a std::string; it is only built when the condition is false.
#define GODWIT_ASSERT(condition, sentence)                                                                             \
  ((condition) ? static_cast<void>(0) : ::godwit::runtime::assertion_failed(__FILE__, __LINE__, #condition, (sentence)))
