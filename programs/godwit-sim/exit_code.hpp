// What godwit-sim says to the shell when it ends; the same numbers as in all programs of godwit. Thread: a value.
#pragma once

namespace godwit::sim {

enum class exit_code : int {
  ok = 0,
  failed = 1, // it could not do what it was asked; the reason stands on stderr
  usage = 2,  // a mistake on the command line
};

} // namespace godwit::sim
