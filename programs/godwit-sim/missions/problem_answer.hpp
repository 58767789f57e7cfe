// Errors of the service as answers with a problem document. Thread: pure. Source: RFC 9457.
#pragma once

#include <string>
#include <vector>

#include "actors/domain/mission/error.hpp"
#include "programs/godwit-sim/missions/exchange.hpp"

namespace godwit::sim::missions {

// DETAIL: what a person is to read; of other people's texts only what in_quotes has made harmless.
[[nodiscard]] answer problem_answer(unsigned status, const std::string& detail,
                                    const std::vector<mission::document_problem>& places = {});

// What is wrong with a body: 400 when it is no JSON, 413 when it is too large, 422 for the rest.
[[nodiscard]] answer problem_answer(const mission::document_error& error);

// 422, and what is wrong is said at one place of the body.
[[nodiscard]] answer wrong_place(std::string pointer, std::string what, std::string allowed);

} // namespace godwit::sim::missions
