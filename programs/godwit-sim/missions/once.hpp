// A POST that has its effect once, however often it comes.
//
// The key, the digest of the request, the answer and the change are one transaction. An answer that is no success has
// changed nothing, and is kept under the key all the same: who repeats a change that came too late is told so again.
// Errors: kept by the file; then nothing has changed and nothing is kept. Thread: the file's.
#pragma once

#include <string>

#include "actors/domain/mission/read.hpp"
#include "programs/godwit-sim/missions/answer_table.hpp"
#include "programs/godwit-sim/missions/call.hpp"
#include "programs/godwit-sim/missions/problem_answer.hpp"

namespace godwit::sim::missions {

inline constexpr std::int64_t second_ns = 1'000'000'000;
inline constexpr unsigned first_failure = 300; // status

template <class Apply>
[[nodiscard]] answer once(service_file& file, const call& at, const std::string& key, const Apply& apply) {
  kept_answer given{digest_of(at.asked.method, at.to.path, at.asked.body), {}};
  file.begin();
  if (auto known = find_answer(file, key)) {
    if (known->digest != given.digest) {
      file.rollback();
      return wrong_place("/idempotency_key", "was used for another request", "a new key for each request");
    }
    count_replay(file, key);
    static_cast<void>(file.commit()); // who handles the request looks for errors of the file
    return std::move(known->what);
  }
  given.what = apply();
  if (given.what.status >= first_failure) {
    file.rollback();
    file.begin();
  }
  keep_answer(file, key, given, at.now_ns / second_ns);
  static_cast<void>(file.commit());
  return std::move(given.what);
}

// Reads the body as a BODY and has APPLY(body) done once.
template <class Body, class Apply>
[[nodiscard]] answer post_once(service_file& file, const call& at, const Apply& apply) {
  const auto body = mission::read<Body>(at.asked.body);
  if (!body)
    return problem_answer(body.error());
  return once(file, at, body->idempotency_key, [&] { return apply(*body); });
}

} // namespace godwit::sim::missions
