#include "actors/mapobjects_store/map_access.hpp"

namespace godwit::mapobjects_store {

map_result<void> map_access::add_page(load_page page, const page_stage::callback& done) {
  auto shared = std::make_shared<load_page>(std::move(page));
  return push(queued_job{.start = [shared, done](map_store&) -> std::unique_ptr<staged_work> {
                           return std::make_unique<page_stage>(std::move(*shared), done);
                         },
                         .dropped = [done](const map_error& error) { done(tl::unexpected(error)); }});
}

map_result<void> map_access::finish(const finish_load& asked, const load_finish::callback& done) {
  return push(queued_job{.start = [asked, done](map_store&) -> std::unique_ptr<staged_work> {
                           return std::make_unique<load_finish>(asked, done);
                         },
                         .dropped = [done](const map_error& error) { done(tl::unexpected(error)); }});
}

map_result<void> map_access::review(pass_end pass, const pass_review::callback& done) {
  const auto start = [pass = std::move(pass), done](map_store& store) -> std::unique_ptr<staged_work> {
    auto made = store.review(pass, done);
    if (made)
      return std::move(*made);
    done(tl::unexpected(std::move(made.error())));
    return nullptr;
  };
  return push(queued_job{.start = start, .dropped = [done](const map_error& error) { done(tl::unexpected(error)); }});
}

} // namespace godwit::mapobjects_store
