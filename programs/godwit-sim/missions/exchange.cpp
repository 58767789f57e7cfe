#include "programs/godwit-sim/missions/exchange.hpp"

#include <utility>

#include "actors/domain/mission/write.hpp"
#include "io/http/server/response_head.hpp"
#include "messages/mission/answer.hpp"

namespace godwit::sim::missions {

namespace {

// As in the schema of a problem.
constexpr std::size_t max_detail = 4000;
constexpr std::size_t max_place_text = 1000;
constexpr std::size_t max_places = 64;
// All places together: a vehicle reads 64 KiB of a problem, and characters may be escaped.
constexpr std::size_t max_places_bytes = 8 * 1024;

std::string title_of(unsigned status) {
  const auto phrase = io::http::reason_phrase(status);
  return phrase.empty() ? "Status " + std::to_string(status) : std::string(phrase);
}

// At most MAX bytes, and no half character at the end.
std::string cut(std::string text, std::size_t max) {
  if (text.size() <= max)
    return text;
  while (max > 0 && (static_cast<unsigned char>(text[max]) & 0xC0U) == 0x80U)
    --max;
  text.resize(max);
  return text;
}

} // namespace

answer problem_answer(unsigned status, const std::string& detail,
                      const std::vector<mission::document_problem>& places) {
  mission::problem problem;
  problem.type = "about:blank";
  problem.title = title_of(status);
  problem.status = static_cast<std::int32_t>(status);
  problem.detail = cut(detail, max_detail);
  std::size_t bytes = 0;
  for (const auto& each : places) {
    const auto allowed = each.allowed.empty() ? std::string() : "; allowed: " + each.allowed;
    mission::wrong_place place{cut(each.pointer, max_place_text), cut(each.what + allowed, max_place_text)};
    bytes += place.pointer.size() + place.detail.size();
    if (problem.errors.size() == max_places || bytes > max_places_bytes)
      break;
    problem.errors.push_back(std::move(place));
  }
  auto text = mission::to_text(problem);
  return {status, std::string(problem_type), std::move(text), {}};
}

answer problem_answer(const mission::document_error& error) {
  using mission::document_errc;
  if (error.code == document_errc::syntax)
    return problem_answer(400, "The body " + error.problems.front().what + ".");
  if (error.code == document_errc::too_large)
    return problem_answer(413, "The body " + error.problems.front().message() + ".");
  const auto count = error.problems.size() + error.omitted;
  const auto how_many = count == 1 ? std::string("1 place is wrong.") : std::to_string(count) + " places are wrong.";
  return problem_answer(422, how_many, error.problems);
}

answer wrong_place(std::string pointer, std::string what, std::string allowed) {
  return problem_answer(422, "1 place is wrong.", {{std::move(pointer), std::move(what), std::move(allowed)}});
}

} // namespace godwit::sim::missions
