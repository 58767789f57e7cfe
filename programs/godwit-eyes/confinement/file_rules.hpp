// Which files this thread, and all that it begins, may still open: those that are named, and no others.
//
// What is not there now stays closed when it comes, and what is replaced under its name, too: a rule is about the file
// and not about its name. Symbolic links are followed once, now. Errors: a sentence. Thread: the one that is confined,
// before it begins others.
// Source: landlock(7), and the kernel's Documentation/userspace-api/landlock.rst (ABI 1 to 6).
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace godwit::eyes {

struct open_paths {
  std::vector<std::string> readable; // files and folders with all below them; programs there may be executed
  std::vector<std::string> writable; // the same, with making and removing
  std::vector<std::string> devices;  // read, written, asked
};

[[nodiscard]] tl::expected<void, std::string> allow_only(const open_paths& paths);

} // namespace godwit::eyes
