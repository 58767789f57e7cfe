#include "actors/mapobjects_store/map_writer.hpp"

#include "actors/mapobjects_store/map_access.hpp"
#include "io/sqlite/group_writer.hpp"

namespace godwit::mapobjects_store {

namespace {

map_writer_status status_of(const io::sqlite::writer_status& now) {
  const auto& error = now.counts.last_error;
  return {.failing = error.has_value(),
          .reason = error ? from_store(*error).message() : "",
          .commits = now.counts.commits,
          .changes = now.counts.written,
          .retries = now.counts.retries,
          .queued = now.queue.items,
          .fill = now.queue.fill};
}

map_error refused_work(io::sqlite::refusal why) {
  if (why == io::sqlite::refusal::closed)
    return {map_errc::closed, "the map is closed", {}};
  return {map_errc::full, "the writer of the map is late by its bound",
          "Look at its health: the disk is failing or too slow"};
}

} // namespace

struct map_writer::parts {
  parts(const map_writer_options& options, std::unique_ptr<map_store> store)
      : target(std::move(store), options.clock), writer({.queue = {.max_items = options.max_queued},
                                                         .group = {.max_items = options.max_group},
                                                         .retry = {options.retry_min, options.retry_max},
                                                         .close_timeout = options.close_timeout,
                                                         .clock = options.clock,
                                                         .on_health_change =
                                                             [this, told = options.on_health_change] {
                                                               if (told)
                                                                 told(status_of(writer.status()));
                                                             }},
                                                        target) {}

  map_target target;
  io::sqlite::group_writer<map_item> writer;
};

map_writer::map_writer(std::unique_ptr<parts> made) : parts_(std::move(made)) {}

map_result<std::unique_ptr<map_writer>> map_writer::open(const map_writer_options& options) {
  auto store = map_store::open(options.store);
  if (!store)
    return tl::unexpected(std::move(store.error()));
  auto made = std::make_unique<parts>(options, std::move(*store));
  if (options.own_thread)
    made->writer.start();
  return std::unique_ptr<map_writer>(new map_writer(std::move(made)));
}

map_writer::~map_writer() { close(); }

map_result<void> map_writer::push(queued_work item) {
  return parts_->writer.push({std::move(item)}).map_error(refused_work);
}

map_writer_status map_writer::status() const { return status_of(parts_->writer.status()); }

void map_writer::run_once() { parts_->writer.run_once(); }

void map_writer::close() { parts_->writer.close(); }

} // namespace godwit::mapobjects_store
