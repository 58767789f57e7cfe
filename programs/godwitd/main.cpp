// godwitd: the onboard daemon. See `godwitd --help`.
#include "programs/godwitd/program.hpp"

int main(int argc, char** argv) { return godwit::daemon::run_program(argc, argv); }
