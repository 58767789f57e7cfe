// Which calls of the kernel this thread, and all that it begins, may still make: those with which one process reaches
// into another of the same user are refused, and so are the ways around the rules for files.
//
// Refused calls fail (EACCES, EPERM), and end nothing. Errors: a sentence. Thread: the one that is confined, before it
// begins others. Source: seccomp(2), and the kernel's Documentation/userspace-api/seccomp_filter.rst.
#pragma once

#include <string>

#include <tl/expected.hpp>

namespace godwit::eyes {

// USES_NETWORK: sockets of the Internet stay.
[[nodiscard]] tl::expected<void, std::string> refuse_calls(bool uses_network);

} // namespace godwit::eyes
