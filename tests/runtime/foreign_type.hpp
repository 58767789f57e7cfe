// A type that a shared object defines once more, under a name that the program knows: what a plug-in that was built
// against other headers would send.
#pragma once

#include "runtime/envelope.hpp"

extern "C" {
// An envelope with a `test.add` of the shared object's own.
void godwit_make_foreign_add(godwit::runtime::envelope* made);
}
