#include "runtime/journal/error.hpp"

namespace godwit::runtime {

std::string journal_error::message() const { return "journal " + file + ": " + what + ". " + remedy; }

} // namespace godwit::runtime
