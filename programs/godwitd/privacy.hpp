// Keys and the token lie in memory: what is written of it, or made by it, is for this user alone.
//
// No core dump, no debugger of the same user, and files and folders that are made belong to this user alone. Thread:
// the first, before any other. Source: prctl(2), PR_SET_DUMPABLE; core(5); umask(2).
#pragma once

namespace godwit::daemon {

void keep_memory_private();

} // namespace godwit::daemon
