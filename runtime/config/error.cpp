#include "runtime/config/error.hpp"

namespace godwit::runtime {

namespace {

std::string sentence(const config_problem& problem) {
  std::string result = problem.path.empty() ? problem.what : problem.path + " " + problem.what;
  if (!problem.allowed.empty())
    result += "; allowed: " + problem.allowed;
  return result;
}

} // namespace

std::string config_error::message() const {
  std::string prefix = source;
  if (line != 0)
    prefix += ":" + std::to_string(line) + ":" + std::to_string(column);
  std::string result;
  for (const auto& problem : problems) {
    if (!result.empty())
      result += '\n';
    result += prefix + ": " + sentence(problem);
  }
  if (omitted != 0)
    result += "\n" + prefix + ": and " + std::to_string(omitted) + " further problems";
  return result;
}

} // namespace godwit::runtime
