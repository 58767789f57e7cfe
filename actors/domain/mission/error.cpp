#include "actors/domain/mission/error.hpp"

#include <algorithm>

namespace godwit::mission {

std::string document_problem::message() const {
  auto result = pointer.empty() ? "the document " + what : pointer + ' ' + what;
  return allowed.empty() ? result : result + "; allowed: " + allowed;
}

std::string document_error::message() const {
  std::string result;
  for (const auto& problem : problems)
    result += (result.empty() ? "" : "\n") + problem.message();
  if (omitted != 0)
    result += "\nand " + std::to_string(omitted) + " further problems";
  return result;
}

document_error bounded(document_error error, std::string_view text) {
  if (error.problems.size() > max_document_problems) {
    error.omitted += error.problems.size() - max_document_problems;
    error.problems.resize(max_document_problems);
  }
  error.sample = text.substr(0, max_document_sample);
  return error;
}

std::string pointer_to(std::string_view parent, std::string_view key) {
  auto result = std::string(parent) + '/';
  for (const auto each : key.substr(0, io::schemas::longest_quote))
    result += each == '~' ? "~0" : each == '/' ? "~1" : std::string(1, each);
  return result;
}

std::string pointer_to(std::string_view parent, std::size_t index) {
  return std::string(parent) + '/' + std::to_string(index);
}

} // namespace godwit::mission
