#include "actors/executor/preflight/checks/actors.hpp"

#include <string>

namespace godwit::executor::preflight {

namespace {

std::string names_of_missing(const std::vector<actor_fact>& all) {
  std::string result;
  for (const auto& each : all)
    if (!each.is_running)
      result += (result.empty() ? "" : ", ") + each.name;
  return result;
}

} // namespace

result look_at_actors(const facts& seen, const settings&) {
  if (seen.actors.empty())
    return fail("It is not known which parts of the program run; wait until they have started.");
  const auto missing = names_of_missing(seen.actors);
  if (!missing.empty())
    return fail("Parts of the program do not run: " + missing + "; the log says why. Start the program again.");
  return pass("All parts of the program run.");
}

} // namespace godwit::executor::preflight
