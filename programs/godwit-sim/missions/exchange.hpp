// A request and its answer, as they are without the wire. Thread: plain values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "actors/domain/mission/error.hpp"
#include "io/http/server/response_head.hpp"

namespace godwit::sim::missions {

inline constexpr std::string_view json_type = "application/json";
using io::http::problem_type;

struct request {
  std::string method;        // "GET"
  std::string target;        // path and query, as they came
  std::string authorization; // the whole header; empty: none
  std::string content_type;  // of the body
  std::string body;
  std::string accept_encoding = {};
};

using answer = io::http::server_response;

// Errors of the service as answers with a problem document. Thread: pure. Source: RFC 9457.

// DETAIL: what a person is to read; of other people's texts only what in_quotes has made harmless.
[[nodiscard]] answer problem_answer(unsigned status, const std::string& detail,
                                    const std::vector<mission::document_problem>& places = {});

// What is wrong with a body: 400 when it is no JSON, 413 when it is too large, 422 for the rest.
[[nodiscard]] answer problem_answer(const mission::document_error& error);

// 422, and what is wrong is said at one place of the body.
[[nodiscard]] answer wrong_place(std::string pointer, std::string what, std::string allowed);

} // namespace godwit::sim::missions
