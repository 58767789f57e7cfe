// `godwitd operator add|passwd|token|remove|list`: who may talk to a godwitd from afar. It changes the file of
// accounts; a godwitd that runs sees the change within two seconds, and sessions of accounts that are gone or were
// changed end.
//
// Errors: a sentence on stderr, exit code 1 or 2. Thread: the main one; blocks.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/http/secret_file.hpp"
#include "messages/operator/principal.hpp"
#include "runtime/process.hpp"

namespace godwit::accounts {

enum class operator_act {
  add,    // asks for a password
  passwd, // the same
  token,  // of a program: prints a new one once; the one before is good for nothing then
  remove,
  list
};

struct operator_arguments {
  operator_act act = operator_act::list;
  std::string name;
  operators::role role = operators::role::viewer; // add
};

[[nodiscard]] runtime::exit_code run_operator(const operator_arguments& asked, const std::string& file);

// A password from who sits at the terminal, without showing it; or the first line of what is piped in. Never from the
// command line: others on the machine can read that.
//
// Errors: a sentence. Thread: the main one; blocks.

// At a terminal it is asked for twice.
[[nodiscard]] tl::expected<io::http::secret_text, std::string> ask_new_password(const std::string& name);

} // namespace godwit::accounts
