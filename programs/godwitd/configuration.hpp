// The configuration that counts: command line over environment over file over defaults.
//
// Errors: sentences that name the option, the variable or the place in the file. A variable that begins with GODWIT_
// and that nobody knows is an error too: whoever mistypes GODWIT_TOKEN_FILE would else look for the mistake at the
// service. Thread: pure, but for reading the file.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

namespace godwit::daemon {

// By the name of the option or variable. A flag that was given is "true".
using given_texts = std::map<std::string, std::string, std::less<>>;

// Complete, and valid by config/godwit.schema.json.
[[nodiscard]] tl::expected<nlohmann::json, std::string> effective_configuration(const given_texts& command_line,
                                                                                const given_texts& environment);

// The variables of this process that begin with GODWIT_.
[[nodiscard]] given_texts godwit_variables();

} // namespace godwit::daemon
