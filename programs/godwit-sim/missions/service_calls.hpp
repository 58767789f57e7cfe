// The calls of the missions service: what each of them reads from a request, does and answers.
#pragma once

#include <cstdint>
#include <string>

#include "actors/domain/mission/read.hpp"
#include "programs/godwit-sim/missions/answer_table.hpp"
#include "programs/godwit-sim/missions/exchange.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"
#include "programs/godwit-sim/missions/route.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

// A request on its way through the service: who may ask was looked at, and where it goes is known. Thread: values.
struct call {
  const request& asked;
  const route& to;
  const mission_row& mission; // is there, and not deleted; of get_next: none
  std::int64_t now_ns = 0;    // since 1970
};

using call_handler = answer (*)(service_file& file, const call& at);

// A POST that has its effect once, however often it comes.
//
// The key, the digest of the request, the answer and the change are one transaction. An answer that is no success has
// changed nothing, and is kept under the key all the same: who repeats a change that came too late is told so again.
// Errors: kept by the file; then nothing has changed and nothing is kept. Thread: the file's.
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

// The calls that pull the map, page by page. Errors: as answers; those of the file are kept by it. Thread: the file's.

[[nodiscard]] answer get_map_objects(service_file& file, const call& at);
[[nodiscard]] answer get_ignored(service_file& file, const call& at);

// The calls about the mission itself: fetching, deleting, inserting a waypoint, replacing its end.
//
// Errors: as answers; those of the file are kept by it. Thread: the file's.

[[nodiscard]] answer get_mission(service_file& file, const call& at);
// The first of all missions that is not deleted, complete or aborted, whoever asks. The body is empty when there is
// none; no_next then ends the wait.
[[nodiscard]] answer get_next(service_file& file, const call& at);
[[nodiscard]] answer no_next();
[[nodiscard]] answer remove_mission(service_file& file, const call& at);
[[nodiscard]] answer post_waypoint(service_file& file, const call& at);
[[nodiscard]] answer post_tail(service_file& file, const call& at);

// The calls about assignments: asking for them, and answering one.
//
// Errors: as answers; those of the file are kept by it. Thread: the file's.

// What there is now. The body is empty when that is nothing; empty_assignments then ends the wait.
[[nodiscard]] answer get_assignments(service_file& file, const call& at);
[[nodiscard]] answer empty_assignments();

[[nodiscard]] answer post_response(service_file& file, const call& at);

// The calls that deliver rows: progress reports, observations, ignored items. A batch is stored whole or not at all.
//
// Errors: as answers; those of the file are kept by it. Thread: the file's.

// The number of the last report.
[[nodiscard]] answer get_progress(service_file& file, const call& at);
[[nodiscard]] answer post_progress(service_file& file, const call& at);
[[nodiscard]] answer post_map_objects(service_file& file, const call& at);
[[nodiscard]] answer post_ignored(service_file& file, const call& at);
[[nodiscard]] answer post_picture(service_file& file, const call& at);

} // namespace godwit::sim::missions
