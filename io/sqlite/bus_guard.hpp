// A page of a mapped file that is not there any more is no reason to die.
//
// SQLite maps PATH-shm, the index of its log. When somebody cuts that file the next look at it is a SIGBUS, which ends
// a process. Instead the page is replaced by an empty one and the error is counted. What is read from then on may be
// wrong: whoever sees the count rise must commit nothing more to that file (io/sqlite/file_watch.hpp says which it is).
// Other causes of SIGBUS end the process as ever. Thread: any; the first call installs the handler, for good.
// Source: sigaction(2), SIGBUS with BUS_ADRERR; mmap(2).
#pragma once

#include <cstdint>

namespace godwit::io::sqlite {

void guard_against_bus_errors();
[[nodiscard]] std::uint64_t bus_errors(); // so far

} // namespace godwit::io::sqlite
