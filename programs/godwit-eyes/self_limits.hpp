// What godwit-eyes takes from itself before it does anything: memory beyond a bound, and any claim to it in need.
//
// It decodes what strangers send, in the cgroup of godwitd's unit, and a decoder can be made to ask for gigabytes. With
// the bound such a decoder fails, or ends the helper, which is started again; and should the whole unit have too
// little, the kernel ends the helper and not godwitd. posix_spawn can set neither, so the helper does. Thread: the
// first, before others. Source: setrlimit(2) (RLIMIT_DATA), proc(5) (oom_score_adj).
#pragma once

#include <cstddef>

namespace godwit::eyes {

// Private memory that can be written: heap, pictures, stacks of threads. Measured: docs/performance.md. The unit has 1
// GiB for both programs.
inline constexpr std::size_t max_memory_bytes = std::size_t{640} * 1024 * 1024;

// The sentence: what could not be done; null: nothing.
[[nodiscard]] const char* limit_own_memory();

} // namespace godwit::eyes
