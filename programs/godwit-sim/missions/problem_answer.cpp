#include "programs/godwit-sim/missions/problem_answer.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "actors/domain/mission/write.hpp"
#include "messages/mission/answer.hpp"

namespace godwit::sim::missions {
namespace {

// As in the schema of a problem.
constexpr std::size_t max_detail = 4000;
constexpr std::size_t max_place_text = 1000;
constexpr std::size_t max_places = 64;
// All places together: a vehicle reads 64 KiB of a problem, and characters may be escaped.
constexpr std::size_t max_places_bytes = 8 * 1024;

struct title_row {
  unsigned status;
  std::string_view title;
};

// RFC 9110, 15.
constexpr std::array titles{
    title_row{400, "Bad Request"},
    title_row{401, "Unauthorized"},
    title_row{403, "Forbidden"},
    title_row{404, "Not Found"},
    title_row{405, "Method Not Allowed"},
    title_row{408, "Request Timeout"},
    title_row{409, "Conflict"},
    title_row{410, "Gone"},
    title_row{413, "Content Too Large"},
    title_row{422, "Unprocessable Content"},
    title_row{429, "Too Many Requests"},
    title_row{431, "Request Header Fields Too Large"},
    title_row{500, "Internal Server Error"},
    title_row{502, "Bad Gateway"},
    title_row{503, "Service Unavailable"},
    title_row{504, "Gateway Timeout"},
};

std::string title_of(unsigned status) {
  const auto* const found = std::ranges::find(titles, status, &title_row::status);
  return found == titles.end() ? "Status " + std::to_string(status) : std::string(found->title);
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
