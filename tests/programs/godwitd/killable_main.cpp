// godwitd that dies at a commit, with somebody on board who inserts a waypoint:
// `godwitd-killable before|after NUMBER ARGUMENTS OF GODWITD...`.
#include <cstdlib>
#include <string_view>

#include "programs/godwitd/program.hpp"
#include "tests/programs/godwitd/commit_killer.hpp"
#include "tests/programs/godwitd/inserter.hpp"

int main(int argc, char** argv) {
  using namespace godwit;
  if (argc < 3)
    return EXIT_FAILURE;
  const auto where = std::string_view(argv[1]) == "before" ? test::kill_place::before : test::kill_place::after;
  test::install_commit_killer(where, std::atoll(argv[2]));
  return daemon::run_program(argc - 2, argv + 2, [](daemon::composition& made) {
    made.host().actors().add<test::inserter>({.name = "inserter"}, {}, made.client(), made.mission_id());
  });
}
