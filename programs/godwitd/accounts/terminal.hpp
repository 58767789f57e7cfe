// A password from who sits at the terminal, without showing it; or the first line of what is piped in. Never from the
// command line: others on the machine can read that.
//
// Errors: a sentence. Thread: the main one; blocks.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/http/secret_text.hpp"

namespace godwit::accounts {

// At a terminal it is asked for twice.
[[nodiscard]] tl::expected<io::http::secret_text, std::string> ask_new_password(const std::string& name);

} // namespace godwit::accounts
