// What a program says to the shell when it ends. godwitd says more: runtime/process.hpp. Thread: a value.
#pragma once

namespace godwit::programs {

enum class exit_code : int {
  ok = 0,
  failed = 1, // it could not do what it was asked; the reason stands on stderr
  usage = 2,  // a mistake on the command line
};

} // namespace godwit::programs
