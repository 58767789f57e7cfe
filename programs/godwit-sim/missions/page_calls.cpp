#include "programs/godwit-sim/missions/page_calls.hpp"

#include "programs/godwit-sim/missions/pages.hpp"
#include "programs/godwit-sim/missions/problem_answer.hpp"

namespace godwit::sim::missions {
namespace {

answer page_answer(service_file& file, const call& at, page_kind kind) {
  auto body = page(file, at.mission, kind, at.to.next, at.to.limit);
  if (!body)
    return problem_answer(400, "This `next` is not known, or not any more: begin with the first page.");
  return {.body = *std::move(body), .headers = {}};
}

} // namespace

answer get_map_objects(service_file& file, const call& at) { return page_answer(file, at, page_kind::map_objects); }

answer get_ignored(service_file& file, const call& at) { return page_answer(file, at, page_kind::ignored_items); }

} // namespace godwit::sim::missions
